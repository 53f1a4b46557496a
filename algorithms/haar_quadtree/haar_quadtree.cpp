// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// M1, the Haar vertex quadtree.
// E. Yusov, V. Turlapov: "Dynamic terrain simplification based on Haar transform and vertices quadtree" (in
// Russian), GraphiCon 2006. Implemented here: the vertex quadtree with averaged nodes and Haar detail norms,
// the screen error, the bottom-up pass of the first frame and the coherent top-down pass, the adaptive
// triangulation, morphing by error, the node budget. Promises: METHODS M1.C1–C8. Departures, with reasons:
// the Haar step is mean-normalised, so that ε is in metres; the triangulation walks the dual of the
// partition, which gives the same triangle set as the paper's fans; κ stands for the paper's s·d_near.
#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>
#include <queue>

#include <fmt/format.h>

#include "algorithms/haar_quadtree/dual_mesh.h"
#include "algorithms/haar_quadtree/forest.h"
#include "algorithms/registry.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

using haar_quadtree::children;
using haar_quadtree::Cut;
using haar_quadtree::Forest;
using haar_quadtree::Node;

struct Settings {
  bool morph = false;
  bool cull = true;
  double lambda = 2;          ///< morphing runs over [τ, λτ]
  std::size_t max_nodes = 0;  ///< budget of roots; 0: none
  int patch_size = 0;         ///< samples a side; 0: as large as the terrain allows
};

/// A root that wants to split: largest error first, then the lower index.
struct Candidate {
  double error_px;
  std::size_t index;
  Node node;
  friend bool operator<(const Candidate& a, const Candidate& b) {
    return a.error_px != b.error_px ? a.error_px < b.error_px : a.index > b.index;
  }
};

/// One frame's pass over the cut.
class Pass {
 public:
  Pass(const Forest& forest, Cut& cut, const Camera& camera, double threshold_px, const Settings& settings,
       Counters& counters)
      : forest_(forest),
        cut_(cut),
        camera_(camera),
        tau_(threshold_px),
        settings_(settings),
        counters_(counters) {}

  /// The node's screen error; 0 for a culled node, which so stands for its whole subtree.
  double error_px(Node node) {
    ++counters_.evaluated;
    if (settings_.cull && forest_.culled(node, camera_)) return 0;
    return forest_.screen_error_px(node, camera_);
  }

  /// First frame, bottom-up: a node becomes a root if its four children are and its error is under τ.
  void from_leaves() {
    for_each_patch([this](Node patch) { collapse(patch); });
    if (settings_.max_nodes > 0) keep_largest_errors();
  }

  /// Later frames, top-down: at most one level of change on each path.
  void from_roots() {
    for_each_patch([this](Node patch) { visit(patch); });
    if (settings_.max_nodes == 0) return;
    // All merges are done, so the budget is settled by error, not by the order of the walk.
    std::sort(candidates_.begin(), candidates_.end(),
              [](const Candidate& a, const Candidate& b) { return b < a; });
    for (const Candidate& candidate : candidates_) {
      if (roots_ + 3 > settings_.max_nodes) break;
      split(candidate.node);
      roots_ += 3;
    }
  }

 private:
  template <class Action>
  void for_each_patch(Action action) {
    for (int b = 0; b < forest_.patches_y(); ++b) {
      for (int a = 0; a < forest_.patches_x(); ++a) action(Node{0, a, b});
    }
  }

  bool collapse(Node node) {
    ++counters_.visited;
    if (node.level == forest_.leaf_level()) return true;
    bool all_roots = true;
    for (const Node& child : children(node)) all_roots = collapse(child) && all_roots;
    const bool becomes_root = all_roots && error_px(node) < tau_;
    cut_.set_split(node, !becomes_root);
    return becomes_root;
  }

  /// Refines again from the patches' roots inside the cut just found, largest error first, until the budget
  /// is spent.
  void keep_largest_errors() {
    Cut wanted = cut_;
    cut_.clear();
    std::priority_queue<Candidate> queue;
    const auto offer = [&](Node node) {
      if (wanted.is_split(node)) queue.push({error_px(node), forest_.index(node), node});
    };
    std::size_t roots = 0;
    for_each_patch([&](Node patch) {
      offer(patch);
      ++roots;
    });
    while (!queue.empty() && roots + 3 <= settings_.max_nodes) {
      const Node node = queue.top().node;
      queue.pop();
      cut_.set_split(node, true);
      roots += 3;
      for (const Node& child : children(node)) offer(child);
    }
  }

  void visit(Node node) {
    ++counters_.visited;
    if (!cut_.is_split(node)) {
      ++roots_;
      if (node.level == forest_.leaf_level()) return;
      const double error = error_px(node);
      if (!(error > tau_)) return;
      if (settings_.max_nodes == 0) {
        split(node);
      } else {
        candidates_.push_back({error, forest_.index(node), node});
      }
      return;
    }
    const std::array<Node, 4> below = children(node);
    const bool all_roots =
        std::none_of(below.begin(), below.end(), [this](Node child) { return cut_.is_split(child); });
    if (all_roots && error_px(node) < tau_) {
      cut_.set_split(node, false);
      ++counters_.merged;
      ++roots_;
      return;
    }
    for (const Node& child : below) visit(child);
  }

  void split(Node node) {
    cut_.set_split(node, true);
    ++counters_.split;
  }

  const Forest& forest_;
  Cut& cut_;
  const Camera& camera_;
  double tau_;
  const Settings& settings_;
  Counters& counters_;
  std::vector<Candidate> candidates_;
  std::size_t roots_ = 0;
};

class HaarQuadtree final : public LodMethod {
 public:
  explicit HaarQuadtree(const Settings& settings) : settings_(settings) {}

  void prepare(const Terrain& terrain) override {
    const int level = leaf_level(terrain);
    forest_ = std::make_shared<const Forest>(terrain, level);
    reset();
  }

  void update(const Camera& camera, LodFrame& frame) override {
    frame.clear();
    if (!cut_) {
      cut_.emplace(*forest_);
      vertex_of_.resize(forest_->node_count());
    }
    frame.counters.nodes = forest_->node_count();
    Pass pass(*forest_, *cut_, camera, threshold_px(), settings_, frame.counters);
    if (first_frame_) {
      pass.from_leaves();
    } else {
      pass.from_roots();
    }
    first_frame_ = false;

    for (int b = 0; b < forest_->patches_y(); ++b) {
      for (int a = 0; a < forest_->patches_x(); ++a) place({0, a, b}, pass, frame);
    }
    haar_quadtree::triangulate(*cut_, vertex_of_, frame.mesh.triangles);
    if (frame.mesh.triangles.empty()) {  // a lone root has no triangle, and so no vertex in the mesh
      frame.mesh.clear();
      frame.vertex_keys.clear();
    }
    frame.domain.add_rectangle({0, 0}, forest_->extent_m());
  }

  [[nodiscard]] SampleBlock reference(const Terrain&) const override {
    return {forest_->columns(forest_->leaf_level()), forest_->rows(forest_->leaf_level())};
  }

  void reset() override {
    first_frame_ = true;
    if (cut_) cut_->clear();
  }

  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override {
    auto copy = std::make_unique<HaarQuadtree>(settings_);
    copy->forest_ = forest_;
    copy->set_threshold_px(threshold_px());
    return copy;
  }

 private:
  /// A patch has 2^level samples a side. Samples beyond the last whole patch are not represented.
  [[nodiscard]] int leaf_level(const Terrain& terrain) const {
    const int least = std::min(terrain.columns, terrain.rows) - 1;
    int level = 0;
    if (settings_.patch_size > 0) {
      while ((1 << level) < settings_.patch_size) ++level;
      if (level < 1 || (1 << level) != settings_.patch_size || settings_.patch_size > least) {
        throw InputError(
            fmt::format("haar_quadtree: option patch_size = {} is no power of two up to {}, the "
                        "lesser side of {} x {} samples less one",
                        settings_.patch_size, least, terrain.columns, terrain.rows));
      }
      return level;
    }
    if (least < 2) {
      throw InputError(fmt::format("haar_quadtree: cannot take {} x {} samples; it needs at least 3 a side",
                                   terrain.columns, terrain.rows));
    }
    // The largest patch that divides both sides; where that is under 16, patches of 16 (or of what fits).
    const unsigned cells =
        static_cast<unsigned>(terrain.columns - 1) | static_cast<unsigned>(terrain.rows - 1);
    level = std::countr_zero(cells);
    while (level < 4 && (2 << level) <= least) ++level;
    return level;
  }

  /// Gives every root below `node` its vertex.
  void place(Node node, Pass& pass, LodFrame& frame) {
    if (!cut_->is_split(node)) {
      add(node, forest_->position(node), frame);
      return;
    }
    const std::array<Node, 4> below = children(node);
    const bool all_roots =
        std::none_of(below.begin(), below.end(), [this](Node child) { return cut_->is_split(child); });
    if (!settings_.morph || !all_roots) {
      for (const Node& child : below) place(child, pass, frame);
      return;
    }
    // Geomorphing: C_i = α·C_i⁰ + (1−α)·P, α from 0 at τ to 1 at λτ.
    const double tau = threshold_px();
    const double alpha = std::clamp((pass.error_px(node) - tau) / (settings_.lambda * tau - tau), 0.0, 1.0);
    const Vec3 parent = forest_->position(node);
    for (const Node& child : below)
      add(child, alpha * forest_->position(child) + (1 - alpha) * parent, frame);
  }

  void add(Node root, Vec3 position, LodFrame& frame) {
    const std::size_t index = forest_->index(root);
    vertex_of_[index] = static_cast<std::uint32_t>(frame.mesh.positions.size());
    frame.mesh.positions.push_back(position);
    frame.vertex_keys.push_back(index);
  }

  Settings settings_;
  std::shared_ptr<const Forest> forest_;
  std::optional<Cut> cut_;
  std::vector<std::uint32_t> vertex_of_;
  bool first_frame_ = true;
};

Settings read_settings(std::string_view variant, const Options& options) {
  Settings s;
  s.morph = variant == "morph";
  s.cull = option_flag(options, "cull", s.cull);
  s.lambda = option_number(options, "lambda", s.lambda);
  const double nodes = option_number(options, "max_nodes", 0);
  const double patch = option_number(options, "patch_size", 0);
  if (!(s.lambda > 1 && std::isfinite(s.lambda))) {
    throw InputError(fmt::format("haar_quadtree: option lambda = {} is not above 1", s.lambda));
  }
  if (!(nodes >= 0 && nodes <= 1e9) || nodes != std::floor(nodes)) {
    throw InputError(
        fmt::format("haar_quadtree: option max_nodes = {} is no whole number from 0 (no budget) "
                    "to 10^9",
                    nodes));
  }
  if (!(patch >= 0 && patch <= (1 << 20)) || patch != std::floor(patch)) {
    throw InputError(
        fmt::format("haar_quadtree: option patch_size = {} is no power of two; give 128, 256, "
                    "…, or 0 for the largest that divides the terrain",
                    patch));
  }
  s.max_nodes = static_cast<std::size_t>(nodes);
  s.patch_size = static_cast<int>(patch);
  return s;
}

}  // namespace

MethodDescription describe_haar_quadtree() {
  using enum Promise;
  return {
      .id = "haar_quadtree",
      .title = "Haar transform and quadtree of vertices",
      .citation =
          "E. Yusov, V. Turlapov: \"Dynamic terrain simplification based on Haar transform and vertices "
          "quadtree\" (in Russian), GraphiCon 2006",
      .section = "M1",
      .variants =
          {
              {"",
               "as published: bottom-up at the first frame, then one level of change a frame",
               {conforming}},
              {"morph",
               "children move to their parent while its error is between tau and lambda tau",
               {conforming}},
          },
      .options =
          {
              {"patch_size", "samples along a patch's side, 2^n; 0: the largest that divides the terrain",
               0.0},
              {"lambda", "morph: geomorphing runs over errors from tau to lambda tau", 2.0},
              {"max_nodes", "budget: no more roots than this, largest screen errors first; 0: none", 0.0},
              {"cull", "nodes outside the view cone stand for their whole subtree", true},
          },
      .claims =
          {
              {"M1.C1", "no cracks and no T-junctions, inside patches and across, for any levels"},
              {"M1.C2", "nothing is added for stitching: one or two triangles a partition corner"},
              {"M1.C3", "update cost follows the model, not the terrain"},
              {"M1.C4", "merging at alpha = 0 changes nothing visible"},
              {"M1.C5", "tau bounds the error in the image"},
              {"M1.C6", "the triangulation exists for any set of roots, free of fold-overs"},
              {"M1.C7", "averaged nodes give a smaller vertical error than sampled ones at the same cut"},
              {"M1.C8", "the screen error takes the camera's orientation into account"},
          },
      .make = [](std::string_view variant, const Options& options) -> std::unique_ptr<LodMethod> {
        return std::make_unique<HaarQuadtree>(read_settings(variant, options));
      },
  };
}

}  // namespace plumbline
