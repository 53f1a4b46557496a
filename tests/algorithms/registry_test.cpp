// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The registry, and what every method in it must keep, whoever wrote it.
#include "algorithms/registry.h"

#include <filesystem>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lattice.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

using ::testing::HasSubstr;

template <class Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::vector<std::string> all_ids() {
  std::vector<std::string> out;
  for (const MethodDescription& method : registered_methods()) {
    for (const VariantDescription& variant : method.variants) {
      out.push_back(variant.name.empty() ? method.id : method.id + ":" + variant.name);
    }
  }
  return out;
}

class EveryMethod : public ::testing::TestWithParam<std::string> {
 protected:
  EveryMethod() : terrain_(lattice::rough(33, 33, 4, 12)) {}
  [[nodiscard]] bool promises(Promise promise) const { return find_method(GetParam()).promises(promise); }
  Terrain terrain_;
};

std::vector<std::string> ids_that_promise(Promise promise) {
  std::vector<std::string> out = all_ids();
  std::erase_if(out, [promise](const std::string& id) { return !find_method(id).promises(promise); });
  return out;
}

std::string test_name(const ::testing::TestParamInfo<std::string>& param) {
  std::string name = param.param;
  std::replace(name.begin(), name.end(), ':', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryMethod, ::testing::ValuesIn(all_ids()), test_name);

class EveryIdempotentMethod : public EveryMethod {};
INSTANTIATE_TEST_SUITE_P(Registry, EveryIdempotentMethod,
                         ::testing::ValuesIn(ids_that_promise(Promise::idempotent)), test_name);

TEST_P(EveryMethod, IsFoundByItsId) {
  const MethodChoice choice = find_method(GetParam());
  EXPECT_TRUE(GetParam().starts_with(choice.method->id));
  EXPECT_NE(make_method(GetParam()), nullptr);
}

TEST_P(EveryMethod, IsDescribed) {
  const MethodChoice choice = find_method(GetParam());
  EXPECT_FALSE(choice.method->title.empty());
  EXPECT_FALSE(choice.method->citation.empty());
  EXPECT_FALSE(choice.method->section.empty());
  EXPECT_FALSE(choice.variant->summary.empty());
  EXPECT_FALSE(choice.variant->promises.empty());
  EXPECT_EQ(choice.method->variants.front().name, "") << "the published default comes first";
  const std::filesystem::path readme =
      std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "algorithms" / choice.method->id / "README.md";
  ASSERT_TRUE(std::filesystem::exists(readme)) << readme;
  EXPECT_GT(std::filesystem::file_size(readme), 500U) << readme << " says too little";
  for (const OptionDescription& option : choice.method->options)
    EXPECT_FALSE(option.summary.empty()) << option.name;
}

TEST_P(EveryMethod, RefusesUnknownOptions) {
  EXPECT_THAT(error_of([] {
                (void)make_method(GetParam(), {{"no_such_option", 1.0}});
              }),
              HasSubstr("no_such_option"));
}

TEST_P(EveryMethod, OverwritesTheFrameWhole) {
  const auto method = make_method(GetParam());
  method->prepare(terrain_);
  Random random(1);
  const Camera first = lattice::any_camera(random, terrain_), second = lattice::any_camera(random, terrain_);
  LodFrame reused, fresh;
  method->update(first, reused);
  method->reset();
  method->update(second, reused);
  method->reset();
  method->update(second, fresh);
  EXPECT_TRUE(lattice::same_mesh(reused, fresh));
  EXPECT_EQ(fresh.vertex_keys.size(), fresh.mesh.positions.size());
  EXPECT_EQ(std::set<std::uint64_t>(fresh.vertex_keys.begin(), fresh.vertex_keys.end()).size(),
            fresh.vertex_keys.size());
}

TEST_P(EveryIdempotentMethod, ChangesNothingWhenAskedAgain) {
  const auto method = make_method(GetParam());
  method->prepare(terrain_);
  Random random(2);
  for (int k = 0; k < 10; ++k) {
    const Camera camera = lattice::any_camera(random, terrain_);
    LodFrame once, twice;
    method->update(camera, once);
    method->update(camera, twice);
    EXPECT_TRUE(lattice::same_mesh(once, twice));
  }
}

TEST_P(EveryMethod, CloneAndResetForgetTheFlight) {
  const auto method = make_method(GetParam());
  method->prepare(terrain_);
  method->set_threshold_px(3);
  Random random(3);
  std::vector<Camera> flight;
  for (int k = 0; k < 6; ++k) flight.push_back(lattice::any_camera(random, terrain_));
  LodFrame flown, cloned, after_reset, untouched;
  const auto bystander = method->clone();
  for (const Camera& camera : flight) method->update(camera, flown);
  const auto clone = method->clone();
  EXPECT_EQ(clone->threshold_px(), 3);
  clone->update(flight.back(), cloned);
  bystander->update(flight.back(), untouched);
  EXPECT_TRUE(lattice::same_mesh(cloned, untouched)) << "a clone is as after reset";
  method->reset();
  method->update(flight.back(), after_reset);
  EXPECT_TRUE(lattice::same_mesh(after_reset, cloned));
  if (promises(Promise::path_independent)) {
    EXPECT_TRUE(lattice::same_mesh(flown, cloned));
  }
}

TEST_P(EveryMethod, ACloneOutlivesItsOriginal) {
  auto method = make_method(GetParam());
  method->prepare(terrain_);
  const auto clone = method->clone();
  Random random(4);
  const Camera camera = lattice::any_camera(random, terrain_);
  LodFrame before, after;
  method->update(camera, before);
  method.reset();
  clone->update(camera, after);
  EXPECT_TRUE(lattice::same_mesh(before, after));
}

TEST_P(EveryMethod, IgnoresTheThresholdExactlyIfPromised) {
  Terrain wide = terrain_;
  wide.spacing_m = 100;  // ring_tin leaves what is within 100 m of the viewer as it is
  const auto method = make_method(GetParam());
  method->prepare(wide);
  Random random(5);
  const double far_m = 5 * wide.width_m();
  bool blind = true;
  // vertex_tree draws all of an object in whose ball the viewer stands: so once from outside, too.
  for (const Camera& camera : {lattice::any_camera(random, wide),
                               make_camera({-far_m, 0, far_m}, {0, 0, wide.lowest_m()}, 60, 640, 480)}) {
    LodFrame fine, coarse;
    method->reset();
    method->set_threshold_px(1e-3);
    method->update(camera, fine);
    method->set_threshold_px(1e3);
    method->update(camera, coarse);
    blind = blind && lattice::same_mesh(fine, coarse);
  }
  EXPECT_EQ(blind, promises(Promise::threshold_blind));
}

TEST_P(EveryMethod, TakesOrRefusesOddSizes) {
  for (const auto& [columns, rows] :
       {std::pair{2, 2}, std::pair{3, 3}, std::pair{4, 7}, std::pair{5, 9}, std::pair{40, 31}}) {
    const Terrain terrain = lattice::rough(columns, rows, 6, 2);
    const auto method = make_method(GetParam());
    const std::string error = error_of([&] { method->prepare(terrain); });
    if (!error.empty()) {
      EXPECT_THAT(error, HasSubstr("samples"));
      EXPECT_EQ(error.find('\n'), std::string::npos);
      continue;
    }
    LodFrame frame;
    method->update(make_camera({1, 1, 50}, {1, 1, 0}, 90, 640, 480), frame);
    EXPECT_FALSE(frame.domain.loops.empty()) << columns << " x " << rows;
    // What does not promise to cover its domain may draw nothing there (a lone vertex has no triangle).
    if (!promises(Promise::covers_domain)) continue;
    EXPECT_FALSE(frame.mesh.triangles.empty()) << columns << " x " << rows;
  }
}

TEST(Registry, IdsAreUnique) {
  const std::vector<std::string> ids = all_ids();
  EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), ids.size());
  EXPECT_GE(registered_methods().size(), 3U);
}

TEST(Registry, PublishedNamesTheDefault) {
  EXPECT_EQ(find_method("block_bintree:published").variant, find_method("block_bintree").variant);
  EXPECT_EQ(find_method("block_bintree:tri_cull").variant->name, "tri_cull");
}

TEST(Registry, NamesTheNearest) {
  EXPECT_THAT(error_of([] { find_method("blok_bintree"); }), HasSubstr("block_bintree"));
  EXPECT_THAT(error_of([] { find_method("block_bintree:tricull"); }), HasSubstr("tri_cull"));
  EXPECT_THAT(error_of([] { find_method("block_bintree:"); }), HasSubstr("variant"));
  EXPECT_THAT(error_of([] { find_method(""); }), HasSubstr("unknown method"));
  EXPECT_THAT(error_of([] {
                (void)make_method("block_bintree", {{"block_sise", 9.0}});
              }),
              HasSubstr("block_size"));
  EXPECT_THAT(error_of([] { (void)make_method("full", {{"cull", true}}); }), HasSubstr("takes no options"));
}

TEST(Registry, ChecksOptionTypes) {
  EXPECT_THAT(error_of([] {
                (void)make_method("block_bintree", {{"cull", 1.0}});
              }),
              HasSubstr("true or false"));
  EXPECT_THAT(error_of([] {
                (void)make_method("block_bintree", {{"block_size", std::string("65")}});
              }),
              HasSubstr("give a number"));
}

TEST(Registry, EveryPromiseHasAName) {
  using enum Promise;
  std::set<std::string_view> names;
  for (const Promise p :
       {conforming, covers_domain, monotone_in_tau, idempotent, path_independent, exact_at_zero, symmetric,
        threshold_blind, screen_error_within_tau, continuous_in_camera}) {
    names.insert(promise_name(p));
  }
  EXPECT_EQ(names.size(), 10U);
  EXPECT_FALSE(names.contains("unknown"));
}

}  // namespace
}  // namespace plumbline
