// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/whole_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "scenarios/error.h"

namespace plumbline {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError(
      fmt::format("cannot write {}: {}; choose a place that can be written", path.string(), why));
}

}  // namespace

void write_whole_file(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code error;
  if (path.has_parent_path()) {
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) refuse(path, error.message());
  }
  // The process id keeps two programs writing the same report from sharing a temporary file.
  std::filesystem::path temporary = path;
  temporary += fmt::format(".{}.part", static_cast<long>(::getpid()));
  std::FILE* file = std::fopen(temporary.c_str(), "wb");
  if (file == nullptr) refuse(path, std::strerror(errno));
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const int write_error = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written || !closed) {
    const int cause = written ? errno : write_error;
    std::filesystem::remove(temporary, error);
    refuse(path, std::strerror(cause));
  }
  std::filesystem::rename(temporary, path, error);
  if (error) {
    const std::string why = error.message();
    std::filesystem::remove(temporary, error);
    refuse(path, why);
  }
}

void require_writable(const std::filesystem::path& folder) {
  const std::filesystem::path probe = folder / ".plumbline-probe";
  write_whole_file(probe, "");
  std::error_code ignored;
  std::filesystem::remove(probe, ignored);
}

}  // namespace plumbline
