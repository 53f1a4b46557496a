// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// mutants            prints the table of docs/mutants.md
// mutants NAME…      only those whose names begin so, each with what was found
#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "tests/mutants/hunt.h"

int main(int argc, char** argv) {
  using namespace plumbline::mutants;
  if (argc == 1) {
    fmt::print("{}", mutant_table());
    return 0;
  }
  bool some = false, all_found = true;
  for (const Mutant& mutant : mutant_list()) {
    if (std::none_of(argv + 1, argv + argc, [&](const char* name) { return mutant.name.starts_with(name); }))
      continue;
    some = true;
    const auto kill = hunt(mutant);
    all_found = all_found && kill;
    fmt::print("{}: {}\n", mutant.name,
               kill ? fmt::format("{} after {} cases: {}", kill->by, kill->cases, kill->what) : "survived");
    std::fflush(stdout);
  }
  if (!some) fmt::print(stderr, "mutants: no name begins so; see tests/mutants/mutant_list.cpp\n");
  return some && all_found ? 0 : 1;
}
