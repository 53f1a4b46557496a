// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/finding.h"

namespace plumbline::oracle {

std::string_view finding_name(FindingCode code) {
  for (const FindingDescription& description : finding_catalogue()) {
    if (description.code == code) return description.name;
  }
  return "unknown";
}

const std::vector<FindingDescription>& finding_catalogue() {
  using enum FindingCode;
  static const std::vector<FindingDescription> catalogue{
      {bad_index, "bad_index",
       "A triangle names a vertex that the mesh does not have. It is left out of every later check."},
      {non_finite, "non_finite",
       "A vertex with an infinite or undefined coordinate. Its triangles are left out of every later check."},
      {nothing_judged, "nothing_judged",
       "An oracle or a law had nothing to judge: no frame, no triangle in the picture, a precondition that "
       "never held. "
       "That is a failure, not a pass."},
      {degenerate, "degenerate",
       "A triangle whose three corners are exactly collinear in plan (or that names a vertex twice)."},
      {duplicate, "duplicate",
       "A triangle with the same three corners as another, in any order. Only the copy is the finding, and "
       "it is left out "
       "of later checks."},
      {non_manifold, "non_manifold",
       "An edge, by index, with more than two triangles or with two triangles that run along it in the same "
       "direction."},
      {unused_vertex, "unused_vertex",
       "A vertex that no triangle names. A hazard: the picture does not show it."},
      {fold_over, "fold_over",
       "A triangle that runs clockwise in plan: 'reversed' if it would fit its neighbours wound the other "
       "way round, "
       "'folded' if the surface itself turns over."},
      {t_junction, "t_junction",
       "A vertex in the open interior of another triangle's edge in plan, exactly at the edge's height. A "
       "hazard: no gap in "
       "exact arithmetic, but a rasteriser shows pixels through it."},
      {crack, "crack",
       "An open gap: a T-vertex off the edge's height ('t_vertex'; the gap is vertex minus edge), or two "
       "coincident plan "
       "edges whose end heights differ ('height_mismatch'; the larger difference)."},
      {hole, "hole",
       "A plan region inside the promised domain, away from its outline, that no triangle covers."},
      {overlap, "overlap", "A plan region of the promised domain that triangles cover twice or more."},
      {outline, "outline",
       "The covered region ends elsewhere than promised: 'missing' along the promised outline, or 'extra' "
       "beyond it; with "
       "the area and the largest distance of the region's corners to the promised outline."},
      {law_violated, "law_violated", "A law that the method promises does not hold on this input."},
      {error_over_threshold, "error_over_threshold",
       "The measured displacement in the picture is above the threshold that the method was given."},
      {uncovered, "uncovered", "Pixels whose reference point has no point of the mesh above or below it."},
  };
  return catalogue;
}

}  // namespace plumbline::oracle
