// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// All that `plumbline check` does with one mesh of 2 097 152 triangles, against CGAL's does_self_intersect in
// the same run. One thread, processor time. Reading the file (binary PLY, doubles) is timed by itself and not
// counted; everything after it is: walls, conformity, border, shape, edges. Aim: at least 50 × faster.
// --brief leaves CGAL out.
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include "properties/check/examination.h"
#include "scenarios/little_endian.h"
#include "scenarios/mesh_file/mesh_file.h"
#include "scenarios/terrain.h"
#include "tests/bench/hills.h"

namespace plumbline {
namespace {

const Mesh& full_mesh() {
  static const Mesh mesh = reference_mesh(bench::hills());
  return mesh;
}

/// The mesh as a file, for as long as the program runs.
class File {
 public:
  File()
      : path_(std::filesystem::temp_directory_path() /
              fmt::format("plumbline_check_bench_{}.ply", getpid())) {
    const Mesh& mesh = full_mesh();
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
        "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.positions.size(), mesh.triangles.size());
    for (const Vec3& p : mesh.positions) {
      for (const double c : {p.x, p.y, p.z}) append_little_endian(bytes, c);
    }
    for (const auto& t : mesh.triangles) {
      bytes.push_back('\3');
      for (const std::uint32_t i : t) append_little_endian(bytes, i);
    }
    std::ofstream(path_, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  ~File() {
    std::error_code error;
    std::filesystem::remove(path_, error);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};
const File& file() {
  static const File file;
  return file;
}

void ReadFile(benchmark::State& state) {
  file();
  for (auto _ : state) {
    if (triangulate(read_mesh_file(file().path())).triangles.size() != full_mesh().triangles.size())
      state.SkipWithError("not all of it");
  }
}

void Judge(benchmark::State& state) {
  const CheckRequest request;
  const checking::Examination exam{request, {}, {}, {}, {}};
  checking::Subject subject;
  subject.facts.terrain = true;
  subject.mesh = full_mesh();
  for (auto _ : state) {
    subject.findings.clear();
    checking::judge_inside(subject, exam);
    if (subject.facts.conformity.total() != 0 || !subject.held_to_rectangle ||
        subject.border.edges.size() != 4 * (bench::kSide - 1))
      state.SkipWithError("not clean");
  }
}

/// The command without its output: reads, guesses the axis that is up, judges.
void WholeCheck(benchmark::State& state) {
  CheckRequest request;
  request.inputs = {file().path()};
  request.jobs = 1;
  for (auto _ : state) {
    if (!check(request).verdict.sound) state.SkipWithError("not sound");
  }
}

void CgalDoesSelfIntersect(benchmark::State& state) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  using Vertex = CGAL::Surface_mesh<Kernel::Point_3>::Vertex_index;
  for (const Vec3& p : full_mesh().positions) surface.add_vertex({p.x, p.y, p.z});
  for (const auto& [a, b, c] : full_mesh().triangles) surface.add_face(Vertex(a), Vertex(b), Vertex(c));
  for (auto _ : state) {
    if (CGAL::Polygon_mesh_processing::does_self_intersect(surface)) state.SkipWithError("intersects");
  }
}

BENCHMARK(ReadFile)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->MinTime(2)->MinWarmUpTime(0.5);
BENCHMARK(Judge)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->MinTime(1);
BENCHMARK(WholeCheck)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->MinTime(2)->MinWarmUpTime(0.5);

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
  // Memory that was once had is kept: what a fresh page costs differs by machine more than anything here.
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  benchmark::Initialize(&argc, argv);
  const bool brief = argc > 1 && std::string(argv[1]) == "--brief";
  if (!brief) {
    benchmark::RegisterBenchmark("CgalDoesSelfIntersect", plumbline::CgalDoesSelfIntersect)
        ->Unit(benchmark::kMillisecond)
        ->MeasureProcessCPUTime()
        ->Iterations(1);
  }
  plumbline::Remember reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  const auto& ms = reporter.cpu_ms;
  for (const char* name : {"ReadFile", "Judge", "WholeCheck"}) {
    if (!ms.contains(name)) return 0;  // a filter left it out
  }
  const double whole = ms.at("WholeCheck") - ms.at("ReadFile");
  fmt::print("reading the file: {:.0f} ms; all that follows: {:.0f} ms, of that the judgement {:.0f} ms\n",
             ms.at("ReadFile"), whole, ms.at("Judge"));
  if (ms.contains("CgalDoesSelfIntersect")) {
    const double cgal = ms.at("CgalDoesSelfIntersect");
    fmt::print("CGAL does_self_intersect / judgement: {:.0f} (aim: at least 50); / all but reading: {:.0f}\n",
               cgal / ms.at("Judge"), cgal / whole);
  }
  return 0;
}
