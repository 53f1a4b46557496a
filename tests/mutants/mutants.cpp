// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Prints the table of docs/mutants.md. With names: only these, and what was found.
#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "tests/mutants/hunt.h"

int main(int argc, char** argv) {
  using namespace plumbline::mutants;
  if (argc == 1) {
    fmt::print("{}", mutant_table());
    return 0;
  }
  const std::string_view first = argv[1];
  if (first == "--clean") {
    for (int k = 2; k < argc; ++k) {
      for (const std::string& line : judge_unmutated(argv[k])) fmt::print("{}: {}\n", argv[k], line);
    }
    return 0;
  }
  int survived = 0;
  for (const Mutant& mutant : mutant_list()) {
    if (std::none_of(argv + 1, argv + argc, [&](const char* name) { return mutant.name.starts_with(name); }))
      continue;
    const auto kill = hunt(mutant);
    survived += kill ? 0 : 1;
    fmt::print("{:<32} {}\n", mutant.name,
               kill ? fmt::format("{} after {} cases: {}", kill->by, kill->cases, kill->what) : "SURVIVED");
    std::fflush(stdout);
  }
  return survived == 0 ? 0 : 1;
}
