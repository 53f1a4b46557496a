// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/whole_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>
#include <vector>

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
  std::error_code ignored;
  std::vector<std::filesystem::path> missing;  // deepest first
  for (std::filesystem::path part = folder; !part.empty() && !std::filesystem::exists(part, ignored);
       part = part.parent_path()) {
    missing.push_back(part);
  }
  const std::filesystem::path probe = folder / ".plumbline-probe";
  write_whole_file(probe, "");
  std::filesystem::remove(probe, ignored);
  // Whether the work will be refused for another reason is not known yet: then nothing may be left behind.
  for (const std::filesystem::path& part : missing) std::filesystem::remove(part, ignored);
}

}  // namespace plumbline
