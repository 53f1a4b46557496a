// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/shipped.h"

#include <system_error>

namespace plumbline::cli {
namespace {

std::filesystem::path& share_set() {
  static std::filesystem::path share;
  return share;
}

}  // namespace

void set_share(const std::filesystem::path& share) { share_set() = share; }

std::filesystem::path shipped(const std::filesystem::path& relative) {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path beside = program.parent_path().parent_path() / "share" / "plumbline";
  return (std::filesystem::exists(beside, error) ? beside : share_set()) / relative;
}

}  // namespace plumbline::cli
