// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// O1 on the full mesh of a 1025² terrain (2 097 152 triangles), against its floor (bucket the edges by their
// smaller vertex with a counting sort, and match twins) and against CGAL's does_self_intersect, in the same
// run. One thread. Aims: at most 2.5 × the floor; at least 50 × faster than CGAL.
#include <algorithm>
#include <map>
#include <string>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "oracle/conformity.h"
#include "scenarios/terrain.h"
#include "tests/bench/hills.h"

namespace plumbline {
namespace {

using bench::hills;
using bench::kSide;

struct Input {
  Mesh mesh;
  PlanDomain domain;
};
const Input& full_mesh() {
  static const Input input = [] {
    const Terrain terrain = hills();
    return Input{reference_mesh(terrain), full_domain(terrain)};
  }();
  return input;
}

/// Every triangle with vertices of its own, as an STL file has them.
const Input& soup() {
  static const Input input = [] {
    Input s{{}, full_mesh().domain};
    for (const auto& corners : full_mesh().mesh.triangles) {
      const auto v = static_cast<std::uint32_t>(s.mesh.positions.size());
      for (const std::uint32_t c : corners) s.mesh.positions.push_back(full_mesh().mesh.positions[c]);
      s.mesh.triangles.push_back({v, v + 1, v + 2});
    }
    return s;
  }();
  return input;
}

/// The floor: nothing but the edges. Returns how many have no twin.
std::size_t bucket_and_match(const Mesh& mesh) {
  const std::size_t vertex_count = mesh.positions.size();
  std::vector<std::uint32_t> starts(vertex_count + 2, 0);
  const auto each = [&mesh](auto&& visit) {
    for (const auto& [a, b, c] : mesh.triangles) {
      visit(a, b);
      visit(b, c);
      visit(c, a);
    }
  };
  each([&](std::uint32_t u, std::uint32_t v) { ++starts[std::min(u, v) + 2]; });
  for (std::size_t v = 2; v < starts.size(); ++v) starts[v] += starts[v - 1];
  std::vector<std::uint32_t> larger(starts.back());
  each([&](std::uint32_t u, std::uint32_t v) { larger[starts[std::min(u, v) + 1]++] = std::max(u, v); });
  std::size_t single = 0;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    for (std::uint32_t i = starts[v]; i < starts[v + 1]; ++i) {
      std::size_t twins = 0;
      for (std::uint32_t j = starts[v]; j < starts[v + 1]; ++j) twins += larger[j] == larger[i];
      single += twins == 1;
    }
  }
  return single;
}

void Floor(benchmark::State& state) {
  for (auto _ : state) {
    const std::size_t single = bucket_and_match(full_mesh().mesh);
    if (single != 4 * (kSide - 1)) state.SkipWithError("the floor miscounts the border");
  }
}

void Conformity(benchmark::State& state) {
  for (auto _ : state) {
    if (!oracle::check_conformity(full_mesh().mesh, full_mesh().domain).clean())
      state.SkipWithError("not clean");
  }
}

void ConformityOfOneDroppedTriangle(benchmark::State& state) {
  Input input = full_mesh();
  input.mesh.triangles.erase(input.mesh.triangles.begin() + 1000001);
  for (auto _ : state) {
    if (oracle::check_conformity(input.mesh, input.domain).counts.hole != 1) state.SkipWithError("no hole");
  }
}

void ConformityOfOneFlippedTriangle(benchmark::State& state) {
  Input input = full_mesh();
  std::swap(input.mesh.triangles[1000001][0], input.mesh.triangles[1000001][1]);
  for (auto _ : state) {
    if (oracle::check_conformity(input.mesh, input.domain).counts.fold_over != 1)
      state.SkipWithError("no fold");
  }
}

void ConformityOfASoup(benchmark::State& state) {
  for (auto _ : state) {
    if (!oracle::check_conformity(soup().mesh, soup().domain).clean()) state.SkipWithError("not clean");
  }
}

void CgalDoesSelfIntersect(benchmark::State& state) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  using Vertex = CGAL::Surface_mesh<Kernel::Point_3>::Vertex_index;
  for (const Vec3& p : full_mesh().mesh.positions) surface.add_vertex({p.x, p.y, p.z});
  for (const auto& [a, b, c] : full_mesh().mesh.triangles) surface.add_face(Vertex(a), Vertex(b), Vertex(c));
  for (auto _ : state) {
    if (CGAL::Polygon_mesh_processing::does_self_intersect(surface)) state.SkipWithError("intersects");
  }
}

BENCHMARK(Floor)->Unit(benchmark::kMillisecond)->MinTime(1);
BENCHMARK(Conformity)->Unit(benchmark::kMillisecond)->MinTime(1);
BENCHMARK(ConformityOfOneDroppedTriangle)->Unit(benchmark::kMillisecond);
BENCHMARK(ConformityOfOneFlippedTriangle)->Unit(benchmark::kMillisecond);
BENCHMARK(ConformityOfASoup)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(CgalDoesSelfIntersect)->Unit(benchmark::kMillisecond)->Iterations(1);

/// Prints as usual, and remembers the times.
class Remember : public benchmark::ConsoleReporter {
 public:
  void ReportRuns(const std::vector<Run>& runs) override {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) cpu_ms[run.run_name.function_name] = run.GetAdjustedCPUTime();
  }
  std::map<std::string, double> cpu_ms;
};

}  // namespace
}  // namespace plumbline

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  plumbline::Remember reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  const auto& ms = reporter.cpu_ms;
  if (!ms.contains("Floor") || !ms.contains("Conformity")) return 0;  // a filter left them out
  const double ours = ms.at("Conformity");
  fmt::print("conformity / floor: {:.2f} (aim: at most 2.5)\n", ours / ms.at("Floor"));
  if (ms.contains("CgalDoesSelfIntersect")) {
    fmt::print("CGAL does_self_intersect / conformity: {:.0f} (aim: at least 50)\n",
               ms.at("CgalDoesSelfIntersect") / ours);
  }
  return 0;
}
