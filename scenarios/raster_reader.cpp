// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/raster_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <vector>

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_minixml.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "scenarios/error.h"
#include "scenarios/portable_math.h"

namespace plumbline {
namespace {

constexpr int kLongestSide = 1 << 20;
constexpr std::int64_t kMostSourceSamples = std::int64_t{1} << 32;
constexpr std::int64_t kLargestBlockBytes = std::int64_t{1} << 30;

// Collects this thread's GDAL errors instead of letting GDAL print them.
class GdalErrors {
 public:
  GdalErrors() { CPLPushErrorHandlerEx(&GdalErrors::take, this); }
  ~GdalErrors() { CPLPopErrorHandler(); }
  GdalErrors(const GdalErrors&) = delete;
  GdalErrors& operator=(const GdalErrors&) = delete;

  [[nodiscard]] bool failed() const { return failed_; }
  /// The first error: later ones follow from it.
  [[nodiscard]] std::string text() const {
    return first_.empty() ? "GDAL gives no reason" : one_line(first_, 200);
  }

 private:
  static void CPL_STDCALL take(CPLErr severity, CPLErrorNum, const char* message) {
    if (severity < CE_Failure) return;
    auto* self = static_cast<GdalErrors*>(CPLGetErrorHandlerUserData());
    if (!self->failed_) self->first_ = message;
    self->failed_ = true;
  }
  bool failed_ = false;
  std::string first_;
};

void register_drivers() {
  static std::once_flag once;
  std::call_once(once, [] {
    const GdalErrors quiet;  // a plug-in that does not load is no concern of the user's raster
    GDALAllRegister();
  });
}

// Metres per vertical unit; 0 if the unit is unknown.
double metres_per_unit(const std::string& name) {
  std::string unit;
  for (const char c : name) unit += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  const auto is = [&](std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), unit) != names.end();
  };
  if (is({"", "m", "metre", "metres", "meter", "meters"})) return 1;
  if (is({"ft", "foot", "feet", "international foot", "international feet"})) return 0.3048;
  if (is({"ftus", "us-ft", "foot_us", "us survey foot", "us survey feet"})) return 1200.0 / 3937;
  if (is({"km", "kilometre", "kilometer"})) return 1000;
  if (is({"dm", "decimetre", "decimeter"})) return 0.1;
  if (is({"cm", "centimetre", "centimeter"})) return 0.01;
  if (is({"mm", "millimetre", "millimeter"})) return 0.001;
  return 0;
}

}  // namespace

struct RasterReader::Impl {
  std::string label;  // "terrain 'x': FILE"
  std::unique_ptr<GDALDataset, void (*)(GDALDataset*)> dataset{nullptr, [](GDALDataset* d) {
                                                                 const GdalErrors quiet;
                                                                 GDALClose(d);
                                                               }};
  GDALRasterBand* band = nullptr;
  GDALRasterBand* mask = nullptr;  // null: none beside the no-data value
  RasterFrame frame;
  bool rows_from_north = true, columns_from_east = false;
  bool has_no_data = false;
  double no_data = 0;
  double scale = 1, offset = 0, unit_m = 1;

  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(fmt::format("{}: {}", label, what));
  }
  void read_size();
  void check_raw_bytes(const std::filesystem::path& file) const;
  void read_transform();
  void read_reference();
  void read_values();
};

void RasterReader::Impl::read_size() {
  if (dataset->GetRasterCount() < 1) refuse("has no raster band; name a subdataset or another file");
  band = dataset->GetRasterBand(1);
  frame.columns = dataset->GetRasterXSize();
  frame.rows = dataset->GetRasterYSize();
  if (frame.columns < 2 || frame.rows < 2) {
    refuse(fmt::format("has {} x {} samples; a terrain needs 2 x 2", frame.columns, frame.rows));
  }
  if (frame.columns > kLongestSide || frame.rows > kLongestSide ||
      std::int64_t{frame.columns} * frame.rows > kMostSourceSamples) {
    refuse(fmt::format("claims {} x {} samples; at most 2^20 a side and 2^32 in all are read, cut it first",
                       frame.columns, frame.rows));
  }
  int block_columns = 0, block_rows = 0;
  band->GetBlockSize(&block_columns, &block_rows);
  const std::int64_t sample_bytes = GDALGetDataTypeSizeBytes(band->GetRasterDataType());
  if (std::int64_t{block_columns} * block_rows >
      kLargestBlockBytes / std::max<std::int64_t>(sample_bytes, 1)) {
    refuse(fmt::format("is stored in blocks of {} x {} samples, over 1 GiB each; store it in tiles",
                       block_columns, block_rows));
  }
  if (GDALDataTypeIsComplex(band->GetRasterDataType()) != 0)
    refuse("holds complex numbers; give real heights");
}

// GDAL reads zeros beyond the end of a VRT's raw file, in silence; they are not heights.
void RasterReader::Impl::check_raw_bytes(const std::filesystem::path& file) const {
  char** xml = dataset->GetMetadata("xml:VRT");
  if (xml == nullptr || xml[0] == nullptr) return;
  const std::unique_ptr<CPLXMLNode, void (*)(CPLXMLNode*)> tree(CPLParseXMLString(xml[0]), CPLDestroyXMLNode);
  const CPLXMLNode* element = CPLGetXMLNode(tree.get(), "=VRTDataset.VRTRasterBand");
  if (element == nullptr || !EQUAL(CPLGetXMLValue(element, "subClass", ""), "VRTRawRasterBand")) return;
  std::string source = CPLGetXMLValue(element, "SourceFilename", "");
  if (EQUAL(CPLGetXMLValue(element, "SourceFilename.relativeToVRT", "1"), "1")) {
    source = CPLProjectRelativeFilename(CPLGetPath(file.c_str()), source.c_str());
  }
  const std::int64_t sample_bytes = GDALGetDataTypeSizeBytes(band->GetRasterDataType());
  const auto number = [&](const char* name, std::int64_t fallback) {
    const char* text = CPLGetXMLValue(element, name, "");
    return *text == '\0' ? fallback : std::int64_t{CPLAtoGIntBig(text)};
  };
  const std::int64_t pixel_bytes = number("PixelOffset", sample_bytes);
  const std::int64_t line_bytes = number("LineOffset", pixel_bytes * frame.columns);
  const std::int64_t needed = number("ImageOffset", 0) +
                              std::max<std::int64_t>(line_bytes, 0) * (frame.rows - 1) +
                              std::max<std::int64_t>(pixel_bytes, 0) * (frame.columns - 1) + sample_bytes;
  VSIStatBufL status;
  if (VSIStatL(source.c_str(), &status) != 0)
    refuse(fmt::format("cannot find its samples in {}", one_line(source)));
  const auto present = static_cast<std::int64_t>(status.st_size);
  if (present < needed) {
    refuse(fmt::format("{} ends after {} of {} bytes; restore the file", one_line(source), present, needed));
  }
}

void RasterReader::Impl::read_transform() {
  double t[6] = {0, 1, 0, 0, 0, -1};
  frame.georeferenced = dataset->GetGeoTransform(t) == CE_None;
  if (!frame.georeferenced) {
    t[1] = 1;
    t[5] = -1;
    t[0] = t[2] = t[3] = t[4] = 0;
  }
  for (const double v : t) {
    if (!std::isfinite(v)) refuse("has a geotransform that is not finite; mend its georeference");
  }
  if (t[2] != 0 || t[4] != 0) refuse("is rotated; warp it north-up first (gdalwarp)");
  if (t[1] == 0 || t[5] == 0) refuse("has a pixel size of 0; mend its georeference");
  rows_from_north = t[5] < 0;
  columns_from_east = t[1] < 0;
  frame.step_x = std::fabs(t[1]);
  frame.step_y = std::fabs(t[5]);
  // Samples stand in the middle of their pixels.
  frame.south_west.longitude = t[0] + (columns_from_east ? frame.columns - 0.5 : 0.5) * t[1];
  frame.south_west.latitude = t[3] + (rows_from_north ? frame.rows - 0.5 : 0.5) * t[5];
  frame.rows_from_north = rows_from_north;
  frame.columns_from_east = columns_from_east;
  frame.own_origin = {frame.south_west.longitude, frame.south_west.latitude};
  frame.own_step = {frame.step_x, frame.step_y};
}

void RasterReader::Impl::read_reference() {
  const OGRSpatialReference* reference = dataset->GetSpatialRef();
  if (reference == nullptr || !frame.georeferenced) return;
  if (const char* name = reference->GetName(); name != nullptr) frame.crs = one_line(name, 80);
  if (reference->IsGeocentric())
    refuse("is in geocentric coordinates; give a map projection or longitudes, latitudes");
  if (reference->IsGeographic()) {
    frame.geographic = true;
    double radians = reference->GetAngularUnits();
    // WKT writes the degree with 15 digits, or 17: one degree for all.
    if (std::fabs(radians / kRadiansPerDegree - 1) < 1e-9) radians = kRadiansPerDegree;
    frame.own_unit = radians;
    frame.step_x *= radians;
    frame.step_y *= radians;
    frame.south_west.longitude *= radians;
    frame.south_west.latitude *= radians;
    frame.semi_major_m = reference->GetSemiMajor();
    frame.inverse_flattening = reference->GetInvFlattening();
    if (!(frame.semi_major_m > 0) || !std::isfinite(frame.semi_major_m) ||
        !(frame.inverse_flattening == 0 || frame.inverse_flattening > 1)) {
      refuse("has a CRS without a sensible ellipsoid; mend its georeference");
    }
    return;
  }
  const double metres = reference->GetLinearUnits();
  if (!(metres > 0) || !std::isfinite(metres))
    refuse("has a CRS without a linear unit; mend its georeference");
  frame.own_unit = metres;
  frame.step_x *= metres;
  frame.step_y *= metres;
}

void RasterReader::Impl::read_values() {
  int given = 0;
  switch (band->GetRasterDataType()) {
    case GDT_Int64:
      no_data = static_cast<double>(band->GetNoDataValueAsInt64(&given));
      break;
    case GDT_UInt64:
      no_data = static_cast<double>(band->GetNoDataValueAsUInt64(&given));
      break;
    case GDT_Float32:  // a text header may hold more digits than the samples do
      no_data = static_cast<double>(static_cast<float>(band->GetNoDataValue(&given)));
      break;
    default:
      no_data = band->GetNoDataValue(&given);
  }
  has_no_data = given != 0;
  const double band_scale = band->GetScale(&given);
  if (given != 0) scale = band_scale;
  const double band_offset = band->GetOffset(&given);
  if (given != 0) offset = band_offset;
  if (!std::isfinite(scale) || scale == 0 || !std::isfinite(offset)) {
    refuse(fmt::format("has band scale {} and offset {}; mend them", scale, offset));
  }
  // A mask of the data set's or of the band's own; no-data values are looked at as values.
  if ((band->GetMaskFlags() & (GMF_ALL_VALID | GMF_NODATA)) == 0) mask = band->GetMaskBand();
  const std::string unit = band->GetUnitType();
  const OGRSpatialReference* reference = dataset->GetSpatialRef();
  if (unit.empty() && reference != nullptr && reference->IsCompound()) {
    unit_m = reference->GetTargetLinearUnits("COMPD_CS|VERT_CS");
  } else {
    unit_m = metres_per_unit(unit);
  }
  if (!(unit_m > 0) || !std::isfinite(unit_m)) {
    refuse(fmt::format("has heights in '{}'; give metres or feet", one_line(unit, 40)));
  }
  frame.height_unit = one_line(unit, 40);
  frame.height_unit_m = unit_m;
}

RasterReader::RasterReader(const std::string& terrain_id, const std::filesystem::path& file)
    : impl_(std::make_unique<Impl>()) {
  register_drivers();
  impl_->label = fmt::format("terrain '{}': {}", terrain_id, one_line(file.string(), 400));
  const GdalErrors errors;
  impl_->dataset.reset(
      GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
  if (impl_->dataset == nullptr) impl_->refuse(fmt::format("cannot be opened: {}", errors.text()));
  impl_->read_size();
  impl_->check_raw_bytes(file);
  impl_->read_transform();
  impl_->read_reference();
  impl_->read_values();
}

RasterReader::~RasterReader() = default;

const RasterFrame& RasterReader::frame() const { return impl_->frame; }

HeightGrid RasterReader::read(GridWindow window, int step) const {
  const Impl& raster = *impl_;
  const GdalErrors errors;
  HeightGrid grid;
  grid.columns = (window.columns - 1) / step + 1;
  grid.rows = (window.rows - 1) / step + 1;
  const auto columns = static_cast<std::size_t>(grid.columns);
  grid.heights_m.resize(columns * static_cast<std::size_t>(grid.rows));
  const auto width = static_cast<std::size_t>(window.columns);
  std::vector<double> values(width);
  std::vector<std::uint8_t> valid(raster.mask != nullptr ? width : 0);
  const int first_column =
      raster.columns_from_east ? raster.frame.columns - window.i - window.columns : window.i;
  // In the file's own order: a compressed file read backwards would be unpacked again for every row.
  for (int k = 0; k < grid.rows; ++k) {
    const int j = raster.rows_from_north ? grid.rows - 1 - k : k;
    const int row = window.j + j * step;
    const int file_row = raster.rows_from_north ? raster.frame.rows - 1 - row : row;
    CPLErr outcome = raster.band->RasterIO(GF_Read, first_column, file_row, window.columns, 1, values.data(),
                                           window.columns, 1, GDT_Float64, 0, 0, nullptr);
    if (outcome == CE_None && raster.mask != nullptr) {
      outcome = raster.mask->RasterIO(GF_Read, first_column, file_row, window.columns, 1, valid.data(),
                                      window.columns, 1, GDT_Byte, 0, 0, nullptr);
    }
    if (outcome != CE_None || errors.failed()) {
      raster.refuse(fmt::format("cannot be read at row {}: {}", file_row, errors.text()));
    }
    double* heights = grid.heights_m.data() + columns * static_cast<std::size_t>(j);
    for (std::size_t i = 0; i < columns; ++i) {
      const std::size_t at = i * static_cast<std::size_t>(step);
      const std::size_t in_file = raster.columns_from_east ? width - 1 - at : at;
      const double value = values[in_file];
      const bool hole = !std::isfinite(value) || (raster.has_no_data && value == raster.no_data) ||
                        (raster.mask != nullptr && valid[in_file] == 0);
      heights[i] = hole ? std::numeric_limits<double>::quiet_NaN()
                        : (value * raster.scale + raster.offset) * raster.unit_m;
    }
  }
  return grid;
}

}  // namespace plumbline
