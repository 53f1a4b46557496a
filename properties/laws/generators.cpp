// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "properties/laws/generators.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <rapidcheck.h>

#include "scenarios/error.h"

namespace plumbline::properties {
namespace {

/// Draws from RapidCheck generators, each from a split of its own: a splittable generator (threefish) whose
/// output is specified. Only whole numbers and choices are drawn; doubles are made of them.
class Draw {
 public:
  explicit Draw(const rc::Random& random) : random_(random) {}
  template <typename T>
  T operator()(const rc::Gen<T>& gen) {
    return gen(random_.split()).value();
  }
  /// Uniform in [low, high].
  int whole(int low, int high) { return (*this)(rc::gen::inRange(low, high + 1)); }
  template <typename T>
  T one_of(const std::vector<T>& choices) {
    return (*this)(rc::gen::elementOf(choices));
  }
  bool chance(int percent) { return whole(0, 99) < percent; }

 private:
  rc::Random random_;
};

// ---- terrain
// -----------------------------------------------------------------------------------------------------

/// Samples a side, and clusters along x and y for the methods that take several.
struct Extent {
  int columns, rows;
  int cluster_samples;  ///< 0: leave the option at its default
};

bool has_option(const MethodDescription& method, std::string_view name) {
  return std::any_of(method.options.begin(), method.options.end(),
                     [&](const OptionDescription& o) { return o.name == name; });
}

Extent draw_extent(Draw& draw, const MethodDescription& method) {
  const int side = draw(rc::gen::weightedElement<int>({{3, 3}, {6, 5}, {5, 9}, {2, 17}, {1, 33}}));
  const auto takes = [&](std::string_view option) {
    return std::any_of(method.options.begin(), method.options.end(),
                       [&](const OptionDescription& o) { return o.name == option; });
  };
  // Tiles reach beyond the terrain where they do not fit: any size will do, and some should not fit.
  if (takes("tile_size") && draw.chance(50)) return {side + draw.whole(0, 4), side + draw.whole(0, 3), 0};
  const bool takes_clusters = takes("cluster_size");
  if (!takes_clusters || side > 9 || draw.chance(60)) return {side, side, 0};
  const int across = draw.whole(1, 3);
  const int along = across == 1 ? draw.whole(2, 3) : draw.whole(1, 2);
  return {(side - 1) * across + 1, (side - 1) * along + 1, draw.chance(50) ? side : 0};
}

/// Options of the method's own, where it has them; most trials keep the defaults, which the claims are about.
void draw_options(Draw& draw, const MethodDescription& method, const Extent& extent, Options& options) {
  if (extent.cluster_samples != 0) {
    if (has_option(method, "cluster_size")) options["cluster_size"] = double{1} * extent.cluster_samples;
    if (has_option(method, "patch_size")) options["patch_size"] = double{1} * (extent.cluster_samples - 1);
  }
  for (const OptionDescription& option : method.options) {
    if (option.name == "depth_ratio" && draw.chance(15))
      options[option.name] = draw.one_of<double>({0.05, 0.2, 0.5});
    if (option.name == "block_size" && draw.chance(60)) options[option.name] = draw.one_of<double>({3, 5, 9});
    if (option.name == "tile_size" && draw.chance(80)) options[option.name] = draw.one_of<double>({3, 5, 9});
    if (option.name == "max_nodes" && draw.chance(20))
      options[option.name] = draw.one_of<double>({1, 4, 7, 16, 40});
    if (option.name == "cull" && draw.chance(30)) options[option.name] = false;
  }
}

/// Rings of a few cells: the paper's are wider than a drawn terrain, which would lie in the finest one. Drawn
/// after the spacing, of which they are multiples.
void draw_rings(Draw& draw, const MethodDescription& method, double spacing_m, Options& options) {
  const bool has_rings = std::any_of(method.options.begin(), method.options.end(),
                                     [](const OptionDescription& o) { return o.name == "rings_m"; });
  if (!has_rings) return;
  struct Choice {
    std::vector<double> cells;
    const char* delta_px;
  };
  static const std::vector<Choice> kChoices{
      {{0.5, 1.5}, "0 1"}, {{0.5, 2, 4}, "0 1 1.2"}, {{1, 3}, "0.5 1"}, {{0.5, 8}, "0 1"}, {{1}, "1"}};
  const Choice choice = draw.one_of(kChoices);
  std::string rings;
  for (const double cells : choice.cells) {
    rings += fmt::format("{}{}", rings.empty() ? "" : " ", cells * spacing_m);
  }
  options["rings_m"] = rings;
  options["delta_px"] = std::string(choice.delta_px);
  if (draw.chance(20)) options["depth_cap"] = draw.one_of<double>({2, 4, 5, 10});
}

struct Grid {
  Terrain terrain;
  void set(int i, int j, double z) { terrain.heights_m[terrain.index(i, j)] = z; }
  void add(int i, int j, double z) { terrain.heights_m[terrain.index(i, j)] += z; }
  template <typename F>
  void each(F&& height) {
    for (int j = 0; j < terrain.rows; ++j) {
      for (int i = 0; i < terrain.columns; ++i) set(i, j, height(i, j));
    }
  }
};

void draw_heights(Draw& draw, const std::string& shape, Grid& grid) {
  Terrain& terrain = grid.terrain;
  // Slopes are in units of a cell: 30 m a cell at 10 m spacing is 72°.
  const int spacing = static_cast<int>(terrain.spacing_m);
  const int steep = 3 * spacing + 2;
  const auto somewhere = [&] {
    return std::array<int, 2>{draw.whole(0, terrain.columns - 1), draw.whole(0, terrain.rows - 1)};
  };
  const auto plane = [&](int limit) {
    const int gx = draw.whole(-limit, limit), gy = draw.chance(50) ? 0 : draw.whole(-limit, limit);
    const int z0 = draw.chance(50) ? 0 : draw.whole(-20, 200);
    grid.each([&](int i, int j) { return double{1} * (z0 + gx * i + gy * j); });
  };
  if (shape == "bump") {
    const auto [i, j] = somewhere();
    grid.set(i, j, draw.whole(1, 3 * spacing));
  } else if (shape == "tilted_plane") {
    plane(std::max(1, spacing / 2));
  } else if (shape == "steep_ramp") {
    plane(steep);
  } else if (shape == "bump_on_ramp") {  // what M4.S1 needs: a small error on a steep slope
    plane(steep);
    const auto [i, j] = somewhere();
    grid.add(i, j, draw.whole(1, 5));
  } else if (shape == "spikes") {
    const int count = draw.whole(1, 3);
    for (int k = 0; k < count; ++k) {
      const auto [i, j] = somewhere();
      grid.set(i, j, draw.whole(-20 * spacing, 20 * spacing));
    }
  } else if (shape == "step") {
    const int at = draw.whole(1, terrain.columns - 1), height = draw.whole(1, 10 * spacing);
    const bool along_y = draw.chance(50);
    grid.each([&](int i, int j) { return (along_y ? j : i) >= at ? height : 0.0; });
  } else if (shape == "checkerboard") {
    const int amplitude = draw.whole(1, 3 * spacing);
    grid.each([&](int i, int j) { return (i + j) % 2 == 0 ? 0.0 : amplitude; });
  } else {  // noise
    const int amplitude = draw.one_of<int>({1, spacing, 8 * spacing});
    grid.each([&](int, int) { return double{1} * draw.whole(-amplitude, amplitude); });
  }
}

// ---- camera
// ------------------------------------------------------------------------------------------------------

/// Whole metres: nothing of a pose is rounded, and shrinking counts down.
Vec3 whole(double x, double y, double z) { return {std::floor(x), std::floor(y), std::floor(z)}; }

CameraPose draw_pose(Draw& draw, const std::string& kind, const Terrain& terrain) {
  const double extent = std::max(terrain.width_m(), terrain.depth_m());
  const int range = static_cast<int>(extent) + 1;
  const auto ground_point = [&] {
    // One draw a statement: arguments are evaluated in an order that each compiler chooses.
    const int i = draw.whole(0, terrain.columns - 1);
    const int j = draw.whole(0, terrain.rows - 1);
    return terrain.point(i, j);
  };
  const Vec3 target = ground_point();
  Vec3 position;
  if (kind == "nadir") {
    position = {target.x, target.y, target.z + std::floor(draw.whole(1, 80) * terrain.spacing_m)};
  } else if (kind == "above") {
    const Vec3 below = ground_point();
    position = {below.x + draw.whole(-range, range), below.y + draw.whole(-range, range),
                terrain.highest_m() + draw.whole(1, 8 * range)};
  } else if (kind == "near") {
    const Vec3 below = ground_point();
    position = {below.x, below.y, below.z + draw.whole(1, 3)};
  } else if (kind == "grazing") {
    const int away = draw.whole(1, 20 * range);
    position = {draw.chance(50) ? -double{1} * away : terrain.width_m() + away, target.y,
                target.z + draw.whole(0, 3)};
  } else if (kind == "far") {
    position = {target.x + draw.whole(-100, 100) * range, target.y + draw.whole(-100, 100) * range,
                terrain.highest_m() + draw.whole(10, 200) * range};
  } else if (kind == "along_slope") {
    // On the line through a sample and its neighbour: nothing sets depths of neighbours further apart.
    const int i = draw.whole(0, terrain.columns - 2), j = draw.whole(0, terrain.rows - 1);
    const bool ahead = draw.chance(50);
    const Vec3 a = terrain.point(ahead ? i : i + 1, j), b = terrain.point(ahead ? i + 1 : i, j);
    const Vec3 toward = b - a;
    position = a - toward * draw.whole(1, 60);
    return {position, position + toward};
  } else {  // away: the terrain is behind the camera or beside the picture
    const Vec3 below = ground_point();
    position = {below.x, below.y, terrain.highest_m() + draw.whole(1, 2 * range)};
    const Vec3 ahead{position.x + draw.whole(-range, range), position.y, position.z + draw.whole(1, range)};
    return {whole(position.x, position.y, position.z), whole(ahead.x, ahead.y, ahead.z)};
  }
  CameraPose pose{whole(position.x, position.y, position.z), whole(target.x, target.y, target.z)};
  if (pose.position == pose.look_at) pose.position.z += 1;
  return pose;
}

// ---- threshold
// ---------------------------------------------------------------------------------------------------

/// A threshold at which some sample's second difference, seen from the judged camera, is just worth a split:
/// split tests are then decided by little, and nodes stand on both sides.
std::optional<double> draw_decisive_threshold(Draw& draw, const LawInput& input) {
  const Terrain& terrain = input.terrain;
  const CameraPose& pose = input.poses.back();
  const Camera camera =
      make_camera(pose.position, pose.look_at, input.fov_y_deg, input.width_px, input.height_px);
  for (int attempt = 0; attempt < 8; ++attempt) {
    const int i = draw.whole(1, terrain.columns - 2), j = draw.whole(0, terrain.rows - 1);
    const double error_m = std::fabs(terrain.z(i, j) - (terrain.z(i - 1, j) + terrain.z(i + 1, j)) / 2);
    const double depth_m = camera.depth(terrain.point(i, j));
    if (error_m > 0 && depth_m > 0) {
      // A little below 1 the sample is worth a split by a margin of less than q − 1.
      const double factor = draw.one_of<double>({1, 0.984375, 0.984375, 0.984375, 0.9375, 1.0625, 0.5, 2});
      return error_m * camera.kappa_px / depth_m * factor;
    }
  }
  return std::nullopt;
}

/// The pixels of a picture and its field of view; 90° makes κ half the height.
void draw_picture(Draw& draw, LawInput& input) {
  struct Picture {
    double fov_y_deg;
    int width_px, height_px;
  };
  static const std::vector<Picture> kPictures{{90, 200, 200}, {60, 1280, 720}, {120, 64, 64}, {20, 640, 480}};
  const Picture picture = draw.one_of(kPictures);
  input.fov_y_deg = picture.fov_y_deg;
  input.width_px = picture.width_px;
  input.height_px = picture.height_px;
}

DrawnCase draw_whole_case(const std::string& method_id, const rc::Random& random) {
  Draw draw(random);
  const MethodChoice choice = find_method(method_id);
  DrawnCase drawn;
  LawInput& input = drawn.input;
  input.method = method_id;

  const Extent extent = draw_extent(draw, *choice.method);
  draw_options(draw, *choice.method, extent, input.options);

  Grid grid;
  grid.terrain.id = "drawn";
  grid.terrain.columns = extent.columns;
  grid.terrain.rows = extent.rows;
  grid.terrain.spacing_m = draw.one_of<int>({1, 2, 10, 30});
  grid.terrain.heights_m.assign(
      static_cast<std::size_t>(extent.columns) * static_cast<std::size_t>(extent.rows), 0.0);
  // The shape that M4.S1 needs is drawn more often; so are the cameras that set neighbours' depths apart.
  drawn.terrain_shape = draw.chance(25) ? "bump_on_ramp" : draw.one_of(terrain_shapes());
  draw_heights(draw, drawn.terrain_shape, grid);
  input.terrain = std::move(grid.terrain);
  draw_rings(draw, *choice.method, input.terrain.spacing_m, input.options);

  draw_picture(draw, input);
  const int poses = draw.one_of<int>({1, 2, 2, 3, 4});
  for (int k = 0; k < poses; ++k) {
    drawn.camera_class = draw.chance(20)   ? "nadir"
                         : draw.chance(25) ? "along_slope"
                                           : draw.one_of(camera_classes());
    input.poses.push_back(draw_pose(draw, drawn.camera_class, input.terrain));
  }

  drawn.threshold_class = draw.chance(70) ? "decisive" : "any";
  if (drawn.threshold_class == "decisive") {
    if (const auto threshold_px = draw_decisive_threshold(draw, input)) {
      input.threshold_px = *threshold_px;
      return drawn;
    }
    drawn.threshold_class = "any";  // a plane, or all of it behind the camera
  }
  input.threshold_px = draw.one_of<double>({0.125, 0.5, 1, 2, 4, 16, 64});
  return drawn;
}

}  // namespace

const std::vector<std::string>& terrain_shapes() {
  static const std::vector<std::string> shapes{"bump",   "tilted_plane", "steep_ramp",   "bump_on_ramp",
                                               "spikes", "step",         "checkerboard", "noise"};
  return shapes;
}

const std::vector<std::string>& camera_classes() {
  static const std::vector<std::string> classes{"nadir", "above",       "near", "grazing",
                                                "far",   "along_slope", "away"};
  return classes;
}

const std::vector<std::string>& threshold_classes() {
  static const std::vector<std::string> classes{"decisive", "any"};
  return classes;
}

namespace {

/// Several patches, for the methods that sew patches together. Drawn on its own, so that no other draw moves.
void draw_patches(const rc::Random& random, LawInput& input) {
  const MethodDescription& method = *find_method(input.method).method;
  if (!has_option(method, "patch_size") || input.options.contains("patch_size")) return;
  Draw draw(random);
  const int side = draw.one_of<int>({2, 4, 8});
  const int cells = std::min(input.terrain.columns, input.terrain.rows) - 1;
  if (2 * side <= cells && draw.chance(35)) input.options["patch_size"] = double{1} * side;
}

}  // namespace

DrawnCase draw_case(const std::string& method, std::uint64_t seed, std::uint64_t index) {
  // Method, seed and index are the key itself, so that case k does not depend on the cases before it.
  std::uint64_t name = 0xcbf29ce484222325;  // FNV-1a
  for (const char c : method) name = (name ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  DrawnCase drawn = draw_whole_case(method, rc::Random(rc::Random::Key{seed, index, name, 0}));
  draw_patches(rc::Random(rc::Random::Key{seed, index, name, 1}), drawn.input);
  return drawn;
}

}  // namespace plumbline::properties
