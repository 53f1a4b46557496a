// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The commands as CONTRACT promises them: exit status, files, output, and the same bytes twice.

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/cli/suite_text.h"

namespace plumbline::testing_cli {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsSupersetOf;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return lines;
}

std::vector<std::string> keys_of(const json& object) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : object.items()) keys.push_back(key);
  return keys;
}

class Help : public ProgramTest {};

TEST_F(Help, NamesEveryCommand) {
  const Outcome outcome = run({"--help"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* command : {"run", "fuzz", "replay", "list", "tables", "selftest", "compare"})
    EXPECT_THAT(outcome.out, HasSubstr(command));
}

TEST_F(Help, OfACommandNamesItsOptions) {
  const Outcome outcome = run({"run", "--help"});
  EXPECT_EQ(outcome.status, 0);
  for (const char* option :
       {"--out", "--jobs", "--methods", "--dump-meshes", "--expected", "--write-expected", "--quiet"}) {
    EXPECT_THAT(outcome.out, HasSubstr(option));
  }
}

TEST_F(Help, VersionIsOneLine) {
  const Outcome outcome = run({"--version"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(lines_of(outcome.out).size(), 1U);
  EXPECT_THAT(outcome.out, HasSubstr("plumbline "));
}

class List : public ProgramTest {};

TEST_F(List, HasEveryShelf) {
  const struct {
    const char* shelf;
    std::vector<std::string> entries;
  } shelves[] = {
      {"methods", {"full", "restricted_quadtree", "block_bintree"}},
      {"terrains",
       {"plane", "tilted_plane", "cliff", "sine", "fbm", "ridged", "canyon", "spike", "checkerboard",
        "island"}},
      {"trajectories",
       {"approach", "retreat", "orbit", "skim", "spin", "nadir", "teleport", "hover", "poses"}},
      {"laws", {"conforming"}},
      {"oracles",
       {"conformity", "vertical", "image", "economy", "stability", "shape", "soundness", "likeness", "border",
        "seams", "placement", "tile_conformance", "302 crack"}},
  };
  const Outcome all = run({"list"});
  EXPECT_EQ(all.status, 0);
  for (const auto& [shelf, entries] : shelves) {
    SCOPED_TRACE(shelf);
    const Outcome outcome = run({"list", shelf});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_THAT(all.out, HasSubstr(outcome.out));
    for (const std::string& entry : entries) {
      const std::vector<std::string> lines = lines_of(outcome.out);
      EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [&entry](const std::string& line) {
        return line.rfind("  " + entry + " ", 0) == 0;
      })) << entry;
    }
  }
}

TEST_F(List, HasEveryOracleOfTheFolder) {
  const Outcome outcome = run({"list", "oracles"});
  for (const char* number : {"O1", "O2", "O3", "O4", "O5", "O6", "O7"})
    EXPECT_THAT(outcome.out, HasSubstr(std::string("[ORACLES ") + number + "]"));
}

class Run : public ProgramTest {
 protected:
  Outcome fly(const SuiteText& suite, const std::string& out, std::vector<std::string> more = {}) {
    put("suite.toml", suite.text());
    std::vector<std::string> arguments{"run", "suite.toml", "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

TEST_F(Run, WritesTheReportAndPasses) {
  const Outcome outcome = fly({}, "out");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const char* file :
       {"results.json", "timing.json", "results.csv", "junit.xml", "summary.md", "report.html"}) {
    EXPECT_GT(read_file(folder() / "out" / file).size(), 0U) << file;
  }
  EXPECT_THAT(outcome.out, HasSubstr("report.html"));
  // Nothing but the report: no probe, no temporary name.
  for (const std::string& name : files()) EXPECT_THAT(name, ::testing::Not(HasSubstr("probe")));
}

TEST_F(Run, TakesAShippedSuiteByName) {
  const Outcome outcome = run({"run", "smoke.toml", "--methods", "full", "--no-pictures", "--quiet"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(json::parse(read_file(folder() / "out/results.json")).at("suite"), "smoke");
}

// A file of that name goes before what is shipped.
TEST_F(Run, PrefersAFileToAShippedSuite) {
  put("smoke.toml", "[suite]\nnme = 1\n");
  const Outcome outcome = run({"run", "smoke.toml"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("nme"));
}

TEST_F(Run, FiguresHaveThePromisedNames) {
  ASSERT_EQ(fly({}, "out").status, 0);
  const json results = json::parse(read_file(folder() / "out/results.json"));
  EXPECT_EQ(results.at("schema"), "plumbline.results/1");
  ASSERT_EQ(results.at("runs").size(), 1U);
  const json& flight = results.at("runs").at(0);
  EXPECT_EQ(flight.at("terrain"), "hills");
  EXPECT_EQ(flight.at("trajectory"), "down");
  EXPECT_EQ(flight.at("method"), "restricted_quadtree");
  EXPECT_EQ(flight.at("threshold_px"), 2);
  ASSERT_EQ(flight.at("frames").size(), 2U);
  const json& frame = flight.at("frames").at(1);
  EXPECT_THAT(keys_of(frame),
              IsSupersetOf({"index", "camera", "triangles", "vertices", "conformity", "vertical_m",
                            "displacement_px", "silhouette_px", "pop_px", "shape", "counters"}));
  EXPECT_THAT(keys_of(frame.at("camera")),
              IsSupersetOf({"position", "forward", "up", "fov_y_deg", "viewport"}));
  EXPECT_THAT(keys_of(frame.at("conformity")),
              IsSupersetOf({"crack", "t_junction", "fold_over", "degenerate", "hole", "overlap", "outline",
                            "non_manifold", "duplicate", "non_finite"}));
  EXPECT_THAT(keys_of(frame.at("vertical_m")), IsSupersetOf({"max", "certain_max", "rms", "mean", "at"}));
  EXPECT_THAT(keys_of(frame.at("displacement_px")),
              IsSupersetOf({"max", "p999", "p99", "rms", "mean", "over_threshold", "uncovered_px"}));
  EXPECT_THAT(keys_of(frame.at("silhouette_px")), IsSupersetOf({"pixels", "max"}));
  EXPECT_THAT(keys_of(frame.at("pop_px")), IsSupersetOf({"max", "p99"}));
  EXPECT_THAT(keys_of(frame.at("shape")), IsSupersetOf({"slivers", "min_quality"}));
  EXPECT_THAT(keys_of(frame.at("counters")),
              IsSupersetOf({"visited", "evaluated", "split", "merged", "entered", "left"}));
  ASSERT_EQ(results.at("gates").size(), 1U);
  EXPECT_THAT(keys_of(results.at("gates").at(0)), IsSupersetOf({"name", "run", "limit", "value", "pass"}));
}

TEST_F(Run, FailsByStatus1WhenAGateFails) {
  SuiteText suite;
  suite.gate = "triangles = 0\n";
  const Outcome outcome = fly(suite, "out");
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  const json results = json::parse(read_file(folder() / "out/results.json"));
  ASSERT_EQ(results.at("gates").size(), 1U);
  EXPECT_EQ(results.at("gates").at(0).at("pass"), false);
  EXPECT_THAT(read_file(folder() / "out/junit.xml"), HasSubstr("<failure"));
}

TEST_F(Run, KeepsOnlyTheMethodsAskedFor) {
  SuiteText suite;
  suite.gate = "crack = 0\n[[method]]\nid = \"full\"\nthresholds_px = [1]\n";
  ASSERT_EQ(fly(suite, "both").status, 0);
  ASSERT_EQ(fly(suite, "one", {"--methods", "full"}).status, 0);
  EXPECT_EQ(json::parse(read_file(folder() / "both/results.json")).at("runs").size(), 2U);
  const json one = json::parse(read_file(folder() / "one/results.json"));
  ASSERT_EQ(one.at("runs").size(), 1U);
  EXPECT_EQ(one.at("runs").at(0).at("method"), "full");
}

TEST_F(Run, QuietIsQuiet) {
  const Outcome outcome = fly({}, "out", {"--quiet"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Run, DumpsAMeshForEveryFrame) {
  ASSERT_EQ(fly({}, "out", {"--dump-meshes"}).status, 0);
  std::size_t meshes = 0;
  for (const std::string& name : files()) {
    if (name.rfind("out/meshes/", 0) != 0 || name.size() < 4 || name.substr(name.size() - 4) != ".ply")
      continue;
    ++meshes;
    const std::string head = read_file(folder() / name).substr(0, 400);
    EXPECT_THAT(head, HasSubstr("format binary_little_endian 1.0"));
    EXPECT_THAT(head, HasSubstr("property double x"));
  }
  EXPECT_EQ(meshes, 2U);
}

// Ctrl-C: what was finished is kept, whole.
TEST_F(Run, InterruptedKeepsWhatWasFinished) {
  SuiteText suite;
  suite.trajectory = "id = \"long\"\nkind = \"orbit\"\nframes = 10000\n";
  put("suite.toml", suite.text());
  bool sent = false;
  const Outcome outcome =
      run({"run", "suite.toml", "--out", "out", "--jobs", "2", "--dump-meshes"}, 120, [&](pid_t program) {
        // The first mesh is there once the flight began, well after the handler was installed.
        if (sent || !std::filesystem::exists(folder() / "out/meshes")) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        kill(program, SIGINT);
        sent = true;
      });
  ASSERT_TRUE(sent);
  EXPECT_EQ(outcome.status, 130) << outcome.err;
  const json results = json::parse(read_file(folder() / "out/results.json"));
  EXPECT_EQ(results.at("schema"), "plumbline.results/1");
}

// The report is a function of the suite: not of the threads, the instruction set, the folder, or an earlier
// run.
TEST_F(Run, SameSuiteSameBytes) {
  SuiteText suite;
  suite.terrain = "id = \"hills\"\ngenerator = \"fbm\"\nseed = 3\nsize = 65\nspacing_m = 10\n";
  suite.trajectory = "id = \"jump\"\nkind = \"teleport\"\nframes = 4\nseed = 9\n";
  suite.method = "id = \"block_bintree\"\nthresholds_px = [1, 16]\n";
  suite.gate = "non_finite = 0\n";
  ASSERT_EQ(fly(suite, "a", {"--jobs", "1"}).status, 0);
  ASSERT_EQ(fly(suite, "b", {"--jobs", "2"}).status, 0);
  ASSERT_EQ(fly(suite, "c", {"--isa", "sse2"}).status, 0);
  ASSERT_EQ(fly(suite, "a/deeper", {"--jobs", "2"}).status, 0);
  const std::string reference = read_file(folder() / "a/results.json");
  ASSERT_FALSE(reference.empty());
  // EXPECT_TRUE, since a difference of two long files helps nobody here: script/determinism shows the lines.
  EXPECT_TRUE(reference == read_file(folder() / "b/results.json")) << "2 jobs";
  EXPECT_TRUE(reference == read_file(folder() / "c/results.json")) << "sse2";
  EXPECT_TRUE(reference == read_file(folder() / "a/deeper/results.json")) << "another folder";
}

class Fuzz : public ProgramTest {
 protected:
  [[nodiscard]] std::vector<std::string> cases_in(const std::string& out) const {
    std::vector<std::string> cases;
    for (const std::string& name : files()) {
      if (name.rfind(out + "/", 0) == 0 && name.size() > 5 && name.substr(name.size() - 5) == ".toml") {
        cases.push_back(name);
      }
    }
    return cases;
  }
};

// METHODS M4.S1: steep ground breaks the split test's monotony, so the hunt must come home with something.
TEST_F(Fuzz, FindsBlockBintreesFaultAndReplayShowsIt) {
  const Outcome hunt =
      run({"fuzz", "--method", "block_bintree", "--cases", "300", "--seed", "1", "--out", "found"}, 300);
  EXPECT_EQ(hunt.status, 1) << hunt.out << hunt.err;
  const std::vector<std::string> cases = cases_in("found");
  ASSERT_GE(cases.size(), 1U);
  for (const std::string& name : cases) {
    SCOPED_TRACE(name);
    const Outcome first = run({"replay", name});
    const Outcome second = run({"replay", name});
    EXPECT_EQ(first.status, 1) << first.err;
    EXPECT_EQ(first.out, second.out);
    EXPECT_EQ(first.err, second.err);
    EXPECT_THAT(first.out, HasSubstr("block_bintree"));
  }
}

TEST_F(Fuzz, SameSeedSameCases) {
  for (const char* out : {"a", "b"}) {
    const Outcome hunt =
        run({"fuzz", "--method", "block_bintree", "--cases", "60", "--seed", "5", "--out", out}, 300);
    EXPECT_TRUE(hunt.status == 0 || hunt.status == 1) << hunt.err;
  }
  const std::vector<std::string> first = cases_in("a"), second = cases_in("b");
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].substr(1), second[i].substr(1));
    EXPECT_EQ(read_file(folder() / first[i]), read_file(folder() / second[i]));
  }
}

TEST_F(Fuzz, FindsNothingThatTheFullGridPromises) {
  const Outcome hunt =
      run({"fuzz", "--method", "full", "--cases", "40", "--seed", "2", "--out", "found"}, 300);
  EXPECT_EQ(hunt.status, 0) << hunt.out << hunt.err;
  // Its diagonals all lean one way, so it is not symmetric and does not promise to be: this alone is written
  // down.
  for (const std::string& name : cases_in("found")) EXPECT_THAT(name, HasSubstr("symmetric"));
}

}  // namespace
}  // namespace plumbline::testing_cli
