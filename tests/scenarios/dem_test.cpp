// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// DEMs as they are, from small GeoTIFFs written here, and meshes laid over them.

#include "scenarios/dem.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "scenarios/placing.h"
#include "scenarios/terrain_source.h"
#include "support.h"

namespace plumbline {
namespace {

using test::input_error;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double kNoData = -9999;

/// Rough enough that no arrangement fits like another.
double ground(int column, int row) {
  return 1000 + 40 * ((column * 7 + row * 13) % 11) + 3.5 * column - 1.25 * row * row;
}

/// A GeoTIFF; `height(column, row)` with row 0 first in the file.
struct Tiff {
  int columns = 8, rows = 6;
  std::array<double, 6> transform{500000, 30, 0, 4200000, 0, -30};
  int epsg = 32610;  // UTM 10 N; 0: none
  std::function<double(int, int)> height = ground;
  std::optional<double> no_data{};
  std::string wkt{};  // instead of epsg
  bool georeferenced = true;

  [[nodiscard]] std::filesystem::path write(const test::TemporaryFolder& folder) const {
    const std::filesystem::path path = folder.path() / "dem.tif";
    GDALAllRegister();
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    const std::unique_ptr<GDALDataset, void (*)(GDALDataset*)> file(
        driver->Create(path.c_str(), columns, rows, 1, GDT_Float64, nullptr),
        [](GDALDataset* d) { GDALClose(d); });
    std::array<double, 6> t = transform;
    if (georeferenced) file->SetGeoTransform(t.data());
    OGRSpatialReference reference;
    if (!wkt.empty()) reference.SetFromUserInput(wkt.c_str());
    if (wkt.empty() && epsg != 0) reference.importFromEPSG(epsg);
    if (!reference.IsEmpty()) file->SetSpatialRef(&reference);
    GDALRasterBand* band = file->GetRasterBand(1);
    if (no_data) band->SetNoDataValue(*no_data);
    for (int row = 0; row < rows; ++row) {
      std::vector<double> line;
      for (int column = 0; column < columns; ++column) line.push_back(height(column, row));
      EXPECT_EQ(band->RasterIO(GF_Write, 0, row, columns, 1, line.data(), columns, 1, GDT_Float64, 0, 0),
                CE_None);
    }
    return path;
  }
};

Tiff geographic() {
  Tiff tiff;
  tiff.epsg = 4326;
  tiff.columns = 21;
  tiff.rows = 15;
  tiff.transform = {7.5, 1.0 / 1200, 0, 46.5, 0, -1.0 / 1200};
  return tiff;
}

class DemFile : public testing::Test {
 protected:
  Dem read(const Tiff& tiff, DemHoles holes = DemHoles::leave_out) {
    return read_dem({tiff.write(folder_), holes});
  }
  std::string error(const Tiff& tiff, DemHoles holes = DemHoles::leave_out) {
    return input_error([&] { (void)read(tiff, holes); });
  }
  LaidDem lay(const Tiff& tiff, std::string_view name, const Mesh& mesh,
              DemHoles holes = DemHoles::leave_out) {
    const Mesh* const meshes[] = {&mesh};
    return lay_over_dem({tiff.write(folder_), holes}, name, meshes);
  }
  test::TemporaryFolder folder_;
};

/// The full mesh of a tiff with a vertex on each sample, `place(column, row)`, row 0 first in the file. Sound
/// when seen with y as `place` has it.
template <class Place>
Mesh mesh_of(const Tiff& tiff, Place place) {
  Mesh mesh;
  const auto columns = static_cast<std::uint32_t>(tiff.columns);
  for (int row = 0; row < tiff.rows; ++row) {
    for (int column = 0; column < tiff.columns; ++column) {
      const Vec2 at = place(column, row);
      mesh.positions.push_back({at.x, at.y, tiff.height(column, row)});
    }
  }
  const bool rows_go_north = mesh.positions[0].y < mesh.positions.back().y;
  for (std::uint32_t row = 0; row + 1 < static_cast<std::uint32_t>(tiff.rows); ++row) {
    for (std::uint32_t column = 0; column + 1 < columns; ++column) {
      const std::uint32_t a = row * columns + column, b = a + 1, c = a + columns, d = c + 1;
      if (rows_go_north) {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({a, d, c});
      } else {
        mesh.triangles.push_back({a, d, b});
        mesh.triangles.push_back({a, c, d});
      }
    }
  }
  return mesh;
}

Vec2 as_crs(const Tiff& t, int column, int row) {
  return {t.transform[0] + (column + 0.5) * t.transform[1], t.transform[3] + (row + 0.5) * t.transform[5]};
}

/// Every vertex on its sample, exactly.
void expect_on_samples(const LaidDem& laid, const Mesh& mesh) {
  const Mesh over = laid_over(mesh, laid.placing, laid.turned);
  for (const Vec3& p : over.positions) {
    ASSERT_EQ(p.x, std::floor(p.x));
    ASSERT_EQ(p.y, std::floor(p.y));
    ASSERT_EQ(p.z, laid.dem.samples.z(static_cast<int>(p.x), static_cast<int>(p.y)));
  }
  for (const auto& t : over.triangles) {
    const Vec3 a = over.positions[t[0]], b = over.positions[t[1]], c = over.positions[t[2]];
    ASSERT_GT((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x), 0);
  }
  EXPECT_EQ(laid.rms_m, 0);
  EXPECT_EQ(laid.vertices, mesh.positions.size());
  for (std::size_t k = 0; k < mesh.positions.size(); ++k) {
    const Vec2 back = laid.placing.from_samples({over.positions[k].x, over.positions[k].y});
    EXPECT_NEAR(back.x, mesh.positions[k].x, 1e-9 * std::fabs(back.x) + 1e-9);
    EXPECT_NEAR(back.y, mesh.positions[k].y, 1e-9 * std::fabs(back.y) + 1e-9);
  }
}

// --- reading ---------------------------------------------------------------------------------------------

TEST_F(DemFile, ProjectedSamplesStandAtTheCentresOfCells) {
  const Dem dem = read({});
  EXPECT_EQ(dem.samples.columns, 8);
  EXPECT_EQ(dem.samples.rows, 6);
  EXPECT_EQ(dem.samples.spacing_m, 1);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 8; ++column) EXPECT_EQ(dem.samples.z(column, 5 - row), ground(column, row));
  }
  EXPECT_EQ(dem.origin, (Vec2{500015, 4200000 - 6 * 30 + 15}));
  EXPECT_EQ(dem.to_crs({7, 5}), (Vec2{500000 + 7.5 * 30, 4200000 - 15}));
  EXPECT_EQ(dem.step_x, 30);
  EXPECT_EQ(dem.metres_y, 30);
  EXPECT_TRUE(dem.has_data.empty());
  EXPECT_THAT(
      dem.description,
      AllOf(HasSubstr("dem.tif: 8 x 6 samples, 30 x 30 m apart, WGS 84 / UTM zone 10N"),
            HasSubstr("first row is the northmost, as its georeference says"),
            HasSubstr("points at the centres of the file's cells"), HasSubstr("every sample holds data")));
  EXPECT_THAT(reading_in_words(dem, 12.345), HasSubstr("ambiguous by up to 12.3 m"));
}

TEST_F(DemFile, SouthUpAndNonSquareKeepTheirSamples) {
  Tiff tiff;
  tiff.transform = {500000, 10, 0, 4200000, 0, 25};
  const Dem dem = read(tiff);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 8; ++column) EXPECT_EQ(dem.samples.z(column, row), ground(column, row));
  }
  EXPECT_EQ(dem.origin, (Vec2{500005, 4200012.5}));
  EXPECT_EQ(dem.metres_x, 10);
  EXPECT_EQ(dem.metres_y, 25);
  EXPECT_THAT(dem.description, HasSubstr("first row is the southmost"));
}

TEST_F(DemFile, GeographicStaysInDegrees) {
  const Tiff tiff = geographic();
  const Dem dem = read(tiff);
  EXPECT_TRUE(dem.geographic);
  EXPECT_EQ(dem.samples.columns, 21);
  EXPECT_EQ(dem.samples.rows, 15);
  EXPECT_EQ(dem.step_x, 1.0 / 1200);
  EXPECT_NEAR(dem.origin.x, 7.5 + 0.5 / 1200, 1e-13);
  EXPECT_NEAR(dem.origin.y, 46.5 - 14.5 / 1200, 1e-13);
  for (int row = 0; row < 15; ++row) {
    for (int column = 0; column < 21; ++column)
      EXPECT_EQ(dem.samples.z(column, 14 - row), ground(column, row));
  }
  // 3" at 46.5° N: 63.9 m along the parallel, 92.6 m along the meridian.
  EXPECT_NEAR(dem.metres_x, 63.9, 0.1);
  EXPECT_NEAR(dem.metres_y, 92.65, 0.1);
  EXPECT_THAT(dem.description, HasSubstr("degrees apart (63.9"));
}

TEST_F(DemFile, FeetBecomeMetresAndTheOwnUnitIsKept) {
  Tiff tiff;
  tiff.epsg = 2227;  // California 3, US survey feet
  const Dem dem = read(tiff);
  EXPECT_NEAR(dem.crs_unit_m, 1200.0 / 3937, 1e-12);
  EXPECT_NEAR(dem.step_x, 30 * 1200.0 / 3937, 1e-9);
  const Mesh mesh = mesh_of(tiff, [&](int c, int r) { return as_crs(tiff, c, r); });
  const LaidDem laid = lay(tiff, "guess", mesh);
  EXPECT_EQ(laid.placing.name, "crs_units");
  expect_on_samples(laid, mesh);
}

TEST_F(DemFile, HolesAreLeftOutCroppedFilledOrRefused) {
  Tiff tiff;
  tiff.no_data = kNoData;
  tiff.height = [](int column, int row) { return column == 1 && row == 2 ? kNoData : ground(column, row); };
  const Dem left_out = read(tiff);
  EXPECT_EQ(left_out.holes, 1U);
  ASSERT_EQ(left_out.has_data.size(), 48U);
  EXPECT_EQ(std::count(left_out.has_data.begin(), left_out.has_data.end(), 0), 1);
  EXPECT_EQ(left_out.has_data[left_out.samples.index(1, 3)], 0);
  EXPECT_TRUE(std::all_of(left_out.samples.heights_m.begin(), left_out.samples.heights_m.end(), [](double z) {
    return z > 900 && z < 1600;
  })) << "placeholders are heights, no no-data values";
  EXPECT_THAT(left_out.description,
              HasSubstr("1 of 48 samples hold no data, the cells around them are left out"));
  EXPECT_FALSE(height_where_data_m(left_out.samples, left_out.has_data, {1.5, 3.5}));
  EXPECT_FALSE(height_where_data_m(left_out.samples, left_out.has_data, {0.5, 2.5}));
  EXPECT_EQ(height_where_data_m(left_out.samples, left_out.has_data, {4, 4}), left_out.samples.z(4, 4));
  EXPECT_FALSE(height_where_data_m(left_out.samples, left_out.has_data, {7.01, 1}));

  const Dem cropped = read(tiff, DemHoles::crop);
  EXPECT_EQ(cropped.samples.columns, 6);
  EXPECT_EQ(cropped.samples.rows, 6);
  EXPECT_EQ(cropped.origin, (Vec2{500000 + 2.5 * 30, 4200000 - 6 * 30 + 15}));
  EXPECT_EQ(cropped.file_low, (Vec2{-2, 0}));
  EXPECT_EQ(cropped.file_high, (Vec2{5, 5}));
  EXPECT_EQ(cropped.samples.z(0, 5), ground(2, 0));

  const Dem filled = read(tiff, DemHoles::fill);
  EXPECT_TRUE(filled.has_data.empty());
  EXPECT_EQ(filled.samples.heights_m, left_out.samples.heights_m);
  EXPECT_THAT(error(tiff, DemHoles::refuse), HasSubstr("1 of 48 samples hold no data; say --holes"));

  tiff.height = [](int column, int row) { return (column + row) % 2 == 0 ? kNoData : ground(column, row); };
  EXPECT_THAT(error(tiff), HasSubstr("no 2 x 2 samples hold data"));
}

TEST_F(DemFile, WhatCannotBeCheckedIsRefusedInOneLine) {
  Tiff rotated;
  rotated.transform = {500000, 30, 5, 4200000, 5, -30};
  EXPECT_THAT(error(rotated), HasSubstr("is rotated"));
  Tiff deep;
  deep.height = [](int, int) { return -3.4e38; };
  EXPECT_THAT(error(deep), HasSubstr("declare the raster's no-data value"));
  EXPECT_THAT(input_error([&] { (void)read_dem({folder_.write("text.tif", "no raster")}); }),
              HasSubstr("cannot be opened"));
  const std::filesystem::path wide =
      folder_.write("wide.vrt",
                    "<VRTDataset rasterXSize=\"20000\" rasterYSize=\"3\"><VRTRasterBand dataType=\"Byte\" "
                    "band=\"1\"/></VRTDataset>");
  EXPECT_THAT(input_error([&] { (void)read_dem({wide}); }),
              AllOf(HasSubstr("20000 x 3 samples"), HasSubstr("gdal_translate -srcwin")));
}

// --- placing ---------------------------------------------------------------------------------------------

TEST_F(DemFile, EachPlacingIsGuessedAndLaysSamplesOnSamples) {
  Tiff tiff;
  tiff.columns = 40;
  tiff.rows = 25;
  tiff.transform = {500000, 10, 0, 4200000, 0, -25};
  const struct {
    const char* name;
    std::function<Vec2(int, int)> place;
  } conventions[] = {
      {"crs", [&](int c, int r) { return as_crs(tiff, c, r); }},
      {"local",
       [](int c, int r) {
         return Vec2{c * 10.0, (24 - r) * 25.0};
       }},
      {"samples",
       [](int c, int r) {
         return Vec2{c * 1.0, r * 1.0};
       }},
      {"samples_up",
       [](int c, int r) {
         return Vec2{c * 1.0, 24.0 - r};
       }},
      {"samples_scaled",
       [](int c, int r) {
         return Vec2{c * 10.0, r * 25.0};
       }},
      {"centred",
       [](int c, int r) {
         return Vec2{(c - 19.5) * 10, (12.0 - r) * 25};
       }},
      {"fit",
       [](int c, int r) {
         return Vec2{0.001 * c, 0.001 * (24 - r)};
       }},
  };
  for (const auto& [name, place] : conventions) {
    Mesh mesh = mesh_of(tiff, place);
    const bool south = std::string(name) == "samples" || std::string(name) == "samples_scaled";
    if (south) {  // wound to be seen from above, as martini and delatin do
      for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    }
    for (const std::string_view asked : {std::string_view("guess"), std::string_view(name)}) {
      const LaidDem laid = lay(tiff, asked, mesh);
      EXPECT_EQ(laid.placing.name, name);
      EXPECT_EQ(laid.guessed, asked == "guess");
      EXPECT_FALSE(laid.turned) << laid.words;
      if (std::string_view(name) != "fit") expect_on_samples(laid, mesh);
      EXPECT_LT(laid.rms_m, 1e-6) << laid.words;
      EXPECT_THAT(laid.words, asked == "guess" ? testing::Matcher<std::string>(AllOf(
                                                     HasSubstr("guessed, since"), HasSubstr("--placing")))
                                               : HasSubstr("as said"));
    }
  }
}

TEST_F(DemFile, APartOfTheGroundIsLaidWhereItBelongs) {
  Tiff tiff;
  tiff.columns = 40;
  tiff.rows = 40;
  for (const char* name : {"crs", "local", "samples_up"}) {
    Mesh mesh = mesh_of(tiff, [&](int c, int r) {
      return std::string(name) == "crs" ? as_crs(tiff, c, r)
                                        : Vec2{c * 1.0, 39.0 - r} * (std::string(name) == "local" ? 30 : 1);
    });
    std::vector<std::array<std::uint32_t, 3>> kept;
    for (const auto& t : mesh.triangles) {
      if (t[0] % 40 >= 5 && t[0] % 40 < 20 && t[0] / 40 < 12) kept.push_back(t);
    }
    // Only the vertices that the part uses.
    Mesh part;
    for (const auto& t : kept) {
      const auto first = static_cast<std::uint32_t>(part.positions.size());
      for (const std::uint32_t v : t) part.positions.push_back(mesh.positions[v]);
      part.triangles.push_back({first, first + 1, first + 2});
    }
    const LaidDem laid = lay(tiff, "guess", part);
    EXPECT_EQ(laid.placing.name, name) << laid.words;
    expect_on_samples(laid, part);
  }
}

TEST_F(DemFile, FlippedRowsAreNoPlacing) {
  // North-up coordinates and winding, heights the wrong way round: laid as its coordinates say.
  Tiff tiff;
  tiff.columns = 30;
  tiff.rows = 30;
  const Mesh mesh = mesh_of(tiff, [](int c, int r) { return Vec2{c * 30.0, r * 30.0}; });
  const LaidDem laid = lay(tiff, "guess", mesh);
  EXPECT_EQ(laid.placing.name, "local");
  EXPECT_GT(laid.rms_m, 50);
  // Said to run south, the same vertices fit, and the triangles are seen from below.
  const LaidDem said = lay(tiff, "samples_scaled", mesh);
  EXPECT_TRUE(said.turned);
  EXPECT_THAT(said.words, HasSubstr("turned over"));
  expect_on_samples(said, mesh);
}

TEST_F(DemFile, DegreesAreLaidExactlyAndMetresOverTheResampledDem) {
  const Tiff tiff = geographic();
  const Mesh degrees = mesh_of(tiff, [&](int c, int r) { return as_crs(tiff, c, r); });
  LaidDem laid = lay(tiff, "guess", degrees);
  EXPECT_EQ(laid.placing.name, "crs");
  expect_on_samples(laid, degrees);
  Mesh turned = degrees;  // longitudes from 0 to 360, or a map that begins elsewhere
  for (Vec3& p : turned.positions) p.x -= 360;
  laid = lay(tiff, "guess", turned);
  EXPECT_EQ(laid.placing.name, "crs");
  EXPECT_LT(laid.rms_m, 1e-6);
  EXPECT_THAT(laid.words, HasSubstr("360 apart"));

  TerrainSource source;
  source.id = "t";
  source.file = tiff.write(folder_);
  const Mesh metres = reference_mesh(load_terrain(source));
  laid = lay(tiff, "guess", metres);
  EXPECT_EQ(laid.placing.name, "local");
  EXPECT_TRUE(laid.dem.resampled);
  EXPECT_THAT(laid.dem.description, HasSubstr("resampled to plumbline's local frame"));
  expect_on_samples(laid, metres);
  EXPECT_TRUE(lay(tiff, "local", metres).dem.resampled);
}

TEST_F(DemFile, CroppedDemsKnowWhereTheFileBegins) {
  Tiff tiff;
  tiff.columns = 20;
  tiff.rows = 20;
  tiff.no_data = kNoData;
  tiff.height = [](int column, int row) { return column == 1 && row == 18 ? kNoData : ground(column, row); };
  Mesh mesh = mesh_of(tiff, [](int c, int r) { return Vec2{c * 1.0, r * 1.0}; });
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  for (const DemHoles holes : {DemHoles::leave_out, DemHoles::crop}) {
    const LaidDem laid = lay(tiff, "guess", mesh, holes);
    EXPECT_EQ(laid.placing.name, "samples");
    EXPECT_EQ(laid.rms_m, 0);
    EXPECT_GT(laid.vertices, 300U);
    EXPECT_LT(laid.vertices, 400U);
  }
}

TEST_F(DemFile, EqualPlacingsTakeTheFirstAndUnknownOnesAreRefused) {
  Tiff tiff;
  tiff.georeferenced = false;
  tiff.epsg = 0;
  const Mesh mesh = mesh_of(tiff, [](int c, int r) { return Vec2{c * 1.0, 5.0 - r}; });
  const LaidDem laid = lay(tiff, "guess", mesh);
  EXPECT_EQ(laid.placing.name, "local") << "a metre a sample: samples_up is the same";
  EXPECT_THAT(laid.dem.description, HasSubstr("not georeferenced"));
  EXPECT_THAT(
      input_error([&] { (void)lay(tiff, "crs", mesh); }),
      AllOf(HasSubstr("this DEM and mesh have none"), HasSubstr("local, samples"), Not(HasSubstr("crs,"))));
  EXPECT_THAT(input_error([&] { (void)lay(tiff, "upside\ndown", mesh); }), HasSubstr("no such placing"));
  EXPECT_THAT(input_error([&] { (void)lay(tiff, "guess", Mesh{}); }),
              HasSubstr("no mesh has a finite vertex"));
}

TEST(SpreadIndices, OneOfEachStretchAlwaysTheSame) {
  EXPECT_EQ(spread_indices(3, 5), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(spread_indices(0, 5).empty());
  const std::vector<std::size_t> drawn = spread_indices(1000, 10);
  ASSERT_EQ(drawn.size(), 10U);
  for (std::size_t k = 0; k < 10; ++k) {
    EXPECT_GE(drawn[k], 100 * k);
    EXPECT_LT(drawn[k], 100 * (k + 1));
  }
  EXPECT_EQ(drawn, spread_indices(1000, 10));
}

}  // namespace
}  // namespace plumbline
