// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// O4, slack: each vertex is taken out in turn and the pixels of its star are looked at again. Which triangles
// fill a star is decided by exact orientations; displacements are plain doubles. What is not verified here:
// that the mesh is sound (O1), and what two removals together would do.
#include "oracle/economy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "oracle/image_seen.h"
#include "oracle/predicates.h"

namespace plumbline::oracle {
namespace {

/// A pixel's point of the reference and how far the mesh displaces it.
struct PixelPoint {
  Vec3 point;
  double displacement_px = 0;
};

/// Items of one kind by owner, as compressed rows.
template <class Item>
struct Rows {
  std::vector<std::size_t> first;
  std::vector<Item> items;
  [[nodiscard]] std::size_t size(std::size_t row) const { return first[row + 1] - first[row]; }
};

/// `owners[k]` is the row of item k; rows keep the items' order.
template <class Item>
Rows<Item> by_row(const std::vector<std::uint32_t>& owners, const std::vector<Item>& items,
                  std::size_t rows) {
  Rows<Item> out;
  out.first.assign(rows + 1, 0);
  for (const std::uint32_t owner : owners) ++out.first[owner + 1];
  for (std::size_t r = 0; r < rows; ++r) out.first[r + 1] += out.first[r];
  std::vector<std::size_t> next(out.first.begin(), out.first.end() - 1);
  out.items.resize(items.size());
  for (std::size_t k = 0; k < items.size(); ++k) out.items[next[owners[k]]++] = items[k];
  return out;
}

using Corners = std::array<std::uint32_t, 3>;

class SlackMeter {
 public:
  SlackMeter(const Camera& camera, const RaySurface& reference, const PixelHits& reference_hits,
             const RaySurface& mesh, double threshold_px)
      : mesh_(mesh.mesh()), threshold_px_(threshold_px), view_(camera) {
    gather_pixels(camera, reference, reference_hits, mesh);
    gather_stars(mesh);
  }

  Slack measure(std::vector<std::uint8_t>* removable) {
    Slack out;
    out.vertices = mesh_.positions.size();
    if (removable != nullptr) removable->assign(out.vertices, 0);
    for (std::uint32_t v = 0; v < out.vertices; ++v) {
      bool seen = false;
      for (std::size_t k = stars_.first[v]; k < stars_.first[v + 1]; ++k)
        seen = seen || pixels_.size(stars_.items[k]) > 0;
      out.in_view += seen ? 1 : 0;
      const Rim rim = find_rim(v);
      if (rim == Rim::none || rim_.size() > Slack::kLargestStar) {
        ++out.not_judged;
        continue;
      }
      if (rim == Rim::open && !straight_at(v)) continue;
      if (!fill() || !bearable(v)) continue;
      ++out.removable;
      out.removable_in_view += seen ? 1 : 0;
      if (removable != nullptr) (*removable)[v] = 1;
    }
    return out;
  }

 private:
  enum class Rim { closed, open, none };

  void gather_pixels(const Camera& camera, const RaySurface& reference, const PixelHits& hits,
                     const RaySurface& mesh) {
    const SeenSurface seen(camera, reference, hits);
    const PlanIndex& index = mesh.state().plan_index();
    PlanIndex::Cursor cursor;
    std::vector<std::uint32_t> owners;
    std::vector<PixelPoint> points;
    const auto width = static_cast<std::size_t>(hits.width);
    for (std::size_t pixel = 0; pixel < hits.triangle.size(); ++pixel) {
      if (hits.triangle[pixel] == PixelHits::kNoHit) continue;
      const Vec3 point = seen.point(pixel % width, pixel / width, pixel);
      if (!(view_.local(point).z > 0)) continue;
      const auto top = index.top(mesh_, {point.x, point.y}, cursor);
      if (!top) continue;  // uncovered: no star to look into
      owners.push_back(cursor.triangle);
      points.push_back({point, vertical_length_px(view_, point, *top)});
    }
    pixels_ = by_row(owners, points, mesh_.triangles.size());
  }

  void gather_stars(const RaySurface& mesh) {
    const std::vector<std::uint8_t>& usable = mesh.state().usable;
    std::vector<std::uint32_t> owners, triangles;
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (!usable.empty() && usable[t] == 0) continue;
      for (const std::uint32_t corner : mesh_.triangles[t]) {
        owners.push_back(corner);
        triangles.push_back(t);
      }
    }
    stars_ = by_row(owners, triangles, mesh_.positions.size());
  }

  [[nodiscard]] Vec2 place(std::uint32_t v) const { return plan(mesh_.positions[v]); }
  [[nodiscard]] int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return orientation(place(a), place(b), place(c)).value;
  }

  /// The neighbours of v, counter-clockwise, into rim_; of an open fan from its first to its last.
  Rim find_rim(std::uint32_t v) {
    rim_.clear();
    spokes_.clear();
    for (std::size_t k = stars_.first[v]; k < stars_.first[v + 1]; ++k) {
      const Corners& t = mesh_.triangles[stars_.items[k]];
      if (turn(t[0], t[1], t[2]) <= 0) return Rim::none;
      const std::size_t at = t[0] == v ? 0 : t[1] == v ? 1 : 2;
      spokes_.push_back({t[(at + 1) % 3], t[(at + 2) % 3]});
    }
    if (spokes_.empty()) return Rim::none;
    std::sort(spokes_.begin(), spokes_.end());
    const auto leaving = [&](std::uint32_t from) {
      const auto found = std::lower_bound(spokes_.begin(), spokes_.end(), std::array{from, std::uint32_t{0}});
      return found != spokes_.end() && (*found)[0] == from ? &*found : nullptr;
    };
    for (std::size_t k = 1; k < spokes_.size(); ++k) {
      if (spokes_[k][0] == spokes_[k - 1][0]) return Rim::none;  // two triangles leave one edge
    }
    // An open fan begins where no triangle arrives.
    std::vector<std::uint32_t>& arrivals = scratch_;
    arrivals.clear();
    for (const auto& spoke : spokes_) arrivals.push_back(spoke[1]);
    std::sort(arrivals.begin(), arrivals.end());
    std::uint32_t start = spokes_.front()[0];
    std::size_t beginnings = 0;
    for (const auto& spoke : spokes_) {
      if (std::binary_search(arrivals.begin(), arrivals.end(), spoke[0])) continue;
      start = spoke[0];
      ++beginnings;
    }
    if (beginnings > 1) return Rim::none;
    std::uint32_t at = start;
    for (std::size_t k = 0; k < spokes_.size(); ++k) {
      const auto* spoke = leaving(at);
      if (spoke == nullptr) return Rim::none;
      rim_.push_back(at);
      at = (*spoke)[1];
    }
    if (beginnings == 1) {
      rim_.push_back(at);
      return Rim::open;
    }
    if (at != start || !once_around(v)) return Rim::none;
    return Rim::closed;
  }

  /// Whether the closed fan comes round once: a step that passes the direction of east happens once.
  [[nodiscard]] bool once_around(std::uint32_t v) const {
    const Vec2 c = place(v);
    const auto above = [&](std::uint32_t u) {
      const Vec2 p = place(u);
      return p.y != c.y ? p.y > c.y : p.x > c.x;  // east itself counts as above
    };
    int rounds = 0;
    for (std::size_t k = 0; k < rim_.size(); ++k) {
      rounds += !above(rim_[k]) && above(rim_[(k + 1) % rim_.size()]) ? 1 : 0;
    }
    return rounds == 1;
  }

  /// Whether the outline runs straight through v: removing it leaves the covered region as it is.
  [[nodiscard]] bool straight_at(std::uint32_t v) const {
    return inside_segment(place(rim_.front()), place(rim_.back()), place(v));
  }

  /// An ear's worth: its quality in plan; among equals the heights of its tip and of its feet. None of these
  /// depends on the numbering of vertices or on which way the plan's axes run, so neither does the filling,
  /// unless ears are alike in all of them.
  struct Ear {
    double quality = 0, tip_m = 0, low_foot_m = 0, high_foot_m = 0;
    friend auto operator<=>(const Ear&, const Ear&) = default;
  };

  /// Cuts rim_, as a polygon, into ears. False if there is no ear left while three corners or more are.
  bool fill() {
    filling_.clear();
    ring_ = rim_;
    while (ring_.size() >= 3) {
      std::size_t best = ring_.size();
      Ear best_ear;
      for (std::size_t k = 0; k < ring_.size(); ++k) {
        const Ear ear = ear_at(k);
        if (ear.quality > 0 && (best == ring_.size() || ear > best_ear)) {
          best = k;
          best_ear = ear;
        }
      }
      if (best == ring_.size()) return false;
      const std::size_t n = ring_.size();
      filling_.push_back({ring_[(best + n - 1) % n], ring_[best], ring_[(best + 1) % n]});
      ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(best));
    }
    return !filling_.empty();
  }

  /// The ear at ring_[k]; its quality, 4√3·area / Σ length² in plan, is 0 if it is none.
  [[nodiscard]] Ear ear_at(std::size_t k) const {
    const std::size_t n = ring_.size();
    const std::uint32_t a = ring_[(k + n - 1) % n], b = ring_[k], c = ring_[(k + 1) % n];
    if (turn(a, b, c) <= 0) return {};
    for (const std::uint32_t other : ring_) {
      if (other == a || other == b || other == c) continue;
      if (turn(a, b, other) >= 0 && turn(b, c, other) >= 0 && turn(c, a, other) >= 0) return {};
    }
    const auto squared = [](Vec2 p, Vec2 q) { return (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y); };
    const Vec2 pa = place(a), pb = place(b), pc = place(c);
    const double lengths = (squared(pa, pb) + squared(pb, pc)) + squared(pc, pa);
    // The area from the tip, so that a and c may change places.
    const double quality = 2 * std::sqrt(3.0) * std::fabs(edge_value(pa, pc, pb)) / lengths;
    const auto height = [&](std::uint32_t v) { return mesh_.positions[v].z; };
    return {std::max(quality, std::numeric_limits<double>::min()), height(b), std::min(height(a), height(c)),
            std::max(height(a), height(c))};
  }

  /// Whether every pixel in the star of v stands the filling.
  [[nodiscard]] bool bearable(std::uint32_t v) {
    for (std::size_t k = stars_.first[v]; k < stars_.first[v + 1]; ++k) {
      const std::uint32_t t = stars_.items[k];
      for (std::size_t p = pixels_.first[t]; p < pixels_.first[t + 1]; ++p) {
        const PixelPoint& pixel = pixels_.items[p];
        const auto height = height_of_filling({pixel.point.x, pixel.point.y});
        if (!height) return false;  // beside the filling by a rounding: not known to be bearable
        const double after_px = vertical_length_px(view_, pixel.point, *height);
        if (!(after_px <= std::max(threshold_px_, pixel.displacement_px))) return false;
      }
    }
    return true;
  }

  [[nodiscard]] std::optional<double> height_of_filling(Vec2 p) const {
    for (const auto& [a, b, c] : filling_) {
      if (const auto height = height_over(mesh_.positions[a], mesh_.positions[b], mesh_.positions[c], p))
        return height;
    }
    return std::nullopt;
  }

  const Mesh& mesh_;
  double threshold_px_;
  View view_;
  Rows<PixelPoint> pixels_;    ///< by triangle of the mesh
  Rows<std::uint32_t> stars_;  ///< triangles, by vertex
  // Of the vertex in hand:
  std::vector<std::array<std::uint32_t, 2>> spokes_;  ///< the edges opposite to it
  std::vector<std::uint32_t> scratch_, rim_, ring_;
  std::vector<Corners> filling_;
};

}  // namespace

Slack measure_slack(const Camera& camera, const RaySurface& reference, const PixelHits& reference_hits,
                    const RaySurface& mesh, double threshold_px, std::vector<std::uint8_t>* removable) {
  return SlackMeter(camera, reference, reference_hits, mesh, threshold_px).measure(removable);
}

}  // namespace plumbline::oracle
