// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The prepared TIN in its database: the same frames, bit for bit, and nothing else is taken.
#include <bit>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "algorithms/registry.h"
#include "algorithms/ring_tin/prepared_tin.h"
#include "lattice.h"
#include "scenarios/error.h"
#include "scenarios/random.h"

namespace plumbline::ring_tin {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class Store : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    terrain_.spacing_m = 10;
    terrain_.heights_m[3] = -0.0;  // must come back as it went
    terrain_.heights_m[40] = 0x1.123456789abcdp-7;
    terrain_.roads = {{{12.5, 33}, {100, 110}, {160, 70}}};
  }
  void TearDown() override { fs::remove_all(folder_); }
  [[nodiscard]] std::string error_of_prepare(const Terrain& terrain, const Options& options = {}) const {
    Options all = options;
    all["database"] = file_.string();
    try {
      make_method("ring_tin", all)->prepare(terrain);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_ =
      fs::path(::testing::TempDir()) /
      ("ring_tin_store_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
  fs::path file_ = folder_ / "prepared.sqlite";
  Terrain terrain_ = lattice::rough(21, 17, 3, 9);
};

TEST_F(Store, ReopenedGivesTheSameFramesBitForBit) {
  const Options rings{{"rings_m", std::string("30 60 90")}, {"delta_px", std::string("0 4 9")}};
  Options kept = rings;
  kept["database"] = file_.string();
  const auto afresh = make_method("ring_tin", rings);
  const auto made = make_method("ring_tin", kept);
  const auto opened = make_method("ring_tin", kept);
  afresh->prepare(terrain_);
  made->prepare(terrain_);
  ASSERT_TRUE(fs::exists(file_));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1)
      << "no draft is left";
  const auto written = fs::last_write_time(file_);
  opened->prepare(terrain_);
  EXPECT_EQ(fs::last_write_time(file_), written);
  Random random(5);
  for (int k = 0; k < 20; ++k) {
    const Camera camera =
        make_camera({random.between(0, 200), random.between(0, 160), 150}, {80, 80, 0}, 60, 1280, 720);
    LodFrame a, b, c;
    afresh->update(camera, a);
    made->update(camera, b);
    opened->update(camera, c);
    ASSERT_LT(a.mesh.triangles.size(), 2U * 20 * 16);
    for (const LodFrame* other : {&b, &c}) {
      ASSERT_TRUE(lattice::same_mesh(a, *other));
      for (std::size_t v = 0; v < a.mesh.positions.size(); ++v) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(a.mesh.positions[v].z),
                  std::bit_cast<std::uint64_t>(other->mesh.positions[v].z));
      }
    }
  }
}

TEST_F(Store, KeepsEveryBit) {
  const PlanDomain domain = full_domain(terrain_);
  const PreparedTin prepared(terrain_tin(terrain_, {}), domain);
  store(file_, prepared, 42);
  const PreparedTin opened = open_stored(file_, 42, domain);
  EXPECT_EQ(opened.tin.mesh.triangles, prepared.tin.mesh.triangles);
  EXPECT_EQ(opened.tin.roads, prepared.tin.roads);
  EXPECT_GT(opened.tin.roads.size(), 0U);
  EXPECT_EQ(opened.prices, prepared.prices);
  bool invalid = false;
  for (const double error_m : opened.prices.error_m) invalid = invalid || std::isinf(error_m);
  EXPECT_TRUE(invalid) << "an edge without a valid direction is among them";
  ASSERT_EQ(opened.tin.mesh.positions.size(), prepared.tin.mesh.positions.size());
  for (std::size_t v = 0; v < opened.tin.mesh.positions.size(); ++v) {
    const Vec3 a = opened.tin.mesh.positions[v], b = prepared.tin.mesh.positions[v];
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.x), std::bit_cast<std::uint64_t>(b.x));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.y), std::bit_cast<std::uint64_t>(b.y));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(a.z), std::bit_cast<std::uint64_t>(b.z));
  }
}

TEST_F(Store, RefusesAnotherTerrainOrOtherPoints) {
  ASSERT_EQ(error_of_prepare(terrain_), "");
  EXPECT_EQ(error_of_prepare(terrain_), "");
  Terrain other = terrain_;
  other.heights_m[7] += 1;
  EXPECT_THAT(error_of_prepare(other), HasSubstr("another terrain"));
  other = terrain_;
  other.roads[0][1].x += 1;
  EXPECT_THAT(error_of_prepare(other), HasSubstr("another terrain"));
  EXPECT_THAT(error_of_prepare(terrain_, {{"point_share", 0.5}}), HasSubstr("other points"));
  EXPECT_EQ(error_of_prepare(terrain_, {{"depth_cap", 4.0}}), "") << "the TIN is the same";
}

TEST_F(Store, RefusesWhatIsNoDatabaseOfItsKind) {
  std::ofstream(file_) << "not a database, but long enough to be looked at: " << std::string(2000, 'x');
  const std::string error = error_of_prepare(terrain_);
  EXPECT_THAT(error, HasSubstr("prepared.sqlite"));
  EXPECT_EQ(error.find('\n'), std::string::npos);
  fs::remove(file_);
  std::ofstream(file_).close();  // SQLite takes an empty file for an empty database
  EXPECT_THAT(error_of_prepare(terrain_), HasSubstr("not a database"));
  file_ = folder_ / "nowhere" / "prepared.sqlite";
  EXPECT_THAT(error_of_prepare(terrain_), HasSubstr("folder"));
}

TEST_F(Store, NoticesDamage) {
  ASSERT_EQ(error_of_prepare(terrain_), "");
  std::ifstream in(file_, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(in)), {});
  in.close();
  Random random(6);
  int noticed = 0, harmless = 0;
  for (int k = 0; k < 200; ++k) {
    std::string damaged = whole;
    const std::size_t place = 100 + random.below(whole.size() - 100);
    damaged[place] = static_cast<char>(damaged[place] ^ (1 << random.below(8)));
    if (k % 10 == 0) damaged.resize(place);
    std::ofstream(file_, std::ios::binary | std::ios::trunc) << damaged;
    const std::string error = error_of_prepare(terrain_);
    EXPECT_EQ(error.find('\n'), std::string::npos);
    (error.empty() ? harmless : noticed) += 1;
  }
  // Bits between the cells of a page belong to nothing.
  EXPECT_GT(noticed, 100);
  EXPECT_LT(harmless, 100);
}

}  // namespace
}  // namespace plumbline::ring_tin
