// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The fault table beside CGAL: plumbline right in every row, CGAL's cells as measured, the page as printed.
#include "properties/peers/peer_table.h"

#include <cstdlib>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

namespace plumbline::peers {
namespace {

TEST(PeerTable, PlumblineIsRightInEveryRow) {
  const auto verdicts = judge_peers();
  ASSERT_EQ(verdicts.size(), 9u);
  for (const PeerVerdict& verdict : verdicts) {
    EXPECT_TRUE(verdict.plumbline_right) << verdict.fault;
    for (const oracle::Finding& finding : verdict.findings)
      EXPECT_FALSE(finding.triangles.empty() && finding.loop.empty() && finding.vertices.empty());
  }
}

TEST(PeerTable, PageIsWhatTheCommandPrints) {
  const std::string path = PLUMBLINE_SOURCE_DIR "/docs/peers.md", page = peer_table_markdown();
  if (std::getenv("PLUMBLINE_WRITE_GOLDEN") != nullptr) std::ofstream(path, std::ios::binary) << page;
  std::ifstream file(path, std::ios::binary);
  const std::string kept{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(kept, page) << "PLUMBLINE_WRITE_GOLDEN=1 writes it";
}

}  // namespace
}  // namespace plumbline::peers
