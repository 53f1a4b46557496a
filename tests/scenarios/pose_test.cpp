// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/pose.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenarios/error.h"

namespace plumbline {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string message(std::string_view text) {
  try {
    parse_pose(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Pose, WhatIsLeftOutHasItsDefault) {
  EXPECT_EQ(parse_pose("1,2,3:4,5,6"), (Pose{{1, 2, 3}, {4, 5, 6}, 60, 1280, 720}));
  EXPECT_EQ(parse_pose("1,2,3:4,5,6:45"), (Pose{{1, 2, 3}, {4, 5, 6}, 45, 1280, 720}));
  EXPECT_EQ(parse_pose("-1.5,+2,3e2:4,5,-6:0.5:640x480"), (Pose{{-1.5, 2, 300}, {4, 5, -6}, 0.5, 640, 480}));
}

TEST(Pose, PrintsAndReadsBackToTheSameBits) {
  const Pose pose{{0.1, -1e-300, 123456789.125}, {1e17, 2.0 / 3, -0.25}, 33.3, 1, 16384};
  EXPECT_EQ(parse_pose(pose_text(pose)), pose);
}

TEST(Pose, RefusalNamesTheWrongPart) {
  EXPECT_THAT(message(""), HasSubstr("1 part instead of 2 to 4"));
  EXPECT_THAT(message("1,2,3"), HasSubstr("1 part instead of 2 to 4"));
  EXPECT_THAT(message("1,2,3:4,5,6:60:1x1:"), HasSubstr("5 parts"));
  EXPECT_THAT(message("1,2:4,5,6"), HasSubstr("position '1,2' is not three numbers"));
  EXPECT_THAT(message("1,2,3:4,5,6,7"), HasSubstr("look-at '4,5,6,7'"));
  EXPECT_THAT(message("1,2,3:4,,6"), HasSubstr("look-at '' is no number"));
  EXPECT_THAT(message("1,2,3m:4,5,6"), HasSubstr("'3m' is no number"));
  EXPECT_THAT(message("1,2,+-3:4,5,6"), HasSubstr("'+-3' is no number"));
  EXPECT_THAT(message("1,2,1e400:4,5,6"), HasSubstr("'1e400'"));
  EXPECT_THAT(message("1,2,3:4,5,6:wide"), HasSubstr("field of view 'wide'"));
  EXPECT_THAT(message("1,2,3:4,5,6:60:640"), HasSubstr("viewport '640' is not WxH"));
  EXPECT_THAT(message("1,2,3:4,5,6:60:640x4.5"), HasSubstr("height '4.5'"));
}

TEST(Pose, RefusesWhatIsNoCamera) {
  EXPECT_THAT(message("1,2,nan:4,5,6"), AllOf(HasSubstr("1,2,nan"), HasSubstr("finite")));
  EXPECT_THAT(message("1,2,3:1,2,3"), HasSubstr("coincide"));
  EXPECT_THAT(message("1,2,3:4,5,6:180"), HasSubstr("(0, 180)"));
  EXPECT_THAT(message("1,2,3:4,5,6:60:0x720"), HasSubstr("[1, 16384]"));
  EXPECT_THAT(message("1,2,3\n:1,2,3"), Not(HasSubstr("\n")));
}

}  // namespace
}  // namespace plumbline
