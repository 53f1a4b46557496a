// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "oracle/soundness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "oracle/predicates.h"

namespace plumbline::oracle {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

bool finite(Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Exact: points of space lie on a line when they do in each of the three coordinate planes.
bool collinear(Vec3 a, Vec3 b, Vec3 c) {
  return orientation({a.x, a.y}, {b.x, b.y}, {c.x, c.y}).value == 0 &&
         orientation({a.y, a.z}, {b.y, b.z}, {c.y, c.z}).value == 0 &&
         orientation({a.z, a.x}, {b.z, b.x}, {c.z, c.x}).value == 0;
}

/// Where a finding about a whole triangle stands: its least corner along x, then y, then z, so that neither
/// the order of corners nor the numbering of vertices moves it.
Vec3 place_of(const Mesh& mesh, const Triangle& triangle) {
  const auto key = [&](std::uint32_t v) {
    const Vec3& p = mesh.positions[v];
    return std::array{p.x, p.y, p.z};
  };
  return mesh.positions[*std::min_element(triangle.begin(), triangle.end(),
                                          [&](std::uint32_t u, std::uint32_t v) { return key(u) < key(v); })];
}

struct Side {
  std::uint32_t low, high, triangle;
  bool forward;  // runs from low to high in its triangle
};

class Survey {
 public:
  explicit Survey(const Mesh& mesh) : mesh_(mesh) {}

  ConformityReport run() {
    look_at_vertices();
    look_at_triangles();
    look_for_duplicates();
    look_at_edges();
    look_at_fans();
    std::stable_sort(report_.findings.begin(), report_.findings.end(),
                     [](const Finding& a, const Finding& b) {
                       return std::tie(a.code, a.at.x, a.at.y, a.at.z, a.vertices, a.triangles) <
                              std::tie(b.code, b.at.x, b.at.y, b.at.z, b.vertices, b.triangles);
                     });
    return std::move(report_);
  }

 private:
  void add(FindingCode code, const char* kind, Vec3 at, std::vector<std::uint32_t> vertices,
           std::vector<std::uint32_t> triangles, Severity severity = Severity::fault) {
    Finding finding;
    finding.code = code;
    finding.severity = severity;
    finding.kind = kind;
    finding.at = at;
    finding.vertices = std::move(vertices);
    finding.triangles = std::move(triangles);
    report_.findings.push_back(std::move(finding));
  }

  void look_at_vertices() {
    std::vector<std::uint8_t> used(mesh_.positions.size(), 0);
    for (const Triangle& triangle : mesh_.triangles) {
      for (const std::uint32_t v : triangle) {
        if (v < used.size()) used[v] = 1;
      }
    }
    for (std::uint32_t v = 0; v < used.size(); ++v) {
      if (!finite(mesh_.positions[v])) {
        ++report_.counts.non_finite;
        add(FindingCode::non_finite, "", {}, {v}, {});  // a place that is no number cannot be sorted by
      }
      if (used[v] == 0) {
        ++report_.counts.unused_vertex;
        add(FindingCode::unused_vertex, "", finite(mesh_.positions[v]) ? mesh_.positions[v] : Vec3{}, {v}, {},
            Severity::hazard);
      }
    }
  }

  void look_at_triangles() {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      if (std::max({a, b, c}) >= mesh_.positions.size()) {
        ++report_.counts.bad_index;
        add(FindingCode::bad_index, "", {}, {a, b, c}, {t});
        continue;
      }
      const Vec3 p = mesh_.positions[a], q = mesh_.positions[b], r = mesh_.positions[c];
      if (!finite(p) || !finite(q) || !finite(r)) continue;
      const bool repeats = a == b || b == c || c == a;
      if (repeats || collinear(p, q, r)) {
        ++report_.counts.degenerate;
        add(FindingCode::degenerate, repeats ? "repeated_vertex" : "", place_of(mesh_, {a, b, c}), {a, b, c},
            {t});
      }
      if (!repeats) sound_.push_back(t);
    }
  }

  void look_for_duplicates() {
    std::vector<std::pair<Triangle, std::uint32_t>> sorted;
    for (const std::uint32_t t : sound_) {
      Triangle corners = mesh_.triangles[t];
      std::sort(corners.begin(), corners.end());
      sorted.emplace_back(corners, t);
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t k = 1; k < sorted.size(); ++k) {
      if (sorted[k].first != sorted[k - 1].first) continue;
      ++report_.counts.duplicate;
      const Triangle& corners = sorted[k].first;
      add(FindingCode::duplicate, "", place_of(mesh_, corners), {corners[0], corners[1], corners[2]},
          {sorted[k - 1].second, sorted[k].second});
    }
  }

  void look_at_edges() {
    std::vector<Side> sides;
    sides.reserve(3 * sound_.size());
    for (const std::uint32_t t : sound_) {
      const Triangle& corners = mesh_.triangles[t];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = corners[k], to = corners[(k + 1) % 3];
        sides.push_back({std::min(from, to), std::max(from, to), t, from < to});
      }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
      std::vector<std::uint32_t> triangles;
      for (end = first;
           end < sides.size() && sides[end].low == sides[first].low && sides[end].high == sides[first].high;
           ++end) {
        triangles.push_back(sides[end].triangle);
      }
      const bool crowded = end - first > 2;
      if (!crowded && !(end - first == 2 && sides[first].forward == sides[first + 1].forward)) continue;
      ++report_.counts.non_manifold;
      add(FindingCode::non_manifold, crowded ? "edge" : "orientation",
          (mesh_.positions[sides[first].low] + mesh_.positions[sides[first].high]) * 0.5,
          {sides[first].low, sides[first].high}, std::move(triangles));
    }
  }

  /// Triangles at a vertex belong to one fan if they share an edge there.
  void look_at_fans() {
    struct Corner {
      std::uint32_t vertex, other, triangle;
    };
    std::vector<Corner> corners;
    corners.reserve(6 * sound_.size());
    for (const std::uint32_t t : sound_) {
      for (const std::uint32_t v : mesh_.triangles[t]) {
        for (const std::uint32_t w : mesh_.triangles[t]) {
          if (v != w) corners.push_back({v, w, t});
        }
      }
    }
    std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
      return std::tie(a.vertex, a.other, a.triangle) < std::tie(b.vertex, b.other, b.triangle);
    });
    std::vector<std::uint32_t> star, root;
    for (std::size_t first = 0, end = 0; first < corners.size(); first = end) {
      star.clear();
      for (end = first; end < corners.size() && corners[end].vertex == corners[first].vertex; ++end)
        star.push_back(corners[end].triangle);
      std::sort(star.begin(), star.end());
      star.erase(std::unique(star.begin(), star.end()), star.end());
      root.resize(star.size());
      std::iota(root.begin(), root.end(), 0U);
      const auto find = [&](std::uint32_t k) {
        while (root[k] != k) k = root[k] = root[root[k]];
        return k;
      };
      const auto place = [&](std::uint32_t t) {
        return static_cast<std::uint32_t>(std::lower_bound(star.begin(), star.end(), t) - star.begin());
      };
      std::size_t fans = star.size();
      for (std::size_t k = first + 1; k < end; ++k) {
        if (corners[k].other != corners[k - 1].other) continue;
        const std::uint32_t a = find(place(corners[k - 1].triangle)), b = find(place(corners[k].triangle));
        if (a == b) continue;
        root[std::max(a, b)] = std::min(a, b);
        --fans;
      }
      if (fans < 2) continue;
      ++report_.counts.non_manifold;
      add(FindingCode::non_manifold, "vertex", mesh_.positions[corners[first].vertex],
          {corners[first].vertex}, star);
    }
  }

  const Mesh& mesh_;
  std::vector<std::uint32_t> sound_;  // triangles of three different vertices, all finite
  ConformityReport report_;
};

}  // namespace

ConformityReport check_soundness(const Mesh& mesh) { return Survey(mesh).run(); }

}  // namespace plumbline::oracle
