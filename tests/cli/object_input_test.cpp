// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes that cannot be flown around: one line, exit status 2.
#include <algorithm>
#include <string>

#include <gmock/gmock.h>

#include "tests/cli/program.h"

namespace plumbline::testing_cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class ObjectInput : public ProgramTest {
 protected:
  void expect_refused(const std::string& off, const ::testing::Matcher<std::string>& message) {
    if (!off.empty()) put("m.off", off);
    put("s.toml",
        "[suite]\nname = \"o\"\nviewport = [64, 48]\n[[mesh]]\nid = \"m\"\nfile = \"m.off\"\n"
        "[[trajectory]]\nid = \"r\"\nkind = \"orbit\"\nframes = 2\n"
        "[[method]]\nid = \"vertex_tree\"\nthresholds_px = [1]\n");
    const Outcome outcome = run({"run", "s.toml", "--out", "out"});
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_THAT(outcome.err, message);
  }
};

TEST_F(ObjectInput, AMissingFileIsNamed) {
  expect_refused("", AllOf(HasSubstr("mesh 'm'"), HasSubstr("m.off")));
}

TEST_F(ObjectInput, TheFirstEdgeThatIsNotManifoldIsNamed) {
  expect_refused("OFF\n5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 -1 0\n3 0 1 2\n3 1 0 3\n3 0 1 4\n",
                 AllOf(HasSubstr("mesh 'm'"), HasSubstr("not manifold"),
                       HasSubstr("edge 0-1 from (0, 0, 0) to (1, 0, 0)")));
}

TEST_F(ObjectInput, ABrokenFileIsRefused) {
  expect_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n", AllOf(HasSubstr("mesh 'm'"), HasSubstr("m.off")));
}

}  // namespace
}  // namespace plumbline::testing_cli
