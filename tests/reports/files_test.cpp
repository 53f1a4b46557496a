// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "reports/escape.h"
#include "reports/report.h"
#include "scenarios/error.h"
#include "tests/reports/sample_verdict.h"

namespace plumbline::reports {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class ReportFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              fmt::format("plumbline_{}_{}", testing::UnitTest::GetInstance()->current_test_info()->name(),
                          getpid());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static std::string read(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    EXPECT_TRUE(file) << path;
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static std::set<std::string> files_below(const fs::path& folder) {
    std::set<std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (entry.is_regular_file()) out.insert(fs::relative(entry.path(), folder).generic_string());
    return out;
  }

  const verdict::SuiteVerdict verdict_ = sample::suite_verdict({{"canyon"}, {"orbit"}, 4});
  const verdict::SuiteTiming timing_ = sample::suite_timing(verdict_);
  const std::vector<verdict::FramePictures> pictures_{
      sample::frame_pictures("canyon.orbit.block_bintree.2", 2, 96, 54)};
  fs::path folder_;
};

TEST_F(ReportFiles, AllOfThemAndNothingElse) {
  write_reports(verdict_, timing_, pictures_, folder_ / "new" / "out");
  EXPECT_THAT(
      files_below(folder_ / "new" / "out"),
      testing::ElementsAre("images/canyon.orbit.block_bintree.2.error.png",
                           "images/canyon.orbit.block_bintree.2.mesh.png",
                           "images/canyon.orbit.block_bintree.2.reference.png", "junit.xml", "report.html",
                           "results.csv", "results.json", "summary.md", "timing.json"));
  EXPECT_EQ(read(folder_ / "new/out/results.json"), results_json(verdict_));
  EXPECT_EQ(read(folder_ / "new/out/junit.xml"), junit_xml(verdict_));
}

TEST_F(ReportFiles, OldReportIsReplacedAndOtherFilesStay) {
  std::ofstream(folder_ / "results.json") << "old";
  std::ofstream(folder_ / "notes.txt") << "mine";
  write_reports(verdict_, timing_, {}, folder_);
  EXPECT_EQ(read(folder_ / "results.json"), results_json(verdict_));
  EXPECT_EQ(read(folder_ / "notes.txt"), "mine");
}

TEST_F(ReportFiles, FolderThatCannotBeMadeIsRefusedInOneLine) {
  std::ofstream(folder_ / "file") << "in the way";
  try {
    write_reports(verdict_, timing_, pictures_, folder_ / "file" / "out");
    FAIL() << "wrote below a file";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cannot write"));
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
  }
  EXPECT_THAT(files_below(folder_), testing::ElementsAre("file"));
  EXPECT_EQ(read(folder_ / "file"), "in the way");
}

TEST_F(ReportFiles, FileThatCannotBeReplacedLeavesNoPart) {
  fs::create_directories(folder_ / "timing.json" / "a folder in the way");
  EXPECT_THROW(write_reports(verdict_, timing_, pictures_, folder_), InputError);
  EXPECT_THAT(files_below(folder_), testing::ElementsAre("results.json")) << "whole, or not at all";
  EXPECT_EQ(read(folder_ / "results.json"), results_json(verdict_));
}

std::string between(const std::string& text, const std::string& open, const std::string& close) {
  const std::size_t from = text.find(open);
  if (from == std::string::npos) return {};
  const std::size_t start = from + open.size();
  return text.substr(start, text.find(close, start) - start);
}

TEST_F(ReportFiles, PageHoldsTheSameResults) {
  const std::string page = report_html(verdict_, timing_, pictures_, "plumbline run default.toml");
  const std::string results = between(page, "<script type=\"application/json\" id=\"results\">", "</script>");
  EXPECT_EQ(nlohmann::json::parse(results), nlohmann::json::parse(results_json(verdict_)));
  const std::string facts = between(page, "<script type=\"application/json\" id=\"facts\">", "</script>");
  const nlohmann::json read = nlohmann::json::parse(facts);
  EXPECT_EQ(read["command"], "plumbline run default.toml");
  EXPECT_EQ(read["pictures"].size(), 1u);
  EXPECT_THAT(read["pictures"][0]["error"].get<std::string>(),
              testing::StartsWith("data:image/png;base64,iVBOR"));
  EXPECT_EQ(read["catalogue"].size(), oracle::finding_catalogue().size());
}

TEST_F(ReportFiles, PageFetchesNothing) {
  const std::string page = report_html(verdict_, timing_, pictures_, "");
  EXPECT_THAT(page, HasSubstr("Content-Security-Policy\" content=\"default-src 'none'"));
  // No element loads from elsewhere, and no style or script asks for more. Names of XML namespaces are not
  // fetched.
  for (const char* pattern : {"<script[^>]*\\ssrc=", "<link\\b", "<iframe", "<img[^>]*src=[\"']?http",
                              "@import", "url\\(\\s*[\"']?https?:", "\\bfetch\\(\\s*[\"'`]http",
                              "XMLHttpRequest", "sendBeacon", "new WebSocket", "sourceMappingURL"})
    EXPECT_FALSE(std::regex_search(page, std::regex(pattern))) << pattern;
}

TEST_F(ReportFiles, NamesCannotBreakOutOfThePage) {
  verdict::SuiteVerdict verdict = verdict_;
  verdict.suite = "</script><script>alert(1)</script><!--data:results-->";
  verdict.gates[0].name = "<!-- </SCRIPT";
  const std::string page = report_html(verdict, timing_, {}, "</script>");
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("</SCRIPT")));
  const std::string results = between(page, "<script type=\"application/json\" id=\"results\">", "</script>");
  EXPECT_EQ(nlohmann::json::parse(results)["suite"], verdict.suite);
  EXPECT_EQ(nlohmann::json::parse(results)["gates"][0]["name"], verdict.gates[0].name);
}

TEST_F(ReportFiles, PageStaysSmall) {
  // The budget of the page itself, without data and pictures: charts included, below 1.2 MB.
  EXPECT_LT(report_html({}, {}, {}, "").size(), 1200000u);
}

}  // namespace
}  // namespace plumbline::reports
