// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Faults planted in the methods: each is found by the law or oracle that should find it, and nothing is found
// without one. The tests are named after the mutants.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "algorithms/mutant.h"
#include "properties/laws/generators.h"
#include "scenarios/error.h"
#include "tests/mutants/hunt.h"

namespace plumbline::mutants {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = PLUMBLINE_SOURCE_DIR;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

class Mutants : public testing::TestWithParam<Mutant> {};

TEST_P(Mutants, IsFound) {
  const Mutant& mutant = GetParam();
  const std::optional<Kill> kill = hunt(mutant);
  ASSERT_TRUE(kill) << "survived: " << mutant.slip;
  EXPECT_EQ(kill->by, mutant.killer) << kill->what;
  EXPECT_FALSE(kill->what.empty());
}

INSTANTIATE_TEST_SUITE_P(All, Mutants, testing::ValuesIn(mutant_list().begin(), mutant_list().end()),
                         [](const auto& test) { return std::string(test.param.name); });

std::set<std::string> hunted_methods() {
  std::set<std::string> methods;
  for (const Mutant& mutant : mutant_list()) methods.insert(std::string(mutant.method));
  return methods;
}

class Unmutated : public testing::TestWithParam<std::string> {};

/// Without a mutant the same battery finds nothing, and every law and oracle has something to judge.
TEST_P(Unmutated, IsClean) {
  ASSERT_EQ(switched_on, 0u);
  EXPECT_THAT(judge_unmutated(GetParam()), testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(All, Unmutated, testing::ValuesIn(hunted_methods()), [](const auto& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), ':', '_');
  return name;
});

/// Every hook in the code is in the list and the other way round, once each; no hook stands in a header.
TEST(MutantList, IsWhatTheCodeHas) {
  const std::regex hook(R"(PLUMBLINE_MUTANT\((\w+)\))");
  std::set<std::string> in_code;
  for (const auto& entry : fs::recursive_directory_iterator(kSource / "algorithms")) {
    const fs::path& path = entry.path();
    if ((path.extension() != ".cpp" && path.extension() != ".h") || path.filename() == "mutant.h") continue;
    const std::string text = text_of(path);
    for (std::sregex_iterator found(text.begin(), text.end(), hook), end; found != end; ++found) {
      EXPECT_EQ(path.extension(), ".cpp")
          << path << ": a hook in a header would be two functions of one name";
      in_code.insert((*found)[1]);
    }
  }
  std::set<std::string> in_list;
  std::set<std::uint64_t> numbers;
  for (const Mutant& mutant : mutant_list()) {
    EXPECT_TRUE(in_list.insert(std::string(mutant.name)).second) << mutant.name << " twice";
    EXPECT_TRUE(numbers.insert(number_of(mutant.name)).second) << mutant.name << " shares its number";
    EXPECT_FALSE(mutant.slip.empty()) << mutant.name;
  }
  EXPECT_EQ(in_code, in_list);
}

TEST(MutantList, SpreadsOverTheFiveMethods) {
  std::map<std::string, std::size_t> by_method;
  for (const Mutant& mutant : mutant_list())
    ++by_method[std::string(mutant.method.substr(0, mutant.method.find(':')))];
  EXPECT_GE(mutant_list().size(), 40u);
  for (const char* method :
       {"haar_quadtree", "ring_tin", "isolated_quadtree", "block_bintree", "vertex_tree"}) {
    EXPECT_GE(by_method[method], 10u) << method;
  }
}

/// The manual's table has the mutants of the list, in its order, with what they stand for and what finds
/// them.
TEST(MutantList, IsTheManualsTable) {
  std::istringstream manual(text_of(kSource / "docs/mutants.md"));
  std::vector<std::string> rows;
  for (std::string line; std::getline(manual, line);) {
    if (line.starts_with("| m") || line.starts_with("| rq_") || line.starts_with("| gt_"))
      rows.push_back(line);
  }
  std::erase_if(rows, [](const std::string& row) { return row.starts_with("| mutant "); });
  ASSERT_EQ(rows.size(), mutant_list().size());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Mutant& mutant = mutant_list()[k];
    EXPECT_THAT(rows[k], testing::StartsWith("| " + std::string(mutant.name) + " | " +
                                             std::string(mutant.method) + " | " + std::string(mutant.slip) +
                                             " | " + std::string(mutant.killer) + " | "));
  }
}

/// A law that a method is known to break finds no mutant; so it must be broken, or the list shuts an eye for
/// nothing.
TEST(KnownToFail, FailsIndeed) {
  for (const auto& [method, law] : all_known_to_fail()) {
    bool violated = false;
    for (std::uint64_t k = 0; k < kCases && !violated; ++k) {
      try {
        violated = judge(properties::find_law(law), properties::draw_case(method, kSeed, k).input).kind ==
                   properties::LawOutcome::Kind::violated;
      } catch (const InputError&) {  // a case that the method does not take
      }
    }
    EXPECT_TRUE(violated) << method << " keeps " << law;
  }
}

}  // namespace
}  // namespace plumbline::mutants
