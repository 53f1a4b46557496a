// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// meshoptimizer_debian INPUT OUTPUT: Debian's meshoptimizer beside npm's (simplified.mjs). Both files are
// raw, this machine's byte order; INPUT: vertices, indices, target indices, lock the border?; then floats,
// indices. Prints the error that the library reports, in metres.
#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <vector>

#include <meshoptimizer.h>

namespace {

template <typename T>
bool fill(std::ifstream& file, T* data, std::size_t count) {
  return static_cast<bool>(
      file.read(reinterpret_cast<char*>(data), static_cast<std::streamsize>(count * sizeof(T))));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fputs("usage: meshoptimizer_debian INPUT OUTPUT\n", stderr), 2;
  std::ifstream input(argv[1], std::ios::binary);
  std::array<std::uint32_t, 4> head{};
  if (!fill(input, head.data(), head.size())) return std::fputs("no header\n", stderr), 2;
  std::vector<float> positions(std::size_t{3} * head[0]);
  std::vector<unsigned int> indices(head[1]);
  if (!fill(input, positions.data(), positions.size()) || !fill(input, indices.data(), indices.size()))
    return std::fputs("the file ends early\n", stderr), 2;
  constexpr std::size_t kStride = 3 * sizeof(float);
  std::vector<unsigned int> kept(indices.size());
  float error = 0;
  kept.resize(meshopt_simplify(kept.data(), indices.data(), indices.size(), positions.data(), head[0],
                               kStride, head[2], 1.0F, head[3] != 0 ? meshopt_SimplifyLockBorder : 0,
                               &error));
  std::ofstream(argv[2], std::ios::binary)
      .write(reinterpret_cast<const char*>(kept.data()),
             static_cast<std::streamsize>(kept.size() * sizeof(unsigned int)));
  std::printf("%.9g\n",
              static_cast<double>(error) * meshopt_simplifyScale(positions.data(), head[0], kStride));
}
