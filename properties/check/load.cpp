// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Reads what was asked for; settles whether it is terrain, and which axis is up.
#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "oracle/tile_conformance.h"
#include "properties/check/tiles.h"
#include "scenarios/error.h"
#include "scenarios/mesh_file/mesh_file.h"

namespace plumbline::checking {
namespace {

namespace fs = std::filesystem;

/// What the triangles' normals sum up to along each axis, with and without their signs.
struct Facing {
  Vec3 sum, size;

  void add(const Mesh& mesh) {
    for (const auto& t : mesh.triangles) {
      const std::size_t count = mesh.positions.size();
      if (t[0] >= count || t[1] >= count || t[2] >= count) continue;
      const Vec3 a = mesh.positions[t[0]];
      const Vec3 n = cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
      if (!std::isfinite(n.x) || !std::isfinite(n.y) || !std::isfinite(n.z)) continue;
      sum = sum + n;
      size = size + Vec3{std::fabs(n.x), std::fabs(n.y), std::fabs(n.z)};
    }
  }
  void add(const Facing& other) {
    sum = sum + other.sum;
    size = size + other.size;
  }
  /// The same of the mesh in the frame's axes.
  [[nodiscard]] Facing in(const Frame& frame) const {
    const Vec3 s = frame.from_file(size);
    return {frame.from_file(sum), {std::fabs(s.x), std::fabs(s.y), std::fabs(s.z)}};
  }
};

/// A surface over a plan faces one way: of its area in plan at least this share is not cancelled by area that
/// faces the other way. A closed object's cancels to nothing.
constexpr double kTerrainShare = 0.5;

/// Shares that differ by less differ by the rounding of millions of areas.
constexpr double kSameShare = 1e-9;

struct Guess {
  Frame::Up up = Frame::Up::z;
  bool terrain = false;
};

/// z where nothing folds over in it, though ground be steeper than 45 degrees one way; else the axis along
/// which most faces.
Guess guess(const Facing& facing) {
  constexpr double kMuch = 0.1;  // of the largest of the three areas: a few slivers' facing tells nothing
  const std::array<double, 3> sum{std::fabs(facing.sum.x), std::fabs(facing.sum.y), std::fabs(facing.sum.z)};
  const std::array<double, 3> size{facing.size.x, facing.size.y, facing.size.z};
  std::size_t best = 2;
  if (!(size[2] > kMuch * std::max(size[0], size[1]) && sum[2] >= (1 - kSameShare) * size[2])) {
    for (const std::size_t k : {std::size_t{1}, std::size_t{0}}) {
      if (sum[k] > sum[best]) best = k;
    }
  }
  Guess out;
  out.up = best == 2 ? Frame::Up::z : best == 1 ? Frame::Up::y : Frame::Up::x;
  out.terrain = sum[best] > kTerrainShare * size[best];
  return out;
}

const char* axis_name(Frame::Up up) { return up == Frame::Up::x ? "x" : up == Frame::Up::y ? "y" : "z"; }

Subject read_mesh(const fs::path& path) {
  Subject subject;
  MeshFile file = read_mesh_file(path);
  subject.facts.file = path.generic_string();
  subject.facts.format = file.format;
  try {
    subject.mesh = triangulate(file);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", one_line(path.generic_string()), error.what()));
  }
  if (subject.mesh.triangles.empty())
    throw InputError(fmt::format("{}: the mesh has no triangle; there is nothing to check",
                                 one_line(path.generic_string())));
  subject.normals = std::move(file.normals);
  return subject;
}

/// Tiles of the inputs: folders, and single files whose path ends in level/x/y.terrain.
struct Inputs {
  std::vector<fs::path> meshes;
  std::vector<TileSource> tiles;
};

/// Tiles are neighbours by their numbers: of two sets each number means two places, or one place twice.
void require_one_set(const std::vector<TileSource>& tiles) {
  const TileSource* first = nullptr;
  for (const TileSource& tile : tiles) {
    if (!tile.address) continue;
    if (first == nullptr) first = &tile;
    std::error_code error;
    if (tile.root == first->root || fs::equivalent(tile.root, first->root, error)) continue;
    throw InputError(fmt::format(
        "{} and {} are two sets of tiles; check each by itself, and let 'plumbline compare' tell what "
        "differs between the two verdicts",
        one_line(first->root.generic_string()), one_line(tile.root.generic_string())));
  }
}

Inputs sort_out(const CheckRequest& request, std::vector<std::string>& notes,
                std::vector<verdict::CheckFinding>& findings) {
  Inputs out;
  std::map<fs::path, std::optional<TileGrid>> layers;
  for (const fs::path& input : request.inputs) {
    std::error_code error;
    if (fs::is_directory(input, error)) {
      add_tile_folder(input, out.tiles, notes, findings);
    } else if (input.extension() == ".terrain") {
      add_tile_file(input, out.tiles, notes, layers);
    } else {
      out.meshes.push_back(input);
    }
  }
  require_one_set(out.tiles);
  std::sort(out.tiles.begin(), out.tiles.end(), [](const TileSource& a, const TileSource& b) {
    return std::tie(a.address, a.path) < std::tie(b.address, b.path);
  });
  return out;
}

/// A surface of which most runs clockwise seen from above has y running south (as rows of images do), or is
/// wound the wrong way round as a whole. Which, the mesh alone does not tell; a triangle each would say it
/// two million times.
void turn_over(Examination& exam, const std::vector<Subject*>& meshes, const Facing& all) {
  if (!(all.sum.z < -kTerrainShare * all.size.z)) return;
  exam.frame.turned = true;
  for (Subject* subject : meshes) {
    for (auto& t : subject->mesh.triangles) std::swap(t[1], t[2]);
  }
  exam.verdict.notes.emplace_back(
      "every triangle runs clockwise in x and y: right if y runs south, as rows of images do; otherwise "
      "back-face culling hides the whole mesh. They were judged turned over");
}

/// Meshes of one folder are told apart by what follows it.
void name_meshes(std::vector<Subject>& subjects) {
  std::string common;
  bool first = true;
  for (const Subject& subject : subjects) {
    const std::string& file = subject.facts.file;
    const std::string folder = subject.tile ? std::string() : file.substr(0, file.rfind('/') + 1);
    if (std::exchange(first, false)) common = folder;
    const auto differ = std::mismatch(common.begin(), common.end(), folder.begin(), folder.end()).first;
    common.erase(differ, common.end());
    common.erase(common.rfind('/') + 1);
  }
  for (Subject& subject : subjects) subject.facts.name = subject.facts.file.substr(common.size());
}

void settle_frame(Examination& exam) {
  std::vector<Subject*> meshes;
  for (Subject& subject : exam.subjects) {
    if (!subject.tile) meshes.push_back(&subject);
  }
  verdict::CheckVerdict& verdict = exam.verdict;
  if (meshes.empty()) {
    verdict.frame = "longitude and latitude in degrees, height in metres above the ellipsoid (WGS84)";
    return;
  }
  std::vector<Facing> facings(meshes.size());
  tbb::parallel_for(std::size_t{0}, meshes.size(), [&](std::size_t k) { facings[k].add(meshes[k]->mesh); });
  Facing all;
  for (const Facing& facing : facings) all.add(facing);
  const Guess guessed = guess(all);
  const CheckRequest& request = exam.request;
  exam.frame.unit_m = request.unit_m;
  switch (request.up) {
    case CheckRequest::Up::x:
      exam.frame.up = Frame::Up::x;
      break;
    case CheckRequest::Up::y:
      exam.frame.up = Frame::Up::y;
      break;
    case CheckRequest::Up::z:
      exam.frame.up = Frame::Up::z;
      break;
    case CheckRequest::Up::guess:
      exam.frame.up = guessed.terrain ? guessed.up : Frame::Up::z;
      if (exam.frame.up != Frame::Up::z)
        verdict.notes.push_back(
            fmt::format("up is taken to be {}, since most triangles face along it; "
                        "--up says otherwise",
                        axis_name(exam.frame.up)));
      break;
  }
  if (exam.frame.up != Frame::Up::z) {
    for (Subject* subject : meshes) {
      for (Vec3& p : subject->mesh.positions) p = exam.frame.from_file(p);
      for (Vec3& n : subject->normals) n = exam.frame.from_file(n);
    }
  }
  turn_over(exam, meshes, all.in(exam.frame));
  for (std::size_t k = 0; k < meshes.size(); ++k) {
    Subject* subject = meshes[k];
    // Against the axis that holds for all, not the one that would suit this mesh best.
    const Facing own = facings[k].in(exam.frame);
    subject->facts.terrain = request.kind == CheckRequest::Kind::guess
                                 ? std::fabs(own.sum.z) > kTerrainShare * own.size.z
                                 : request.kind == CheckRequest::Kind::terrain;
    if (subject->facts.terrain && own.sum.z < -kTerrainShare * own.size.z && !exam.frame.turned)
      verdict.notes.push_back(
          fmt::format("{} runs clockwise as a whole, which the others do not: turn its triangles over",
                      subject->facts.name));
    if (const Guess by_itself = guess(facings[k]); request.up == CheckRequest::Up::guess &&
                                                   meshes.size() > 1 && by_itself.terrain &&
                                                   by_itself.up != exam.frame.up)
      verdict.notes.push_back(
          fmt::format("{} by itself looks as if {} were up in it; one axis holds for all, here {}",
                      subject->facts.name, axis_name(by_itself.up), axis_name(exam.frame.up)));
    if (request.kind == CheckRequest::Kind::guess && !subject->facts.terrain)
      verdict.notes.push_back(
          fmt::format("{} is taken for an object in space, since its faces cancel in "
                      "every direction; --kind terrain says otherwise",
                      subject->facts.name));
  }
  verdict.frame = fmt::format(
      "the files' own coordinates, {} up{}", axis_name(exam.frame.up),
      exam.frame.unit_m == 1 ? std::string(", metres") : fmt::format(", {} m a unit", exam.frame.unit_m));
}

}  // namespace

void load(Examination& exam) {
  if (exam.request.inputs.empty())
    throw InputError("check: no mesh was given; name files, or a folder of tiles");
  const Inputs inputs = sort_out(exam.request, exam.verdict.notes, exam.between);
  const std::size_t meshes = inputs.meshes.size(), tiles = inputs.tiles.size();
  exam.subjects.resize(meshes + tiles);
  std::vector<std::exception_ptr> failed(exam.subjects.size());
  tbb::parallel_for(std::size_t{0}, exam.subjects.size(), [&](std::size_t k) {
    try {
      exam.subjects[k] = k < meshes ? read_mesh(inputs.meshes[k]) : read_tile(inputs.tiles[k - meshes]);
    } catch (...) {
      failed[k] = std::current_exception();
    }
  });
  // The first in order, whatever thread met another one earlier.
  for (const std::exception_ptr& failure : failed) {
    if (failure) std::rethrow_exception(failure);
  }
  name_meshes(exam.subjects);
  settle_frame(exam);
  if (!exam.request.terrain.empty() || exam.request.camera) choose_drawn(exam);
}

}  // namespace plumbline::checking
