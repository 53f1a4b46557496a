// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Result files as `plumbline compare` reads them, held against themselves.
#include <cstdint>

#include "properties/compare/compare.h"
#include "tests/fuzz/fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace plumbline;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto read = [&](const char* name) {
    return fuzz::accepted([&] { return compare::parse_result(text, name); });
  };
  const auto before = read("a.json"), after = read("b.json");
  fuzz::require(before.has_value() == after.has_value(), "a second reading comes to the same verdict");
  if (!before) return 0;
  fuzz::require(before->subjects.size() + before->gates.size() + before->findings.size() <= size,
                "what is kept is bounded by the file's size");
  const verdict::Comparison same = compare::compare_results(*before, *after);
  fuzz::require(same.differences.empty() && same.word() == "unchanged", "a file is like itself");
  return 0;
}
