// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two results, one of them spoiled in one place: is that place named, alone, and in the right direction?
#include "properties/compare/compare.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "properties/compare/json_reader.h"
#include "properties/verdict/verdict.h"
#include "reports/check_report.h"
#include "reports/report.h"
#include "scenarios/error.h"
#include "tests/reports/sample_check.h"
#include "tests/reports/sample_verdict.h"

namespace plumbline::compare {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using verdict::Change;
using verdict::Comparison;
using verdict::Direction;

const std::string& sound_results() {
  static const std::string text =
      reports::results_json(sample::suite_verdict({{"canyon"}, {"orbit", "skim"}, 5}));
  return text;
}

/// The sample's results with one change made to the tree.
std::string spoiled(const std::function<void(Json&)>& spoil) {
  Json root = Json::parse(sound_results());
  spoil(root);
  return root.dump();
}

Comparison compare_texts(const std::string& before, const std::string& after, double tolerance = 0) {
  return compare_results(parse_result(before, "old.json"), parse_result(after, "new.json"), tolerance);
}

/// "worse canyon.orbit.full.1: crack 0 → 3"
std::vector<std::string> lines(const Comparison& comparison) {
  std::vector<std::string> out;
  for (const verdict::Difference& one : comparison.differences) {
    const auto side = [](const std::optional<double>& value, const std::string& text) {
      return value ? fmt::format("{}", *value) : text;
    };
    out.push_back(fmt::format("{} {}: {} {} → {}{}{}", change_name(one.change), one.where, one.what,
                              side(one.before, one.before_text), side(one.after, one.after_text),
                              one.note.empty() ? "" : ", ", one.note));
  }
  return out;
}

std::vector<std::string> spoiled_lines(const std::function<void(Json&)>& spoil) {
  return lines(compare_texts(sound_results(), spoiled(spoil)));
}

Json& summary_of(Json& root, std::size_t run) { return root["runs"][run]["summary"]; }

TEST(CompareResults, EqualFilesAreUnchanged) {
  const Comparison same = compare_texts(sound_results(), sound_results());
  EXPECT_THAT(lines(same), IsEmpty());
  EXPECT_EQ(same.word(), "unchanged");
  EXPECT_EQ(same.subjects, 14u);
  EXPECT_GT(same.same, 14u * 30) << "every figure of every run";
  EXPECT_EQ(compare_texts(sound_results(), spoiled([](Json&) {})).differences.size(), 0u)
      << "blanks and the order of keys say nothing";
}

TEST(CompareResults, EachFigureIsHeldAgainstItsNamesake) {
  // Every figure of one run, changed alone, is the one line that is told: none is passed over.
  std::size_t told = 0;
  for (const verdict::Figure& figure : verdict::figures()) {
    const std::string path(figure.path);
    const std::size_t dot = path.find('.');
    bool judged = false;
    const auto lines_of = spoiled_lines([&](Json& root) {
      Json& summary = summary_of(root, 3);
      Json& group = dot == std::string::npos
                        ? (summary["conformity"].contains(path) ? summary["conformity"] : summary)
                        : summary[path.substr(0, dot)];
      Json& value = group[dot == std::string::npos ? path : path.substr(dot + 1)];
      judged = value.is_number();
      value = judged ? value.get<double>() + 1 : 1;
    });
    ASSERT_EQ(lines_of.size(), 1u) << path;
    EXPECT_THAT(lines_of[0], HasSubstr("canyon.orbit.restricted_quadtree.4: " + path + " "));
    const Direction direction = verdict::figure_direction(path);
    const char* word = !judged || direction == Direction::neither ? "changed "
                       : direction == Direction::more_is_worse    ? "worse "
                                                                  : "better ";
    EXPECT_THAT(lines_of[0], testing::StartsWith(word)) << path;
    told += judged ? 1 : 0;
  }
  EXPECT_GT(told, 30u) << "the sample judges too little";
}

TEST(CompareResults, TheLastBitCountsUnlessATolerancePassesIt) {
  const std::string after = spoiled([](Json& root) {
    Json& p99 = summary_of(root, 1)["displacement_px"]["p99"];
    p99 = std::nextafter(p99.get<double>(), 10);
  });
  EXPECT_EQ(compare_texts(sound_results(), after).word(), "worse");
  const Comparison close = compare_texts(sound_results(), after, 1e-9);
  EXPECT_EQ(close.word(), "unchanged");
  EXPECT_EQ(close.within_tolerance, 1u);
}

TEST(CompareResults, NoToleranceForCounts) {
  const auto with_slivers = [](int slivers) {
    return spoiled([&](Json& root) { summary_of(root, 1)["shape"]["slivers"] = slivers; });
  };
  EXPECT_EQ(compare_texts(with_slivers(1'000'000), with_slivers(1'000'001), 0.5).count(Change::worse), 1u);
}

TEST(CompareResults, WhatIsJudgedNoLongerIsWorse) {
  EXPECT_THAT(spoiled_lines([](Json& root) { summary_of(root, 1)["vertical_m"]["max"] = nullptr; }),
              ElementsAre(testing::MatchesRegex("worse .*: vertical_m.max .* → not judged")));
}

TEST(CompareResults, RunsThatAreGoneAreWorseAndNewOnesAreTold) {
  const std::string id = "canyon.orbit.restricted_quadtree.2";
  const std::string fewer = spoiled([&](Json& root) {
    root["runs"].erase(2);
    Json kept = Json::array();
    for (const Json& gate : root["gates"])
      if (gate["run"] != id) kept.push_back(gate);
    root["gates"] = kept;
  });
  EXPECT_THAT(lines(compare_texts(sound_results(), fewer)),
              ElementsAre("worse " + id + ": run judged → gone"))
      << "and not its gates besides";
  const auto gained = lines(compare_texts(fewer, sound_results()));
  EXPECT_THAT(gained, ElementsAre("changed " + id + ": run — → new"));
}

TEST(CompareResults, GatesThatTurn) {
  const auto turn = [](Json& root) { root["gates"][4]["pass"] = !root["gates"][4]["pass"].get<bool>(); };
  EXPECT_THAT(spoiled_lines(turn),
              ElementsAre("worse canyon.orbit.restricted_quadtree.2: gate crack == 0 holds → fails"));
  EXPECT_THAT(lines(compare_texts(spoiled(turn), sound_results())),
              ElementsAre("better canyon.orbit.restricted_quadtree.2: gate crack == 0 fails → holds"));
}

TEST(CompareResults, NewGatesThatFailAreWorse) {
  const auto add = [](bool pass) {
    return [pass](Json& root) {
      for (const char* run : {"canyon.orbit.full.1", "canyon.skim.full.1"})
        root["gates"].push_back({{"name", "hole == 0"}, {"run", run}, {"limit", "== 0"}, {"pass", pass}});
    };
  };
  EXPECT_THAT(spoiled_lines(add(true)), ElementsAre("changed : gate hole == 0 — → holds, 2 runs"));
  EXPECT_THAT(spoiled_lines(add(false)), ElementsAre("worse canyon.orbit.full.1: gate hole == 0 — → fails",
                                                     "worse canyon.skim.full.1: gate hole == 0 — → fails"));
  EXPECT_THAT(lines(compare_texts(spoiled(add(false)), sound_results())),
              ElementsAre("changed : gate hole == 0 fails → not asked, 2 runs"));
}

TEST(CompareResults, VerdictAndVacuousComeFirst) {
  const auto spoil = [](Json& root) {
    summary_of(root, 0)["largest_gap_m"] = 5;
    root["vacuous"].push_back("x: no frame");
    root["interrupted"] = true;
    summary_of(root, 0)["conformity"]["hole"] = 2;
    root["yardstick"] = "other";
  };
  EXPECT_THAT(
      spoiled_lines(spoil),
      ElementsAre("worse : finished finished → interrupted", "worse : x: no frame — → judged nothing",
                  "worse canyon.orbit.full.1: hole 0 → 2", "worse canyon.orbit.full.1: largest_gap_m 0 → 5",
                  "changed : yardstick null → other"));
}

TEST(CompareResults, WhatWasFlownIsToldFactByFact) {
  EXPECT_THAT(spoiled_lines([](Json& root) { root["terrains"][0]["columns"] = 257; }),
              ElementsAre("changed : columns of canyon 513 → 257"));
}

TEST(CompareResults, FramesMayDifferUnderAnEqualSummary) {
  const std::string after =
      spoiled([](Json& root) { root["runs"][5]["frames"][2]["camera"]["position"][0] = 1.5; });
  const Comparison frames = compare_texts(sound_results(), after);
  ASSERT_EQ(frames.differences.size(), 1u);
  EXPECT_EQ(frames.differences[0].change, Change::changed);
  EXPECT_EQ(frames.differences[0].what, "single frames");
  EXPECT_EQ(compare_texts(sound_results(), after, 1e-6).word(), "unchanged") << "no frame has a tolerance";
}

TEST(CompareResults, AFigureThatOneFileNeverTellsIsOneChange) {
  const std::string older = spoiled([](Json& root) {
    for (Json& run : root["runs"]) run["summary"].erase("nothing_judged");
  });
  EXPECT_THAT(lines(compare_texts(older, sound_results())),
              ElementsAre("changed : nothing_judged — → is told"));
}

// ---- checks

const std::string kCheck = R"({ "schema": "plumbline.check/1", "verdict": "faulty", "frame": "the file's own",
  "meshes": [ { "file": "a/b/one.ply", "triangles": 10, "vertices": 8, "shape": { "min_quality": 0.5 } },
              { "file": "a/b/two.ply", "triangles": 20, "vertices": 18 } ],
  "conformity": { "crack": 2, "hole": 0 },
  "findings": [
    { "code": 302, "name": "crack", "kind": "gap", "mesh": "a/b/one.ply", "at": [1, 2, 3], "gap_m": 0.5 },
    { "code": 302, "name": "crack", "kind": "gap", "mesh": 0, "other_mesh": 1, "at": [1, 2, 4], "gap_m": 0.5 } ],
  "seams": [ { "mesh": 0, "other_mesh": 1, "state": "covered by a skirt", "largest_gap_m": -0.5 } ],
  "vertical_m": { "max": 1.5, "certain_max": 1.25, "at": [3, 4] }, "terrain": { "file": "dem.tif", "declared": { "bound_m": 2, "everywhere": true } },
  "headline": "2 cracks", "displacement_px": null, "image": { "camera": { "position": [1, 2, 9] }, "mesh_px": 7 } })";

std::string check_with(const std::string& from, const std::string& to) {
  std::string text = kCheck;
  EXPECT_NE(text.find(from), std::string::npos) << from;
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

std::vector<std::string> check_lines(const std::string& from, const std::string& to) {
  return lines(compare_texts(kCheck, check_with(from, to)));
}

TEST(CompareChecks, WhatBecameWorse) {
  EXPECT_THAT(check_lines("\"verdict\"", "\"verdict\""), IsEmpty());
  EXPECT_THAT(check_lines("\"faulty\"", "\"sound\""), ElementsAre("better : verdict faulty → sound"));
  EXPECT_THAT(check_lines("\"hole\": 0", "\"hole\": 3"), ElementsAre("worse : conformity.hole 0 → 3"));
  EXPECT_THAT(check_lines("1.25", "1"), ElementsAre("better : vertical_m.certain_max 1.25 → 1"));
  EXPECT_THAT(check_lines("0.5 }", "0.25 }"),
              testing::Contains("worse one.ply: shape.min_quality 0.5 → 0.25"));
  EXPECT_THAT(check_lines("\"triangles\": 20", "\"triangles\": 21"),
              ElementsAre("changed two.ply: triangles 20 → 21"));
  EXPECT_THAT(check_lines("covered by a skirt", "open"),
              ElementsAre("worse one.ply | two.ply: state covered by a skirt → open"));
  EXPECT_THAT(check_lines("-0.5", "0.75"), ElementsAre("worse one.ply | two.ply: largest_gap_m -0.5 → 0.75"))
      << "a signed gap is as bad as it is large";
  EXPECT_THAT(check_lines("true", "false"), ElementsAre("worse : terrain.declared.everywhere true → false"));
  EXPECT_THAT(check_lines("\"headline\": \"2", "\"headline\": \"3"), IsEmpty()) << "counts again, in words";
  EXPECT_THAT(check_lines("\"position\": [1", "\"position\": [2"),
              ElementsAre(HasSubstr("changed : image.camera {")));
  EXPECT_THAT(check_lines("dem.tif", "other.tif"), ElementsAre("changed : terrain.file dem.tif → other.tif"));
  EXPECT_THAT(check_lines("the file's own", "metres"),
              ElementsAre("changed : frame the file's own → metres"));
}

TEST(CompareChecks, AGroupThatIsNullIsNotJudged) {
  const std::string with = "{ \"max\": 1.5, \"certain_max\": 1.25, \"at\": [3, 4] }";
  EXPECT_THAT(check_lines(with, "null"), ElementsAre("worse : vertical_m.certain_max 1.25 → not judged",
                                                     "worse : vertical_m.max 1.5 → not judged"));
  EXPECT_THAT(lines(compare_texts(check_with(with, "null"), kCheck)),
              ElementsAre("changed : vertical_m.certain_max not judged → 1.25",
                          "changed : vertical_m.max not judged → 1.5"));
}

TEST(CompareChecks, FindingsAreKnownByCodeKindMeshAndPlace) {
  EXPECT_THAT(check_lines("[1, 2, 3]", "[1, 2, 3.0000000000000004]"),
              ElementsAre("worse one.ply: 302 crack: gap at 1, 2, 3.0000000000000004 — → found",
                          "better one.ply: 302 crack: gap at 1, 2, 3 found → —"));
  EXPECT_THAT(check_lines("[1, 2, 4]", "[9, 2, 4]"),
              ElementsAre("worse one.ply | two.ply: 302 crack: gap at 9, 2, 4 — → found",
                          "better one.ply | two.ply: 302 crack: gap at 1, 2, 4 found → —"));
  EXPECT_THAT(check_lines("\"gap_m\": 0.5", "\"gap_m\": 0.75"), IsEmpty()) << "the same findings";
}

// Cracks that skirts hid, and that are there without them: the same places, another severity.
TEST(CompareChecks, AHazardThatBecomesAFaultIsNew) {
  const std::string hidden = check_with("\"kind\": \"gap\"", "\"kind\": \"gap\", \"severity\": \"hazard\"");
  const std::string bare = check_with("\"kind\": \"gap\"", "\"kind\": \"gap\", \"severity\": \"fault\"");
  EXPECT_THAT(lines(compare_texts(hidden, bare)),
              testing::Contains("worse one.ply: 302 crack: gap at 1, 2, 3 — → found"));
  EXPECT_THAT(lines(compare_texts(hidden, bare)),
              testing::Contains("better one.ply: 302 crack: gap (hazard) at 1, 2, 3 found → —"));
}

// Lists are cut short, counts are not: of every code.
TEST(CompareChecks, ACodeThatIsNewIsCountedFromNone) {
  const auto counted = [](const std::string& counts) {
    return check_with(
        "\"findings\":",
        fmt::format("\"findings_total\": 812, \"findings_by_code\": {}, \"findings\":", counts));
  };
  const std::string before = counted("{ \"302\": 812 }"), after = counted("{ \"302\": 811, \"306\": 1 }");
  EXPECT_THAT(lines(compare_texts(before, after)),
              ElementsAre("worse : findings_by_code.306 0 → 1", "better : findings_by_code.302 812 → 811"));
  EXPECT_EQ(verdict::findings_only(compare_texts(before, after)).word(), "worse");
  EXPECT_EQ(lines(compare_texts(counted("{}"), after)).size(), 2u);
  EXPECT_THAT(lines(compare_texts(kCheck, after)), testing::Not(testing::Contains(HasSubstr("0 → 1"))))
      << "a file of before the counts";
}

TEST(CompareChecks, FindingsAloneStillSeeWhatIsJudgedNoLonger) {
  const Comparison gone = compare_texts(kCheck, check_with("two.ply", "three.ply"));
  EXPECT_EQ(verdict::findings_only(gone).word(), "worse");
  const Comparison turned = compare_texts(check_with("\"faulty\"", "\"sound\""), kCheck);
  EXPECT_EQ(verdict::findings_only(turned).word(), "worse");
}

// A tile keeps its name, whatever other tiles there are.
TEST(CompareChecks, TilesAreKnownByTheirPlace) {
  const auto tiles = [](std::vector<std::string> files) {
    std::string meshes;
    for (const std::string& file : files)
      meshes += fmt::format(R"({}{{"file": "{}", "format": "quantized-mesh", "triangles": 4}})",
                            meshes.empty() ? "" : ", ", file);
    return fmt::format(
        R"({{"schema": "plumbline.check/1", "verdict": "sound", "meshes": [{}], "findings": []}})", meshes);
  };
  EXPECT_THAT(lines(compare_texts(tiles({"10/533/383.terrain", "10/533/384.terrain"}),
                                  tiles({"10/533/383.terrain", "10/533/384.terrain", "10/534/383.terrain"}))),
              ElementsAre("changed 10/534/383.terrain: mesh — → new",
                          "changed : 10/534/383.terrain: format — → quantized-mesh"));
}

TEST(CompareChecks, AListThatIsCutShortDecidesNothing) {
  const std::string cut = check_with("\"findings\":", "\"findings_total\": 812, \"findings\":");
  std::string other = cut;
  other.replace(other.find("[1, 2, 3]"), 9, "[7, 7, 7]");
  const Comparison comparison = compare_texts(cut, other);
  EXPECT_EQ(comparison.word(), "changed");
  EXPECT_EQ(comparison.differences.size(), 2u);
  EXPECT_THAT(comparison.notes, ElementsAre(HasSubstr("old.json lists its worst findings only"),
                                            HasSubstr("new.json lists its worst findings only")));
}

TEST(CompareChecks, FoldersDoNotMatter) {
  EXPECT_THAT(check_lines("a/b/", "elsewhere/"), IsEmpty());
  EXPECT_THAT(check_lines("two.ply", "three.ply"),
              testing::IsSupersetOf({"worse two.ply: mesh judged → gone", "changed three.ply: mesh — → new",
                                     "worse one.ply | two.ply: seam judged → gone"}));
}

TEST(CompareChecks, OneMeshAgainstOneMeshWhateverTheirNames) {
  const auto one = [](const std::string& name, int cracks) {
    return fmt::format(
        R"({{"schema": "plumbline.check/1", "verdict": "faulty", "meshes": [{{"file": "{}", "triangles": 4}}],
            "conformity": {{"crack": {}}},
            "findings": [{{"code": 302, "mesh": "{}", "at": [0, 0, 0]}}]}})",
        name, cracks, name);
  };
  const Comparison comparison = compare_texts(one("x/before.ply", 1), one("y/after.ply", 2));
  EXPECT_THAT(lines(comparison), ElementsAre("worse : conformity.crack 1 → 2"));
  EXPECT_THAT(comparison.notes, ElementsAre("before.ply before is compared with after.ply after"));
}

TEST(CompareChecks, ReadsWhatCheckWrites) {
  for (const verdict::CheckVerdict& check :
       {sample::terrain_check(), sample::tiles_check(), sample::object_check()}) {
    const std::string known = reports::check_json(check);
    const Comparison same = compare_texts(known, known);
    EXPECT_THAT(lines(same), IsEmpty());
    EXPECT_EQ(same.subjects, check.meshes.size() + check.seams.size());
    EXPECT_GT(same.same, 20u);
    verdict::CheckVerdict worse = check;
    worse.conformity.degenerate += 3;
    worse.findings.push_back(
        sample::check_finding(oracle::FindingCode::degenerate, "needle", 0, {1, 1, 1}, {7, 8, 9}));
    worse.findings_total += 1;
    const Comparison comparison = compare_texts(known, reports::check_json(worse));
    EXPECT_THAT(lines(comparison),
                testing::Contains(HasSubstr("201 degenerate: needle at 7, 8, 9 — → found")));
    EXPECT_EQ(comparison.count(Change::worse), check.findings_total == check.findings.size() ? 3u : 2u);
  }
}

TEST(CompareChecks, ResultsAreNotComparedWithChecks) {
  EXPECT_THROW(compare_texts(sound_results(), kCheck), InputError);
}

// ---- directions

TEST(FigureDirection, FewFiguresAreNotBadWhenTheyGrow) {
  std::vector<std::string> others;
  for (const verdict::Figure& figure : verdict::figures()) {
    if (verdict::figure_direction(figure.path) != Direction::more_is_worse) others.emplace_back(figure.path);
  }
  EXPECT_THAT(others, ElementsAre("triangles", "triangles_max", "stability.cuts", "shape.min_quality"));
  EXPECT_EQ(verdict::figure_direction("shape.min_quality"), Direction::less_is_worse);
  EXPECT_EQ(verdict::figure_direction("conformity.crack"), Direction::more_is_worse);
  EXPECT_EQ(verdict::figure_direction("something.new"), Direction::neither);
}

}  // namespace
}  // namespace plumbline::compare
