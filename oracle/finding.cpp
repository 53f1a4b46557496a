// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/finding.h"

#include <fmt/format.h>

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
       "A triangle names a vertex that the mesh does not have. It is left out of every later check.",
       R"(
    vertices 0 … 8      triangle 3 4 9
                                     ^ there is no vertex 9
)"},
      {non_finite, "non_finite",
       "A vertex with an infinite or undefined coordinate. Its triangles are left out of every later check.",
       R"(
    vertex 4 = (12, 30, nan)
)"},
      {tile_encoding,
       "tile_encoding",
       "A quantized-mesh tile breaks its format: what a client relies on when it decodes the tile, hangs "
       "skirts from its edge lists or culls it by its sphere.",
       {},
       {{"corner_missing", "no triangle has a vertex at a corner of the tile"},
        {"off_border", "the mesh ends inside of the tile's square, or its border is not at 0 and 32767"},
        {"edge_list", "an edge list and the vertices on that side differ"},
        {"index", "a triangle names a vertex that the tile does not have: the high-water mark is broken"},
        {"range", "a coordinate lies outside 0 … 32767"},
        {"height_range", "the header's heights are not finite or reversed; as a hazard: not all used"},
        {"sphere", "a vertex lies outside of the header's bounding sphere"},
        {"center", "a hazard: the header's center is far from the tile"},
        {"normal", "normals are missing or zero; as a hazard: one points into the ground"},
        {"trailing", "a hazard: bytes that belong to nothing"},
        {"missing_tile", "layer.json advertises tiles that are not there"},
        {"misplaced_tile", "a hazard: a file lies where the grid has no place, so no client asks for it"}}},
      {nothing_judged, "nothing_judged",
       "An oracle or a law had nothing to judge: no frame, no triangle in the picture, a precondition that "
       "never "
       "held. That is a failure, not a pass."},
      {degenerate,
       "degenerate",
       "A triangle whose three corners are exactly collinear in plan, or that names a vertex twice "
       "('repeated_index').",
       R"(
    a────────b────────c      triangle a b c
)",
       {{"collinear", "three different vertices on one line in plan (of an object: no area)"},
        {"repeated_index", "one vertex named twice"}}},
      {duplicate, "duplicate",
       "A triangle with the same three corners as another, in any order. Only the copy is the finding, and "
       "it is "
       "left out of later checks.",
       R"(
    c
    │ ╲        triangle a b c
    a───b      triangle b c a
)"},
      {non_manifold,
       "non_manifold",
       "An edge, by index, with more than two triangles, or with two triangles that run along it in the same "
       "direction. In plan those cover each other, so an overlap stands beside it.",
       R"(
        c   e
       ╱ ╲ ╱ ╲         a b c, a b e: both to the left of a → b
      a═══╪═══b
       ╲     ╱
          d
)",
       {{"edge", "of an object: more than two triangles at an edge"},
        {"orientation", "of an object: two triangles run along an edge the same way"},
        {"vertex", "of an object: the triangles at a vertex form several fans"}}},
      {unused_vertex, "unused_vertex",
       "A vertex that no triangle names. A hazard: the picture does not show it."},
      {fold_over,
       "fold_over",
       "A triangle that runs clockwise in plan: 'reversed' if it would fit its neighbours wound the other "
       "way "
       "round, 'folded' if the surface itself turns over.",
       R"(
    d───────c
    │ ╲   ╱ │      pull the middle vertex m across a–b:
    │  ╲ ╱  │      a b m turns over
    a───╳───b
      ╲ │ ╱
        m
)",
       {{"reversed", "it would fit its neighbours wound the other way round"},
        {"folded", "the surface itself turns over"}}},
      {sliver,
       "sliver",
       "A triangle of quality under 0.05 in plan, or an edge a thousand times shorter than the median: "
       "detail "
       "that no picture shows, and shading that suffers. A hazard. One finding a mesh, at the worst place; "
       "the count is with it.",
       R"(
    a──────────────────────────b
     ╲________________________╱      4·√3·area / Σl² < 0.05
                 c
)",
       {{"thin", "a triangle of little quality"}, {"short_edge", "an edge far below the others"}}},
      {self_intersection, "self_intersection",
       "Two triangles of an object meet elsewhere than in a corner or an edge that they share. Decided "
       "exactly.",
       R"(
        ╱╲
    ───╱──╲───      one triangle passes
      ╱────╲        through the other
)"},
      {t_junction, "t_junction",
       "A vertex in the open interior of another triangle's edge in plan, exactly at the edge's height. A "
       "hazard: "
       "no gap in exact arithmetic, but a rasteriser shows pixels through it.",
       R"(
    ┌───┬───┐
    │ ╲ │ ╱ │      two fine triangles
    a───v───c      meet one coarse one, which does not know v
     ╲     ╱
        b
)"},
      {crack,
       "crack",
       "An open gap: a T-vertex off the edge's height ('t_vertex'; the gap is vertex minus edge), or two "
       "coincident plan edges whose end heights differ ('height_mismatch'; the larger difference).",
       R"(
            v            seen from the side:
         ╱  ↕ gap  ╲     the fine edges a v, v c
    a───────────────c    over the coarse edge a c
)",
       {{"t_vertex", "a vertex in the interior of an edge in plan, off its height"},
        {"height_mismatch", "two edges with the same ends in plan, at different heights"},
        {"quantization",
         "a hazard: two tiles have the vertex, and their heights differ by no more than their rounding"},
        {"cliff", "a hazard: a wall closes the step, so that no daylight shows"}}},
      {hole, "hole",
       "A plan region inside the promised domain that no triangle covers, and that shares no stretch of the "
       "promised outline. Its area and its loop are given.",
       R"(
    ┌───────────┐
    │   ╱╲      │
    │  ╱  ╲  ←  no triangle here
    │ ╱────╲    │
    └───────────┘
)"},
      {overlap, "overlap",
       "A plan region of the promised domain that triangles cover twice or more. Its area and its loop are "
       "given.",
       R"(
    ┌─────────┐
    │     ┌───┼─────┐
    │     │ 2 │     │
    └─────┼───┘     │
          └─────────┘
)"},
      {outline,
       "outline",
       "The covered region ends elsewhere than promised: 'missing' along a stretch of the promised outline, "
       "or "
       "'extra' beyond it; with the area, and the largest distance of the region's corners to the promised "
       "outline.",
       R"(
    ┌─────────────┐
    │             │
    │    mesh     ├──╮
    │             │  │ extra: beyond the promised side
    │     ╱╲      ├──╯
    └────╱  ╲─────┘
       missing: the promised side runs straight on
)",
       {{"missing", "along a stretch of the promised outline"}, {"extra", "beyond it"}}},
      {slit,
       "slit",
       "The borders of two meshes run side by side, within a quarter of an edge, without meeting: a slit, or "
       "an overlap, of that width. Found by distance, since nothing exact relates two borders that do not "
       "meet; what does meet is decided exactly before.",
       R"(
    ───────a───────b───────
    ───────a'──────b'──────      a and a' were meant to be one
)",
       {{"lattice", "tiles: vertices that miss their partner by one step of the lattice"}}},
      {border_normal, "border_normal",
       "At a vertex that two meshes share, their normals differ by more than 2 degrees (twice what two-byte "
       "normals may err by, rounded up): the border shows as a line of light. A hazard."},
      {misplaced,
       "misplaced",
       "Laid over the DEM as it is, the mesh is far off; in another arrangement it fits. Every other figure "
       "against the DEM then speaks of the arrangement.",
       {},
       {{"rows_flipped", "it fits with north and south exchanged"},
        {"columns_flipped", "it fits with east and west exchanged"},
        {"transposed", "it fits with rows and columns exchanged"},
        {"shifted", "it fits when moved by whole or half samples"},
        {"height_offset", "it fits with a constant added to its heights"},
        {"height_factor", "it fits with its heights multiplied (feet for metres)"}}},
      {declared_error,
       "declared_error",
       "The error bound that the maker declared is not true: the mesh is farther from the DEM (or the "
       "reference mesh) than that, whichever way the samples are read.",
       {},
       {{"samples", "at the samples already"},
        {"between", "between the samples, outside of both ways to split the cell"},
        {"reference", "from the reference mesh, certified"}}},
      {law_violated, "law_violated", "A law that the method promises does not hold on this input."},
      {level_gap, "level_gap",
       "The deepest tiles on the two sides of a border are two or more levels apart. A hazard: renderers "
       "expect neighbours one level apart, and skirts are sized for that.",
       R"(
    ┌───────┬─┬─┐
    │       ├─┼─┤
    │   1   ├─┼─┤  3
    │       ├─┼─┤
    └───────┴─┴─┘
)"},
      {error_over_threshold, "error_over_threshold",
       "The measured displacement in the picture is above the threshold that the method was given. A figure "
       "of each frame (displacement_px.over_threshold, the share of pixels) that a gate may limit; not "
       "listed place by place."},
      {uncovered, "uncovered",
       "Pixels whose reference point has no point of the mesh above or below it. A figure of each frame "
       "(displacement_px.uncovered_px) that a gate may limit; not listed place by place."},
      {skirt_visible, "skirt_visible",
       "Pixels that see a skirt's wall before anything else: the gap that the skirt hides shows as a cliff. "
       "A "
       "hazard."},
  };
  return catalogue;
}

namespace {

std::string stem(FindingCode code) {
  return fmt::format("{}_{}", static_cast<int>(code), finding_name(code));
}
/// Findings about laws need a method, so their example is a case file. What `plumbline check` alone finds has
/// a folder: meshes or tiles that belong together, and what else is asked: a DEM (dem.asc), a bound
/// (declared_m.txt), a POSE (camera.txt). The others' is a mesh.
std::string_view ending(FindingCode code) {
  using enum FindingCode;
  switch (code) {
    case nothing_judged:
    case law_violated:
      return ".toml";
    case tile_encoding:
    case sliver:
    case self_intersection:
    case slit:
    case border_normal:
    case misplaced:
    case declared_error:
    case level_gap:
    case skirt_visible:
      return "";
    default:
      return ".off";
  }
}

}  // namespace

std::string finding_example(FindingCode code) {
  return fmt::format("tests/data/findings/{}{}", stem(code), ending(code));
}

std::string finding_twin(FindingCode code) {
  return fmt::format("tests/data/findings/{}_twin{}", stem(code), ending(code));
}

std::string finding_image(FindingCode code) { return fmt::format("images/findings/{}.svg", stem(code)); }

std::string finding_section(FindingCode code) {
  return fmt::format("docs/findings.md#{}-{}", static_cast<int>(code), finding_name(code));
}

std::string findings_manual() {
  std::string page =
      "# Findings\n\n"
      "This page is written by the program's own catalogue (`oracle/finding.cpp`); a test keeps them "
      "equal. The\npictures are drawn from the example files: witnesses orange, vertices and places red. "
      "Each "
      "example has the\nfinding and no other, its near twin has none; a test judges both.\n\n"
      "Codes are stable: 1xx input, 2xx triangles and edges, 3xx surface, 4xx hierarchy and laws, 5xx "
      "picture. One\n"
      "cause makes one finding: what a lower layer has told, a higher one does not repeat. So a triangle "
      "with a bad\n"
      "index leaves no hole behind it, a triangle twice is no overlap, a reversed one no gap.\n\n"
      "Findings of layers 1 to 3 about a mesh are decided exactly, without a tolerance. Gaps, areas and "
      "distances only\n"
      "describe them, and are rounded.\n";
  for (const FindingDescription& entry : finding_catalogue()) {
    page += fmt::format("\n## {} `{}`\n\n{}\n", static_cast<int>(entry.code), entry.name, entry.definition);
    if (!entry.kinds.empty()) page += '\n';
    for (const FindingKindDescription& kind : entry.kinds)
      page += fmt::format("- `{}`: {}.\n", kind.name, kind.meaning);
    page += fmt::format("\n![{} in its example]({})\n\n[Example](../{}) · [near twin](../{})\n", entry.name,
                        finding_image(entry.code), finding_example(entry.code), finding_twin(entry.code));
    if (!entry.drawing.empty()) page += fmt::format("\n```text{}```\n", entry.drawing);
  }
  return page;
}

}  // namespace plumbline::oracle
