// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The main of a fuzz target without a fuzzer: runs it on the files named and on all below the folders named.
// A fault ends the program as it would end the fuzzer; no input at all is a fault, too.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

std::vector<std::filesystem::path> inputs(int count, char** names) {
  namespace fs = std::filesystem;
  std::vector<fs::path> files;
  for (int k = 1; k < count; ++k) {
    if (!fs::is_directory(names[k])) {
      files.emplace_back(names[k]);
      continue;
    }
    const auto first = static_cast<std::ptrdiff_t>(files.size());
    for (const auto& entry : fs::recursive_directory_iterator(names[k])) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
    std::sort(files.begin() + first, files.end());
  }
  return files;
}

}  // namespace

int main(int count, char** names) {
  try {
    const auto files = inputs(count, names);
    for (const auto& file : files) {
      fmt::print(stderr, "{}\n", file.string());  // before it runs: the last line names the culprit
      std::ifstream in(file, std::ios::binary);
      if (!in) {
        fmt::print(stderr, "cannot be read\n");
        return 2;
      }
      const std::string bytes{std::istreambuf_iterator<char>(in), {}};
      // A copy of just this size, so that a sanitizer sees the first byte read behind it.
      const std::vector<std::uint8_t> exact(bytes.begin(), bytes.end());
      LLVMFuzzerTestOneInput(exact.data(), exact.size());
    }
    fmt::print("{} inputs replayed\n", files.size());
    return files.empty() ? 2 : 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "not an InputError: {}\n", error.what());
    return 1;
  }
}
