// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/mesh_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // The shortest line, "f\n", makes a polygon of two bytes.
  plumbline::fuzz::fuzz_mesh(data, size, "a.obj", 1);
  return 0;
}
