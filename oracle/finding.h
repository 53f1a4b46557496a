// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/vec.h"

namespace plumbline::oracle {

/// The catalogue of findings, numbered by layer (1xx input, 2xx edge and triangle, 3xx surface, 4xx hierarchy
/// and laws, 5xx image). Numbers and names are stable: code, manual (docs/findings.md) and reports share this
/// list.
enum class FindingCode : int {
  bad_index = 101,
  non_finite = 102,
  tile_encoding = 103,
  nothing_judged = 110,  ///< an oracle or law had nothing to judge: a failure, not a pass
  degenerate = 201,
  duplicate = 202,
  non_manifold = 203,
  unused_vertex = 204,
  fold_over = 205,
  sliver = 206,
  self_intersection = 207,
  t_junction = 301,
  crack = 302,
  hole = 303,
  overlap = 304,
  outline = 305,
  slit = 306,
  border_normal = 307,
  misplaced = 308,
  declared_error = 309,
  law_violated = 401,
  level_gap = 402,
  error_over_threshold = 501,
  uncovered = 502,
  skirt_visible = 503,
};

/// What Finding::kind may say, and what it means.
struct FindingKindDescription {
  std::string_view name;
  std::string_view meaning;
};
/// One entry of the catalogue.
struct FindingDescription {
  FindingCode code;
  std::string_view name;
  std::string_view definition;
  std::string_view drawing = {};  ///< lines of plain text, each ending in a line break; may be empty
  std::vector<FindingKindDescription> kinds = {};
};
/// In the order of the codes.
const std::vector<FindingDescription>& finding_catalogue();
std::string_view finding_name(FindingCode code);
/// A small file, or a folder of files that are checked together, that has this finding and no other, and a
/// near twin that has none; paths from the project's folder. What judges them is said in their comments.
std::string finding_example(FindingCode code);
std::string finding_twin(FindingCode code);
/// The picture of the example (finding_picture.h), a path from docs/.
std::string finding_image(FindingCode code);
/// Where the manual page explains it: "docs/findings.md#302-crack".
std::string finding_section(FindingCode code);
/// The catalogue as the manual page docs/findings.md (Markdown).
std::string findings_manual();

enum class Severity { hazard, fault };

/// Where a finding stands with respect to a camera.
enum class Visibility {
  unknown,   ///< no camera was given
  outside,   ///< does not project into the picture (behind the camera, beside the frustum)
  occluded,  ///< in the frustum, behind the surface
  visible,
};

/// One located defect, with its witnesses.
struct Finding {
  FindingCode code{};
  Severity severity = Severity::fault;
  std::string kind;       ///< finer than the code: "t_vertex", "height_mismatch", …; may be empty
  Vec3 at;                ///< metres
  double gap_m = 0;       ///< crack, t_junction: vertical distance; signed vertex minus edge
  double gap_px = 0;      ///< the same, seen from the camera; 0 without a camera
  double area_m2 = 0;     ///< hole, overlap, outline, fold_over
  double distance_m = 0;  ///< outline: largest distance to the promised outline
  std::vector<std::uint32_t> vertices;   ///< indices into the mesh
  std::vector<std::uint32_t> triangles;  ///< indices into the mesh
  std::vector<Vec2> loop;                ///< hole, overlap, outline: the region's boundary in plan
  Visibility visibility = Visibility::unknown;
};

}  // namespace plumbline::oracle
