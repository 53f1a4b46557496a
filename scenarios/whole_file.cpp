// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/whole_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
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

/// `path` is what messages speak of.
void write_to(const std::filesystem::path& place, const std::filesystem::path& path, std::string_view bytes) {
  std::FILE* file = std::fopen(place.c_str(), "wb");
  if (file == nullptr) refuse(path, std::strerror(errno));
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  const int write_error = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written || !closed) refuse(path, std::strerror(written ? errno : write_error));
}

}  // namespace

std::string read_whole_file(const std::filesystem::path& path, std::string_view what) {
  const std::string name = one_line(path.string());
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (std::filesystem::is_directory(status))
    throw InputError(fmt::format("{}: is a folder, not {}", name, what));
  // Some devices never end.
  if (std::filesystem::is_character_file(status) || std::filesystem::is_block_file(status))
    throw InputError(fmt::format("{}: is a device, not {}", name, what));
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw InputError(fmt::format("cannot read {}: no such file, or no permission", name));
  std::string bytes;
  if (std::filesystem::is_regular_file(status)) {
    const auto size = std::filesystem::file_size(path, error);
    if (!error) bytes.resize(static_cast<std::size_t>(size));
  }
  std::size_t have = std::fread(bytes.data(), 1, bytes.size(), file.get());
  // A pipe states no size, and a file may have grown.
  for (std::size_t step = std::size_t{1} << 16U;; step *= 2) {
    bytes.resize(have + step);
    const std::size_t more = std::fread(bytes.data() + have, 1, step, file.get());
    have += more;
    if (more == 0) break;
  }
  if (std::ferror(file.get()) != 0)
    throw InputError(fmt::format("cannot read {}: {}", name, std::strerror(errno)));
  bytes.resize(have);
  return bytes;
}

void write_whole_file(const std::filesystem::path& named, std::string_view bytes) {
  std::error_code error;
  // A link keeps pointing at what it names; a device or a pipe is written to, not replaced by a file.
  std::filesystem::path path = named;
  if (std::filesystem::is_symlink(named, error)) {
    const auto target = std::filesystem::canonical(named, error);
    if (!error) path = target;
  }
  const auto status = std::filesystem::status(path, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
      !std::filesystem::is_directory(status)) {
    write_to(path, path, bytes);
    return;
  }
  if (path.has_parent_path()) {
    std::filesystem::create_directories(path.parent_path(), error);
    if (error) refuse(path, error.message());
  }
  // The process id keeps two programs writing the same report from sharing a temporary file.
  std::filesystem::path temporary = path;
  temporary += fmt::format(".{}.part", static_cast<long>(::getpid()));
  try {
    write_to(temporary, path, bytes);
  } catch (...) {
    std::filesystem::remove(temporary, error);
    throw;
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

void require_writable_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (std::filesystem::is_directory(status)) refuse(file, "it is a folder");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    return;  // a device, a pipe
  require_writable(file.has_parent_path() ? file.parent_path() : std::filesystem::path("."));
}

}  // namespace plumbline
