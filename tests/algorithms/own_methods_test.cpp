// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// A user's own methods in the registry. The first look-up closes it for the whole process, so the order of
// these tests matters where they run in one: what is refused, what is entered, what comes too late.
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "algorithms/registry.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

using ::testing::HasSubstr;

class Nothing final : public LodMethod {
 public:
  void prepare(const Terrain&) override {}
  void update(const Camera&, LodFrame& frame) override { frame.clear(); }
  void reset() override {}
  [[nodiscard]] std::unique_ptr<LodMethod> clone() const override { return std::make_unique<Nothing>(); }
};

MethodDescription own(const std::string& id) {
  return {.id = id,
          .title = "nothing",
          .variants = {{"", "", {Promise::idempotent}}, {"other", "", {}}},
          .options = {{"depth", "", 1.0}},
          .make = [](std::string_view, const Options&) { return std::make_unique<Nothing>(); }};
}

std::string refusal(std::vector<MethodDescription> methods) {
  try {
    register_methods(std::move(methods));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string refusal_of(const std::function<void(MethodDescription&)>& spoil) {
  MethodDescription method = own("mine");
  spoil(method);
  return refusal({own("innocent"), method});
}

TEST(OwnMethods, AreRefusedForTheirDescription) {
  using Description = MethodDescription;
  EXPECT_THAT(refusal_of([](Description& m) { m.id = "full"; }), HasSubstr("'full' is taken"));
  EXPECT_THAT(refusal_of([](Description& m) { m.id = "innocent"; }), HasSubstr("'innocent' is taken"));
  for (const char* id : {"", "Mine", "2nd", "a.b", "a:b", "a b", "a/b", "é"})
    EXPECT_THAT(refusal_of([id](Description& m) { m.id = id; }), HasSubstr("is no name")) << id;
  EXPECT_THAT(refusal_of([](Description& m) { m.title = ""; }), HasSubstr("'mine' has no title"));
  EXPECT_THAT(refusal_of([](Description& m) { m.make = nullptr; }), HasSubstr("'mine' has no factory"));
  EXPECT_THAT(refusal_of([](Description& m) { m.variants.clear(); }), HasSubstr("no published variant"));
  EXPECT_THAT(refusal_of([](Description& m) { m.variants[0].name = "a"; }),
              HasSubstr("no published variant"));
  EXPECT_THAT(refusal_of([](Description& m) { m.variants[1].name = ""; }),
              HasSubstr("variant '' is no name"));
  EXPECT_THAT(refusal_of([](Description& m) { m.variants[1].name = "published"; }), HasSubstr("there twice"));
  EXPECT_THAT(refusal_of([](Description& m) { m.options.push_back(m.options[0]); }),
              HasSubstr("option 'depth' is there twice"));
}

TEST(OwnMethods, StandBehindTheBuiltInOnesInTheOrderGiven) {
  register_methods({});
  register_methods({own("zebra"), own("ape")});
  register_methods({own("bee")});
  const std::vector<MethodDescription>& all = registered_methods();
  const std::size_t built_in = built_in_methods().size();
  ASSERT_EQ(all.size(), built_in + 3);  // and none of those refused
  for (std::size_t k = 0; k < built_in; ++k) EXPECT_EQ(all[k].id, built_in_methods()[k].id);
  EXPECT_EQ(all[built_in].id, "zebra");
  EXPECT_EQ(all[built_in + 1].id, "ape");
  EXPECT_EQ(all[built_in + 2].id, "bee");
  EXPECT_TRUE(find_method("ape").promises(Promise::idempotent));
  EXPECT_EQ(find_method("ape:other").variant->name, "other");
  EXPECT_NE(make_method("bee", {{"depth", 2.0}}), nullptr);
  EXPECT_THROW(make_method("bee", {{"dept", 2.0}}), InputError);
}

TEST(OwnMethods, ComeTooLateAfterALookUp) {
  const MethodDescription* full = find_method("full").method;
  const std::size_t before = registered_methods().size();
  EXPECT_THAT(refusal({own("late")}), HasSubstr("'late' comes too late"));
  EXPECT_EQ(registered_methods().size(), before);
  EXPECT_EQ(find_method("full").method, full);
}

}  // namespace
}  // namespace plumbline
