// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// One mesh by itself: O1 and O6; of an object, O7.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "oracle/likeness.h"
#include "oracle/soundness.h"
#include "properties/check/tiles.h"
#include "scenarios/mesh_file/mesh_file.h"

namespace plumbline::checking {
namespace {

using oracle::Finding;
using oracle::FindingCode;
using oracle::Severity;

/// An edge this much shorter than the median is a slip of the maker, not detail: where the others are a pixel
/// long it is a thousandth of one.
constexpr double kShortEdgeShare = 1e-3;

/// What walls fill: each stands on two points of the plan, and spans heights over one of them.
class WallSpans {
 public:
  explicit WallSpans(const Subject& subject) : positions_(subject.mesh.positions) {
    for (const std::uint32_t t : subject.sheet.walls) {
      const auto& corners = subject.mesh.triangles[t];
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &p = positions_[corners[k]], &q = positions_[corners[(k + 1) % 3]],
                   &r = positions_[corners[(k + 2) % 3]];
        if (p.x == q.x && p.y == q.y)
          spans_[{place(p), place(r)}].emplace_back(std::min(p.z, q.z), std::max(p.z, q.z));
      }
    }
    for (auto& entry : spans_) std::sort(entry.second.begin(), entry.second.end());
  }
  /// Whether walls that stand on the crack's own edges fill it: over each of its points that has two heights,
  /// towards each other point. A wall that ends there, a skirt outside of it, fills nothing.
  [[nodiscard]] bool fill(const Finding& crack) const {
    std::map<Place, Span> heights;
    const auto note = [&](const Vec3& p, double z) {
      const auto [slot, is_new] = heights.try_emplace(place(p), z, z);
      slot->second = {std::min(slot->second.first, z), std::max(slot->second.second, z)};
    };
    for (const std::uint32_t v : crack.vertices) note(positions_[v], positions_[v].z);
    note(crack.at, crack.at.z);
    note(crack.at, crack.at.z - crack.gap_m);
    for (const auto& [here, span] : heights) {
      if (span.first == span.second) continue;
      for (const auto& other : heights) {
        if (other.first != here && !covered(here, other.first, span)) return false;
      }
    }
    return heights.size() > 1;
  }

 private:
  using Place = std::pair<double, double>;
  using Span = std::pair<double, double>;
  static Place place(const Vec3& p) { return {p.x, p.y}; }

  [[nodiscard]] bool covered(const Place& here, const Place& towards, const Span& gap) const {
    const auto found = spans_.find({here, towards});
    if (found == spans_.end()) return false;
    double reached = gap.first;
    for (const Span& span : found->second) {
      if (span.first <= reached) reached = std::max(reached, span.second);
    }
    return reached >= gap.second && found->second.front().first <= gap.first;
  }

  const std::vector<Vec3>& positions_;
  std::map<std::pair<Place, Place>, std::vector<Span>> spans_;
};

/// Per vertex: whether a triangle names it, and it is finite.
std::vector<std::uint8_t> used_vertices(const Mesh& mesh) {
  std::vector<std::uint8_t> used(mesh.positions.size(), 0);
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) {
      if (v < used.size()) used[v] = 1;
    }
  }
  for (std::size_t v = 0; v < used.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) used[v] = 0;
  }
  return used;
}

/// Of a mesh, and whether its surface has a vertex in each of the box's four corners: then it is taken to
/// promise the rectangle.
struct Reach {
  verdict::Extent box;
  bool rectangular = false;
};
Reach reach_of(const Mesh& mesh, const std::vector<Vec3>& positions, const oracle::Sheet& sheet) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  verdict::Extent box{{inf, inf, inf}, {-inf, -inf, -inf}};
  const std::vector<std::uint8_t> used = used_vertices(mesh);
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] == 0) continue;
    const Vec3& p = positions[v];
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  if (!(box.low.x <= box.high.x)) return {};
  if (!(box.low.x < box.high.x) || !(box.low.y < box.high.y)) return {box, false};
  const std::vector<std::uint8_t> of_surface = sheet.walls.empty() ? used : used_vertices(sheet.surface);
  std::array<bool, 4> seen{};
  for (std::size_t v = 0; v < of_surface.size(); ++v) {
    const Vec3& p = positions[v];
    if (of_surface[v] == 0) continue;
    if ((p.x == box.low.x || p.x == box.high.x) && (p.y == box.low.y || p.y == box.high.y))
      seen[(p.x == box.high.x ? 1u : 0u) + (p.y == box.high.y ? 2u : 0u)] = true;
  }
  return {box, std::all_of(seen.begin(), seen.end(), [](bool b) { return b; })};
}

/// Where two triangles that meet do so: the middle of the points where an edge of one passes the other's
/// plane inside of it; of coplanar ones, of their corners. Rounded: for a person to go there.
Vec3 meeting_place(const Mesh& mesh, std::uint32_t first, std::uint32_t second) {
  Vec3 sum, corners;
  double count = 0;
  const auto corner = [&](std::uint32_t t, std::size_t k) {
    return mesh.positions[mesh.triangles[t][k % 3]];
  };
  for (const auto& [edges, face] : {std::pair(first, second), std::pair(second, first)}) {
    const Vec3 a = corner(face, 0), b = corner(face, 1), c = corner(face, 2), n = cross(b - a, c - a);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = corner(edges, k), q = corner(edges, k + 1);
      corners = corners + p * (1.0 / 6);
      const double above = dot(n, p - a), below = dot(n, q - a);
      if (!((above < 0 && below > 0) || (above > 0 && below < 0))) continue;
      const Vec3 x = p + (q - p) * (above / (above - below));
      if (dot(cross(b - a, x - a), n) < 0 || dot(cross(c - b, x - b), n) < 0 ||
          dot(cross(a - c, x - c), n) < 0)
        continue;
      sum = sum + x;
      ++count;
    }
  }
  return count > 0 ? sum * (1 / count) : corners;
}

class Inside {
 public:
  Inside(Subject& subject, const Examination& exam) : subject_(subject), exam_(exam) {}

  void judge() {
    verdict::CheckedMesh& facts = subject_.facts;
    facts.triangles = subject_.mesh.triangles.size();
    facts.vertices = subject_.mesh.positions.size();
    if (facts.terrain) {
      judge_terrain();
    } else {
      judge_object();
    }
    judge_shape();
  }

 private:
  void add(const Finding& finding, std::string message = {}) {
    verdict::CheckFinding out = as_check_finding(finding, subject_, verdict::kNoMesh, exam_.frame);
    if (!message.empty()) out.message = std::move(message);
    subject_.findings.push_back(std::move(out));
  }

  void judge_terrain() {
    verdict::CheckedMesh& facts = subject_.facts;
    subject_.sheet = oracle::take_walls_off(subject_.mesh);
    const Mesh& surface = subject_.sheet.surface;
    const std::vector<Vec3>& places = subject_.places.empty() ? subject_.mesh.positions : subject_.places;
    const Reach reach = reach_of(subject_.mesh, places, subject_.sheet);
    facts.box = reach.box;
    oracle::ConformityReport report;
    if (subject_.tile) {
      PlanDomain domain;
      domain.add_rectangle({0, 0}, {32767, 32767});
      report = oracle::check_conformity(surface, domain);
      facts.domain = "the tile's square";
    } else if (reach.rectangular) {
      PlanDomain domain;
      domain.add_rectangle({facts.box.low.x, facts.box.low.y}, {facts.box.high.x, facts.box.high.y});
      report = oracle::check_conformity(surface, domain);
      subject_.held_to_rectangle = true;
      facts.domain = "the rectangle of its box";
    } else {
      report = oracle::check_conformity_without_outline(surface);
      facts.domain = "its own outline";
    }
    drop_feet(report);
    facts.conformity = report.counts;
    const WallSpans walls(subject_);
    for (const Finding& finding : report.findings) {
      if (finding.code == FindingCode::degenerate)
        flat_.push_back(subject_.sheet.triangle_of[finding.triangles.front()]);
    }
    std::sort(flat_.begin(), flat_.end());
    for (Finding& finding : report.findings) {
      for (std::uint32_t& t : finding.triangles) t = subject_.sheet.triangle_of[t];
      if (finding.code == FindingCode::crack && !subject_.sheet.walls.empty() && walls.fill(finding)) {
        finding.kind = "cliff";
        finding.severity = Severity::hazard;
      }
      // Of a tile the format's own finding has told it.
      if (finding.code == FindingCode::bad_index && subject_.tile) continue;
      add(finding);
    }
    subject_.border = oracle::border_of(subject_.mesh, subject_.sheet, subject_.normals, &report);
    if (subject_.tile) quantize_border(subject_);
    measure_skirt();
  }

  /// The lower vertices of skirts are used by walls alone.
  void drop_feet(oracle::ConformityReport& report) const {
    if (subject_.sheet.walls.empty()) return;
    std::vector<bool> used(subject_.mesh.positions.size(), false);
    for (const std::uint32_t t : subject_.sheet.walls) {
      for (const std::uint32_t v : subject_.mesh.triangles[t]) used[v] = true;
    }
    std::erase_if(report.findings, [&](const Finding& finding) {
      return finding.code == FindingCode::unused_vertex && used[finding.vertices.front()];
    });
    report.counts.unused_vertex = static_cast<std::size_t>(
        std::count_if(report.findings.begin(), report.findings.end(),
                      [](const Finding& finding) { return finding.code == FindingCode::unused_vertex; }));
  }

  void measure_skirt() {
    verdict::SkirtFigures& skirt = subject_.facts.skirt;
    skirt.triangles = subject_.sheet.walls.size();
    double hung = 0, all = 0, least = std::numeric_limits<double>::infinity();
    for (const oracle::BorderEdge& edge : subject_.border.edges) {
      const Vec2 d = edge.plan[1] - edge.plan[0];
      const double length = std::sqrt(d.x * d.x + d.y * d.y);
      all += length;
      if (!edge.has_skirt) continue;
      hung += length;
      for (std::size_t k = 0; k < 2; ++k)
        least = std::min(least, edge.height[k].metres() - edge.foot[k].metres());
    }
    if (!(hung > 0)) return;
    skirt.border_share = hung / all;
    skirt.least_depth_m = least * exam_.frame.unit_m;
  }

  void judge_object() {
    verdict::CheckedMesh& facts = subject_.facts;
    subject_.mesh = welded(subject_.mesh);
    facts.box = reach_of(subject_.mesh, subject_.mesh.positions, {}).box;
    facts.domain = "an object: no plan to cover; vertices of equal coordinates are one";
    const oracle::ConformityReport report = oracle::check_soundness(subject_.mesh);
    facts.conformity = report.counts;
    for (const Finding& finding : report.findings) add(finding);
    measure_openness();
    if (subject_.mesh.triangles.size() > kMostIntersected) return;
    const auto some = oracle::some_self_intersections(subject_.mesh, kListedOfACode);
    if (!some) return;  // no manifold: judged by its own findings, and the text claims nothing
    facts.self_intersections = some->total;
    facts.self_intersections_judged = true;
    for (const oracle::TrianglePair& pair : some->pairs) {
      Finding finding;
      finding.code = FindingCode::self_intersection;
      finding.triangles = {pair[0], pair[1]};
      finding.at = meeting_place(subject_.mesh, pair[0], pair[1]);
      add(finding);
    }
  }

  /// Edges that one triangle has alone, and which way round a closed surface is.
  void measure_openness() {
    const Mesh& mesh = subject_.mesh;
    std::vector<std::uint64_t> edges;
    double volume = 0;
    const auto count = mesh.positions.size();
    for (const auto& t : mesh.triangles) {
      if (t[0] >= count || t[1] >= count || t[2] >= count) return;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        edges.push_back(std::uint64_t{std::min(a, b)} << 32 | std::max(a, b));
      }
      const Vec3 o = mesh.positions[mesh.triangles.front()[0]];
      volume += dot(mesh.positions[t[0]] - o, cross(mesh.positions[t[1]] - o, mesh.positions[t[2]] - o));
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size();) {
      const std::size_t first = i;
      while (i < edges.size() && edges[i] == edges[first]) ++i;
      subject_.open_edges += i - first == 1;
    }
    subject_.inside_out = subject_.open_edges == 0 && volume < 0;
  }

  void judge_shape() {
    verdict::CheckedMesh& facts = subject_.facts;
    // A tile's lattice is stretched: its shape is that of the ground.
    const double unit = exam_.frame.unit_m;
    Mesh scaled;
    const Mesh* mesh = facts.terrain ? &subject_.sheet.surface : &subject_.mesh;
    if (subject_.tile) {
      scaled = *mesh;
      for (Vec3& p : scaled.positions) {
        p.x *= subject_.tile->metres_per_step.x;
        p.y *= subject_.tile->metres_per_step.y;
      }
      mesh = &scaled;
    }
    const oracle::EdgeLengths edges = oracle::edge_lengths(*mesh, !facts.terrain);
    facts.shortest_edge_m = edges.shortest * unit;
    facts.median_edge_m = edges.median * unit;
    if (edges.shortest > 0 && edges.shortest < edges.median * kShortEdgeShare) {
      Finding finding;
      finding.code = FindingCode::sliver;
      finding.kind = "short_edge";
      finding.severity = Severity::hazard;
      finding.vertices = {edges.shortest_vertices.begin(), edges.shortest_vertices.end()};
      finding.at = subject_.mesh.positions[finding.vertices.front()];
      add(finding, fmt::format("the shortest edge is {}, the median {}: far below what any picture shows",
                               length_text(facts.shortest_edge_m), length_text(facts.median_edge_m)));
    }
    if (!facts.terrain) return;
    // Triangles without area have their own finding.
    std::vector<std::uint32_t> triangle_of = subject_.sheet.triangle_of;
    if (!flat_.empty()) {
      Mesh thick{mesh->positions, {}};
      std::vector<std::uint32_t> kept;
      for (std::size_t t = 0; t < triangle_of.size(); ++t) {
        if (std::binary_search(flat_.begin(), flat_.end(), triangle_of[t])) continue;
        thick.triangles.push_back(mesh->triangles[t]);
        kept.push_back(triangle_of[t]);
      }
      triangle_of = std::move(kept);
      facts.shape = oracle::shape(thick);
    } else {
      facts.shape = oracle::shape(*mesh);
    }
    if (facts.shape.slivers == 0) return;
    Finding finding;
    finding.code = FindingCode::sliver;
    finding.kind = "thin";
    finding.severity = Severity::hazard;
    const std::uint32_t worst = facts.shape.worst_triangle;
    facts.shape.worst_triangle = triangle_of[worst];
    finding.triangles = {facts.shape.worst_triangle};
    finding.at = subject_.mesh.positions[subject_.mesh.triangles[facts.shape.worst_triangle][0]];
    add(finding, fmt::format("{} {} of quality under {} in plan, this the worst with {:.3g}; normals and "
                             "shading suffer there",
                             facts.shape.slivers, facts.shape.slivers == 1 ? "triangle" : "triangles",
                             oracle::kSliverQuality, facts.shape.min_quality));
  }

  Subject& subject_;
  const Examination& exam_;
  std::vector<std::uint32_t> flat_;  // triangles without area, of the mesh; sorted
};

}  // namespace

void judge_inside(Subject& subject, const Examination& exam) { Inside(subject, exam).judge(); }

}  // namespace plumbline::checking
