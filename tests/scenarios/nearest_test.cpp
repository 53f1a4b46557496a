// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/nearest.h"

#include <string>

#include <gtest/gtest.h>

#include "scenarios/error.h"

namespace plumbline {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsAndReplacements) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("crack", "crack"), 0u);
  EXPECT_EQ(edit_distance("crak", "crack"), 1u);
  EXPECT_EQ(edit_distance("crack", "cracks"), 1u);
  EXPECT_EQ(edit_distance("track", "crack"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
}

TEST(EditDistance, LongNamesAreCut) { EXPECT_EQ(edit_distance(std::string(10'000'000, 'x'), "x"), 63u); }

TEST(NearestName, FirstOfEqualsWins) {
  EXPECT_EQ(nearest_name("tile", {"file", "mile", "generator"}), "file");
  EXPECT_EQ(nearest_name("tile", {}), "");
}

TEST(UnknownName, StaysOnOneLine) {
  EXPECT_EQ(unknown_name("kind", "or\nbit", {"skim", "orbit"}),
            "unknown kind 'or bit'; did you mean 'orbit'?");
  EXPECT_EQ(unknown_name("kind", "x", {}), "unknown kind 'x'");
}

TEST(OneLine, BlanksControlCharactersAndLength) {
  EXPECT_EQ(one_line("  a\t\r\nb\x01 c \n"), "a b c");
  EXPECT_EQ(one_line(std::string(20, 'y'), 8), "yyyyyyyy...");
  EXPECT_EQ(one_line("h\xc3\xb6he", 2), "h...") << "must not cut a UTF-8 character in two";
}

}  // namespace
}  // namespace plumbline
