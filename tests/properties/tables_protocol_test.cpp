// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The protocols of the papers' tables on small terrains: same steps, a sixteenth of the samples or less.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "properties/tables/make_tables.h"
#include "reports/tables_report.h"
#include "scenarios/error.h"

namespace plumbline::tables {
namespace {

/// A count is met to the steps in which a mesh changes: a node more or less, and what hangs on it.
constexpr double kCountStep = 16;

/// A p99 over a small picture is met to the jump that one crest more or less makes in it; a share of it.
constexpr double kErrorJump = 0.1;

TableSettings small_settings() {
  TableSettings settings = published_settings("unused");
  settings.stand_ins.erase(settings.stand_ins.begin());  // the fractal needs no file
  settings.p0.more_stand_ins.clear();
  settings.picture = {256, 192, 45};
  settings.p0.size = 129;
  settings.p0.atl.options["patch_size"] = 32.0;
  settings.p0.atl_triangles = {2408, 1286, 436};
  settings.p2.whole_size = 129;
  settings.p2.whole.options["tile_size"] = 129.0;
  settings.p2.whole_triangles = 1000;
  settings.p2.tiled_size = 257;
  settings.p2.tiled.options["tile_size"] = 17.0;
  settings.p2.tiled_triangles = 5000;
  return settings;
}

MakeOptions with_jobs(int jobs) {
  MakeOptions options;
  options.jobs = jobs;
  return options;
}

/// Made once; the tests look at different sides of it.
const TablesOutcome& small_outcome() {
  static const TablesOutcome outcome = make_tables({"P0", "P2"}, small_settings(), with_jobs(2));
  return outcome;
}

const Table& table_of(const TablesOutcome& outcome, const std::string& id) {
  for (const Table& table : outcome.tables) {
    if (table.id == id) return table;
  }
  throw std::logic_error("no table " + id);
}

double ours(const Table& table, const Trial& trial, const std::string& row, const std::string& name) {
  for (std::size_t k = 0; k < table.figures.size(); ++k) {
    if (table.figures[k].row == row && table.figures[k].name == name) return trial.ours.at(k).value();
  }
  throw std::logic_error("no figure " + row + ", " + name);
}

TEST(MakeTables, EveryTableHasEveryTrialAndEveryFigure) {
  const TablesOutcome& outcome = small_outcome();
  EXPECT_FALSE(outcome.interrupted);
  ASSERT_EQ(outcome.tables.size(), 4U);
  std::size_t judged = 0;
  for (const Table& table : outcome.tables) {
    ASSERT_EQ(table.stand_ins.size(), 1U);
    EXPECT_EQ(table.stand_ins[0].id, "fbm");
    EXPECT_GT(table.stand_ins[0].highest_m, table.stand_ins[0].lowest_m);
    EXPECT_GE(table.trials.size(), 2U);
    for (const Trial& trial : table.trials) {
      ASSERT_EQ(trial.ours.size(), table.figures.size());
      for (std::size_t k = 0; k < trial.ours.size(); ++k) {
        ASSERT_TRUE(trial.ours[k]) << table.id << ": " << table.figures[k].row << table.figures[k].name;
        EXPECT_TRUE(std::isfinite(*trial.ours[k]));
        ++judged;
      }
    }
  }
  EXPECT_GT(judged, 200U);
}

TEST(MakeTables, EveryFitMeetsItsCount) {
  for (const Table& table : small_outcome().tables) {
    for (const Trial& trial : table.trials) {
      EXPECT_FALSE(trial.fits.empty());
      for (const Fit& fit : trial.fits) {
        EXPECT_NEAR(fit.reached, fit.wanted, kCountStep) << table.id << ", " << fit.row << ", " << fit.name;
        EXPECT_GT(fit.value, 0);
      }
    }
  }
}

TEST(MakeTables, TheFittedFigureIsWhatTheFitReached) {
  const TablesOutcome& outcome = small_outcome();
  for (const Trial& trial : table_of(outcome, "P0").trials) {
    for (const Fit& fit : trial.fits) {
      EXPECT_EQ(ours(table_of(outcome, "P0"), trial, fit.row, fit.name), fit.reached);
    }
  }
  for (const char* id : {"P2.1", "P2.2a"}) {
    const Table& table = table_of(outcome, id);
    for (const Trial& trial : table.trials) {
      EXPECT_EQ(ours(table, trial, trial.fits[0].row, trial.fits[0].name), trial.fits[0].reached);
    }
  }
  const Table& relief = table_of(outcome, "P2.2b");
  for (const Trial& trial : relief.trials) {
    EXPECT_EQ(ours(relief, trial, "frame 1", "triangles"), trial.fits.at(1).reached);
  }
}

TEST(TableP0, NodesVisitedAreTheRootsByCounting) {
  // R roots in P patches: (4R − P)/3 visits of (4N − P)/3 nodes, less what merges in this very pass. Roots
  // follow from triangles by Euler: a triangle where three cells meet, two where four do, at most.
  const Table& table = table_of(small_outcome(), "P0");
  for (const Trial& trial : table.trials) {
    for (const char* row : {"6", "7", "8"}) {
      const double share = ours(table, trial, row, "ATL share of full");
      EXPECT_NEAR(ours(table, trial, row, "ATL nodes visited"), share, 0.25 * share) << trial.view << row;
      EXPECT_LE(ours(table, trial, row, "ATL errors evaluated"),
                ours(table, trial, row, "ATL nodes visited"));
      EXPECT_GT(ours(table, trial, row, "ATL errors evaluated"), 0);
    }
  }
}

TEST(TableP0, QuadtinIsHeldToTheSameMeasuredError) {
  // Measured again, from nothing: a restricted quadtree with that many triangles has that p99.
  const TableSettings settings = small_settings();
  const Table& table = table_of(small_outcome(), "P0");
  const Terrain terrain = load_stand_in(settings.stand_ins[0], settings.p0.size);
  const std::unique_ptr<LodMethod> quadtin = prepared(settings.p0.quadtin, terrain);
  const oracle::RayDevice device;
  const Ground ground(device, terrain, prepared(settings.p0.atl, terrain)->reference(terrain));
  const P0View& view = p0_views()[0];
  const Camera camera = look_at_middle(terrain, view.view, view.widths * terrain.width_m(), settings.picture);
  const oracle::PixelHits hits = ground.look(camera);
  const double wanted = ours(table, table.trials[0], "7", "QUADTin triangles, same p99");
  LodFrame frame;
  double threshold_px = 64;  // down to the first threshold with that many triangles
  do {
    threshold_px *= 0.995;
    quadtin->set_threshold_px(threshold_px);
    quadtin->update(camera, frame);
  } while (static_cast<double>(frame.mesh.triangles.size()) < wanted);
  EXPECT_NEAR(static_cast<double>(frame.mesh.triangles.size()), wanted, 0.05 * wanted);
  const double p99 = ours(table, table.trials[0], "7", "ATL displacement p99");
  EXPECT_NEAR(ground.displacement_px(camera, hits, frame.mesh).p99, p99, kErrorJump * p99);
  for (const Trial& trial : table.trials) {
    for (const char* row : {"6", "7", "8"}) {
      const double atl_px = ours(table, trial, row, "ATL displacement p99");
      EXPECT_NEAR(ours(table, trial, row, "QUADTin displacement p99"), atl_px, kErrorJump * atl_px)
          << trial.view;
    }
  }
}

TEST(TableP0, DisplacementIsO3s) {
  const TableSettings settings = small_settings();
  const Terrain terrain = load_stand_in(settings.stand_ins[0], 65);
  const std::unique_ptr<LodMethod> method = prepared({"restricted_quadtree", {}}, terrain);
  const oracle::RayDevice device;
  const Ground ground(device, terrain, method->reference(terrain));
  const Camera camera = look_at_middle(terrain, p2_views()[0].view, terrain.width_m(), settings.picture);
  method->set_threshold_px(4);
  LodFrame frame;
  method->update(camera, frame);
  const Mesh reference = reference_mesh(terrain);
  const oracle::RaySurface ground_surface(device, reference), mesh_surface(device, frame.mesh);
  const oracle::ImageError error = oracle::image_error(camera, ground_surface, ground_surface.look(camera),
                                                       mesh_surface, mesh_surface.look(camera), 4);
  const oracle::PixelFigure ours_px = ground.displacement_px(camera, ground.look(camera), frame.mesh);
  EXPECT_GT(ours_px.p99, 0);
  EXPECT_EQ(ours_px.p99, error.displacement_px.p99);
  EXPECT_EQ(ours_px.max, error.displacement_px.max);
  EXPECT_EQ(ours_px.count, error.displacement_px.count);
}

TEST(TableP2, TrianglesPerNodeAreEightAndTheSplitPoints) {
  const Table& table = table_of(small_outcome(), "P2.1");
  for (const Trial& trial : table.trials) {
    double before = 0;
    for (const char* row : {"ε = 4", "ε = 3", "ε = 2"}) {
      EXPECT_GE(ours(table, trial, row, "triangles per node"), 8);
      EXPECT_LT(ours(table, trial, row, "triangles per node"), 10);
      EXPECT_GT(ours(table, trial, row, "triangles"), before) << row;
      before = ours(table, trial, row, "triangles");
    }
    EXPECT_GT(ours(table, trial, "ε = 2 : ε = 4", "nodes drawn"), 1);
  }
}

TEST(TableP2, MovingBackShowsMoreTiles) {
  for (const char* id : {"P2.2a", "P2.2b"}) {
    const Table& table = table_of(small_outcome(), id);
    for (const Trial& trial : table.trials) {
      double before = 0;
      for (const char* row : {"frame 1", "frame 2", "frame 3", "frame 4", "frame 5", "frame 6"}) {
        EXPECT_GE(ours(table, trial, row, "tiles visible"), before) << id << row;
        EXPECT_LE(ours(table, trial, row, "tiles visible"), 256);
        before = ours(table, trial, row, "tiles visible");
      }
    }
  }
}

TEST(MakeTables, PreprocessingIsTimedBesideThePapers) {
  const Timings& timings = small_outcome().timings;
  ASSERT_EQ(timings.entries.size(), 3U);
  EXPECT_EQ(timings.entries[0].paper, "91.251 s");
  EXPECT_EQ(timings.entries[1].paper, "not done after 10 h");
  EXPECT_EQ(timings.entries[2].paper, "10.698 s, or 610.698 s if a 6 was lost");
  for (const Timing& entry : timings.entries) EXPECT_GT(entry.wall_s, 0) << entry.what;
}

TEST(MakeTables, JobsDoNotMoveAByteAndProgressEndsAtItsTotal) {
  std::size_t most = 0, total = 0, calls = 0;
  MakeOptions options = with_jobs(1);  // so the reports come in order
  options.progress = [&](std::size_t done, std::size_t of) {
    EXPECT_EQ(done, most + 1);
    most = done;
    total = of;
    ++calls;
  };
  const TablesOutcome one = make_tables({"P0", "P2"}, small_settings(), options);
  EXPECT_GT(calls, 0U);
  EXPECT_EQ(most, total);
  const std::span<const Table> two = small_outcome().tables;
  EXPECT_EQ(reports::tables_json(one.tables), reports::tables_json(two));
  EXPECT_EQ(reports::tables_md(one.tables), reports::tables_md(two));
  EXPECT_EQ(reports::tables_csv(one.tables), reports::tables_csv(two));
}

TEST(MakeTables, OnlyWhatIsAskedForIsMade) {
  const TablesOutcome outcome = make_tables({"P2"}, small_settings(), {});
  ASSERT_EQ(outcome.tables.size(), 3U);
  EXPECT_EQ(reports::tables_json(outcome.tables),
            reports::tables_json(std::span(small_outcome().tables).subspan(1)));
}

TEST(MakeTables, InterruptedKeepsWholeTablesOnly) {
  std::atomic<bool> cancelled{false};
  MakeOptions options;
  options.jobs = 1;
  options.cancelled = &cancelled;
  const std::size_t p0_steps = p0_views().size() * kP0Steps;
  options.progress = [&](std::size_t done, std::size_t) { cancelled = done > p0_steps; };
  const TablesOutcome outcome = make_tables({"P0", "P2"}, small_settings(), options);
  EXPECT_TRUE(outcome.interrupted);
  ASSERT_EQ(outcome.tables.size(), 1U);
  EXPECT_EQ(reports::tables_json(outcome.tables),
            reports::tables_json(std::span(small_outcome().tables).first(1)));
}

TEST(MakeTables, ATerrainWithoutReliefIsNoFault) {
  TableSettings settings = small_settings();
  settings.stand_ins[0].source.generator = "plane";
  settings.p2.tiled_size = 129;
  settings.p2.tiled.options["tile_size"] = 9.0;
  const TablesOutcome outcome = make_tables({"P0", "P2"}, settings, {});
  ASSERT_EQ(outcome.tables.size(), 4U);
  const Table& table = table_of(outcome, "P0");
  EXPECT_LT(table.trials[0].fits[0].reached,
            table.trials[0].fits[0].wanted);  // it says that it did not meet it
  EXPECT_EQ(reports::tables_json(outcome.tables).find("nan"), std::string::npos);
}

TEST(StandIn, HeightClassesAreSteps) {
  StandInSource stand_in = small_settings().stand_ins[0];
  const Terrain plain = load_stand_in(stand_in, 65);
  stand_in.height_classes = 12;
  const Terrain stepped = load_stand_in(stand_in, 65);
  std::vector<double> heights = stepped.heights_m;
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  EXPECT_EQ(heights.size(), 12U);
  const double class_m = (plain.highest_m() - plain.lowest_m()) / 12;
  for (std::size_t k = 0; k < plain.heights_m.size(); ++k) {
    EXPECT_LE(stepped.heights_m[k], plain.heights_m[k]);
    EXPECT_LE(plain.heights_m[k], stepped.heights_m[k] + class_m * (1 + 1e-12));
  }
}

TEST(StandIn, OfOneTableAloneChangesNoOther) {
  TableSettings settings = small_settings();
  StandInSource terraced = settings.stand_ins[0];
  terraced.source.id = "terraced";
  terraced.height_classes = 12;
  settings.p0.more_stand_ins = {terraced};
  const TablesOutcome outcome = make_tables({"P0", "P2"}, settings, {});
  ASSERT_EQ(outcome.tables.size(), 4U);
  EXPECT_EQ(outcome.tables[0].stand_ins.size(), 2U);
  EXPECT_EQ(outcome.tables[0].trials.size(), 2 * p0_views().size());
  EXPECT_EQ(outcome.tables[0].trials.back().terrain, "terraced");
  EXPECT_EQ(reports::tables_json(std::span(outcome.tables).subspan(1)),
            reports::tables_json(std::span(small_outcome().tables).subspan(1)));
}

TEST(ChooseTables, NoneNamedIsAllThereAre) {
  EXPECT_EQ(choose_tables({}), (std::vector<std::string>{"P0", "P1", "P2", "P4"}));
  EXPECT_EQ(choose_tables({"P2", "P0", "P2"}), (std::vector<std::string>{"P0", "P2"}));
  EXPECT_EQ(choose_tables({"P2"}), (std::vector<std::string>{"P2"}));
}

TEST(ChooseTables, WhatIsNotReproducedIsSaidSo) {
  try {
    choose_tables({"P0", "P3"});
    ADD_FAILURE() << "P3 was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("not reproduced by this build"), std::string::npos);
  }
  EXPECT_THROW(choose_tables({"p0"}), InputError);
  EXPECT_THROW(choose_tables({""}), InputError);
}

TEST(MakeTables, AMissingTerrainIsAnInputError) {
  TableSettings settings = small_settings();
  settings.stand_ins = published_settings("no/such/file.tif").stand_ins;
  EXPECT_THROW(make_tables({"P2"}, settings, {}), InputError);
}

}  // namespace
}  // namespace plumbline::tables
