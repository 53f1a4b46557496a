// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/source_reader.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/nearest.h"

namespace plumbline {
namespace {

constexpr std::int64_t kLargestSeed = std::numeric_limits<std::int64_t>::max();  // TOML integers end here

// The value that `text` names, or an InputError naming the nearest one.
template <class Value>
Value one_of(const TomlValue& value, std::initializer_list<std::pair<const char*, Value>> choices) {
  std::vector<std::string> names;
  for (const auto& [name, choice] : choices) {
    if (value.text() == name) return choice;
    names.emplace_back(name);
  }
  value.fail(fmt::format("is \"{}\"; did you mean \"{}\"?", one_line(value.text(), 80),
                         nearest_name(value.text(), names)));
}

void read_samples(const TomlValue& value, TerrainSource& source) {
  const auto& rows = value.array();
  if (rows.size() < 2 || rows.size() > kMostSamplesASide) {
    value.fail(fmt::format("has {} rows; give 2 to {}", rows.size(), kMostSamplesASide));
  }
  source.rows = static_cast<int>(rows.size());
  for (const TomlValue& row : rows) {
    const auto& samples = row.array();
    if (source.columns == 0) {
      if (samples.size() < 2 || samples.size() > kMostSamplesASide) {
        row.fail(fmt::format("has a row of {} samples; give 2 to {}", samples.size(), kMostSamplesASide));
      }
      source.columns = static_cast<int>(samples.size());
    }
    if (samples.size() != static_cast<std::size_t>(source.columns)) {
      row.fail(
          fmt::format("has rows of {} and {} samples; make all rows equal", source.columns, samples.size()));
    }
    for (const TomlValue& sample : samples) source.samples.push_back(sample.number());
  }
}

// The keys that do not apply to the source that was chosen are refused by name, not ignored.
void refuse(const TomlTable& table, std::initializer_list<const char*> keys, std::string_view kind) {
  for (const char* key : keys) {
    const TomlValue* value = table.find(key);
    if (value != nullptr) value->fail(fmt::format("does not apply to {}; leave it out", kind));
  }
}

}  // namespace

TerrainSource read_terrain_source(const TomlTable& table, const std::filesystem::path& folder) {
  table.allow_only({"id", "file", "points", "generator", "samples", "seed", "size", "spacing_m", "relief_m",
                    "z_scale", "holes", "fit", "constraints"});
  TerrainSource source;
  source.id = table.at("id").text();
  const TomlValue* file = table.find("file");
  const TomlValue* points = table.find("points");
  const TomlValue* generator = table.find("generator");
  const TomlValue* samples = table.find("samples");
  if ((file != nullptr) + (points != nullptr) + (generator != nullptr) + (samples != nullptr) != 1) {
    table.fail(fmt::format("{} needs exactly one of 'file', 'points', 'generator', 'samples'", table.name()));
  }
  if (file != nullptr) {
    if (file->text().empty()) file->fail("is empty; give a raster's path");
    source.file = (folder / file->text()).lexically_normal();
    refuse(table, {"seed", "relief_m"}, "a file");
  } else if (points != nullptr) {
    if (points->text().empty()) points->fail("is empty; give the path of a vector file of points");
    source.points = (folder / points->text()).lexically_normal();
    refuse(table, {"seed", "relief_m", "fit"}, "points");
  } else if (generator != nullptr) {
    source.generator = generator->text();
    std::vector<std::string> names;
    for (const GeneratorDescription& known : terrain_generators()) names.push_back(known.name);
    if (std::find(names.begin(), names.end(), source.generator) == names.end()) {
      generator->fail(fmt::format("is \"{}\"; did you mean \"{}\"?", one_line(source.generator, 80),
                                  nearest_name(source.generator, names)));
    }
    refuse(table, {"holes", "fit"}, "a generator");
  } else {
    read_samples(*samples, source);
    refuse(table, {"seed", "relief_m", "holes"}, "inline samples");
  }

  source.seed = static_cast<std::uint64_t>(table.integer_or("seed", 0, kLargestSeed, 1));
  if (const TomlValue* size = table.find("size")) {
    const bool native = size->is_text();
    if (native && (size->text() != "native" || generator != nullptr)) {
      size->fail(fmt::format("is \"{}\"; give an integer{}", one_line(size->text(), 80),
                             generator != nullptr ? "" : " or \"native\""));
    }
    if (!native) source.size = static_cast<int>(size->integer_in(2, kMostSamplesASide));
  }
  if (const TomlValue* spacing = table.find("spacing_m")) {
    source.spacing_m = spacing->number_in(kLeastSpacingM, kLargestSpacingM);
  }
  if (const TomlValue* relief = table.find("relief_m")) source.relief_m = relief->number_in(0, kHighestM);
  if (const TomlValue* scale = table.find("z_scale")) {
    source.z_scale = scale->number_in(-kHighestM, kHighestM);
  }
  if (const TomlValue* holes = table.find("holes")) {
    source.holes = one_of<HolePolicy>(
        *holes, {{"refuse", HolePolicy::refuse}, {"crop", HolePolicy::crop}, {"fill", HolePolicy::fill}});
  }
  if (const TomlValue* fit = table.find("fit")) {
    source.fit = one_of<FitRule>(*fit, {{"resample", FitRule::resample}, {"crop", FitRule::crop}});
    if (source.fit == FitRule::crop && !source.size) fit->fail("needs a size; say how many samples to keep");
    if (source.fit == FitRule::crop && source.spacing_m && file != nullptr) {
      table.at("spacing_m").fail("contradicts fit = \"crop\", which keeps the raster's own; leave one out");
    }
  }
  if (const TomlValue* constraints = table.find("constraints")) {
    if (constraints->text().empty())
      constraints->fail("is empty; give a file of road polylines, or \"generated\"");
    source.generated_roads = constraints->text() == "generated";
    if (!source.generated_roads) source.constraints = (folder / constraints->text()).lexically_normal();
  }
  return source;
}

std::vector<CameraPose> read_poses(const TomlValue& value) {
  std::vector<CameraPose> poses;
  const auto point = [](const TomlValue& coordinates) {
    const std::vector<double> v = coordinates.numbers(3);
    return Vec3{v[0], v[1], v[2]};
  };
  for (const TomlValue& element : value.array()) {
    const TomlTable& pose = element.table();
    pose.allow_only({"position", "look_at"});
    poses.push_back({point(pose.at("position")), point(pose.at("look_at"))});
  }
  if (poses.empty()) value.fail("is empty; give at least one { position = [x,y,z], look_at = [x,y,z] }");
  return poses;
}

MeshSource read_mesh_source(const TomlTable& table, const std::filesystem::path& folder) {
  table.allow_only({"id", "file", "generator", "at", "scale", "cut_to_manifold"});
  MeshSource source;
  source.id = table.at("id").text();
  const TomlValue* file = table.find("file");
  const TomlValue* generator = table.find("generator");
  if ((file != nullptr) == (generator != nullptr))
    table.fail(fmt::format("{} needs exactly one of 'file', 'generator'", table.name()));
  if (file != nullptr) {
    if (file->text().empty()) file->fail("is empty; give the path of a PLY, OBJ, OFF or STL file");
    source.file = (folder / file->text()).lexically_normal();
  } else {
    source.generator = generator->text();
    std::vector<std::string> names;
    for (const MeshGenerator& known : mesh_generators()) names.push_back(known.name);
    if (std::find(names.begin(), names.end(), source.generator) == names.end()) {
      generator->fail(fmt::format("is \"{}\"; did you mean \"{}\"?", one_line(source.generator, 80),
                                  nearest_name(source.generator, names)));
    }
  }
  if (const TomlValue* at = table.find("at")) {
    for (const TomlValue& place : at->array()) {
      const std::vector<double> v = place.numbers(3);
      source.at.push_back({v[0], v[1], v[2]});
    }
    if (source.at.empty() || source.at.size() > kMostCopies)
      at->fail(fmt::format("has {} places; give 1 to {}, each [x, y, z]", source.at.size(), kMostCopies));
  }
  if (const TomlValue* cut = table.find("cut_to_manifold")) {
    if (source.file.empty()) cut->fail("does not apply to a generator; leave it out");
    source.cut_to_manifold = cut->boolean();
  }
  if (const TomlValue* scale = table.find("scale"))
    source.scale = scale->number_in(kLeastScale, kLargestScale);
  return source;
}

TrajectorySpec read_trajectory(const TomlTable& table, Subject around) {
  table.allow_only({"id", "kind", "around", "frames", "height_m", "distance_m", "distance_radii", "jitter_px",
                    "hold_frames", "seed", "poses"});
  TrajectorySpec spec;
  spec.id = table.at("id").text();
  spec.around = around;
  if (const TomlValue* chosen = table.find("around"))
    spec.around = one_of<Subject>(*chosen, {{"terrain", Subject::terrain}, {"mesh", Subject::mesh}});
  const bool mesh = spec.around == Subject::mesh;
  const TomlValue& kind = table.at("kind");
  spec.kind = kind.text();
  std::vector<std::string> names;
  const TrajectoryKind* chosen = nullptr;
  for (const TrajectoryKind& known : mesh ? trajectory_kinds_around_mesh() : trajectory_kinds()) {
    names.push_back(known.name);
    if (known.name == spec.kind) chosen = &known;
  }
  const auto& over_terrain = trajectory_kinds();
  if (chosen == nullptr && mesh &&
      std::any_of(over_terrain.begin(), over_terrain.end(),
                  [&](const TrajectoryKind& known) { return known.name == spec.kind; })) {
    kind.fail(fmt::format("is \"{}\", which flies over terrains only; around a mesh there are {}", spec.kind,
                          fmt::join(names, ", ")));
  }
  if (chosen == nullptr) {
    kind.fail(fmt::format("is \"{}\"; did you mean \"{}\"?", one_line(spec.kind, 80),
                          nearest_name(spec.kind, names)));
  }
  for (const auto& [key, value] : table.entries()) {
    if (key == "id" || key == "kind" || key == "around") continue;
    if (std::find(chosen->keys.begin(), chosen->keys.end(), key) == chosen->keys.end()) {
      value.fail(fmt::format("does not apply to kind \"{}\"{}; leave it out", spec.kind,
                             mesh ? " around a mesh" : ""));
    }
  }
  if (spec.kind == "poses") {
    spec.poses = read_poses(table.at("poses"));
  } else {
    spec.frames = static_cast<int>(table.at("frames").integer_in(1, kMostFrames));
  }
  if (const TomlValue* height = table.find("height_m")) spec.height_m = height->positive();
  if (const TomlValue* distance = table.find("distance_m")) spec.distance_m = distance->positive();
  if (const TomlValue* distance = table.find("distance_radii")) {
    spec.distance_radii = distance->positive();
    if (!(spec.distance_radii > 1)) distance->fail("is within the object's ball; give more than 1");
  }
  if (const TomlValue* jitter = table.find("jitter_px")) spec.jitter_px = jitter->positive();
  if (const TomlValue* hold = table.find("hold_frames")) {
    spec.hold_frames = static_cast<int>(hold->integer_in(1, kMostFrames));
  }
  spec.seed = static_cast<std::uint64_t>(table.integer_or("seed", 0, kLargestSeed, 1));
  return spec;
}

}  // namespace plumbline
