// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "oracle/border.h"
#include "oracle/seams.h"
#include "properties/check/check.h"
#include "properties/verdict/check_verdict.h"
#include "scenarios/tiles/tile_grid.h"

/// The stations of `plumbline check`, in order: load, inside, between, against, spots. Each sees what the
/// ones before it left in the examination.
namespace plumbline::checking {

/// Of the same code, this many are listed for each mesh; counts are complete.
inline constexpr std::size_t kListedOfACode = 100;
/// Finding self-intersections takes CGAL some five seconds for two million triangles; beyond, it is left out
/// and said so.
inline constexpr std::size_t kMostIntersected = 4'000'000;

/// Which of the files' axes is up. Everything is judged with z up, in the files' own unit and digits: axes
/// are exchanged, never scaled, so that what was exact stays exact.
struct Frame {
  enum class Up { x, y, z };
  Up up = Up::z;
  double unit_m = 1;  ///< metres per unit
  /// Every mesh runs clockwise seen from above: triangles were turned over, to be judged at all.
  bool turned = false;

  [[nodiscard]] Vec3 from_file(Vec3 p) const {
    if (up == Up::y) return {p.x, -p.z, p.y};
    return up == Up::x ? Vec3{p.y, p.z, p.x} : p;
  }
  [[nodiscard]] Vec3 to_file(Vec3 p) const {
    if (up == Up::y) return {p.x, p.z, -p.y};
    return up == Up::x ? Vec3{p.z, p.x, p.y} : p;
  }
};

/// Where a tile lies, and how its lattice stands in the world.
struct TilePlace {
  bool placed = false;  ///< false: its path does not say where it lies
  TileGrid grid;
  TileAddress address;
  int level = 0;
  std::uint32_t x = 0, y = 0;       ///< y northwards, whatever the scheme
  std::uint32_t columns = 1;        ///< of the level
  Vec2 metres_per_step{1, 1};       ///< one lattice step in the tile's middle
  double low_m = 0, high_m = 0;     ///< the heights' range
  std::vector<std::int32_t> steps;  ///< per vertex: its height in it
  /// None of its children is there. Over a DEM and in a picture only such tiles are looked at: a client draws
  /// the deepest that it has, and levels lie above each other.
  bool drawn = true;
  [[nodiscard]] double quantum_m() const { return (high_m - low_m) / 32767; }
};

/// One mesh under examination.
struct Subject {
  verdict::CheckedMesh facts;
  Mesh mesh;  ///< frame of the check, file units; tiles: lattice steps and metres
  std::vector<Vec3> normals;
  oracle::Sheet sheet;  ///< of a terrain
  oracle::Border border;
  std::optional<TilePlace> tile;
  std::vector<Vec3> places;  ///< tiles: longitude, latitude (degrees), height of each vertex
  std::vector<verdict::CheckFinding> findings;
  bool held_to_rectangle = false;
  std::size_t open_edges = 0;  ///< objects: edges that one triangle has alone
  bool inside_out = false;     ///< objects: closed, and every triangle faces inwards
};

struct Examination {
  const CheckRequest& request;
  Frame frame;
  std::vector<Subject> subjects;
  std::vector<verdict::CheckFinding> between;
  verdict::CheckVerdict verdict;
};

/// Reads everything that was asked for, settles kind and frame.
void load(Examination& exam);
/// Each mesh by itself.
void judge_inside(Subject& subject, const Examination& exam);
/// How meshes fit together.
void judge_between(Examination& exam);
/// Against a DEM, another mesh, a camera.
std::vector<verdict::CheckFinding> judge_against(Examination& exam, verdict::CheckPictures& pictures);
/// The neighbourhoods of the worst findings.
std::vector<verdict::CheckSpot> make_spots(const Examination& exam);

/// What a finding means for whoever made the mesh, one sentence. `unit_m` scales its lengths.
std::string finding_message(const oracle::Finding& finding, double unit_m);
/// "12.4 m", "3.1 mm": three significant digits.
std::string length_text(double metres);

/// The same, never less than it is: "a skirt of that height suffices".
std::string sufficient_length_text(double metres);

/// A finding of one subject, its place in file coordinates, its lengths in metres.
verdict::CheckFinding as_check_finding(const oracle::Finding& finding, const Subject& subject,
                                       std::uint32_t index, const Frame& frame);

}  // namespace plumbline::checking
