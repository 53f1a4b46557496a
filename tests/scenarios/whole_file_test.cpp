// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/whole_file.h"

#include <filesystem>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/scenarios/support.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;
using test::input_error;
using ::testing::HasSubstr;

TEST(WholeFile, TakesThePlaceOfWhatWasThere) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "deep/er/a.json";
  write_whole_file(file, "one");
  write_whole_file(file, "two");
  EXPECT_EQ(read_whole_file(file, "a text"), "two");
  EXPECT_EQ(std::distance(fs::directory_iterator(file.parent_path()), {}), 1) << "nothing is left beside it";
}

// A rename would make a file of it; of /dev/null, too, where the user is root.
TEST(WholeFile, GoesThroughAPipe) {
  const test::TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string read;
  std::thread reader([&] { read = read_whole_file(pipe, "a text"); });
  write_whole_file(pipe, "through");
  reader.join();
  EXPECT_EQ(read, "through");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(WholeFile, KeepsALinkALink) {
  const test::TemporaryFolder folder;
  write_whole_file(folder.path() / "kept/real.json", "old");
  fs::create_symlink("kept/real.json", folder.path() / "latest.json");
  write_whole_file(folder.path() / "latest.json", "new");
  EXPECT_TRUE(fs::is_symlink(folder.path() / "latest.json"));
  EXPECT_EQ(read_whole_file(folder.path() / "kept/real.json", "a text"), "new");
}

TEST(WholeFile, IsAskedForBeforeTheWork) {
  const test::TemporaryFolder folder;
  require_writable_file(folder.path() / "new/a.json");
  EXPECT_FALSE(fs::exists(folder.path() / "new")) << "asking leaves nothing";
  require_writable_file("/dev/null");
  EXPECT_THAT(input_error([&] { require_writable_file(folder.path()); }), HasSubstr("it is a folder"));
  EXPECT_THAT(input_error([] { require_writable_file("/proc/none/a.json"); }), HasSubstr("cannot write"));
}

}  // namespace
}  // namespace plumbline
