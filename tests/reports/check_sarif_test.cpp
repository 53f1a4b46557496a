// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "reports/check_report.h"
#include "reports/json_text.h"
#include "tests/reports/sample_check.h"

namespace plumbline::reports {
namespace {

using testing::HasSubstr;

Json sarif_of(const verdict::CheckVerdict& check) { return Json::parse(check_sarif(check)); }

/// RFC 3986's characters of a reference, and no scheme but file.
bool is_reference(const std::string& uri) {
  static const std::regex allowed("(file://)?([A-Za-z0-9._~/-]|%[0-9A-F]{2})+");
  return std::regex_match(uri, allowed);
}

/// What the schema of SARIF 2.1.0 requires of the objects that are used here.
void expect_schema(const Json& log) {
  EXPECT_EQ(log["version"], "2.1.0");
  ASSERT_TRUE(log["runs"].is_array());
  for (const Json& run : log["runs"]) {
    const Json& driver = run["tool"]["driver"];
    EXPECT_TRUE(driver["name"].is_string());
    std::set<std::string> ids;
    for (const Json& rule : driver["rules"]) {
      ASSERT_TRUE(rule["id"].is_string());
      EXPECT_TRUE(ids.insert(rule["id"]).second) << "rules are unique";
      for (const char* text : {"shortDescription", "fullDescription", "help"})
        EXPECT_FALSE(rule[text]["text"].get<std::string>().empty()) << rule["id"] << text;
      EXPECT_FALSE(rule.contains("helpUri")) << "must be absolute, and the manual has no address";
      EXPECT_THAT((std::set<std::string>{"none", "note", "warning", "error"}),
                  testing::Contains(rule["defaultConfiguration"]["level"].get<std::string>()));
    }
    for (const Json& one : run["invocations"]) EXPECT_TRUE(one["executionSuccessful"].is_boolean());
    for (const Json& artifact : run["artifacts"])
      EXPECT_TRUE(is_reference(artifact["location"]["uri"])) << artifact;
    for (const Json& result : run["results"]) {
      EXPECT_FALSE(result["message"]["text"].get<std::string>().empty());
      const auto rule = result["ruleIndex"].get<std::size_t>();
      ASSERT_LT(rule, driver["rules"].size());
      EXPECT_EQ(driver["rules"][rule]["id"], result["ruleId"]);
      for (const auto& [key, print] : result["partialFingerprints"].items())
        EXPECT_TRUE(print.is_string()) << key;
      for (const Json& location : result["locations"]) {
        EXPECT_TRUE(is_reference(location["physicalLocation"]["artifactLocation"]["uri"])) << location;
        EXPECT_GE(location["physicalLocation"]["region"]["startLine"], 1);
        for (const Json& logical : location["logicalLocations"]) EXPECT_TRUE(logical["name"].is_string());
      }
    }
  }
}

TEST(CheckSarif, HasWhatTheSchemaRequires) {
  for (const verdict::CheckVerdict& check :
       {sample::sound_check(), sample::tiles_check(), sample::terrain_check(), sample::object_check()})
    expect_schema(sarif_of(check));
}

TEST(CheckSarif, EveryCodeOfTheCatalogueIsARule) {
  const Json log = sarif_of(sample::sound_check());
  const Json& rules = log["runs"][0]["tool"]["driver"]["rules"];
  ASSERT_EQ(rules.size(), oracle::finding_catalogue().size());
  for (std::size_t i = 0; i < rules.size(); ++i) {
    const oracle::FindingDescription& entry = oracle::finding_catalogue()[i];
    EXPECT_EQ(rules[i]["id"], fmt::format("PL{}", static_cast<int>(entry.code)));
    EXPECT_EQ(rules[i]["name"], entry.name);
    EXPECT_EQ(rules[i]["fullDescription"]["text"], entry.definition);
    EXPECT_THAT(rules[i]["help"]["markdown"].get<std::string>(),
                HasSubstr("(" + oracle::finding_section(entry.code) + ")"));
  }
  EXPECT_TRUE(log["runs"][0]["results"].empty());
}

TEST(CheckSarif, ACodeThatTheCatalogueLacksIsARuleToo) {
  verdict::CheckVerdict check = sample::sound_check();
  check.findings.push_back(
      sample::check_finding(static_cast<oracle::FindingCode>(399), "", 0, {1, 2, 3}, {1, 2, 3}));
  const Json log = sarif_of(check);
  expect_schema(log);
  EXPECT_EQ(log["runs"][0]["results"][0]["ruleId"], "PL399");
}

TEST(CheckSarif, AResultSaysWhatAndWhere) {
  const verdict::CheckVerdict check = sample::tiles_check();
  const Json results = sarif_of(check)["runs"][0]["results"];
  ASSERT_EQ(results.size(), check.findings.size());
  const Json& crack = results[0];
  EXPECT_EQ(crack["ruleId"], "PL302");
  EXPECT_EQ(crack["level"], "error");
  EXPECT_EQ(results.back()["level"], "warning") << "a hazard";
  const std::string text = crack["message"]["text"];
  EXPECT_THAT(text, HasSubstr(check.findings[0].message));
  EXPECT_THAT(text, HasSubstr("9/533/383.terrain and 9/534/383.terrain"));
  EXPECT_EQ(crack["locations"][0]["physicalLocation"]["artifactLocation"]["uri"], "9/533/383.terrain");
  EXPECT_EQ(crack["locations"][0]["properties"]["at"][0], check.findings[0].at.x);
  EXPECT_EQ(crack["relatedLocations"][0]["physicalLocation"]["artifactLocation"]["uri"], "9/534/383.terrain");
  EXPECT_EQ(crack["properties"]["gap_m"], check.findings[0].finding.gap_m);
}

// Code scanning refuses an upload with a result that has no location, and opens what the location names.
TEST(CheckSarif, EveryResultHasAPlaceThatCanBeOpened) {
  verdict::CheckVerdict check = sample::tiles_check();
  for (verdict::CheckedMesh& mesh : check.meshes) mesh.path = "out/tiles/" + mesh.file;
  check.meshes.push_back(check.meshes.front());
  verdict::CheckFinding missing = sample::check_finding(oracle::FindingCode::tile_encoding, "missing_tile",
                                                        verdict::kNoMesh, {1, 2, 3}, {1, 2, 3});
  missing.file = "out/tiles/layer.json";
  check.findings.push_back(missing);
  const Json log = sarif_of(check);
  expect_schema(log);
  const Json& run = log["runs"][0];
  const auto uri = [](const Json& result) {
    return result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"].get<std::string>();
  };
  for (const Json& result : run["results"]) ASSERT_EQ(result["locations"].size(), 1u) << result;
  EXPECT_EQ(uri(run["results"].back()), "out/tiles/layer.json");
  EXPECT_EQ(uri(run["results"][0]), "out/tiles/9/533/383.terrain");
  std::set<std::string> artifacts;
  for (const Json& artifact : run["artifacts"])
    EXPECT_TRUE(artifacts.insert(artifact["location"]["uri"]).second) << "the schema wants each once";
}

TEST(CheckSarif, NamesOfFilesBecomeReferences) {
  verdict::CheckVerdict check = sample::terrain_check();
  const auto uri = [&](const std::string& file) {
    check.meshes[0].file = file;
    return sarif_of(check)["runs"][0]["artifacts"][0]["location"]["uri"].get<std::string>();
  };
  EXPECT_EQ(uri("maps/hill & dale.glb"), "maps/hill%20%26%20dale.glb");
  EXPECT_EQ(uri("/data/a.ply"), "file:///data/a.ply");
  EXPECT_EQ(uri("C:a%?#.ply"), "C%3Aa%25%3F%23.ply") << "no scheme, no query, no fragment";
  EXPECT_EQ(uri("\xC3\xA9\xFF.ply"), "%C3%A9%FF.ply");
}

std::vector<std::string> prints(const verdict::CheckVerdict& check) {
  std::vector<std::string> out;
  const Json sarif = sarif_of(check);  // outlives the loop: a range's temporaries do not
  for (const Json& result : sarif["runs"][0]["results"])
    out.push_back(result["partialFingerprints"]["plumblineFinding/v1"]);
  return out;
}

TEST(CheckSarif, FingerprintsFollowTheFinding) {
  const verdict::CheckVerdict check = sample::tiles_check(12, 8);
  const std::vector<std::string> before = prints(check);
  EXPECT_EQ(std::set<std::string>(before.begin(), before.end()).size(), before.size());

  verdict::CheckVerdict later = check;  // another order, other words, other sizes: the same findings
  std::ranges::reverse(later.findings);
  for (verdict::CheckFinding& finding : later.findings) {
    finding.message = "said otherwise";
    finding.finding.gap_m *= 2;
  }
  std::vector<std::string> after = prints(later);
  std::ranges::reverse(after);
  EXPECT_EQ(after, before);

  for (const auto change : {+[](verdict::CheckFinding& f) { f.at.x = std::nextafter(f.at.x, 1e9); },
                            +[](verdict::CheckFinding& f) { f.finding.kind = "height_mismatch"; },
                            +[](verdict::CheckFinding& f) { f.finding.code = oracle::FindingCode::hole; },
                            +[](verdict::CheckFinding& f) { f.other_mesh = 5; }}) {
    verdict::CheckVerdict other = check;
    change(other.findings[0]);
    EXPECT_NE(prints(other)[0], before[0]);
  }
}

TEST(CheckSarif, TwoOfAKindAtOnePlaceStayTwo) {
  verdict::CheckVerdict check = sample::tiles_check();
  check.findings.push_back(check.findings[0]);
  const std::vector<std::string> all = prints(check);
  EXPECT_NE(all.front(), all.back());
  EXPECT_EQ(all.front(), prints(sample::tiles_check()).front());
}

}  // namespace
}  // namespace plumbline::reports
