// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Laws of M1, the Haar vertex quadtree (METHODS M1). Each recomputes from the samples what the method keeps.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "algorithms/haar_quadtree/dual_mesh.h"
#include "algorithms/haar_quadtree/haar_quadtree.h"
#include "properties/laws/trial.h"
#include "scenarios/error.h"

namespace plumbline::properties {
namespace {

using haar_quadtree::Cut;
using haar_quadtree::Forest;
using haar_quadtree::HaarQuadtree;
using haar_quadtree::Node;

bool is_haar(const MethodChoice& choice) { return choice.method->id == "haar_quadtree"; }

const HaarQuadtree& as_haar(const LodMethod& method) {
  const auto* haar = dynamic_cast<const HaarQuadtree*>(&method);
  if (haar == nullptr)
    throw InputError("the method has no Haar forest; the laws of M1 speak of haar_quadtree");
  return *haar;
}

/// The samples below a node.
struct Block {
  int i = 0, j = 0, side = 1;
};
Block block_of(const Forest& forest, const Node& node) {
  const int side = 1 << (forest.leaf_level() - node.level);
  return {node.a * side, node.b * side, side};
}

double mean_m(const Terrain& terrain, Block b) {
  double sum = 0;
  for (int j = b.j; j < b.j + b.side; ++j) {
    for (int i = b.i; i < b.i + b.side; ++i) sum += terrain.z(i, j);
  }
  return sum / (static_cast<double>(b.side) * b.side);
}

/// The largest of the three Haar details of a block, mean-normalised: half the differences between the means
/// of its halves, and of its diagonal pairs of quarters.
double detail_m(const Terrain& terrain, Block b) {
  const int h = b.side / 2;
  const double south_west = mean_m(terrain, {b.i, b.j, h}), south_east = mean_m(terrain, {b.i + h, b.j, h});
  const double north_west = mean_m(terrain, {b.i, b.j + h, h}),
               north_east = mean_m(terrain, {b.i + h, b.j + h, h});
  const double west = (south_west + north_west) / 2, east = (south_east + north_east) / 2;
  const double south = (south_west + south_east) / 2, north = (north_west + north_east) / 2;
  const double rising = (south_west + north_east) / 2, falling = (south_east + north_west) / 2;
  return std::max({std::fabs(west - east), std::fabs(south - north), std::fabs(rising - falling)}) / 2;
}

/// Sums over thousands of samples are rounded; relative to the largest height.
constexpr double kSumRounding = 0x1p-40;

double largest_m(const Terrain& terrain) {
  return std::max(std::fabs(terrain.lowest_m()), std::fabs(terrain.highest_m()));
}

template <class Action>
void for_each_inner_node(const Forest& forest, Action&& action) {
  const auto go = [&](const auto& self, const Node& node) -> void {
    if (node.level == forest.leaf_level()) return;
    action(node);
    for (int k = 0; k < 4; ++k) self(self, child(node, k));
  };
  for (std::size_t p = 0; p < forest.patches(); ++p) go(go, forest.patch(p));
}

LawOutcome check_means(const LawInput& input) {
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  const Forest& forest = as_haar(*method).forest();
  const double doubt_m = largest_m(input.terrain) * kSumRounding;
  LawOutcome outcome = vacuous("every node is level");
  for_each_inner_node(forest, [&](const Node& node) {
    if (outcome.kind == LawOutcome::Kind::violated) return;
    const Block block = block_of(forest, node);
    const double mean = mean_m(input.terrain, block), detail = detail_m(input.terrain, block);
    const Vec3 at = forest.position(node);
    if (detail > doubt_m) outcome = held();
    if (std::fabs(at.z - mean) <= doubt_m && std::fabs(forest.error_m(node) - detail) <= doubt_m) return;
    outcome = violated(
        fmt::format("the node over samples ({}, {}) to ({}, {}) stands at {} m with error {} m; their "
                    "mean is {} m, their detail {} m",
                    block.i, block.j, block.i + block.side - 1, block.j + block.side - 1, at.z,
                    forest.error_m(node), mean, detail),
        law_finding("node_is_no_mean", at));
  });
  return outcome;
}

/// Triangles, each from its least corner on, sorted.
std::vector<std::array<std::uint32_t, 3>> in_order(std::vector<std::array<std::uint32_t, 3>> triangles) {
  for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

LawOutcome check_walk(const LawInput& input) {
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  const LodFrame frame = fly(*method, cameras(input));
  if (frame.mesh.triangles.empty()) return vacuous("nothing was drawn");
  const HaarQuadtree& haar = as_haar(*method);
  std::vector<std::array<std::uint32_t, 3>> collapsed;
  collapse_full_triangulation(haar.forest(), haar.cut(), collapsed);
  const auto want = in_order(collapsed), have = in_order(frame.mesh.triangles);
  if (want == have) return held();
  const auto [w, h] = std::mismatch(want.begin(), want.end(), have.begin(), have.end());
  const std::uint32_t v = h != have.end() ? (*h)[0] : (*w)[0];
  return violated(
      fmt::format("{} triangles, {} of the full triangulation are left when it is collapsed to the cut",
                  have.size(), want.size()),
      law_finding("triangulation_differs", frame.mesh.positions.at(v)));
}

/// κ·ε/d·sqrt(1 − (ê_P·ê_z)²), pixels (§3), from the samples below the node.
double screen_error_px(const Terrain& terrain, Block block, Vec3 center, const Camera& camera) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int j = block.j; j < block.j + block.side; ++j) {
    for (int i = block.i; i < block.i + block.side; ++i) {
      low = std::min(low, terrain.z(i, j));
      high = std::max(high, terrain.z(i, j));
    }
  }
  const Vec3 south_west = terrain.point(block.i, block.j);
  const Vec3 north_east = terrain.point(block.i + block.side - 1, block.j + block.side - 1);
  const auto outside = [](double v, double from, double to) { return std::max({from - v, 0.0, v - to}); };
  const Vec3 eye = camera.position;
  const double distance_m =
      length(Vec3{outside(eye.x, south_west.x, north_east.x), outside(eye.y, south_west.y, north_east.y),
                  outside(eye.z, low, high)});
  if (distance_m == 0) return std::numeric_limits<double>::infinity();
  const Vec3 way = center - eye;
  return camera.kappa_px * detail_m(terrain, block) / distance_m * std::sqrt(way.x * way.x + way.y * way.y) /
         length(way);
}

/// The recomputed error is rounded otherwise; relative.
constexpr double kErrorRounding = 1e-9;

/// A node whose four children are roots though its screen error asks for none of them; nothing if there is
/// none.
std::optional<Vec3> needless_split(const HaarQuadtree& haar, const LawInput& input, const Camera& camera) {
  std::optional<Vec3> found;
  const Forest& forest = haar.forest();
  const auto go = [&](const auto& self, const Node& node, Cut::Slot slot) -> void {
    if (haar.cut().is_root(slot) || found) return;
    const Cut::Slot first = haar.cut().children(slot);
    for (int k = 0; k < 4; ++k) self(self, child(node, k), first + static_cast<Cut::Slot>(k));
    if (!haar.cut().children_are_roots(slot)) return;
    const Vec3 at = forest.position(node);
    const double error_px = screen_error_px(input.terrain, block_of(forest, node), at, camera);
    if (error_px < input.threshold_px * (1 - kErrorRounding)) found = at;
  };
  for (std::size_t p = 0; p < forest.patches(); ++p) go(go, forest.patch(p), static_cast<Cut::Slot>(p));
  return found;
}

LawOutcome check_cut(const LawInput& input) {
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  const Camera camera = judged_camera(input);
  if (option_number(input.options, "max_nodes", 0) == 0) {
    LodFrame first;
    method->update(camera, first);
    if (const auto at = needless_split(as_haar(*method), input, camera)) {
      return violated("the first frame splits a node under the threshold",
                      law_finding("needless_split", *at));
    }
    method->reset();
  }
  LodFrame frame = fly(*method, cameras(input));
  const HaarQuadtree& haar = as_haar(*method);
  const Forest& forest = haar.forest();
  const auto budget = static_cast<std::size_t>(option_number(input.options, "max_nodes", 0));
  const bool culls = option_flag(input.options, "cull", true);
  // One level a frame, and the last of these must find nothing to do.
  bool moving = true;
  for (int k = 0; k < forest.leaf_level() + 2 && moving; ++k) {
    method->update(camera, frame);
    moving = frame.counters.split > 0 || frame.counters.merged > 0;
  }
  if (moving) {
    return violated(
        fmt::format("the cut still moves after {} updates with one camera", forest.leaf_level() + 2),
        law_finding("cut_never_settles", camera.position));
  }
  if (const auto at = needless_split(haar, input, camera); at && budget == 0) {
    return violated("a node under the threshold stays split", law_finding("needless_split", *at));
  }
  std::size_t roots = 0;
  bool coarse = false;
  LawOutcome outcome = held();
  for_each_root(forest, haar.cut(), [&](const Node& node, Cut::Slot) {
    ++roots;
    if (node.level == forest.leaf_level() || budget > 0 || outcome.kind == LawOutcome::Kind::violated) return;
    coarse = true;
    const Block block = block_of(forest, node);
    if (culls) {
      bool seen = false;
      for (int j = block.j; j < block.j + block.side; ++j) {
        for (int i = block.i; i < block.i + block.side; ++i)
          seen = seen || camera.sees(input.terrain.point(i, j));
      }
      if (!seen) return;
    }
    const double error_px = screen_error_px(input.terrain, block, forest.position(node), camera);
    if (!(error_px > input.threshold_px * (1 + kErrorRounding))) return;
    oracle::Finding finding = law_finding("root_over_threshold", forest.position(node));
    finding.gap_px = error_px;
    outcome = violated(
        fmt::format("a root over {} x {} samples in the picture has a screen error of {:.6g} px = {:.4g} "
                    "tau",
                    block.side, block.side, error_px, error_px / input.threshold_px),
        std::move(finding));
  });
  if (outcome.kind == LawOutcome::Kind::violated) return outcome;
  if (budget > 0 && roots > std::max(budget, forest.patches())) {
    return violated(fmt::format("{} roots with a budget of {}", roots, budget),
                    law_finding("budget_exceeded", camera.position));
  }
  return coarse || budget > 0 ? held() : vacuous("every root is a sample");
}

/// Positions follow α, and α the recomputed error; relative to the node's size.
constexpr double kMorphRounding = 1e-6;

LawOutcome check_morph(const LawInput& input) {
  const std::unique_ptr<LodMethod> method = prepared_method(input);
  const Camera camera = judged_camera(input);
  const LodFrame frame = fly(*method, cameras(input));
  if (frame.mesh.triangles.empty()) return vacuous("nothing was drawn");
  const HaarQuadtree& haar = as_haar(*method);
  const Forest& forest = haar.forest();
  const Cut& cut = haar.cut();
  const double tau = input.threshold_px, lambda = option_number(input.options, "lambda", 2);
  const bool culls = option_flag(input.options, "cull", true);
  bool between = false;
  LawOutcome outcome = held();
  const auto go = [&](const auto& self, const Node& node, Cut::Slot slot) -> void {
    if (cut.is_root(slot) || outcome.kind == LawOutcome::Kind::violated) return;
    for (int k = 0; k < 4; ++k) self(self, child(node, k), cut.children(slot) + static_cast<Cut::Slot>(k));
    if (!cut.children_are_roots(slot)) return;
    const Block block = block_of(forest, node);
    const Vec3 parent = forest.position(node);
    double error_px = screen_error_px(input.terrain, block, parent, camera);
    if (error_px >= tau && culls && forest.culled(node, camera)) error_px = 0;
    const double alpha = std::clamp((error_px - tau) / (lambda * tau - tau), 0.0, 1.0);
    between = between || (alpha > 0 && alpha < 1);
    for (int k = 0; k < 4; ++k) {
      const Vec3 own = forest.position(child(node, k));
      const Vec3 want = own * alpha + parent * (1 - alpha);
      const Vec3 have = frame.mesh.positions.at(cut.vertex(cut.children(slot) + static_cast<Cut::Slot>(k)));
      if (length(have - want) <= kMorphRounding * length(own - parent)) continue;
      outcome = violated(
          fmt::format("a child stands {:.6g} m from where its weight {:.6g} puts it between itself and its "
                      "parent",
                      length(have - want), alpha),
          law_finding("morph_off", have));
    }
  };
  for (std::size_t p = 0; p < forest.patches(); ++p) go(go, forest.patch(p), static_cast<Cut::Slot>(p));
  if (outcome.kind == LawOutcome::Kind::violated) return outcome;
  return between ? held() : vacuous("nothing is in mid-morph");
}

bool morphs(const MethodChoice& choice) { return is_haar(choice) && choice.variant->name == "morph"; }

}  // namespace

Law law_haar_morphs_by_error() {
  return {.id = "M1_C4_morph_follows_error",
          .statement =
              "for every terrain, flight and threshold, four children that could merge stand between "
              "themselves and "
              "their parent by the weight (error - tau)/(lambda*tau - tau)",
          .source = "METHODS M1 (geomorphing), M1.C4",
          .applies = morphs,
          .promised = morphs,
          .check = check_morph};
}

Law law_haar_nodes_are_means() {
  return {.id = "M1_C7_nodes_are_means",
          .statement =
              "for every terrain, each node stands at the mean of its samples, and its error is the largest "
              "of their "
              "three Haar details",
          .source = "METHODS M1 (preparation), M1.C7",
          .applies = is_haar,
          .promised = is_haar,
          .check = check_means};
}

Law law_haar_walk_is_collapsed_grid() {
  return {
      .id = "M1_C6_walk_is_collapsed_grid",
      .statement =
          "for every terrain, flight and threshold, the mesh is the full triangulation collapsed to the cut",
      .source = "METHODS M1.C6",
      .applies = is_haar,
      .promised = is_haar,
      .check = check_walk};
}

Law law_haar_cut_settles_within_tau() {
  return {.id = "M1_cut_settles_within_tau",
          .statement =
              "for every terrain, flight and threshold, the cut comes to rest within its levels' number of "
              "updates; then, and in the first frame, no node is split for an error under the threshold, no "
              "root in the picture has one over it, and the node budget is kept",
          .source = "METHODS M1 (update)",
          .applies = is_haar,
          .promised = is_haar,
          .check = check_cut};
}

}  // namespace plumbline::properties
