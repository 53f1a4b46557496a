// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/mesh_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A polygon's shortest line has two bytes, and so has a corner.
  plumbline::fuzz::fuzz_mesh(data, size, "a.off", 1);
  return 0;
}
