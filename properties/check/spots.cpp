// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The neighbourhood of the worst findings, small enough to send to somebody.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>

#include "oracle/finding_picture.h"
#include "properties/check/examination.h"
#include "scenarios/portable_math.h"

namespace plumbline::checking {
namespace {

/// Spots of a report, spots of one code among them, and triangles of a spot: what a person looks at.
constexpr std::size_t kMostSpots = 12, kSpotsOfACode = 4, kSpotTriangles = 240;
/// How far around, in lengths of the longest edge at the finding.
constexpr double kReach = 2.5;
/// Metres per degree of latitude, for pictures.
constexpr double kMetresPerDegree = 111319.49;

class SpotMaker {
 public:
  SpotMaker(const Examination& exam, const verdict::CheckFinding& found) : exam_(exam), found_(found) {}

  verdict::CheckSpot make(std::size_t number, std::size_t finding) {
    verdict::CheckSpot spot;
    spot.finding = finding;
    const Subject& subject = exam_.subjects[found_.mesh];
    std::string name =
        fmt::format("{:02}-{}-{}", number + 1, oracle::finding_name(found_.finding.code), subject.facts.file);
    for (char& c : name) {
      const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                         c == '-' || c == '_' || c == '.';
      if (!plain) c = '_';
    }
    constexpr std::size_t kLongestName = 80;
    spot.name = name.substr(0, kLongestName);
    gather(found_.mesh);
    if (found_.other_mesh != verdict::kNoMesh) gather(found_.other_mesh);
    keep_nearest();
    fill(spot);
    return spot;
  }

 private:
  struct Candidate {
    std::uint32_t subject = 0, triangle = 0;
    double distance = 0;
    bool marked = false;
  };

  /// Metres around the finding: tiles have degrees, meshes their own coordinates.
  Vec3 position(std::uint32_t k, std::uint32_t vertex) const {
    const Subject& subject = exam_.subjects[k];
    if (!subject.tile) return subject.mesh.positions[vertex] * exam_.frame.unit_m;
    if (vertex >= subject.places.size()) return subject.mesh.positions[vertex];
    const Vec3& p = subject.places[vertex];
    double east = p.x - found_.at.x;
    if (east > 180) east -= 360;
    if (east < -180) east += 360;
    const double parallel = exact_cos(found_.at.y * kRadiansPerDegree);
    return {east * kMetresPerDegree * parallel, (p.y - found_.at.y) * kMetresPerDegree, p.z};
  }
  Vec3 middle() const {
    const Subject& subject = exam_.subjects[found_.mesh];
    if (!subject.tile) return found_.finding.at * exam_.frame.unit_m;
    if (subject.places.empty()) return found_.finding.at;
    return {0, 0, found_.at.z};
  }
  bool drawable(std::uint32_t k, std::uint32_t t) const {
    const Subject& subject = exam_.subjects[k];
    return std::all_of(subject.mesh.triangles[t].begin(), subject.mesh.triangles[t].end(),
                       [&](std::uint32_t v) {
                         if (v >= subject.mesh.positions.size()) return false;
                         const Vec3& p = subject.mesh.positions[v];
                         return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
                       });
  }
  bool is_witness(std::uint32_t k, std::uint32_t t) const {
    if (k != found_.mesh) return false;
    const auto& triangles = found_.finding.triangles;
    if (std::find(triangles.begin(), triangles.end(), t) != triangles.end()) return true;
    if (!triangles.empty()) return false;
    const auto& corners = exam_.subjects[k].mesh.triangles[t];
    return std::any_of(found_.finding.vertices.begin(), found_.finding.vertices.end(), [&](std::uint32_t v) {
      return std::find(corners.begin(), corners.end(), v) != corners.end();
    });
  }

  static double plan_distance2(Vec3 a, Vec3 b) {
    const double x = a.x - b.x, y = a.y - b.y;
    return x * x + y * y;
  }

  void gather(std::uint32_t k) {
    const Subject& subject = exam_.subjects[k];
    const Vec3 at = middle();
    const bool in_space = !subject.facts.terrain;
    for (std::uint32_t t = 0; t < subject.mesh.triangles.size(); ++t) {
      if (!drawable(k, t)) continue;
      std::array<Vec3, 3> p;
      for (std::size_t i = 0; i < 3; ++i) p[i] = position(k, subject.mesh.triangles[t][i]);
      double nearest = std::numeric_limits<double>::infinity(), longest = 0;
      for (std::size_t i = 0; i < 3; ++i) {
        const double rise = in_space ? p[i].z - at.z : 0;
        nearest = std::min(nearest, plan_distance2(p[i], at) + rise * rise);
        longest = std::max(longest, plan_distance2(p[i], p[(i + 1) % 3]));
      }
      const bool marked = is_witness(k, t);
      if (marked || nearest == 0) reach2_ = std::max(reach2_, longest * kReach * kReach);
      candidates_.push_back({k, t, nearest, marked});
    }
  }

  void keep_nearest() {
    std::erase_if(candidates_,
                  [&](const Candidate& c) { return !c.marked && reach2_ > 0 && c.distance > reach2_; });
    std::stable_sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
      if (a.marked != b.marked) return a.marked;
      return a.distance < b.distance;
    });
    if (candidates_.size() > kSpotTriangles) candidates_.resize(kSpotTriangles);
  }

  void fill(verdict::CheckSpot& spot) const {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> index;
    oracle::Finding drawn = found_.finding;
    drawn.at = middle();
    drawn.vertices.clear();
    drawn.triangles.clear();
    drawn.loop.clear();
    for (const Candidate& c : candidates_) {
      std::array<std::uint32_t, 3> corners{};
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t v = exam_.subjects[c.subject].mesh.triangles[c.triangle][i];
        const auto [slot, is_new] =
            index.try_emplace({c.subject, v}, static_cast<std::uint32_t>(spot.mesh.positions.size()));
        if (is_new) spot.mesh.positions.push_back(position(c.subject, v));
        corners[i] = slot->second;
      }
      if (c.marked) {
        spot.marked.push_back(static_cast<std::uint32_t>(spot.mesh.triangles.size()));
        drawn.triangles.push_back(spot.marked.back());
      }
      spot.mesh.triangles.push_back(corners);
    }
    for (const std::uint32_t v : found_.finding.vertices) {
      if (const auto known = index.find({found_.mesh, v}); known != index.end())
        drawn.vertices.push_back(known->second);
    }
    if (spot.mesh.triangles.empty()) return;
    const bool oblique = found_.finding.code == oracle::FindingCode::crack;
    spot.picture_svg = oracle::finding_picture({spot.mesh, {}, std::span(&drawn, 1), oblique, {}});
  }

  const Examination& exam_;
  const verdict::CheckFinding& found_;
  std::vector<Candidate> candidates_;
  double reach2_ = 0;
};

}  // namespace

std::vector<verdict::CheckSpot> make_spots(const Examination& exam) {
  std::vector<verdict::CheckSpot> out;
  std::map<oracle::FindingCode, std::size_t> of_code;
  std::set<std::pair<std::uint32_t, std::uint32_t>> seams;
  for (std::size_t k = 0; k < exam.verdict.findings.size() && out.size() < kMostSpots; ++k) {
    const verdict::CheckFinding& found = exam.verdict.findings[k];
    if (found.mesh == verdict::kNoMesh || of_code[found.finding.code] >= kSpotsOfACode) continue;
    // Of one seam, its worst place.
    if (found.other_mesh != verdict::kNoMesh &&
        !seams.insert(std::minmax(found.mesh, found.other_mesh)).second)
      continue;
    verdict::CheckSpot spot = SpotMaker(exam, found).make(out.size(), k);
    if (spot.mesh.triangles.empty()) continue;
    ++of_code[found.finding.code];
    out.push_back(std::move(spot));
  }
  return out;
}

}  // namespace plumbline::checking
