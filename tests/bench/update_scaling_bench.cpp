// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Does the cost of a frame follow the picture or the terrain? The same budget of about 20 000 triangles on
// terrains of 513², 1025², 2049² and 4097² samples: nanoseconds of a coherent update per output triangle, and
// the greatest over the least of the four. The floor, copying the frame's mesh, is printed beside it.
// --brief: 129² and 257², few repetitions.
#include <map>

#include <fmt/format.h>

#include "tests/bench/update_support.h"

int main(int count, char** arguments) {
  using namespace plumbline::bench;
  const bool brief = count > 1 && std::string(arguments[1]) == "--brief";
  const std::vector<int> sides = brief ? std::vector{129, 257} : std::vector{513, 1025, 2049, 4097};

  std::vector<std::string> methods;
  for (const std::string& id : all_method_ids()) {
    // A method that always draws everything has no budget to keep.
    if (!plumbline::find_method(id).promises(plumbline::Promise::threshold_blind)) methods.push_back(id);
  }
  std::map<std::string, std::vector<UpdateCost>> costs;
  for (const int side : sides) {  // terrain by terrain: only one is held at a time
    const plumbline::Terrain terrain = fractal_terrain(side);
    const std::vector<plumbline::Camera> flight = short_flight(terrain);
    for (const std::string& id : methods) {
      const auto method = plumbline::make_method(id);
      method->prepare(terrain);
      method->set_threshold_px(threshold_for_budget(*method, flight.front()));
      costs[id].push_back(time_updates(*method, flight, repetitions_of(id, brief ? 2 : 15)));
    }
  }

  fmt::print("ns per triangle; in brackets: of copying the mesh\n{:<28}", "method");
  for (const int side : sides) fmt::print("{:>18}", fmt::format("{}²", side));
  fmt::print("{:>18}\n", "greatest / least");
  for (const std::string& id : methods) {
    fmt::print("{:<28}", id);
    double least = std::numeric_limits<double>::infinity(), greatest = 0;
    for (const UpdateCost& cost : costs[id]) {
      const double ns = cost.update_s * 1e9 / cost.triangles;
      least = std::min(least, ns);
      greatest = std::max(greatest, ns);
      fmt::print("{:>18}", fmt::format("{:.1f} ({:.2f})", ns, cost.copy_s * 1e9 / cost.triangles));
    }
    fmt::print("{:>18.2f}\n", greatest / least);
  }
  return 0;
}
