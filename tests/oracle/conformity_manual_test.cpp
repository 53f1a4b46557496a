// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Code, manual and reports share one list of findings.
#include <fstream>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "oracle/finding.h"

namespace plumbline::oracle {
namespace {

TEST(FindingsManual, IsTheCatalogue) {
  std::ifstream file(PLUMBLINE_SOURCE_DIR "/docs/findings.md");
  std::stringstream text;
  text << file.rdbuf();
  if (file && text.str() == findings_manual()) return;
  // The page to put there, so that nobody has to write it by hand.
  const std::string fresh = testing::TempDir() + "findings.md";
  std::ofstream(fresh) << findings_manual();
  FAIL() << "docs/findings.md is not the catalogue's page; that one is " << fresh;
}

TEST(FindingsManual, CodesAscendAndNamesAreDistinct) {
  std::set<std::string_view> names;
  int last = 0;
  for (const FindingDescription& entry : finding_catalogue()) {
    EXPECT_GT(static_cast<int>(entry.code), last) << entry.name;
    last = static_cast<int>(entry.code);
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_EQ(finding_name(entry.code), entry.name);
    EXPECT_FALSE(entry.definition.empty());
  }
}

}  // namespace
}  // namespace plumbline::oracle
