// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// P4's protocol on a small object: same steps as on the instrument.
#include <string>

#include <gtest/gtest.h>

#include "properties/tables/make_tables.h"
#include "reports/tables_report.h"
#include "scenarios/portable_math.h"

namespace plumbline::tables {
namespace {

/// A ball of 2 · 24 · 24 triangles, closed.
Mesh ball() {
  constexpr std::uint32_t kAround = 24, kRings = 23;
  Mesh mesh;
  mesh.positions.push_back({0, 0, -1});
  for (std::uint32_t ring = 1; ring <= kRings; ++ring) {
    const double tilt = kPi * ring / (kRings + 1);
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double turn = 2 * kPi * k / kAround;
      mesh.positions.push_back(
          {exact_sin(tilt) * exact_cos(turn), exact_sin(tilt) * exact_sin(turn), -exact_cos(tilt)});
    }
  }
  mesh.positions.push_back({0, 0, 1});
  const auto top = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  const auto at = [](std::uint32_t ring, std::uint32_t k) { return 1 + ring * kAround + k % kAround; };
  for (std::uint32_t k = 0; k < kAround; ++k) {
    mesh.triangles.push_back({0, at(0, k + 1), at(0, k)});
    mesh.triangles.push_back({top, at(kRings - 1, k), at(kRings - 1, k + 1)});
    for (std::uint32_t ring = 0; ring + 1 < kRings; ++ring) {
      mesh.triangles.push_back({at(ring, k), at(ring, k + 1), at(ring + 1, k + 1)});
      mesh.triangles.push_back({at(ring, k), at(ring + 1, k + 1), at(ring + 1, k)});
    }
  }
  return mesh;
}

TablesOutcome made(int jobs) {
  TableSettings settings;
  settings.picture = {256, 192, 45};
  settings.p4.meshes = {{"ball", "a ball", ball()}};
  MakeOptions options;
  options.jobs = jobs;
  return make_tables({"P4"}, settings, options);
}

std::optional<double> ours(const Table& table, std::size_t trial, const std::string& row,
                           const std::string& name) {
  for (std::size_t k = 0; k < table.figures.size(); ++k) {
    if (table.figures[k].row == row && table.figures[k].name == name) return table.trials[trial].ours[k];
  }
  ADD_FAILURE() << "no figure " << row << ", " << name;
  return std::nullopt;
}

TEST(TablesP4, FliesTheLadderUnderEveryContourRule) {
  const TablesOutcome outcome = made(2);
  ASSERT_EQ(outcome.tables.size(), 1U);
  const Table& table = outcome.tables[0];
  EXPECT_EQ(table.stand_ins[0].triangles, ball().triangles.size());
  ASSERT_EQ(table.trials.size(), p4_views().size());
  for (std::size_t trial = 0; trial < table.trials.size(); ++trial) {
    EXPECT_EQ(ours(table, trial, "325 px", "share of the triangles"), 100);
    EXPECT_EQ(ours(table, trial, "325 px", "silhouette pixels that differ"), 0);
    for (const auto& value : table.trials[trial].ours) EXPECT_TRUE(value.has_value());
  }
  const std::size_t no_contour = 1;
  const struct {
    const char* row;
    double percent;
  } rungs[] = {{"275 px", 80}, {"225 px", 60}, {"175 px", 40}, {"125 px", 20}, {"75 px", 10}};
  const double full = static_cast<double>(ball().triangles.size());
  for (const auto& rung : rungs) {
    const double share = ours(table, no_contour, rung.row, "share of the triangles").value_or(-1);
    // A closed part loses triangles in pairs, so a rung is met to two of them.
    EXPECT_LE(share, rung.percent);
    EXPECT_GT(share, rung.percent - 100 * 3 / full);
    EXPECT_GT(ours(table, no_contour, rung.row, "Hausdorff distance, at most, of the diameter").value_or(0),
              0);
    EXPECT_GE(ours(table, 0, rung.row, "triangles"), ours(table, no_contour, rung.row, "triangles"));
  }
}

TEST(TablesP4, TheSameFiguresWithOneJobAndTwo) {
  EXPECT_EQ(reports::tables_json(made(1).tables), reports::tables_json(made(2).tables));
}

TEST(TablesP4, ThePapersShareIsRecomputed) {
  const Table table = p4_table();
  for (const Figure& figure : table.figures) {
    if (figure.printed == "6.20") {
      EXPECT_EQ(figure.agreement(), Agreement::rounded);
      return;
    }
  }
  FAIL() << "6.20 % is not in the table";
}

}  // namespace
}  // namespace plumbline::tables
