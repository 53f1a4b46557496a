// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// .gltf and .glb alike: the container tells itself by its first bytes. Buffers in files of their own are
// refused.
#include "tests/fuzz/mesh_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  plumbline::fuzz::fuzz_mesh(data, size, "a.gltf", 64);
  return 0;
}
