// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/gate_figures.h"

#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "properties/verdict/verdict.h"

namespace plumbline {
namespace {

// Suites are checked against names alone, since scenarios know no verdict; the two lists must not drift
// apart.
TEST(GateFigures, AreTheFiguresOfARun) {
  std::vector<std::string_view> paths;
  for (const verdict::Figure& figure : verdict::figures()) paths.push_back(figure.path);
  EXPECT_EQ(std::vector<std::string_view>(kGateFigures.begin(), kGateFigures.end()), paths);
}

}  // namespace
}  // namespace plumbline
