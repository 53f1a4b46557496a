// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/mesh_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A list's length of one byte makes a polygon, an index of one byte a corner, three bytes a vertex.
  plumbline::fuzz::fuzz_mesh(data, size, "a.ply", 1);
  return 0;
}
