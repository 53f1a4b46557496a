// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/compare_report.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace plumbline::reports {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using verdict::Change;
using verdict::Comparison;
using verdict::Difference;
using verdict::Matter;

Difference figure(Change change, const std::string& where, const std::string& what, double before,
                  double after) {
  Difference out;
  out.change = change;
  out.where = where;
  out.what = what;
  out.before = before;
  out.after = after;
  return out;
}

Comparison sample() {
  Comparison out;
  out.schema = "plumbline.results/1";
  out.before = "old.json";
  out.after = "new.json";
  out.subjects = 2;
  out.same = 118;
  Difference gate;
  gate.change = Change::worse;
  gate.matter = Matter::gate;
  gate.where = "crags.orbit.block_bintree.8";
  gate.what = "gate expected: crack (M4.S1: steep ground)";
  gate.before_text = "holds";
  gate.after_text = "fails";
  out.differences = {
      gate, figure(Change::worse, "crags.orbit.block_bintree.8", "crack", 63, 75),
      figure(Change::worse, "crags.orbit.block_bintree.8", "displacement_px.p99", 2.5, 2.5000000000000004),
      figure(Change::better, "crags.nadir.full.1", "pop_px.max", 0.25, 0.125)};
  return out;
}

Comparison with_rows(std::size_t rows, const std::string& name) {
  Comparison out = sample();
  out.differences.clear();
  for (std::size_t k = 0; k < rows; ++k)
    out.differences.push_back(figure(Change::worse, fmt::format("{}{}", name, k), "crack", 0, 1));
  return out;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t times = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++times;
  return times;
}

/// Regenerate by running this test with PLUMBLINE_WRITE_GOLDEN=1; review the difference.
TEST(CompareText, IsTheGolden) {
  const std::string golden_path = PLUMBLINE_SOURCE_DIR "/tests/reports/golden/compare.txt";
  const std::string text = compare_text(sample()) + "\n" + compare_md(sample());
  if (std::getenv("PLUMBLINE_WRITE_GOLDEN") != nullptr) std::ofstream(golden_path, std::ios::binary) << text;
  std::ifstream file(golden_path, std::ios::binary);
  ASSERT_TRUE(file) << golden_path;
  const std::string golden{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, golden);
}

TEST(CompareText, UnchangedIsOneLine) {
  Comparison same = sample();
  same.differences.clear();
  EXPECT_EQ(compare_text(same), "unchanged: 0 worse, 0 better, 0 changed, 118 the same in 2 runs\n");
  EXPECT_THAT(compare_md(same), StartsWith("### plumbline: unchanged\n"));
}

TEST(CompareText, TellsNumbersApartWithFewDigits) {
  Comparison one = sample();
  one.differences = {figure(Change::worse, "r", "f", 0.123456, 0.123457)};
  EXPECT_THAT(compare_text(one), HasSubstr("| 0.123456 | 0.123457 | +0.00081 % |"));
  one.differences = {figure(Change::changed, "r", "f", 1234567, 1234568)};
  EXPECT_THAT(compare_text(one), HasSubstr("| 1234567 | 1234568 |     +1 |"));
}

TEST(CompareText, IsBounded) {
  const std::string text = compare_text(with_rows(10'000, "run"));
  EXPECT_EQ(count(text, "| worse"), kRowsForPeople);
  EXPECT_THAT(text, HasSubstr("… and 9800 more; --json FILE lists all"));
}

TEST(CompareMarkdown, FoldsWhatIsBeyondSixtyRows) {
  EXPECT_THAT(compare_md(with_rows(kRowsOpen, "run")), Not(HasSubstr("<details>")));
  const std::string text = compare_md(with_rows(kRowsOpen + 1, "run"));
  EXPECT_THAT(text, HasSubstr("<details><summary>1 more</summary>\n\n| |"));
  EXPECT_THAT(text, testing::EndsWith("\n</details>\n"));
}

TEST(CompareMarkdown, FitsACommentWhateverTheNames) {
  constexpr std::size_t kGitHubTakes = 65'536;
  for (const std::string& name : {std::string("run"), std::string(5000, 'x'), std::string(5000, '<')}) {
    const std::string text = compare_md(with_rows(2000, name));
    EXPECT_LT(text.size(), kGitHubTakes);
    EXPECT_THAT(text, testing::EndsWith("\n</details>\n"));
    EXPECT_THAT(text, HasSubstr("more that do not fit here"));
  }
}

TEST(CompareMarkdown, NamesAreTextWhateverTheyHold) {
  Comparison bad = sample();
  bad.notes = {"see <b>@everyone</b>"};
  bad.differences = {figure(Change::worse, "<script>|x`\n@someone", "[a](b) #12 **x** <!--", 0, 1)};
  const std::string text = compare_md(bad);
  // Whatever is outside of code spans is ours.
  std::string outside;
  bool inside = false;
  for (const char c : text.substr(text.find("2 runs"))) {
    if (c == '`') inside = !inside;
    if (!inside) outside += c;
  }
  EXPECT_FALSE(inside) << text;
  EXPECT_EQ(outside.find_first_of("<>@[]&"), std::string::npos) << outside;
  EXPECT_EQ(count(outside, "|"), 3U * 7U) << "three rows of six cells";
  EXPECT_THAT(text, HasSubstr("| `<script>¦x' @someone` | `[a](b) #12 **x** <!--` | 0 | 1 | +1 |"));
}

TEST(CompareJson, HoldsEveryDifference) {
  const auto root = nlohmann::json::parse(compare_json(with_rows(500, "run")));
  EXPECT_EQ(root["schema"], "plumbline.compare/1");
  EXPECT_EQ(root["differences"].size(), 500u);
  EXPECT_EQ(root["verdict"], "worse");
  EXPECT_EQ(root["worse"], 500);
  EXPECT_EQ(root["differences"][7]["where"], "run7");
  EXPECT_EQ(root["differences"][7]["old"], 0);
  EXPECT_EQ(root["differences"][7]["new"], 1);
  const auto gate = nlohmann::json::parse(compare_json(sample()))["differences"][0];
  EXPECT_EQ(gate["matter"], "gate");
  EXPECT_EQ(gate["new"], "fails");
}

}  // namespace
}  // namespace plumbline::reports
