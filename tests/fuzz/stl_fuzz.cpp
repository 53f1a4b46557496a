// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/mesh_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A binary facet of 50 bytes makes three corners, at most three vertices and a polygon.
  plumbline::fuzz::fuzz_mesh(data, size, "a.stl", 1);
  return 0;
}
