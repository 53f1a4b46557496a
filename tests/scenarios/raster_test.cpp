// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Rasters through GDAL: real ones, and small ones written here as a VRT over raw samples.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <cpl_vsi.h>
#include <fmt/format.h>

#include "scenarios/portable_math.h"
#include "scenarios/terrain_source.h"
#include "support.h"

namespace plumbline {
namespace {

using test::input_error;
using testing::HasSubstr;
using testing::StartsWith;

const std::filesystem::path kSource = PLUMBLINE_SOURCE_DIR;
const std::filesystem::path kJacksboro = kSource / "scenarios/assets/jacksboro.vrt";
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

// A VRT over raw 32-bit floats; `rows` in the file's order.
struct RawRaster {
  int columns = 0, rows = 0;
  std::vector<float> samples;
  std::string transform = "0, 10, 0, 0, 0, -10";
  std::string reference = {};  // <SRS>
  std::string band = {};       // more elements of the band
  std::string type = "Float32";
  std::string dataset = {};  // more elements of the data set

  [[nodiscard]] std::filesystem::path write(const test::TemporaryFolder& folder,
                                            const std::string& name) const {
    std::string bytes(samples.size() * sizeof(float), '\0');
    if (!samples.empty()) std::memcpy(bytes.data(), samples.data(), bytes.size());
    folder.write(name + ".raw", bytes);
    std::string xml = fmt::format("<VRTDataset rasterXSize=\"{}\" rasterYSize=\"{}\">\n", columns, rows);
    if (!reference.empty()) xml += fmt::format("<SRS>{}</SRS>", reference);
    if (!transform.empty()) xml += fmt::format("<GeoTransform>{}</GeoTransform>", transform);
    xml += fmt::format(
        "<VRTRasterBand dataType=\"{}\" band=\"1\" subClass=\"VRTRawRasterBand\">{}"
        "<SourceFilename relativetoVRT=\"1\">{}.raw</SourceFilename><ImageOffset>0</ImageOffset>"
        "<PixelOffset>4</PixelOffset><LineOffset>{}</LineOffset><ByteOrder>LSB</ByteOrder></VRTRasterBand>{}"
        "</VRTDataset>\n",
        type, band, name, std::int64_t{4} * columns, dataset);
    return folder.write(name + ".vrt", xml);
  }
};

RawRaster counting(int columns, int rows) {
  RawRaster raster{columns, rows, {}};
  for (int k = 0; k < columns * rows; ++k) raster.samples.push_back(static_cast<float>(k));
  return raster;
}

TerrainSource from_file(const std::filesystem::path& path) {
  TerrainSource source;
  source.id = "t";
  source.file = path;
  return source;
}

class Raster : public testing::Test {
 protected:
  Terrain load(const RawRaster& raster) { return load_terrain(from_file(raster.write(folder_, "r"))); }
  template <class Change>
  Terrain load(const RawRaster& raster, Change change) {
    TerrainSource source = from_file(raster.write(folder_, "r"));
    change(source);
    return load_terrain(source);
  }
  std::string error(const RawRaster& raster) {
    return input_error([&] { (void)load(raster); });
  }
  test::TemporaryFolder folder_;
};

// --- the real terrain ------------------------------------------------------------------------------------

// The samples by a second route: the bytes of the array in the zip, without any raster driver.
std::vector<int> jacksboro_samples() {
  const char* name =
      "/vsizip/{/usr/share/matplotlib/mpl-data/sample_data/jacksboro_fault_dem.npz}/elevation.npy";
  VSILFILE* file = VSIFOpenL(name, "rb");
  if (file == nullptr) return {};
  std::vector<unsigned char> bytes(80 + 2 * 403 * 344);
  const std::size_t read = VSIFReadL(bytes.data(), 1, bytes.size(), file);
  VSIFCloseL(file);
  if (read != bytes.size()) return {};
  std::vector<int> samples;
  for (std::size_t k = 80; k < bytes.size(); k += 2) {
    samples.push_back(static_cast<std::int16_t>(static_cast<std::uint16_t>(bytes[k] | bytes[k + 1] << 8)));
  }
  return samples;
}

TEST(Jacksboro, SamplesAreThoseOfTheArray) {
  const std::vector<int> samples = jacksboro_samples();
  ASSERT_EQ(samples.size(), 403u * 344u) << "install python-matplotlib-data";
  EXPECT_EQ(*std::min_element(samples.begin(), samples.end()), 236);
  EXPECT_EQ(*std::max_element(samples.begin(), samples.end()), 1076);
  // Without its georeference the raster is read sample by sample.
  test::TemporaryFolder folder;
  std::ifstream asset(kJacksboro);
  std::string xml((std::istreambuf_iterator<char>(asset)), std::istreambuf_iterator<char>());
  for (const char* element : {"SRS", "GeoTransform"}) {
    const std::size_t begin = xml.find(fmt::format("<{}>", element));
    const std::string end = fmt::format("</{}>", element);
    ASSERT_NE(begin, std::string::npos);
    xml.erase(begin, xml.find(end) + end.size() - begin);
  }
  const Terrain terrain = load_terrain(from_file(folder.write("bare.vrt", xml)));
  ASSERT_EQ(terrain.columns, 403);
  ASSERT_EQ(terrain.rows, 344);
  EXPECT_EQ(terrain.z(0, 343), 483);    // north-west: the array's first
  EXPECT_EQ(terrain.z(402, 343), 444);  // north-east
  EXPECT_EQ(terrain.z(0, 0), 545);      // south-west
  EXPECT_EQ(terrain.z(402, 0), 272);    // south-east
  for (int j = 0; j < 344; ++j) {
    for (int i = 0; i < 403; ++i) {
      ASSERT_EQ(terrain.z(i, j), samples[static_cast<std::size_t>((343 - j) * 403 + i)]) << i << " " << j;
    }
  }
}

TEST(Jacksboro, ReprojectedToMetres) {
  const std::vector<int> samples = jacksboro_samples();
  ASSERT_FALSE(samples.empty());
  const Terrain terrain = load_terrain(from_file(kJacksboro));
  // 3" are 74.5 m along the parallel and 92.5 m along the meridian at 36.59° N.
  EXPECT_NEAR(terrain.spacing_m, (74.53 + 92.47) / 2, 0.1);
  EXPECT_NEAR(terrain.width_m(), 402 * 74.53, 0.005 * 402 * 74.53);
  EXPECT_NEAR(terrain.depth_m(), 343 * 92.47, 0.005 * 343 * 92.47);
  EXPECT_GE(terrain.lowest_m(), 236);
  EXPECT_LE(terrain.highest_m(), 1076);
  EXPECT_GT(terrain.highest_m(), 1060);
  // The middle of the raster lies between columns 201 and 202 of 403: on column 201, between rows 171 and
  // 172.
  const double middle_m = terrain.surface_height_m(terrain.width_m() / 2, terrain.depth_m() / 2);
  const double expected_m = 0.5 * (samples[171 * 403 + 201] + samples[172 * 403 + 201]);
  EXPECT_NEAR(middle_m, expected_m, 15) << "within the relief of one spacing";
}

TEST(Jacksboro, SameBitsWithEveryCompilerAndBuild) {
  TerrainSource source = from_file(kJacksboro);
  test::BitHash native;
  native.add(load_terrain(source).heights_m);
  EXPECT_EQ(native.value(), 0x73d76c7e85840a6u) << std::hex << native.value();
  source.size = 513;
  test::BitHash resampled;
  resampled.add(load_terrain(source).heights_m);
  EXPECT_EQ(resampled.value(), 0x27964e07ea5f06eau) << std::hex << resampled.value();
}

TEST(Jacksboro, CropKeepsTheMiddleAtNativeSpacing) {
  TerrainSource source = from_file(kJacksboro);
  const Terrain whole = load_terrain(source);
  source.size = 257;
  source.fit = FitRule::crop;
  const Terrain cropped = load_terrain(source);
  ASSERT_EQ(cropped.columns, 257);
  EXPECT_NEAR(cropped.spacing_m, whole.spacing_m, 1e-9 * whole.spacing_m);
  source.size = 400;
  EXPECT_THAT(input_error([&] { (void)load_terrain(source); }), HasSubstr("make size less"));
}

// A USGS DEM with a collar without data, beside the checkout or where PLUMBLINE_SHARED_DATA says.
TEST(SaintHelens, CollarIsCroppedOrFilledNeverSilent) {
  const char* folder = std::getenv("PLUMBLINE_SHARED_DATA");
  const std::filesystem::path path =
      (folder != nullptr ? std::filesystem::path(folder) : kSource / "../shared/data") / "SainteHelens.dem";
  if (!std::filesystem::exists(path))
    GTEST_SKIP() << "needs ../shared/data/SainteHelens.dem (or set PLUMBLINE_SHARED_DATA)";
  TerrainSource source = from_file(path);
  EXPECT_THAT(input_error([&] { (void)load_terrain(source); }), HasSubstr("samples hold no data"));
  source.holes = HolePolicy::crop;
  const Terrain cropped = load_terrain(source);
  EXPECT_EQ(cropped.spacing_m, 30);
  EXPECT_EQ(cropped.columns, 317);
  EXPECT_EQ(cropped.rows, 460);
  EXPECT_GE(cropped.lowest_m(), 682);  // the header's least and greatest height
  EXPECT_EQ(cropped.highest_m(), 2543);
  source.holes = HolePolicy::fill;
  const Terrain filled = load_terrain(source);
  EXPECT_EQ(filled.columns, 327);
  EXPECT_EQ(filled.rows, 468);
  EXPECT_EQ(filled.lowest_m(), 682);
  EXPECT_EQ(filled.highest_m(), 2543);
}

// --- orientation, units, values --------------------------------------------------------------------------

TEST_F(Raster, NorthUpRowsAreTurned) {
  const Terrain terrain = load(counting(3, 2));
  EXPECT_EQ(terrain.spacing_m, 10);
  EXPECT_EQ(terrain.heights_m, (std::vector<double>{3, 4, 5, 0, 1, 2}));
}

TEST_F(Raster, SouthUpAndEastFirst) {
  RawRaster raster = counting(3, 2);
  raster.transform = "0, 10, 0, 0, 0, 10";
  EXPECT_EQ(load(raster).heights_m, (std::vector<double>{0, 1, 2, 3, 4, 5}));
  raster.transform = "0, -10, 0, 0, 0, -10";
  EXPECT_EQ(load(raster).heights_m, (std::vector<double>{5, 4, 3, 2, 1, 0}));
}

TEST_F(Raster, ScaleOffsetAndFeet) {
  RawRaster raster = counting(2, 2);
  raster.band = "<Scale>2</Scale><Offset>100</Offset>";
  EXPECT_EQ(load(raster).heights_m, (std::vector<double>{104, 106, 100, 102}));
  raster.band = "<UnitType>ft</UnitType>";
  EXPECT_EQ(load(raster).z(1, 0), 3 * 0.3048);
  raster.band = "<UnitType>fathom</UnitType>";
  EXPECT_THAT(error(raster), HasSubstr("has heights in 'fathom'; give metres or feet"));
  raster.band = "<Scale>0</Scale>";
  EXPECT_THAT(error(raster), HasSubstr("band scale 0"));
}

TEST_F(Raster, ZScaleComesLast) {
  EXPECT_EQ(load(counting(2, 2), [](TerrainSource& s) { s.z_scale = -2; }).heights_m,
            (std::vector<double>{-4, -6, 0, -2}));
}

TEST_F(Raster, ProjectedFeetBecomeMetres) {
  RawRaster raster = counting(3, 3);
  raster.reference = "EPSG:2272";  // Pennsylvania South, US survey feet
  EXPECT_NEAR(load(raster).spacing_m, 10 * 1200.0 / 3937, 1e-9);
  raster.reference = "EPSG:32616";
  EXPECT_EQ(load(raster).spacing_m, 10);
}

TEST_F(Raster, WithoutGeoreferenceSpacingIsGiven) {
  RawRaster raster = counting(3, 3);
  raster.transform = "";
  EXPECT_EQ(load(raster).spacing_m, 1);
  EXPECT_EQ(load(raster, [](TerrainSource& s) { s.spacing_m = 25; }).spacing_m, 25);
}

TEST_F(Raster, UnequalSpacingsBecomeTheirMean) {
  RawRaster raster{9, 9, {}};
  for (int j = 0; j < 9; ++j) {
    for (int i = 0; i < 9; ++i) raster.samples.push_back(static_cast<float>(i));
  }
  raster.transform = "0, 10, 0, 0, 0, -30";
  const Terrain terrain = load(raster);
  EXPECT_EQ(terrain.spacing_m, 20);
  EXPECT_EQ(terrain.columns, 5);
  EXPECT_EQ(terrain.rows, 13);
  EXPECT_EQ(terrain.z(1, 3), 2) << "20 m east of the border are two columns of 10 m";
}

TEST_F(Raster, GeographicSlopeComesOutInMetres) {
  RawRaster raster{101, 101, {}};
  for (int j = 0; j < 101; ++j) {
    for (int i = 0; i < 101; ++i) raster.samples.push_back(static_cast<float>(10 * i));
  }
  raster.reference = "EPSG:4326";
  raster.transform = "9.95, 0.001, 0, 60.05, 0, -0.001";
  const Terrain terrain = load(raster);
  // 0.001° on WGS84 at 60° N: 55.80 m east, 111.41 m north (Snyder, 4-18 to 4-21).
  EXPECT_NEAR(terrain.spacing_m, (55.80 + 111.41) / 2, 0.01);
  const int middle = terrain.rows / 2;
  const double slope = (terrain.z(terrain.columns - 1, middle) - terrain.z(0, middle)) / terrain.width_m();
  EXPECT_NEAR(slope, 10 / 55.80, 1e-4);
}

// --- fit rules -------------------------------------------------------------------------------------------

TEST_F(Raster, ResampleTakesTheMiddleSquare) {
  // Columns 1 to 3 of 5 are the middle square of 3 rows.
  const Terrain same = load(counting(5, 3), [](TerrainSource& s) { s.size = 3; });
  EXPECT_EQ(same.heights_m, (std::vector<double>{11, 12, 13, 6, 7, 8, 1, 2, 3})) << "kept bit for bit";
  EXPECT_EQ(same.spacing_m, 10);
  const Terrain finer = load(counting(5, 3), [](TerrainSource& s) { s.size = 5; });
  EXPECT_EQ(finer.spacing_m, 5);
  EXPECT_EQ(finer.z(0, 0), 11);
  EXPECT_EQ(finer.z(1, 0), 11.5);
  EXPECT_EQ(finer.z(0, 1), 8.5);
  EXPECT_EQ(finer.z(4, 4), 3);
}

TEST_F(Raster, CropKeepsBits) {
  const auto crop = [](int size) {
    return [size](TerrainSource& s) {
      s.size = size;
      s.fit = FitRule::crop;
    };
  };
  const Terrain middle = load(counting(5, 5), crop(3));
  EXPECT_EQ(middle.heights_m, (std::vector<double>{16, 17, 18, 11, 12, 13, 6, 7, 8}));
  EXPECT_EQ(middle.spacing_m, 10);
  EXPECT_THAT(input_error([&] { (void)load(counting(5, 3), crop(4)); }), HasSubstr("cannot be cropped"));
}

TEST_F(Raster, SpacingIsResampledTo) {
  const Terrain whole = load(counting(5, 3), [](TerrainSource& s) { s.spacing_m = 5; });
  EXPECT_EQ(whole.columns, 9);
  EXPECT_EQ(whole.rows, 5);
  EXPECT_EQ(whole.z(1, 0), 10.5);
  const Terrain part = load(counting(5, 3), [](TerrainSource& s) {
    s.spacing_m = 5;
    s.size = 3;
  });
  EXPECT_EQ(part.columns, 3);
  EXPECT_EQ(part.z(1, 1), 7) << "the middle stays the middle";
  EXPECT_THAT(input_error([&] {
                (void)load(counting(5, 3), [](TerrainSource& s) {
                  s.spacing_m = 50;
                  s.size = 3;
                });
              }),
              HasSubstr("make size or spacing_m less"));
}

// --- holes -----------------------------------------------------------------------------------------------

TEST_F(Raster, EveryKindOfHoleIsSeen) {
  RawRaster raster = counting(3, 3);
  raster.samples[4] = kNaN;
  EXPECT_EQ(error(raster),
            fmt::format("terrain 't': 1 of 9 samples hold no data; say holes = \"crop\" or \"fill\""));
  raster.samples[4] = std::numeric_limits<float>::infinity();
  EXPECT_THAT(error(raster), HasSubstr("1 of 9 samples"));
  raster.samples[4] = -9999;
  raster.band = "<NoDataValue>-9999</NoDataValue>";
  EXPECT_THAT(error(raster), HasSubstr("1 of 9 samples"));
  raster.samples[4] = -3.4028235e38f;
  raster.band = "<NoDataValue>-3.4028234663852886e+38</NoDataValue>";
  EXPECT_THAT(error(raster), HasSubstr("1 of 9 samples"));
  raster.band = "";
  EXPECT_THAT(error(raster), HasSubstr("declare the raster's no-data value"));
}

TEST_F(Raster, MaskMakesHoles) {
  RawRaster raster = counting(3, 3);
  folder_.write("mask.raw", std::string("\xff\xff\xff\xff\0\xff\xff\xff\xff", 9));
  raster.dataset =
      "<MaskBand><VRTRasterBand dataType=\"Byte\" subClass=\"VRTRawRasterBand\">"
      "<SourceFilename relativetoVRT=\"1\">mask.raw</SourceFilename><ImageOffset>0</ImageOffset>"
      "<PixelOffset>1</PixelOffset><LineOffset>3</LineOffset></VRTRasterBand></MaskBand>";
  EXPECT_THAT(error(raster), HasSubstr("1 of 9 samples"));
}

TEST_F(Raster, NoDataDoesNotBleedIntoResampledNeighbours) {
  RawRaster raster{9, 9, std::vector<float>(81, 100)};
  raster.samples[40] = -9999;
  raster.band = "<NoDataValue>-9999</NoDataValue>";
  const Terrain terrain = load(raster, [](TerrainSource& s) {
    s.holes = HolePolicy::fill;
    s.size = 33;
  });
  EXPECT_EQ(terrain.columns, 33);
  for (const double z : terrain.heights_m) EXPECT_EQ(z, 100);
}

TEST_F(Raster, CropAvoidsHoles) {
  RawRaster raster = counting(4, 3);
  raster.samples[0] = kNaN;  // north-west corner
  const Terrain terrain = load(raster, [](TerrainSource& s) { s.holes = HolePolicy::crop; });
  EXPECT_EQ(terrain.columns, 3);
  EXPECT_EQ(terrain.rows, 3);
  EXPECT_EQ(terrain.z(0, 2), 1);
}

TEST_F(Raster, AllHolesAreRefusedByEveryPolicy) {
  const RawRaster raster{3, 3, std::vector<float>(9, kNaN)};
  for (const HolePolicy policy : {HolePolicy::refuse, HolePolicy::crop, HolePolicy::fill}) {
    EXPECT_THAT(input_error([&] { (void)load(raster, [&](TerrainSource& s) { s.holes = policy; }); }),
                HasSubstr("no sample holds data"));
  }
}

TEST_F(Raster, CropWithoutAnyCellIsRefused) {
  RawRaster raster{2, 2, {1, kNaN, kNaN, 1}};
  EXPECT_THAT(input_error([&] { (void)load(raster, [](TerrainSource& s) { s.holes = HolePolicy::crop; }); }),
              HasSubstr("no 2 x 2 samples without a hole"));
}

// --- bad input -------------------------------------------------------------------------------------------

TEST_F(Raster, FilesThatAreNoRasters) {
  const auto message = [](const std::filesystem::path& path) {
    return input_error([&] { (void)load_terrain(from_file(path)); });
  };
  EXPECT_THAT(message(folder_.path() / "none.tif"), HasSubstr("cannot be opened: "));
  EXPECT_THAT(message(folder_.write("empty.tif", "")), HasSubstr("cannot be opened: "));
  EXPECT_THAT(message(folder_.write("text.tif", "hello\n")), HasSubstr("cannot be opened: "));
  EXPECT_THAT(message(folder_.path()), HasSubstr("cannot be opened: "));
  EXPECT_THAT(message(folder_.write("y.vrt", "<VRTDataset rasterXSize=\"3\" ")),
              HasSubstr("cannot be opened: "));
}

TEST_F(Raster, TooSmall) {
  EXPECT_THAT(error(counting(1, 1)), HasSubstr("has 1 x 1 samples; a terrain needs 2 x 2"));
  EXPECT_THAT(error(counting(5, 1)), HasSubstr("has 5 x 1 samples"));
}

TEST_F(Raster, AbsurdSizesAreRefusedBeforeAllocation) {
  for (const int side : {2'000'000'000, 1 << 21, 70'000}) {
    RawRaster raster{side, side, {1, 2, 3, 4}};
    EXPECT_THAT(error(raster), StartsWith("terrain 't': ")) << side;
  }
  RawRaster large{20'000, 20'000, {1, 2, 3, 4}};
  EXPECT_THAT(error(large), HasSubstr("too small"));  // GDAL's own check of files that claim a gigabyte
}

TEST_F(Raster, TruncatedFileIsAnError) {
  RawRaster raster = counting(64, 64);
  raster.samples.resize(64 * 40);
  EXPECT_THAT(error(raster), HasSubstr("ends after 10240 of 16384 bytes"));
  raster.samples.clear();
  EXPECT_THAT(error(raster), HasSubstr("ends after 0 of 16384 bytes"));
}

TEST_F(Raster, BadGeoreference) {
  RawRaster raster = counting(3, 3);
  raster.transform = "0, 10, 1, 0, 1, -10";
  EXPECT_THAT(error(raster), HasSubstr("is rotated"));
  raster.transform = "0, 0, 0, 0, 0, -10";
  EXPECT_THAT(error(raster), HasSubstr("pixel size of 0"));
  raster.transform = "0, nan, 0, 0, 0, -10";
  EXPECT_THAT(error(raster), HasSubstr("not finite"));
  raster.reference = "EPSG:4326";
  raster.transform = "0, 10, 0, 30, 0, -10";
  EXPECT_THAT(error(raster), HasSubstr("more than 6 degrees"));
  raster.transform = "0, 0.1, 0, 89, 0, -0.1";
  EXPECT_THAT(error(raster), HasSubstr("beyond 86 degrees"));
}

// More columns than a terrain may have: `crop` reads the middle alone, `resample` every second sample.
TEST_F(Raster, LargeRasterIsCroppedAndDecimated) {
  RawRaster raster = counting(20'001, 1);
  raster.rows = 301;
  const std::filesystem::path path = raster.write(folder_, "large");
  std::filesystem::resize_file(folder_.path() / "large.raw", std::uintmax_t{4} * 20'001 * 301);  // zeros
  TerrainSource source = from_file(path);
  EXPECT_THAT(input_error([&] { (void)load_terrain(source); }),
              HasSubstr("more than 16385 a side; give a size"));
  source.size = 301;
  source.fit = FitRule::crop;
  const Terrain cropped = load_terrain(source);
  EXPECT_EQ(cropped.spacing_m, 10);
  EXPECT_EQ(cropped.z(0, 300), 9850);
  EXPECT_EQ(cropped.z(300, 300), 10'150);
  EXPECT_EQ(cropped.z(300, 299), 0);
  source.size = 151;
  source.fit = FitRule::resample;
  const Terrain decimated = load_terrain(source);
  EXPECT_EQ(decimated.spacing_m, 20);
  EXPECT_EQ(decimated.z(0, 150), 9850);
  EXPECT_EQ(decimated.z(150, 150), 10'150);
  source.holes = HolePolicy::crop;
  EXPECT_THAT(input_error([&] { (void)load_terrain(source); }), HasSubstr("cut it first"));
}

// --- samples given inline --------------------------------------------------------------------------------

TEST(Samples, StandOnExactMultiplesOfTheSpacing) {
  TerrainSource source;
  source.id = "third";
  source.columns = source.rows = 2;
  source.samples = {0, 0, 0, 0};
  source.spacing_m = 1.0 / 3;
  const double spacing_m = load_terrain(source).spacing_m;
  EXPECT_NEAR(spacing_m, 1.0 / 3, 0x1p-33);
  for (int i = 1; i < kMostSamplesASide; ++i) {
    ASSERT_EQ(std::fma(i, spacing_m, -(i * spacing_m)), 0) << "i = " << i;  // what rounding left out
  }
}

TEST(Samples, RowsFromTheSouth) {
  TerrainSource source;
  source.id = "t";
  source.columns = 3;
  source.rows = 2;
  source.samples = {1, 2, 3, 4, 5, 6};
  const Terrain terrain = load_terrain(source);
  EXPECT_EQ(terrain.heights_m, source.samples);
  EXPECT_EQ(terrain.spacing_m, 30);
  EXPECT_EQ(terrain.id, "t");
  source.rows = 3;
  EXPECT_THAT(input_error([&] { (void)load_terrain(source); }),
              HasSubstr("6 samples for 3 columns and 3 rows"));
  source.rows = 2;
  source.samples[3] = std::nan("");
  EXPECT_THAT(input_error([&] { (void)load_terrain(source); }), HasSubstr("1 of 6 samples hold no data"));
}

}  // namespace
}  // namespace plumbline
