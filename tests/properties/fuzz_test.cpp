// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The fuzz driver: finds M4.S1 by itself, the same each time; writes what it found whole or not at all; fails
// when nothing was judged.

#include "properties/fuzz/fuzz.h"

#include <atomic>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "properties/atlas/case_file.h"
#include "properties/laws/generators.h"
#include "properties/laws/split_function_laws.h"
#include "scenarios/error.h"

namespace plumbline::properties {
namespace {

/// A folder of this test's own, removed at the end.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() /
              ("plumbline_fuzz_test_" + name + "_" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

FuzzOptions hunt(const std::string& law) {
  FuzzOptions options;
  options.method = "block_bintree";
  options.law = law;
  options.cases = 300;
  options.seed = 1;
  return options;
}

TEST(Fuzz, M4_C3_IsFoundAndShrunkToThreeByThree) {
  const FuzzReport report = fuzz(hunt("M4_C3_split_test_is_monotone"));
  const LawTally& tally = report.tallies.at(0);
  EXPECT_TRUE(tally.promised);
  EXPECT_GT(tally.violated, 0u);
  EXPECT_FALSE(report.pass());
  ASSERT_TRUE(tally.smallest);
  EXPECT_EQ(tally.smallest->terrain.heights_m.size(), 9u);
  EXPECT_EQ(tally.smallest->poses.size(), 1u);
  int raised = 0;
  for (const double z : tally.smallest->terrain.heights_m) raised += z != 0 ? 1 : 0;
  EXPECT_EQ(raised, 1);
}

TEST(Fuzz, M4_C1_IsFoundAndShrunkToFifteenSamples) {
  Folder folder("c1");
  FuzzOptions options = hunt("conforming");
  options.out = folder.path();
  const FuzzReport report = fuzz(options);
  const LawTally& tally = report.tallies.at(0);
  ASSERT_TRUE(tally.smallest);
  // No fewer can crack: a crack needs a split node with two parents.
  EXPECT_EQ(tally.smallest->terrain.heights_m.size(), 15u);
  EXPECT_EQ(tally.case_file.filename(), "block_bintree.conforming.seed1.toml");
  const ReplayResult result = replay(load_case(tally.case_file));
  EXPECT_TRUE(result.confirmed) << result.difference;
  EXPECT_EQ(result.outcome.kind, LawOutcome::Kind::violated);
}

TEST(Fuzz, CasesAndSeedDecideEverything) {
  Folder first("first"), second("second");
  for (const Folder* folder : {&first, &second}) {
    FuzzOptions options = hunt("");
    options.cases = 200;
    options.out = folder->path();
    fuzz(options);
  }
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(first.path())) {
    EXPECT_EQ(contents(entry.path()), contents(second.path() / entry.path().filename())) << entry.path();
    EXPECT_EQ(entry.path().extension(), ".toml");  // no temporary is left behind
    ++files;
  }
  EXPECT_GE(files, 2);
}

TEST(Fuzz, SecondsOnlyCutTheSequenceShort) {
  FuzzOptions options = hunt("M4_C3_split_test_is_monotone");
  const std::optional<std::uint64_t> first = fuzz(options).tallies.at(0).first_violation;
  ASSERT_TRUE(first);
  options.cases = 0;
  options.seconds = 1;
  const FuzzReport report = fuzz(options);
  EXPECT_GT(report.cases.at("block_bintree"), 0u);
  if (report.cases.at("block_bintree") > *first) {
    EXPECT_EQ(report.tallies.at(0).first_violation, first);
  }
}

TEST(Fuzz, NothingJudgedIsAFinding) {
  FuzzOptions options = hunt("path_independent");
  options.accept = [](const LawInput& input) { return input.poses.size() == 1; };  // no path to depend on
  options.cases = 50;
  const FuzzReport report = fuzz(options);
  EXPECT_GT(report.tallies.at(0).vacuous, 0u);
  ASSERT_EQ(report.nothing_judged.size(), 1u);
  EXPECT_EQ(report.nothing_judged[0].code, oracle::FindingCode::nothing_judged);
  EXPECT_EQ(report.nothing_judged[0].kind, "block_bintree: path_independent");
  EXPECT_FALSE(report.pass());
}

TEST(Fuzz, PassesWhereAllIsKept) {
  FuzzOptions options;
  options.method = "restricted_quadtree";
  options.cases = 100;
  const FuzzReport report = fuzz(options);
  EXPECT_TRUE(report.pass());
  EXPECT_GE(report.tallies.size(), 7u);
}

/// A hunt for cracks where no slope between a split node and its parent reaches M4.S1's 0.902, with the
/// published ε_d.
LawTally hunt_gentle_ground(const std::string& method, std::uint64_t cases) {
  FuzzOptions options;
  options.method = method;
  options.law = "conforming";
  options.cases = cases;
  options.accept = [](const LawInput& input) {
    return !input.options.contains("depth_ratio") &&
           block_bintree::steepest_slope(input.terrain, split_function_of(input).grid()) < 0.9;
  };
  const LawTally tally = fuzz(options).tallies.at(0);
  fmt::print("{}, steepest slope below 0.9: {} of {} trials violated, of {} cases drawn\n", method,
             tally.violated, tally.judged(), cases);
  if (tally.smallest) {
    EXPECT_TRUE(options.accept(*tally.smallest)) << "shrinking left gentle ground";
  }
  return tally;
}

TEST(Fuzz, M4_C1_HoldsOnGentleGround) {
  const LawTally tally = hunt_gentle_ground("block_bintree", 20000);
  EXPECT_GT(tally.held, 800u);
  EXPECT_EQ(tally.violated, 0u);
}

/// Were culling to break M4.C3 by itself, it would show where M4.S1 cannot be the cause.
TEST(Fuzz, M4_S2_CullingTrianglesOpensNoCrackOnGentleGround) {
  const LawTally tally = hunt_gentle_ground("block_bintree:tri_cull", 20000);
  EXPECT_GT(tally.held, 800u);
  EXPECT_EQ(tally.violated, 0u);
}

/// METHODS M4 does not promise conformity for `by_distance`; it breaks on gentle ground too.
TEST(Fuzz, M4_ByDistanceBreaksOnGentleGround) {
  const LawTally tally = hunt_gentle_ground("block_bintree:by_distance", 5000);
  EXPECT_FALSE(tally.promised);
  EXPECT_GT(tally.violated, 0u);
}

TEST(Fuzz, StopsWhenCancelled) {
  std::atomic<bool> cancelled{true};
  FuzzOptions options = hunt("");
  options.cancelled = &cancelled;
  const FuzzReport report = fuzz(options);
  EXPECT_TRUE(report.interrupted);
  EXPECT_FALSE(report.pass());
  EXPECT_EQ(report.cases.at("block_bintree"), 0u);
}

TEST(Fuzz, BadOptionsAreRefused) {
  const auto refuses = [](auto&& spoil, const char* says) {
    FuzzOptions options = hunt("");
    spoil(options);
    try {
      fuzz(options);
      ADD_FAILURE() << says;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(says));
      EXPECT_THAT(std::string(error.what()), testing::Not(testing::HasSubstr("\n")));
    }
  };
  refuses([](FuzzOptions& o) { o.method = "block_bintre"; }, "block_bintree");
  refuses([](FuzzOptions& o) { o.law = "conformin"; }, "conforming");
  refuses([](FuzzOptions& o) { o.cases = 0; }, "seconds");
  refuses([](FuzzOptions& o) { o.seconds = -1; }, "seconds");
  refuses(
      [](FuzzOptions& o) {
        o.method = "full";
        o.law = "M4_C2_error_is_monotone";
      },
      "does not speak");
  refuses(
      [](FuzzOptions& o) {
        o.cases = 200;
        o.law = "M4_C3_split_test_is_monotone";
        o.out = "/proc/plumbline_cannot_write_here";
      },
      "write");
}

}  // namespace
}  // namespace plumbline::properties
