// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/toml_reader.h"

#include <string>

#include "support.h"

namespace plumbline {
namespace {

using test::input_error;

TEST(TomlReader, ValuesOfEachType) {
  const TomlTable file =
      parse_toml("b = true\ni = -3\nx = 2.5\ns = 'text'\na = [1, 2.5, 3]\n[t]\nk = 1\n", "f.toml");
  EXPECT_TRUE(file.at("b").boolean());
  EXPECT_EQ(file.at("i").integer_in(-5, 5), -3);
  EXPECT_EQ(file.at("i").number(), -3);
  EXPECT_EQ(file.at("x").number(), 2.5);
  EXPECT_EQ(file.at("s").text(), "text");
  EXPECT_EQ(file.at("a").numbers(3), (std::vector<double>{1, 2.5, 3}));
  EXPECT_EQ(file.at("t").table().at("k").integer_in(0, 9), 1);
  EXPECT_EQ(file.number_or("none", 7), 7);
  EXPECT_FALSE(file.has("none"));
}

TEST(TomlReader, EntriesKeepTheOrderOfTheFile) {
  const TomlTable file = parse_toml("z = 1\na = 2\nm = { y = 1, b = 2 }\n", "f.toml");
  ASSERT_EQ(file.entries().size(), 3u);
  EXPECT_EQ(file.entries()[0].first, "z");
  EXPECT_EQ(file.entries()[1].first, "a");
  EXPECT_EQ(file.entries()[2].second.table().entries()[0].first, "y");
}

TEST(TomlReader, TablesOfAnArray) {
  const TomlTable file = parse_toml("[[t]]\na = 1\n\n[[t]]\na = 2\n", "f.toml");
  const auto tables = file.tables("t");
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[1]->name(), "[[t]]");
  EXPECT_EQ(tables[1]->at("a").line(), 5);
  EXPECT_TRUE(file.tables("none").empty());
}

struct Complaint {
  const char* text;
  void (*read)(const TomlTable&);
  const char* message;
};

TEST(TomlReader, ComplaintsNamePlaceAndMending) {
  const Complaint complaints[] = {
      {"a = 1\nsiez = 3\n",
       [](const TomlTable& t) {
         t.allow_only({"a", "size", "seed"});
       },
       "f.toml:2: unknown key 'siez' in the top level; did you mean 'size'?"},
      {"a = 'x'", [](const TomlTable& t) { (void)t.at("a").number(); },
       "f.toml:1: 'a' in the top level is a string; give a number"},
      {"a = 1.5", [](const TomlTable& t) { (void)t.at("a").integer_in(1, 9); },
       "f.toml:1: 'a' in the top level is a number; give an integer from 1 to 9"},
      {"a = 12", [](const TomlTable& t) { (void)t.at("a").integer_in(1, 9); },
       "f.toml:1: 'a' in the top level is 12; give an integer from 1 to 9"},
      {"a = nan", [](const TomlTable& t) { (void)t.at("a").number(); },
       "f.toml:1: 'a' in the top level is not finite; give a finite number"},
      {"a = 9007199254740993", [](const TomlTable& t) { (void)t.at("a").number(); },
       "f.toml:1: 'a' in the top level is beyond 2^53; give a smaller number"},
      {"a = -1", [](const TomlTable& t) { (void)t.at("a").positive(); },
       "f.toml:1: 'a' in the top level is -1; give a number above 0"},
      {"a = 3", [](const TomlTable& t) { (void)t.at("a").number_in(0, 2.5); },
       "f.toml:1: 'a' in the top level is 3; give a number from 0 to 2.5"},
      {"[x]\n\na = [1,\n2]", [](const TomlTable& t) { (void)t.at("x").table().at("a").numbers(3); },
       "f.toml:3: 'a' in [x] has 2 elements; give 3 numbers"},
      {"a = 1", [](const TomlTable& t) { (void)t.at("a").text(); },
       "f.toml:1: 'a' in the top level is an integer; give a string in quotes"},
      {"a = 1", [](const TomlTable& t) { (void)t.at("a").boolean(); },
       "f.toml:1: 'a' in the top level is an integer; give true or false"},
      {"a = 1", [](const TomlTable& t) { (void)t.at("a").array(); },
       "f.toml:1: 'a' in the top level is an integer; give an array in brackets"},
      {"[[t]]\nb = 1", [](const TomlTable& t) { (void)t.tables("t")[0]->at("id"); },
       "f.toml:1: [[t]] has no 'id'; add one"},
      {"[t]\nb = 1", [](const TomlTable& t) { (void)t.tables("t"); },
       "f.toml:1: 't' in the top level is a single table; write [[t]]"},
  };
  for (const Complaint& complaint : complaints) {
    const TomlTable file = parse_toml(complaint.text, "f.toml");
    EXPECT_EQ(input_error([&] { complaint.read(file); }), complaint.message);
  }
}

TEST(TomlReader, SyntaxErrorsNameTheLine) {
  const std::string message = input_error([] { (void)parse_toml("a = 1\nb = = 2\n", "f.toml"); });
  EXPECT_THAT(message, testing::StartsWith("f.toml:2: not valid TOML: "));
  EXPECT_THAT(input_error([] { (void)parse_toml("a = 1\na = 2\n", "f.toml"); }),
              testing::StartsWith("f.toml:2: not valid TOML: "));
  EXPECT_THAT(input_error([] { (void)parse_toml("d = 2020-01-01\n", "f.toml"); }),
              testing::HasSubstr("is a date or time"));
  EXPECT_THAT(input_error([] { (void)parse_toml(std::string(100'000, '['), "f.toml"); }),
              testing::HasSubstr("deeper than 128"));
  EXPECT_THAT(input_error([] { (void)parse_toml(std::string(100, '['), "f.toml"); }),
              testing::HasSubstr("not valid TOML"));
}

TEST(TomlReader, FilesThatCannotBeRead) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(input_error([&] { (void)read_toml(folder.path() / "none.toml"); }),
              testing::HasSubstr("no such file"));
  EXPECT_THAT(input_error([&] { (void)read_toml(folder.path()); }), testing::HasSubstr("not a regular file"));
  EXPECT_THAT(input_error([&] { (void)read_toml(folder.write("bad.toml", std::string("a = '\xff'\n"))); }),
              testing::HasSubstr("not valid TOML"));
  EXPECT_TRUE(read_toml(folder.write("empty.toml", "")).entries().empty());
}

}  // namespace
}  // namespace plumbline
