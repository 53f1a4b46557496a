// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// M5.C1 and M5.C4: random legal orders of collapses and splits against the paper's definition 1.
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "m5_support.h"

namespace plumbline::vertex_tree {
namespace {

// The same draws in every run; RC_PARAMS in the environment goes before.
[[maybe_unused]] const int kPinned = setenv("RC_PARAMS", "seed=20261123", 0);

std::shared_ptr<const VertexTree> random_tree(Random& random) {
  BuildSettings settings;
  settings.normal_angle_deg = random.between(30, 120);
  settings.least_quality = random.between(0, 0.2);
  return std::make_shared<const VertexTree>(build_tree(random_mesh(random), settings));
}

std::uint32_t random_made_node(const VertexTree& tree, Random& random) {
  return static_cast<std::uint32_t>(tree.originals + random.below(tree.made()));
}

TEST(M5Identifiers, M5_C1_EveryRandomLegalStepMeetsTheNeighbourhoodOfBuilding) {
  std::uint64_t sequences = 0, steps = 0, refused = 0;
  EXPECT_TRUE(rc::check("stars as at build time", [&](std::uint64_t seed) {
    Random random(seed);
    const auto tree = random_tree(random);
    if (tree->made() == 0) RC_DISCARD("nothing collapses");
    const BuildStars built(*tree);
    for (int sequence = 0; sequence < 1000; ++sequence, ++sequences) {
      Cut cut(tree);
      // A random share of collapses: some sequences go deep, some hover.
      const double towards_collapse = random.between(0.4, 1);
      for (int tries = 0; tries < 60; ++tries) {
        const auto p = random_made_node(*tree, random);
        const std::size_t k = p - tree->originals;
        const auto [a, b] = tree->children[k];
        if (random.unit() < towards_collapse) {
          if (!cut.present(a) || !cut.present(b)) continue;
          const bool as_built = star_of(cut, {a, b}) == built.before[k];
          RC_ASSERT(cut.may_collapse(p) == as_built);  // definition 2 iff definition 1
          if (!as_built) {
            ++refused;
            continue;
          }
          cut.collapse(p);
          RC_ASSERT(star_of(cut, {p}) == built.after[k]);
        } else {
          if (!cut.present(p)) continue;
          const bool as_built = star_of(cut, {p}) == built.after[k];
          RC_ASSERT(cut.may_split(p) == as_built);
          if (!as_built) {
            ++refused;
            continue;
          }
          cut.split(p);
          RC_ASSERT(star_of(cut, {a, b}) == built.before[k]);
        }
        ++steps;
      }
    }
  }));
  std::printf("%llu sequences, %llu steps, %llu refusals\n", static_cast<unsigned long long>(sequences),
              static_cast<unsigned long long>(steps), static_cast<unsigned long long>(refused));
  EXPECT_GE(sequences, 90'000u);
  EXPECT_GE(steps, 100'000u);
  EXPECT_GE(refused, 10'000u) << "without refusals the two tests judged nothing";
}

TEST(M5Identifiers, TheIncrementalStateIsTheOneThatClimbingTheTreeGives) {
  EXPECT_TRUE(rc::check("stars, M and m, and the lemma", [](std::uint64_t seed) {
    Random random(seed);
    const auto tree = random_tree(random);
    if (tree->made() == 0) RC_DISCARD("nothing collapses");
    Cut cut(tree);
    for (int tries = 0; tries < 300; ++tries) {
      const auto p = random_made_node(*tree, random);
      if (cut.may_collapse(p)) {
        cut.collapse(p);
      } else if (cut.may_split(p) && random.below(3) == 0) {
        cut.split(p);
      } else if (cut.present(p) && random.below(10) == 0) {
        cut.force_split(p);
        RC_ASSERT(!cut.present(p));
      } else {
        continue;
      }
      const auto present = present_nodes(cut);
      for (std::uint32_t v = 0; v < tree->nodes(); ++v) {
        if (!cut.present(v)) continue;
        const Star star = star_by_climbing(*tree, present, {v});
        RC_ASSERT(star_of(cut, {v}) == star);
        std::uint32_t greatest = 0, least = kNone;
        for (const auto& [t, corners] : star) {
          for (const auto u : corners) {
            if (u == v) continue;
            greatest = std::max(greatest, u);
            if (u != tree->partner(v)) least = std::min(least, tree->parent[u]);
            RC_ASSERT(v < tree->parent[u]);  // the adjacency lemma
          }
        }
        RC_ASSERT(cut.greatest_neighbour(v) == greatest);
        RC_ASSERT(cut.least_parent(v) == least);
      }
    }
  }));
}

TEST(M5Identifiers, WithoutTheTwoTestsWrongStarsAppear) {
  std::uint64_t wrong = 0, right = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Random random(seed);
    const auto tree = random_tree(random);
    if (tree->made() == 0) continue;
    const BuildStars built(*tree);
    std::vector<std::uint8_t> present(tree->nodes(), 0);
    std::fill_n(present.begin(), tree->originals, std::uint8_t{1});
    for (int tries = 0; tries < 300; ++tries) {
      const auto p = random_made_node(*tree, random);
      const auto [a, b] = tree->children[p - tree->originals];
      if (!present[a] || !present[b]) continue;
      (star_by_climbing(*tree, present, {a, b}) == built.before[p - tree->originals] ? right : wrong) += 1;
      present[a] = present[b] = 0;
      present[p] = 1;
    }
  }
  EXPECT_GT(wrong, 100u);
  EXPECT_GT(right, 100u);
}

TEST(M5Identifiers, M5_C4_ASplitUndoesItsCollapseBitForBit) {
  EXPECT_TRUE(rc::check("collapse, split: the same state", [](std::uint64_t seed) {
    Random random(seed);
    const auto tree = random_tree(random);
    if (tree->made() == 0) RC_DISCARD("nothing collapses");
    Cut cut(tree);
    for (int tries = 0; tries < 200; ++tries) {
      const auto p = random_made_node(*tree, random);
      if (cut.may_collapse(p)) {
        const Snapshot before(cut);
        cut.collapse(p);
        const Snapshot after(cut);
        RC_ASSERT(!(before == after));
        cut.split(p);
        RC_ASSERT(Snapshot(cut) == before);
        cut.collapse(p);
        RC_ASSERT(Snapshot(cut) == after);
      } else if (cut.may_split(p)) {
        cut.split(p);
      }
    }
    cut.refine(tree->triangles.size());
    RC_ASSERT(Snapshot(cut) == Snapshot(Cut(tree)));
  }));
}

}  // namespace
}  // namespace plumbline::vertex_tree
