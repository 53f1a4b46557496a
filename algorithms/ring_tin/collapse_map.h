// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "algorithms/tin/tin.h"

namespace plumbline::ring_tin {

/// What M2 knows of a TIN before the first frame, besides the TIN: for every edge the error of its collapse
/// at full resolution, and which end would go (§2.1, step 4 of §3.1). This is what the paper keeps in a
/// database.
struct Prices {
  std::vector<double> error_m;      ///< by edge; +∞: neither direction is valid
  std::vector<std::uint8_t> start;  ///< by edge: which of its two ends collapses, 0 or 1
  friend bool operator==(const Prices&, const Prices&) = default;
};

/// A TIN under half-edge collapses (§3). State is the map rep: V → V alone: the mesh is the image of the full
/// TIN's triangles whose three representatives differ. The vertices of one representative form a binary tree
/// whose depth is capped, so whatever is asked about a live vertex looks at no more than 2^(cap−1) original
/// stars, and nothing else needs to be kept up to date.
///
/// Live: a vertex that represents itself. An edge of the full TIN is active if its image joins two live
/// vertices and no edge of lower index has the same image.
class CollapseMap {
 public:
  CollapseMap(const tin::Tin& tin, const tin::Adjacency& adjacency, const Prices& prices, int depth_cap);

  [[nodiscard]] std::uint32_t rep(std::uint32_t v) const { return rep_[v]; }
  [[nodiscard]] const std::vector<std::uint32_t>& reps() const { return rep_; }
  [[nodiscard]] bool is_live(std::uint32_t v) const { return rep_[v] == v; }
  [[nodiscard]] bool is_active(std::uint32_t edge) const { return active_[edge] != 0; }
  /// The edge whose collapse removed `v`; kNone while v is live.
  [[nodiscard]] std::uint32_t removed_by(std::uint32_t v) const { return removed_by_[v]; }
  /// Active edges at a live vertex are appended, in no particular order.
  void edges_at(std::uint32_t live, std::vector<std::uint32_t>& out) const;
  /// All vertices of the tree that `v` is in are appended, `v` first.
  void members(std::uint32_t v, std::vector<std::uint32_t>& out) const;
  /// Levels of the binary tree over a live vertex; a lone one has 1.
  [[nodiscard]] int depth(std::uint32_t live) const { return depth_[live]; }

  /// Δh of an active edge on the present mesh, metres; +∞: neither direction is valid. Turns the edge so that
  /// it collapses from start to end. Computed when asked, and again only if a triangle at either end changed.
  double price(std::uint32_t edge);
  /// Δh that a removed vertex's collapse had, metres.
  [[nodiscard]] double error_m(std::uint32_t edge) const { return error_m_[edge]; }
  /// Live end of an active edge that would collapse, and the one it would collapse to, as last priced.
  [[nodiscard]] std::uint32_t start(std::uint32_t edge) const;
  [[nodiscard]] std::uint32_t end(std::uint32_t edge) const;

  /// Why a collapse of an active edge is refused, apart from its error.
  enum class Refusal { none, border, depth, road, fold };
  /// `guard`: also refuse if a remaining triangle at the start would lose its positive orientation. Requires:
  /// priced.
  [[nodiscard]] Refusal refusal(std::uint32_t edge, bool guard);

  /// Collapses an active edge from start to end. Requires: priced.
  void collapse(std::uint32_t edge);
  /// Restores every vertex of the tree that `v` is in (§3.2, "return to zero"); appends them to `restored`.
  void reset_tree(std::uint32_t v, std::vector<std::uint32_t>& restored);
  /// Restores trees until no triangle at `restored` is without positive orientation: those that have a corner
  /// in such a triangle. Ends, since the full TIN has none.
  void mend_folds(std::vector<std::uint32_t>& restored);

  /// Live triangles at a live vertex: the two other corners, counter-clockwise, with the full triangle.
  struct Corner {
    std::uint32_t next, after, triangle;
  };
  void star(std::uint32_t live, std::vector<Corner>& out) const;

  /// Live vertices whose triangles changed since the last call, with repeats: the prices and refusals of
  /// their edges may be others now. Some may have been removed since.
  std::vector<std::uint32_t> take_changed();
  void forget_changed() { changed_.clear(); }
  /// How many trees of two vertices or more were reset since the last call.
  std::uint64_t take_trees_reset() { return std::exchange(trees_reset_, 0); }
  /// How many directed errors were computed so far.
  [[nodiscard]] std::uint64_t evaluated() const { return evaluated_; }

  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

 private:
  friend Prices price_all(const tin::Tin& tin, const tin::Adjacency& adjacency);
  struct Image {
    std::uint32_t other, edge;
    friend bool operator<(const Image& a, const Image& b) {
      return a.other != b.other ? a.other < b.other : a.edge < b.edge;
    }
  };
  template <class Visit>
  void for_each_member(std::uint32_t v, Visit visit) const;
  void refresh(std::uint32_t live);
  void mark_changed(std::uint32_t live);
  double directed_error_m(std::uint32_t from, std::uint32_t to);
  [[nodiscard]] bool on_road(std::uint32_t from, std::uint32_t to) const;

  const tin::Tin& tin_;
  const tin::Adjacency& adjacency_;
  int depth_cap_;
  std::vector<std::uint32_t> rep_;
  std::vector<std::uint32_t> next_member_;  ///< ring list of each tree's vertices
  std::vector<std::uint8_t> depth_;
  std::vector<std::uint8_t> active_;
  std::vector<double> error_m_;
  std::vector<std::uint8_t> turned_;  ///< by edge: which end (0, 1) is the start
  std::vector<std::uint32_t> removed_by_;
  std::vector<std::uint8_t> on_road_;
  std::vector<std::uint8_t> road_fixed_;   ///< road ends and junctions never move
  std::uint64_t clock_ = 0;                ///< counts collapses and resets
  std::vector<std::uint64_t> priced_at_;   ///< by edge
  std::vector<std::uint64_t> changed_at_;  ///< by live vertex
  std::vector<std::uint32_t> changed_;
  std::uint64_t evaluated_ = 0;
  std::uint64_t trees_reset_ = 0;
  std::vector<Corner> star_;
  std::vector<Image> images_;
};

/// The prices of a whole TIN at full resolution: linear, each edge by itself.
Prices price_all(const tin::Tin& tin, const tin::Adjacency& adjacency);

}  // namespace plumbline::ring_tin
