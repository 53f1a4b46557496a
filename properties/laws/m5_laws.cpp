// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Laws of M5, the vertex tree (METHODS M5). Each replays the recorded collapses with triangles of its own.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "algorithms/vertex_tree/vertex_tree.h"
#include "properties/laws/trial.h"
#include "scenarios/portable_math.h"

namespace plumbline::properties {
namespace {

using vertex_tree::BuildSettings;
using vertex_tree::VertexTree;
using Triangle = std::array<std::uint32_t, 3>;

bool is_vertex_tree(const MethodChoice& choice) { return choice.method->id == "vertex_tree"; }

/// Replaying looks at every triangle for every collapse: larger terrains are left to the method's own tests.
constexpr std::size_t kMostTriangles = 600;

std::uint8_t border_line(const Terrain& terrain, int i, int j) {
  return static_cast<std::uint8_t>((i == 0 ? 1 : 0) | (i + 1 == terrain.columns ? 2 : 0) | (j == 0 ? 4 : 0) |
                                   (j + 1 == terrain.rows ? 8 : 0));
}

/// The tree as the method makes it of a terrain.
struct Built {
  VertexTree tree;
  BuildSettings settings;
  std::vector<std::uint8_t> lines;  ///< by original: the sides of the terrain it lies on
};
Built build(const LawInput& input) {
  Built out;
  const Terrain& terrain = input.terrain;
  out.settings.normal_angle_deg =
      option_number(input.options, "normal_angle_deg", out.settings.normal_angle_deg);
  out.settings.least_quality = option_number(input.options, "least_quality", out.settings.least_quality);
  out.settings.least_triangles = static_cast<std::size_t>(option_number(input.options, "least_triangles", 0));
  for (int j = 0; j < terrain.rows; ++j) {
    for (int i = 0; i < terrain.columns; ++i) out.lines.push_back(border_line(terrain, i, j));
  }
  out.tree = build_tree(reference_mesh(terrain), out.settings, out.lines);
  return out;
}

/// Everything below a node.
std::vector<std::uint32_t> below(const VertexTree& tree, std::uint32_t p) {
  std::vector<std::uint32_t> nodes{p};
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (nodes[k] < tree.originals) continue;
    for (const std::uint32_t child : tree.children[nodes[k] - tree.originals]) nodes.push_back(child);
  }
  return nodes;
}

bool has(const Triangle& t, std::uint32_t v) { return std::find(t.begin(), t.end(), v) != t.end(); }

Vec3 normal(const VertexTree& tree, const Triangle& t) {
  const Vec3 p = tree.positions[t[0]];
  return cross(tree.positions[t[1]] - p, tree.positions[t[2]] - p);
}

/// Cosines and lengths are rounded otherwise here; relative.
constexpr double kRounding = 1e-9;

/// The triangles as collapse after collapse leaves them, with the normals that each node has seen.
class Replay {
 public:
  explicit Replay(const Built& built) : tree_(built.tree), settings_(built.settings), now_(tree_.triangles) {
    live_.assign(now_.size(), true);
    lines_ = built.lines;
    normals_.resize(tree_.nodes());
    for (std::uint32_t v = 0; v < tree_.originals; ++v) see(v);
    cos_limit_ = exact_cos(settings_.normal_angle_deg * kRadiansPerDegree);
  }

  /// Makes the next node; what is wrong with it, or nothing.
  std::string make(std::uint32_t p) {
    const auto [a, b] = tree_.children[p - tree_.originals];
    const Vec3 at = tree_.positions[p];
    if (!(at == (tree_.positions[a] + tree_.positions[b]) * 0.5))
      return "it does not stand at the edge's middle";
    if (lines_[a] != lines_[b]) return "its children lie on different sides of the terrain";
    lines_.push_back(lines_[a]);
    rings_.emplace_back();
    double radius_m = 0;
    for (std::size_t t = 0; t < now_.size(); ++t) {
      if (!live_[t] || !(has(now_[t], a) || has(now_[t], b))) continue;
      if (has(now_[t], a) && has(now_[t], b)) {
        live_[t] = false;
        continue;
      }
      const Vec3 before = normal(tree_, now_[t]);
      for (std::uint32_t& corner : now_[t]) {
        if (corner == a || corner == b) corner = p;
      }
      const Vec3 after = normal(tree_, now_[t]);
      const double was = length(before), is = length(after);
      if (was > 0 && dot(before, after) < (cos_limit_ - kRounding) * was * is)
        return "a triangle's normal turns too far";
      double sides = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        rings_.back().push_back(now_[t][k]);
        const Vec3 side = tree_.positions[now_[t][(k + 1) % 3]] - tree_.positions[now_[t][k]];
        sides += dot(side, side);
        radius_m = std::max(radius_m, length(tree_.positions[now_[t][k]] - at));
      }
      if (2 * std::sqrt(3.0) * is < settings_.least_quality * sides * (1 - kRounding))
        return "a triangle is too thin";
    }
    for (const std::uint32_t v : below(tree_, p))
      radius_m = std::max(radius_m, length(tree_.positions[v] - at));
    if (tree_.radii_m[p] < radius_m * (1 - kRounding))
      return "its ball leaves out what it stands for, or its ring";
    for (const std::uint32_t child : {a, b}) {
      normals_[p].insert(normals_[p].end(), normals_[child].begin(), normals_[child].end());
    }
    see(p);
    const vertex_tree::NormalCone& cone = tree_.cones[p - tree_.originals];
    for (const Vec3 n : normals_[p]) {
      if (dot(cone.axis, n) < (cone.cos_half - kConeRounding) * length(n))
        return "its cone leaves out a normal";
    }
    return {};
  }

  /// Nodes that stood around made node p when it was made, with repeats.
  [[nodiscard]] const std::vector<std::uint32_t>& ring(std::uint32_t p) const {
    return rings_[p - tree_.originals];
  }

 private:
  /// A cone takes in its children's by their half angles, which costs some rounding each time.
  static constexpr double kConeRounding = 1e-6;

  void see(std::uint32_t v) {
    for (std::size_t t = 0; t < now_.size(); ++t) {
      if (live_[t] && has(now_[t], v)) normals_[v].push_back(normal(tree_, now_[t]));
    }
  }

  const VertexTree& tree_;
  const BuildSettings& settings_;
  std::vector<Triangle> now_;
  std::vector<bool> live_;
  std::vector<std::uint8_t> lines_;
  std::vector<std::vector<Vec3>> normals_;
  std::vector<std::vector<std::uint32_t>> rings_;  ///< by made node
  double cos_limit_ = 0;
};

bool too_large(const Terrain& terrain) {
  return 2 * static_cast<std::size_t>(terrain.columns - 1) * static_cast<std::size_t>(terrain.rows - 1) >
         kMostTriangles;
}

LawOutcome check_tree(const LawInput& input) {
  if (too_large(input.terrain)) return vacuous("more triangles than are replayed");
  const Built built = build(input);
  const VertexTree& tree = built.tree;
  if (tree.made() == 0) return vacuous("no collapse is safe");
  Replay replay(built);
  for (auto p = static_cast<std::uint32_t>(tree.originals); p < tree.nodes(); ++p) {
    const std::string wrong = replay.make(p);
    if (wrong.empty()) continue;
    const Vec3 at = tree.positions[p];
    return violated(fmt::format("node {} at ({}, {}, {}): {}", p, at.x, at.y, at.z, wrong),
                    law_finding("collapse_not_as_recorded", at));
  }
  return held();
}

LawOutcome check_contour(const LawInput& input) {
  if (too_large(input.terrain)) return vacuous("more triangles than are replayed");
  const Built built = build(input);
  const VertexTree& tree = built.tree;
  LodFrame frame;
  const Camera camera = judged_camera(input);
  prepared_method(input)->update(camera, frame);
  bool collapsed = false, on_contour = false;
  for (const std::uint64_t key : frame.vertex_keys) {
    const auto p = static_cast<std::uint32_t>(key);
    if (p < tree.originals) continue;
    collapsed = true;
    // Original triangles in the node's reach that face the eye, and that do not: between them the contour
    // runs.
    const std::vector<std::uint32_t> nodes = below(tree, p);
    bool front = false, back = false;
    for (const Triangle& t : tree.triangles) {
      if (std::none_of(nodes.begin(), nodes.end(), [&](std::uint32_t v) { return has(t, v); })) continue;
      const Vec3 n = normal(tree, t), way = tree.positions[t[0]] - camera.position;
      const double facing = dot(n, way), doubt = kRounding * length(n) * length(way);
      front = front || facing < -doubt;
      back = back || facing > doubt;
    }
    if (!front || !back) continue;
    return violated(
        fmt::format("node {} was collapsed on the contour: triangles in its reach face the eye and turn from "
                    "it",
                    p),
        law_finding("contour_collapsed", tree.positions[p]));
  }
  for (std::uint32_t v = 0; v < tree.originals && !on_contour; ++v) {
    bool front = false, back = false;
    for (const Triangle& t : tree.triangles) {
      if (!has(t, v)) continue;
      (dot(normal(tree, t), tree.positions[v] - camera.position) < 0 ? front : back) = true;
    }
    on_contour = front && back;
  }
  return collapsed && on_contour ? held() : vacuous("nothing collapsed, or no contour");
}

LawOutcome check_neighbourhoods(const LawInput& input) {
  if (too_large(input.terrain)) return vacuous("more triangles than are replayed");
  const Built built = build(input);
  const VertexTree& tree = built.tree;
  Replay replay(built);
  for (auto p = static_cast<std::uint32_t>(tree.originals); p < tree.nodes(); ++p) {
    if (!replay.make(p).empty()) return vacuous("the tree is not as recorded: another law's matter");
  }
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  LodFrame frame;
  bool some = false;
  for (const Camera& camera : cameras(input)) {
    method->update(camera, frame);
    // Made: present, or part of what is.
    std::vector<std::uint8_t> made(tree.nodes(), 0);
    for (const std::uint64_t key : frame.vertex_keys) {
      for (const std::uint32_t v : below(tree, static_cast<std::uint32_t>(key))) made[v] = 1;
    }
    for (auto p = static_cast<std::uint32_t>(tree.originals); p < tree.nodes(); ++p) {
      if (made[p] == 0) continue;
      for (const std::uint32_t around : replay.ring(p)) {
        some = some || around >= tree.originals;
        if (made[around] != 0) continue;
        return violated(
            fmt::format(
                "node {} is collapsed, though node {}, which stood beside it when the tree was built, "
                "is not made yet",
                p, around),
            law_finding("wrong_neighbourhood", tree.positions[p]));
      }
    }
  }
  return some ? held() : vacuous("no collapse next to another");
}

/// The paper's step 6: the share of the triangles for a screen size, thresholds times `scale`.
std::size_t rung(double size_px, double scale, std::size_t full) {
  constexpr std::array<std::pair<double, std::size_t>, 6> kSteps{
      {{300, 10}, {250, 8}, {200, 6}, {150, 4}, {100, 2}, {-1, 1}}};
  for (const auto& step : kSteps) {
    if (size_px > step.first * scale) return full * step.second / 10;
  }
  return full / 10;
}

/// Triangles at the lowest rung: all that may collapse has.
std::size_t least_triangles(const LawInput& input, const Camera& camera) {
  constexpr double kBeyondAllRungs = 0x1p40;
  LawInput coarse = input;
  coarse.threshold_px = input.threshold_px * kBeyondAllRungs;
  LodFrame frame;
  prepared_method(coarse)->update(camera, frame);
  return frame.mesh.triangles.size();
}

LawOutcome check_ladder(const LawInput& input) {
  const Mesh full = reference_mesh(input.terrain);
  const Camera camera = judged_camera(input);
  Vec3 low = full.positions[0], high = low;
  for (const Vec3 p : full.positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 center = (low + high) * 0.5;
  double radius_m = 0;
  for (const Vec3 p : full.positions) radius_m = std::max(radius_m, length(p - center));
  LodFrame frame;
  prepared_method(input)->update(camera, frame);
  std::size_t drawn = frame.mesh.triangles.size();
  if (camera.outside_view_cone(center, radius_m)) return vacuous("out of sight");
  const double distance_m = length(center - camera.position);
  const double size_px =
      distance_m > radius_m
          ? 2 * camera.kappa_px * radius_m / std::sqrt((distance_m - radius_m) * (distance_m + radius_m))
          : std::numeric_limits<double>::infinity();
  // Where rounding chooses the rung there is nothing to judge.
  const std::size_t granted = rung(size_px, input.threshold_px, full.triangles.size());
  if (rung(size_px * (1 + kRounding), input.threshold_px, full.triangles.size()) != granted ||
      rung(size_px * (1 - kRounding), input.threshold_px, full.triangles.size()) != granted) {
    return vacuous("on a rung");
  }
  if (granted < full.triangles.size() && frame.counters.merged == 0) return vacuous("nothing may collapse");
  // A collapse takes two triangles, or one at the border: no frame ends more than one short of what is
  // granted; nor above it, unless no collapse is legal: that is the hold rule's, or the tree's, whose
  // coarsest mesh this then is.
  bool short_of_it = drawn + 2 <= granted;
  const bool above = drawn > granted && drawn > least_triangles(input, camera);
  if (!short_of_it && !above) {
    // After a flight the same, from below: what came nearer is refined.
    drawn = fly(*prepared_method(input), cameras(input)).mesh.triangles.size();
    short_of_it = drawn + 2 <= granted;
  }
  if (!short_of_it && !above) return held();
  return violated(
      fmt::format("{} triangles at a screen size of {:.6g} px, for which the ladder grants {} of {}", drawn,
                  size_px, granted, full.triangles.size()),
      law_finding("off_the_ladder", center));
}

}  // namespace

Law law_vertex_tree_is_as_built() {
  return {.id = "M5_tree_is_as_recorded",
          .statement =
              "for every terrain, each made node stands at its edge's middle, its collapse keeps normals, "
              "shapes and the "
              "border within the limits, and its ball and cone hold what it stands for",
          .source = "METHODS M5 (steps 2, 3 and 7)",
          .applies = is_vertex_tree,
          .promised = is_vertex_tree,
          .check = check_tree};
}

Law law_vertex_tree_keeps_neighbourhoods() {
  return {.id = "M5_C1_neighbourhood_of_building",
          .statement =
              "for every terrain, flight and threshold, whatever stood around a node when the tree was built "
              "was made "
              "before the node is",
          .source = "METHODS M5.C1",
          .applies = is_vertex_tree,
          .promised = is_vertex_tree,
          .check = check_neighbourhoods};
}

Law law_vertex_tree_holds_contour() {
  return {.id = "M5_C2_contour_is_held",
          .statement =
              "for every terrain, camera and threshold, a fresh update collapses no node whose original "
              "triangles face "
              "the eye in part",
          .source = "METHODS M5.C2 (step 7)",
          .applies =
              [](const MethodChoice& choice) {
                return is_vertex_tree(choice) && choice.variant->name != "no_contour";
              },
          .promised =
              [](const MethodChoice& choice) {
                return is_vertex_tree(choice) && choice.variant->name != "no_contour";
              },
          .check = check_contour};
}

Law law_vertex_tree_meets_ladder() {
  return {.id = "M5_ladder_is_met",
          .statement =
              "for every terrain, camera and threshold, a fresh update draws what the ladder of screen sizes "
              "grants, as "
              "far as collapses are legal",
          .source = "METHODS M5 (step 6)",
          .applies = is_vertex_tree,
          .promised = is_vertex_tree,
          .check = check_ladder};
}

}  // namespace plumbline::properties
