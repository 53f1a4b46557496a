// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// M5 on the measuring instrument (86 802 triangles): building the vertex tree down to the paper's 5 381,
// against two libraries that bring the same mesh to the same number in the same run, CGAL's edge collapse
// (Lindstrom and Turk) and meshoptimizer's simplify, each timed without the conversion of its input and
// output. Then collapses and splits a second on the finished tree.
// --brief: one repetition.
#include <algorithm>
#include <ctime>
#include <memory>
#include <string>
#include <vector>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Count_stop_predicate.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <fmt/format.h>
#include <meshoptimizer.h>

#include "algorithms/vertex_tree/cut.h"
#include "scenarios/instrument.h"
#include "scenarios/random.h"

namespace plumbline::bench {
namespace {

constexpr std::size_t kLeast = 5381;  // paper 004, figure 10

/// Processor time of this thread: what the work costs, whatever else the machine is doing.
template <class Call>
double cpu_seconds(Call&& call) {
  const auto now = [] {
    std::timespec t{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec) * 1e-9;
  };
  const double start = now();
  call();
  return now() - start;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Timed {
  double seconds = 0;
  std::size_t triangles = 0;
};

Timed time_tree(const Mesh& mesh, std::shared_ptr<const vertex_tree::VertexTree>& tree) {
  Timed out;
  out.seconds = cpu_seconds([&] {
    tree = std::make_shared<const vertex_tree::VertexTree>(
        vertex_tree::build_tree(mesh, {.least_triangles = kLeast}));
  });
  vertex_tree::Cut cut(tree);
  cut.coarsen(0);
  out.triangles = cut.triangle_count();
  return out;
}

Timed time_cgal(const Mesh& mesh) {
  using Surface = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
  Surface surface;
  for (const Vec3& p : mesh.positions) surface.add_vertex({p.x, p.y, p.z});
  for (const auto& [a, b, c] : mesh.triangles)
    surface.add_face(Surface::Vertex_index(a), Surface::Vertex_index(b), Surface::Vertex_index(c));
  // Its stop counts edges: three for two triangles of a closed mesh.
  const CGAL::Surface_mesh_simplification::Count_stop_predicate<Surface> stop(kLeast * 3 / 2);
  Timed out;
  out.seconds = cpu_seconds([&] { CGAL::Surface_mesh_simplification::edge_collapse(surface, stop); });
  out.triangles = surface.number_of_faces();
  return out;
}

Timed time_meshopt(const Mesh& mesh) {
  std::vector<unsigned> indices, fewer(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles) indices.insert(indices.end(), t.begin(), t.end());
  std::vector<float> floats;
  for (const Vec3& p : mesh.positions) {
    for (const double x : {p.x, p.y, p.z}) floats.push_back(static_cast<float>(x));
  }
  Timed out;
  out.seconds = cpu_seconds([&] {
    out.triangles =
        meshopt_simplify(fewer.data(), indices.data(), indices.size(), floats.data(), mesh.positions.size(),
                         3 * sizeof(float), 3 * kLeast, 1e10F, 0, nullptr) /
        3;
  });
  return out;
}

void print(const char* name, std::vector<Timed> runs, double floor_s) {
  std::vector<double> seconds;
  for (const Timed& run : runs) seconds.push_back(run.seconds);
  const double middle = median(seconds);
  fmt::print("{:<34}{:>10.1f}{:>12}{:>12.2f}\n", name, middle * 1e3, runs[0].triangles, floor_s / middle);
}

}  // namespace
}  // namespace plumbline::bench

int main(int count, char** arguments) {
  using namespace plumbline;
  using namespace plumbline::bench;
  const bool brief = count > 1 && std::string(arguments[1]) == "--brief";
  const int repetitions = brief ? 1 : 5;
  const Mesh mesh = instrument_mesh();

  std::shared_ptr<const vertex_tree::VertexTree> tree;
  std::vector<Timed> ours, cgal, meshopt;
  for (int k = 0; k < repetitions; ++k) {  // in turn: a busy spell of the machine meets all three
    ours.push_back(time_tree(mesh, tree));
    cgal.push_back(time_cgal(mesh));
    meshopt.push_back(time_meshopt(mesh));
  }
  std::vector<double> seconds;
  for (const Timed& run : ours) seconds.push_back(run.seconds);
  const double build_s = median(seconds);
  fmt::print("{} triangles to {}\n{:<34}{:>10}{:>12}{:>12}\n", mesh.triangles.size(), kLeast, "", "ms",
             "triangles", "build / it");
  print("vertex_tree, build", ours, build_s);
  print("CGAL edge collapse", cgal, build_s);
  print("meshoptimizer simplify", meshopt, build_s);

  // All the way down and up, in the ladder's order; then single steps at random places half way.
  vertex_tree::Cut cut(tree);
  std::size_t collapses = 0, splits = 0;
  double down_s = 0, up_s = 0;
  for (int k = 0; k < repetitions; ++k) {
    down_s += cpu_seconds([&] { collapses += cut.coarsen(0); });
    up_s += cpu_seconds([&] { splits += cut.refine(mesh.triangles.size()); });
  }
  fmt::print("\n{:<34}{:>14.0f} a second, {} in all\n{:<34}{:>14.0f} a second, {} in all\n",
             "collapse, in order", static_cast<double>(collapses) / down_s, collapses, "split, in order",
             static_cast<double>(splits) / up_s, splits);
  cut.coarsen(mesh.triangles.size() / 2);
  Random random(1);
  const std::size_t tries = brief ? 100000 : 4000000;
  std::vector<std::uint32_t> nodes(tries);
  for (auto& p : nodes) p = static_cast<std::uint32_t>(tree->originals + random.below(tree->made()));
  std::size_t done = 0;
  const double steps_s = cpu_seconds([&] {
    for (const std::uint32_t p : nodes) {
      if (cut.may_split(p)) {
        cut.split(p);
        ++done;
      } else if (cut.may_collapse(p)) {
        cut.collapse(p);
        ++done;
      }
    }
  });
  fmt::print("{:<34}{:>14.0f} a second, {} of {} tries legal, {} triangles\n", "collapse or split, at random",
             static_cast<double>(done) / steps_s, done, tries, cut.triangle_count());
  return 0;
}
