// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// .gltf and .glb alike: the container tells itself by its first bytes. Buffers in files of their own are
// refused.
#include "tests/fuzz/mesh_fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // 16 vertices and corners per byte read, and a polygon per three corners; a buffer in base64 is read again.
  plumbline::fuzz::fuzz_mesh(data, size, "a.gltf", 38, 64);
  return 0;
}
