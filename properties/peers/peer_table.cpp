// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/peers/peer_table.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "oracle/peer_checks.h"

namespace plumbline::peers {
namespace {

constexpr std::uint32_t kSide = 41;
constexpr double kSpacingM = 10;
/// The faults sit in the middle, away from the outline.
constexpr std::uint32_t kMiddle = kSide / 2;

std::uint32_t vertex(std::uint32_t i, std::uint32_t j) { return j * kSide + i; }

/// Waves whose heights are multiples of 1/16 m: midpoints of edges are doubles, so "exactly on the edge" is
/// exact.
PeerRow sound_grid(std::string_view fault) {
  PeerRow row;
  row.fault = fault;
  for (std::uint32_t j = 0; j < kSide; ++j) {
    for (std::uint32_t i = 0; i < kSide; ++i)
      row.mesh.positions.push_back(
          {i * kSpacingM, j * kSpacingM, static_cast<double>((i * i * 3 + j * j * 5 + i * j) % 64) / 16});
  }
  for (std::uint32_t j = 0; j + 1 < kSide; ++j) {
    for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
      const std::uint32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                          d = vertex(i, j + 1);
      row.mesh.triangles.push_back({a, b, c});
      row.mesh.triangles.push_back({a, c, d});
    }
  }
  const double side_m = (kSide - 1) * kSpacingM;
  row.domain.add_rectangle({0, 0}, {side_m, side_m});
  return row;
}

/// The south-east triangle of cell (i, j).
std::size_t triangle(std::uint32_t i, std::uint32_t j) { return 2 * (std::size_t{j} * (kSide - 1) + i); }

/// Splits one side of the middle cell's diagonal at its midpoint, `above_m` over it; the other side does not
/// know.
PeerRow split_one_side(std::string_view fault, double above_m) {
  PeerRow row = sound_grid(fault);
  auto& split = row.mesh.triangles[triangle(kMiddle, kMiddle)];
  const auto [a, b, c] = split;
  const Vec3 middle = (row.mesh.positions[a] + row.mesh.positions[c]) * 0.5;
  const auto v = static_cast<std::uint32_t>(row.mesh.positions.size());
  row.mesh.positions.push_back({middle.x, middle.y, middle.z + above_m});
  split = {a, b, v};
  row.mesh.triangles.push_back({v, b, c});
  return row;
}

/// The western half gets vertices of its own along the middle column.
PeerRow doubled_seam(std::string_view fault) {
  PeerRow row = sound_grid(fault);
  const auto first = static_cast<std::uint32_t>(row.mesh.positions.size());
  for (std::uint32_t j = 0; j < kSide; ++j)
    row.mesh.positions.push_back(row.mesh.positions[vertex(kMiddle, j)]);
  for (std::size_t k = 0; k < row.mesh.triangles.size(); ++k) {
    if ((k / 2) % (kSide - 1) >= kMiddle) continue;
    for (std::uint32_t& v : row.mesh.triangles[k]) {
      if (v % kSide == kMiddle) v = first + v / kSide;
    }
  }
  return row;
}

std::string finding_words(const PeerVerdict& verdict) {
  if (verdict.findings.empty()) return verdict.plumbline_right ? "none, rightly" : "**none**";
  std::set<std::string> words;
  for (const oracle::Finding& finding : verdict.findings)
    words.insert(fmt::format("{} {}", static_cast<int>(finding.code), oracle::finding_name(finding.code)));
  const std::string text = fmt::format("{}", fmt::join(words, ", "));
  return verdict.plumbline_right ? text : fmt::format("**{}**", text);
}

}  // namespace

std::vector<PeerRow> peer_rows() {
  using enum oracle::FindingCode;
  std::vector<PeerRow> rows;
  const auto add = [&](PeerRow row, oracle::FindingCode expected, std::string_view val3dity) {
    row.expected = expected;
    row.val3dity = val3dity;
    rows.push_back(std::move(row));
  };
  rows.push_back(sound_grid("no fault"));
  rows.back().sound = true;
  rows.back().val3dity = "not measured";
  add(split_one_side("vertex exactly on a neighbour's edge", 0), t_junction, "yes");
  add(split_one_side("crack of 0.5 m at a T-vertex", 0.5), crack, "no");
  add(split_one_side("crack of 0.1 mm at a T-vertex", 0.0001), crack, "no");
  rows.push_back(doubled_seam("seam of duplicated vertices, closed in space"));
  rows.back().sound = true;
  rows.back().val3dity = "no";

  PeerRow flipped = sound_grid("one triangle flipped");
  std::swap(flipped.mesh.triangles[triangle(kMiddle, kMiddle)][1],
            flipped.mesh.triangles[triangle(kMiddle, kMiddle)][2]);
  add(std::move(flipped), fold_over, "yes");

  PeerRow doubled = sound_grid("triangle doubled");
  doubled.mesh.triangles.push_back(doubled.mesh.triangles[triangle(kMiddle, kMiddle)]);
  add(std::move(doubled), duplicate, "yes");

  // Across the opposite edges of its fan, and high above them: nothing meets in space.
  PeerRow folded = sound_grid("fold-over in plan");
  Vec3& pulled = folded.mesh.positions[vertex(kMiddle, kMiddle)];
  pulled = {pulled.x + 1.3125 * kSpacingM, pulled.y + 0.1875 * kSpacingM, pulled.z + 20};
  add(std::move(folded), fold_over, "no");

  PeerRow missing = sound_grid("triangle missing");
  missing.mesh.triangles.erase(missing.mesh.triangles.begin() +
                               static_cast<std::ptrdiff_t>(triangle(kMiddle, kMiddle)));
  add(std::move(missing), hole, "no");
  return rows;
}

std::vector<PeerVerdict> judge_peers() {
  std::vector<PeerVerdict> verdicts;
  for (const PeerRow& row : peer_rows()) {
    PeerVerdict verdict;
    verdict.fault = row.fault;
    verdict.sound = row.sound;
    verdict.cgal_intersects = oracle::cgal_self_intersects(row.mesh).value_or(true);
    verdict.cgal_valid = oracle::cgal_valid_after_repair(row.mesh);
    verdict.findings = oracle::check_conformity(row.mesh, row.domain).findings;
    verdict.val3dity = row.val3dity;
    verdict.plumbline_right =
        row.sound == verdict.findings.empty() &&
        std::all_of(verdict.findings.begin(), verdict.findings.end(),
                    [&](const oracle::Finding& finding) { return finding.code == row.expected; });
    verdicts.push_back(std::move(verdict));
  }
  return verdicts;
}

std::string peer_table_markdown() {
  std::string out = fmt::format(
      "# The fault table\n\n"
      "One fault in a grid mesh of 41 × 41 vertices: what a general geometry library (CGAL {}) sees of it, "
      "and "
      "what\nplumbline finds. `plumbline list peers` makes this page; a test keeps them equal. The last "
      "column "
      "is quoted from\nan earlier measurement (val3dity, CompositeSurface), not run. A word in bold is "
      "wrong.\n\n"
      "| fault | CGAL: self-intersection after soup → mesh | CGAL: invalid after soup → mesh | plumbline "
      "finds | val3dity "
      "(quoted) "
      "|\n|---|---|---|---|---|\n",
      oracle::cgal_version());
  const auto cell = [](bool seen, bool sound) {
    if (seen) return sound ? "**false alarm**" : "yes";
    return sound ? "no" : "**no**";
  };
  for (const PeerVerdict& verdict : judge_peers())
    out += fmt::format("| {} | {} | {} | {} | {} |\n", verdict.fault,
                       cell(verdict.cgal_intersects, verdict.sound), cell(!verdict.cgal_valid, verdict.sound),
                       finding_words(verdict), verdict.val3dity);
  return out;
}

}  // namespace plumbline::peers
