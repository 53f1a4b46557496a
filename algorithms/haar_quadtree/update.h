// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "algorithms/haar_quadtree/cut.h"
#include "algorithms/haar_quadtree/forest.h"
#include "algorithms/lod_method.h"
#include "scenarios/camera.h"

namespace plumbline::haar_quadtree {

struct Settings {
  bool morph = false;
  bool cull = true;
  double lambda = 2;          ///< morphing runs over [τ, λτ]
  std::size_t max_nodes = 0;  ///< budget of roots; 0: none
  int patch_size = 0;         ///< samples a side; 0: as large as the terrain allows
};

/// One frame's way from a cut to the next. `Counters::evaluated` counts every screen error that the rules ask
/// for.
class Update {
 public:
  Update(const Forest& forest, const Settings& settings, const Camera& camera, double threshold_px,
         Counters& counters)
      : forest_(forest), settings_(settings), camera_(camera), tau_px_(threshold_px), counters_(counters) {}

  /// First frame, bottom-up: a node becomes a root if its four children are and its error is under τ. Under a
  /// budget the cut so found is refined again from the patches' roots, largest error first, until the budget
  /// is spent.
  void from_leaves(Cut& cut);

  /// Later frames, top-down: at most one level of change on each path. Under a budget all merges come first;
  /// then the largest errors split while there is room. Cost proportional to the two cuts.
  void from_roots(const Cut& before, Cut& after);

  /// The node's screen error, px; 0 for a culled node with an error of τ or more, which so stands for its
  /// whole subtree. (Under τ, culled or not makes no difference to any rule.)
  double error_px(const Node& node) {
    ++counters_.evaluated;
    const double error = forest_.screen_error_px(node, camera_);
    return error >= tau_px_ && settings_.cull && forest_.culled(node, camera_) ? 0 : error;
  }

 private:
  /// A root that wants to split: the largest error first, then the lower index.
  struct Candidate {
    double error_px;
    std::size_t index;
    Node node;
    Cut::Slot from, to;  ///< slots in the cut that allows the split, and in the one that is made
    friend bool operator<(const Candidate& a, const Candidate& b) {
      return a.error_px != b.error_px ? a.error_px < b.error_px : a.index > b.index;
    }
  };
  bool collapse(const Node& node, Cut& cut, Cut::Slot slot);
  void keep_largest_errors(const Cut& wanted, Cut& cut);
  void visit(const Cut& before, Cut::Slot from, Cut& after, Cut::Slot to, const Node& node);

  const Forest& forest_;
  const Settings& settings_;
  const Camera& camera_;
  double tau_px_;
  Counters& counters_;
  std::vector<Candidate> candidates_;
  std::size_t roots_ = 0;
};

}  // namespace plumbline::haar_quadtree
