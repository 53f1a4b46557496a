// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/haar_quadtree/update.h"

#include <algorithm>
#include <queue>

#include "algorithms/mutant.h"

namespace plumbline::haar_quadtree {
namespace {

Cut::Slot nth(Cut::Slot first, int corner) { return first + static_cast<Cut::Slot>(corner); }

}  // namespace

void Update::from_leaves(Cut& cut) {
  cut.start(forest_.patches());
  for (std::size_t p = 0; p < forest_.patches(); ++p) {
    collapse(forest_.patch(p), cut, static_cast<Cut::Slot>(p));
  }
  if (settings_.max_nodes == 0) return;
  const Cut wanted = cut;
  keep_largest_errors(wanted, cut);
}

bool Update::collapse(const Node& node, Cut& cut, Cut::Slot slot) {
  ++counters_.visited;
  if (node.level == forest_.leaf_level()) return true;
  const Cut::Slot below = cut.split(slot);
  bool all_roots = true;
  for (int k = 0; k < 4; ++k) all_roots = collapse(child(node, k), cut, nth(below, k)) && all_roots;
  if (PLUMBLINE_MUTANT(m1_single_level)) return false;
  if (!all_roots || !(error_px(node) < tau_px_)) return false;
  cut.take_back(slot);
  return true;
}

void Update::keep_largest_errors(const Cut& wanted, Cut& cut) {
  cut.start(forest_.patches());
  std::priority_queue<Candidate> queue;
  const auto offer = [&](const Node& node, Cut::Slot from, Cut::Slot to) {
    if (!wanted.is_root(from)) queue.push({error_px(node), forest_.index(node), node, from, to});
  };
  for (std::size_t p = 0; p < forest_.patches(); ++p) {
    const auto slot = static_cast<Cut::Slot>(p);
    offer(forest_.patch(p), slot, slot);
  }
  std::size_t roots = forest_.patches();
  while (!queue.empty() && roots + 3 <= settings_.max_nodes) {
    const Candidate next = queue.top();
    queue.pop();
    const Cut::Slot below = cut.split(next.to);
    roots += 3;
    for (int k = 0; k < 4; ++k) {
      offer(child(next.node, k), nth(wanted.children(next.from), k), nth(below, k));
    }
  }
}

void Update::from_roots(const Cut& before, Cut& after) {
  after.start(forest_.patches());
  for (std::size_t p = 0; p < forest_.patches(); ++p) {
    const auto slot = static_cast<Cut::Slot>(p);
    visit(before, slot, after, slot, forest_.patch(p));
  }
  // All merges are done, so the budget is settled by error, not by the order of the walk.
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& a, const Candidate& b) { return b < a; });
  for (const Candidate& candidate : candidates_) {
    if (roots_ + (PLUMBLINE_MUTANT(m1_budget_off_by_one_split) ? 0 : 3) > settings_.max_nodes) break;
    after.split(candidate.to);
    ++counters_.split;
    roots_ += 3;
  }
}

void Update::visit(const Cut& before, Cut::Slot from, Cut& after, Cut::Slot to, const Node& node) {
  ++counters_.visited;
  if (before.is_root(from)) {
    ++roots_;
    if (node.level == forest_.leaf_level()) return;
    const double error = error_px(node);
    if (!(error > (PLUMBLINE_MUTANT(m1_split_late) ? 2 * tau_px_ : tau_px_))) return;
    if (settings_.max_nodes > 0) {
      candidates_.push_back({error, forest_.index(node), node, from, to});
      return;
    }
    after.split(to);
    ++counters_.split;
    return;
  }
  if (before.children_are_roots(from) &&
      error_px(node) < (PLUMBLINE_MUTANT(m1_merge_early) ? 2 * tau_px_ : tau_px_)) {
    ++counters_.merged;
    ++roots_;
    return;
  }
  const Cut::Slot below = after.split(to);
  for (int k = 0; k < 4; ++k) {
    visit(before, nth(before.children(from), k), after, nth(below, k), child(node, k));
  }
}

}  // namespace plumbline::haar_quadtree
