// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "scenarios/tiles/tile_set.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "scenarios/error.h"
#include "scenarios/whole_file.h"

namespace plumbline {
namespace {

using Json = nlohmann::json;

/// A layer.json, key by key.
class LayerReader {
 public:
  LayerReader(std::string_view text, std::string_view name) : name_(name) {
    try {
      root_ = Json::parse(text.begin(), text.end());
    } catch (const Json::parse_error& error) {
      fail("the JSON", fmt::format("has a syntax error at byte {}", error.byte));
    } catch (const Json::exception&) {
      fail("the JSON", "holds a number out of range");
    }
    if (!root_.is_object()) fail("the JSON", "is no object");
  }

  TileLayer read() {
    if (const std::string format = text("format", "quantized-mesh-1.0");
        !format.starts_with("quantized-mesh-1."))
      fail("format", fmt::format("'{}' is not read here; quantized-mesh-1.0 is", one_line(format, 40)));
    const std::string projection = text("projection", "EPSG:4326");
    if (projection != "EPSG:4326" && projection != "EPSG:3857")
      fail("projection", fmt::format("'{}' is neither EPSG:4326 nor EPSG:3857", one_line(projection, 40)));
    layer_.grid.projection =
        projection == "EPSG:4326" ? TileProjection::geographic : TileProjection::mercator;
    const std::string scheme = text("scheme", "tms");
    if (scheme != "tms" && scheme != "slippyMap" && scheme != "xyz")
      fail("scheme", fmt::format("'{}' is neither tms nor slippyMap (xyz)", one_line(scheme, 40)));
    layer_.grid.scheme = scheme == "tms" ? TileScheme::tms : TileScheme::xyz;
    layer_.least_level = level("minzoom");
    layer_.deepest_level = level("maxzoom");
    read_bounds();
    read_extensions();
    read_templates();
    read_available();
    if (root_.contains("parentUrl")) note("parentUrl names another layer, which is not followed");
    return std::move(layer_);
  }

 private:
  [[noreturn]] void fail(std::string_view place, std::string_view what) const {
    throw InputError(fmt::format("{}: {}: {}", one_line(name_), place, what));
  }
  void note(std::string sentence) { layer_.notes.push_back(std::move(sentence)); }
  const Json* find(const char* key) const {
    const auto found = root_.find(key);
    return found == root_.end() || found->is_null() ? nullptr : &*found;
  }

  std::string text(const char* key, const char* otherwise) {
    const Json* value = find(key);
    if (value == nullptr) {
      note(fmt::format("layer.json has no {}: {} is assumed", key, otherwise));
      return otherwise;
    }
    if (!value->is_string()) fail(key, "is no text");
    return value->get<std::string>();
  }

  double whole(const Json& value, std::string_view place) const {
    const double number = value.is_number() ? value.get<double>() : -1;
    if (!(number >= 0 && number <= 4294967295.0) || std::floor(number) != number)
      fail(place, fmt::format("{} is not a whole number from 0 to 4294967295",
                              value.is_structured()  // a nest of lists would take all stack to print
                                  ? value.type_name()
                                  : one_line(value.dump(-1, ' ', true, Json::error_handler_t::replace), 40)));
    return number;
  }

  std::optional<int> level(const char* key) {
    const Json* value = find(key);
    if (value == nullptr) return std::nullopt;
    return static_cast<int>(std::min(whole(*value, key), 1e9));
  }

  void read_bounds() {
    const Json* value = find("bounds");
    if (value == nullptr) return;
    const auto number = [&](std::size_t k) {
      return (*value)[k].is_number() ? (*value)[k].get<double>() : NAN;
    };
    if (!value->is_array() || value->size() != 4 ||
        !std::isfinite(number(0) + number(1) + number(2) + number(3)))
      fail("bounds", "is not a list of four numbers: west, south, east, north");
    layer_.bounds_deg = {number(0), number(1), number(2), number(3)};
  }

  void read_extensions() {
    const Json* value = find("extensions");
    if (value == nullptr) return;
    if (!value->is_array()) fail("extensions", "is no list");
    for (const Json& extension : *value) {
      if (!extension.is_string()) fail("extensions", "holds something else than text");
      layer_.extensions.push_back(extension.get<std::string>());
    }
  }

  void read_templates() {
    const Json* value = find("tiles");
    if (value == nullptr || !value->is_array() || value->empty() || !value->front().is_string()) return;
    const auto& url = value->front().get_ref<const std::string&>();
    if (url.find("{z}/{x}/{y}.terrain") == std::string::npos)
      note(fmt::format(
          "layer.json asks for tiles as '{}'; files are taken as {{z}}/{{x}}/{{y}}.terrain all the same",
          one_line(url, 80)));
  }

  void read_available() {
    if (find("metadataAvailability") != nullptr)
      note("some availability is inside the tiles (metadataAvailability), which is not looked into");
    const Json* value = find("available");
    if (value == nullptr) {
      note("layer.json has no available: nothing says which tiles should be there");
      return;
    }
    if (!value->is_array()) fail("available", "is no list of levels");
    layer_.advertises = true;
    for (std::size_t k = 0; k < value->size(); ++k) {
      const std::string place = fmt::format("available[{}]", k);
      const Json& ranges = (*value)[k];
      if (!ranges.is_array()) fail(place, "is no list of ranges");
      if (!ranges.empty() && k > static_cast<std::size_t>(kDeepestTileLevel))
        fail(place, fmt::format("is deeper than level {}, where reading ends", kDeepestTileLevel));
      for (const Json& range : ranges)
        layer_.available.push_back(range_of(range, static_cast<int>(k), place));
    }
  }

  TileRange range_of(const Json& entry, int at, const std::string& place) const {
    const auto end = [&](const char* key) {
      const auto found = entry.is_object() ? entry.find(key) : entry.end();
      if (!entry.is_object() || found == entry.end())
        fail(place, "has a range without startX, startY, endX and endY");
      return static_cast<std::uint32_t>(whole(*found, fmt::format("{}.{}", place, key)));
    };
    const TileRange range{at, end("startX"), end("startY"), end("endX"), end("endY")};
    if (range.east < range.west || range.last_y < range.first_y ||
        !layer_.grid.contains({at, range.east, range.last_y}))
      fail(place,
           fmt::format("has a range of x {} to {} and y {} to {}, of {} × {} tiles", range.west, range.east,
                       range.first_y, range.last_y, layer_.grid.columns(at), TileGrid::rows(at)));
    return range;
  }

  std::string name_;
  Json root_;
  TileLayer layer_;
};

/// The entries of a folder, by name; empty if it is none.
std::vector<std::filesystem::path> entries(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> out;
  std::error_code error;
  for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    out.push_back(at->path());
  if (error)
    throw InputError(
        fmt::format("cannot read the folder {}: {}", one_line(folder.string()), error.message()));
  std::sort(out.begin(), out.end());
  return out;
}

bool is_number(const std::filesystem::path& name) {
  const std::string text = name.string();
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

TileLayer parse_tile_layer(std::string_view json, std::string_view name) {
  return LayerReader(json, name).read();
}

TileSet read_tile_set(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw InputError(fmt::format("{}: is no folder of tiles", one_line(folder.string())));
  TileSet set;
  set.folder = folder;
  if (const auto layer = folder / "layer.json"; std::filesystem::exists(layer, error)) {
    set.layer = parse_tile_layer(read_whole_file(layer, "a layer.json"), layer.string());
  } else {
    set.layer.notes.emplace_back("there is no layer.json: EPSG:4326 and the scheme tms are assumed");
  }
  for (const auto& level : entries(folder)) {
    if (!is_number(level.filename()) || !std::filesystem::is_directory(level, error)) continue;
    for (const auto& column : entries(level)) {
      if (!std::filesystem::is_directory(column, error)) continue;
      for (const auto& file : entries(column)) {
        if (file.extension() != ".terrain") continue;
        const auto address = tile_address(file);
        if (address && set.layer.grid.contains(*address)) {
          set.tiles.push_back({*address, file});
        } else {
          set.misplaced.push_back(file);
        }
      }
    }
  }
  if (set.tiles.empty() && set.misplaced.empty())
    throw InputError(fmt::format("{}: holds no tile; tiles are <level>/<x>/<y>.terrain inside it",
                                 one_line(folder.string())));
  std::sort(set.tiles.begin(), set.tiles.end(),
            [](const TileFile& a, const TileFile& b) { return a.address < b.address; });
  std::sort(set.misplaced.begin(), set.misplaced.end());
  return set;
}

const TileFile* find_tile(const TileSet& set, const TileAddress& address) {
  const auto found =
      std::lower_bound(set.tiles.begin(), set.tiles.end(), address,
                       [](const TileFile& file, const TileAddress& wanted) { return file.address < wanted; });
  return found == set.tiles.end() || found->address != address ? nullptr : &*found;
}

}  // namespace plumbline
