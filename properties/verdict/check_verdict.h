// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oracle/conformity.h"
#include "oracle/finding.h"
#include "oracle/image.h"
#include "oracle/likeness.h"
#include "oracle/shape.h"
#include "oracle/vertical.h"
#include "properties/verdict/verdict.h"
#include "scenarios/camera.h"
#include "scenarios/mesh.h"
#include "scenarios/raster.h"

/// What `plumbline check` found out about meshes that somebody else made, as plain data.
namespace plumbline::verdict {

/// Where an index into CheckVerdict::meshes could stand: none.
inline constexpr std::uint32_t kNoMesh = 0xffffffffu;

/// A box in plan with heights, in the frame of the check (CheckVerdict::frame).
struct Extent {
  Vec3 low, high;
};

/// The skirt that hangs from a mesh's border: walls without plan area.
struct SkirtFigures {
  std::size_t triangles = 0;  ///< walls; 0: none in the file
  double least_depth_m = 0;   ///< over the border vertices that it hangs from
  double border_share = 0;    ///< of the border's length that it hangs from, [0, 1]
  bool stated = false;        ///< not in the file: the client adds it, as the user said (--skirt)
};

/// One mesh file, or tile, that was read.
struct CheckedMesh {
  std::string file;     ///< as given, or inside the folder that was given: "9/533/383.terrain"
  std::string path{};   ///< where it lies; empty: `file` is that, too
  std::string name{};   ///< what sentences call it: `file` without the folder that all have in common
  std::string format;   ///< "PLY", "quantized-mesh", …
  bool terrain = true;  ///< a surface over a plan; false: an object in space
  std::string domain;   ///< what it was held to, in words: "the rectangle of its box", "its own outline"
  std::size_t triangles = 0, vertices = 0;
  Extent box;
  oracle::ConformityCounts conformity;
  oracle::ShapeReport shape;
  double shortest_edge_m = 0;  ///< in plan (objects: in space); 0 if there is no edge
  double median_edge_m = 0;
  SkirtFigures skirt;
  double least_skirt_m = 0;  ///< that covers every gap to its neighbours; 0: none needed
  /// Objects: pairs of triangles; 0 proves something only where it was asked, which needs a manifold.
  std::size_t self_intersections = 0;
  bool self_intersections_judged = false;
};

/// One finding with whose it is.
struct CheckFinding {
  oracle::Finding finding;             ///< places in the frame of the check
  std::uint32_t mesh = kNoMesh;        ///< into CheckVerdict::meshes
  std::uint32_t other_mesh = kNoMesh;  ///< between two meshes: the other one
  Vec3 at;                             ///< in the coordinates of the file (tiles: longitude, latitude, m)
  std::string message;                 ///< one sentence: what, how much, what follows
  std::string file{};                  ///< of a finding of no mesh: the file that it speaks of
};

/// A gap of one step of height is that also in double: seams.h rounds gaps by at most this much.
inline constexpr double kQuantumSlack = 1 + 0x1p-19;

/// Three states, never mixed.
enum class SeamState {
  watertight,        ///< every stretch meets edge to edge at equal heights
  covered_by_skirt,  ///< gaps, each hidden by a skirt that hangs deep enough from the higher side
  open,              ///< a gap, or a T-junction, that nothing hides
};
/// In words: "watertight", "covered by a skirt", "open".
std::string_view seam_state_name(SeamState state);

/// The border that two meshes share.
struct SeamVerdict {
  std::uint32_t mesh = kNoMesh, other_mesh = kNoMesh;
  SeamState state = SeamState::watertight;
  /// False: tiles of different levels, and no skirt was stated. Nothing promises that those meet: their gaps
  /// are no faults and not in CheckVerdict::conformity; they tell the skirt that a client has to add.
  bool must_meet = true;
  double length_m = 0;          ///< in plan, of the stretch that both have
  std::size_t t_junctions = 0;  ///< vertices of one inside an edge of the other
  std::size_t cracks = 0;       ///< stretches of the common subdivision with a gap
  /// Gaps are signed: height of `mesh` minus height of `other_mesh`.
  double largest_gap_m = 0;        ///< of the largest size
  double mean_gap_m = 0;           ///< over the length; integrated, not sampled
  double mean_abs_gap_m = 0;       ///< likewise, of the size
  Vec3 largest_at;                 ///< file coordinates, on the higher side
  double least_skirt_m = 0;        ///< of `mesh`, that covers all of the seam: where `mesh` is the higher
  double least_skirt_other_m = 0;  ///< of `other_mesh`
  double quantum_m = 0;  ///< quantized tiles: gaps up to this are their height quantization; 0: exact formats
  double normal_max_deg = 0;  ///< largest angle between the two normals at a shared vertex; NaN: no normals
  int level = -1, other_level = -1;  ///< of tiles; -1: no tiles
};

/// Whether a gap of the seam is no more than the rounding of the two sides' heights.
inline bool is_rounding(const SeamVerdict& seam, double gap_m) {
  return std::fabs(gap_m) <= seam.quantum_m * kQuantumSlack;
}

/// Against a DEM.
struct TerrainVerdict {
  std::string file;
  std::string reading;  ///< how the DEM is read, in words: size, spacing, row order, interpolation
  std::string placing;  ///< how the mesh was laid over it, in words, and whether that was guessed
  oracle::VerticalError vertical_m;
  Vec2 at, certain_at;               ///< of vertical_m, in file coordinates
  double samples_max_m = 0;          ///< largest error at the samples alone
  Vec2 samples_at;                   ///< file coordinates
  double judged_share = 0;           ///< of the mesh's plan area that the DEM has data for
  double diagonal_ambiguity_m = 0;   ///< of the DEM itself
  std::optional<double> declared_m;  ///< the bound that the maker declared
  /// Whether the declared bound is true: at the samples; between them, whichever way cells are split
  /// (certain_max); and against the declared diagonal (max).
  bool declared_at_samples = true, declared_certain = true, declared_everywhere = true;
  std::string better_match;  ///< "rows are flipped (…): RMS …": fits far better if that; empty: none
};

/// Against another mesh, in space.
struct ReferenceVerdict {
  std::string file;
  oracle::Likeness likeness;
  std::optional<double> declared_m;
  bool declared_holds = true;    ///< the certified upper bound is within it
  bool declared_broken = false;  ///< the certified lower bound exceeds it
};

/// What the given camera sees of the meshes.
struct ImageVerdict {
  Camera camera;
  bool against_terrain = false;  ///< displacement was measured
  oracle::ImageError image;
  std::size_t visible_findings = 0;
  std::size_t skirt_px = 0;  ///< pixels that see a skirt's wall first
  std::size_t mesh_px = 0;   ///< pixels that see the mesh at all
};

/// All that `check --json` tells.
struct CheckVerdict {
  std::string frame;  ///< what x, y, z are, in words: "the file's own, z up", "longitude, latitude, m"
  std::vector<std::string> notes;  ///< what was guessed, and how to say otherwise; what was not judged
  std::vector<CheckedMesh> meshes;
  oracle::ConformityCounts conformity;  ///< inside all meshes and between them
  std::size_t tile_faults = 0;          ///< findings 103 of quantized-mesh tiles
  std::vector<SeamVerdict> seams;       ///< worst first
  std::vector<CheckFinding> findings;   ///< worst first; the list is capped, the counts are complete
  std::size_t findings_total = 0;
  std::map<oracle::FindingCode, std::size_t>
      totals{};  ///< of each code, listed or not; empty: nobody counted
  std::optional<TerrainVerdict> terrain;
  std::optional<ReferenceVerdict> reference;
  std::optional<ImageVerdict> image;
  bool sound = true;
};

/// The neighbourhood of one finding, to look at.
struct CheckSpot {
  std::string name;                   ///< "01-crack-9_533_383"
  std::size_t finding = 0;            ///< into CheckVerdict::findings
  Mesh mesh;                          ///< the triangles around it, frame of the check
  std::vector<std::uint32_t> marked;  ///< its witnesses: indices into mesh.triangles
  std::string picture_svg;
};

/// What `check --report` shows besides.
struct CheckPictures {
  std::vector<CheckSpot> spots;  ///< of the worst findings
  Raster error_map_m;  ///< z_mesh − z_DEM in plan, rows from the north; NaN: not judged; may be empty
  Extent error_map_box;
  std::optional<FramePictures> camera;  ///< what the camera sees
};

}  // namespace plumbline::verdict
