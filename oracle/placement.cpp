// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "oracle/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "scenarios/dem.h"
#include "scenarios/placing.h"

namespace plumbline::oracle {
namespace {

using Kind = MisplacementKind;

constexpr double kFoot = 0.3048;  // metres; the survey foot differs by 2 in a million

/// Moves of vertices in sample units: swap x and y first, then scale and shift each; then heights.
struct Arrangement {
  bool swap = false;
  Vec2 scale{1, 1}, shift;
  double factor = 1, offset_m = 0;

  [[nodiscard]] Vec3 operator()(Vec3 p) const {
    if (swap) std::swap(p.x, p.y);
    return {p.x * scale.x + shift.x, p.y * scale.y + shift.y, p.z * factor + offset_m};
  }
};

struct Fit {
  double rms_m = std::numeric_limits<double>::infinity();
  std::size_t vertices = 0;
  double relief_m = 0;  ///< standard deviation of the DEM's heights there: what a level plane would be off
};

struct Alternative {
  Misplacement what;
  Arrangement arrangement;
  Fit fit;
};

class Search {
 public:
  Search(std::span<const Vec3> vertices, const Terrain& terrain, std::span<const std::uint8_t> has_data)
      : terrain_(terrain), has_data_(has_data) {
    const double spacing_m = terrain.spacing_m;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    low_ = {kInfinity, kInfinity};
    high_ = {-kInfinity, -kInfinity};
    for (const Vec3& p : vertices) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
      low_ = {std::min(low_.x, p.x / spacing_m), std::min(low_.y, p.y / spacing_m)};
      high_ = {std::max(high_.x, p.x / spacing_m), std::max(high_.y, p.y / spacing_m)};
    }
    for (const std::size_t k : spread_indices(vertices.size(), kMisplacementSample)) {
      const Vec3& p = vertices[k];
      if (std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) {
        vertices_.push_back({p.x / spacing_m, p.y / spacing_m, p.z});
      }
    }
    for (const std::size_t k : spread_indices(vertices_.size(), kMisplacementScout)) {
      scouts_.push_back(vertices_[k]);
    }
    given_ = fit(vertices_, {});
  }

  std::optional<Misplacement> best();

 private:
  [[nodiscard]] std::optional<double> height(Vec3 p) const {
    return height_where_data_m(terrain_, has_data_, {p.x, p.y});
  }
  [[nodiscard]] Fit fit(const std::vector<Vec3>& vertices, const Arrangement& arrangement) const;
  void consider(Misplacement what, const Arrangement& arrangement);
  void consider(Misplacement what, const Arrangement& arrangement, const Fit& fit);
  [[nodiscard]] bool worth_a_search() const;
  void try_symmetries();
  void try_heights();
  void try_cells_for_samples();
  void try_shifts();

  const Terrain& terrain_;
  std::span<const std::uint8_t> has_data_;
  std::vector<Vec3> vertices_, scouts_;  // plan in samples
  Vec2 low_, high_;                      // the box of all vertices
  Fit given_;
  std::optional<Alternative> best_;
};

Fit Search::fit(const std::vector<Vec3>& vertices, const Arrangement& arrangement) const {
  Fit fit;
  double squares = 0, ground_sum = 0, ground_squares = 0;
  const double datum_m = terrain_.heights_m.front();
  for (const Vec3& vertex : vertices) {
    const Vec3 p = arrangement(vertex);
    const std::optional<double> ground = height(p);
    if (!ground) continue;
    squares += (p.z - *ground) * (p.z - *ground);
    ground_sum += *ground - datum_m;
    ground_squares += (*ground - datum_m) * (*ground - datum_m);
    ++fit.vertices;
  }
  if (fit.vertices == 0) return fit;
  const auto count = static_cast<double>(fit.vertices);
  fit.rms_m = std::sqrt(squares / count);
  fit.relief_m =
      std::sqrt(std::max(0.0, ground_squares / count - (ground_sum / count) * (ground_sum / count)));
  return fit;
}

void Search::consider(Misplacement what, const Arrangement& arrangement) {
  consider(std::move(what), arrangement, fit(vertices_, arrangement));
}

void Search::consider(Misplacement what, const Arrangement& arrangement, const Fit& fit) {
  if (fit.vertices < kMisplacementVertices || 2 * fit.vertices < given_.vertices) return;
  if (!(fit.rms_m <= kMisplacementShare * given_.rms_m)) return;
  constexpr double kBetter = 0.9;
  constexpr double kRounding = 0x1p-30;  // of the given one: two exact fits differ by roundings only
  // Any surface, lifted to the DEM's mean, is better than the same elsewhere, and matches nothing.
  constexpr double kLikeness = 0.5;
  if (fit.rms_m > kLikeness * fit.relief_m + kRounding * given_.rms_m) return;
  const bool of_a_kind = best_ && best_->what.kind == what.kind;
  if (best_ && !(fit.rms_m < (of_a_kind ? 1 : kBetter) * best_->fit.rms_m - kRounding * given_.rms_m)) return;
  best_ = Alternative{std::move(what), arrangement, fit};
}

bool Search::worth_a_search() const {
  if (given_.vertices < kMisplacementVertices) return false;
  double squares = 0, highest = 0;
  std::size_t steps = 0;
  const auto step = [&](std::size_t from, std::size_t to) {
    if (!has_data_.empty() && (has_data_[from] == 0 || has_data_[to] == 0)) return;
    const double rise = terrain_.heights_m[to] - terrain_.heights_m[from];
    highest = std::max({highest, std::fabs(terrain_.heights_m[from]), std::fabs(terrain_.heights_m[to])});
    squares += rise * rise;
    ++steps;
  };
  for (int j = 0; j < terrain_.rows; ++j) {
    for (int i = 0; i < terrain_.columns; ++i) {
      if (i + 1 < terrain_.columns) step(terrain_.index(i, j), terrain_.index(i + 1, j));
      if (j + 1 < terrain_.rows) step(terrain_.index(i, j), terrain_.index(i, j + 1));
    }
  }
  const double step_m = steps == 0 ? 0 : std::sqrt(squares / static_cast<double>(steps));
  return given_.rms_m > 0 && given_.rms_m >= step_m / 8 && given_.rms_m >= kMisplacementNoise * highest;
}

void Search::try_symmetries() {
  const auto consider_one = [&](Kind kind, bool swap, bool flip_x, bool flip_y) {
    for (const auto& [low, high] :
         {std::pair{Vec2{}, Vec2{terrain_.columns - 1.0, terrain_.rows - 1.0}}, std::pair{low_, high_}}) {
      const double east = high.x - low.x, north = high.y - low.y;
      if (!(east > 0 && north > 0)) continue;
      Arrangement a;
      a.swap = swap;
      a.scale = swap ? Vec2{east / north, north / east} : Vec2{1, 1};
      if (flip_x) a.scale.x = -a.scale.x;
      if (flip_y) a.scale.y = -a.scale.y;
      const Vec2 from = swap ? Vec2{low.y, low.x} : low;  // what the swap makes of the box's corner
      a.shift = {(flip_x ? high.x : low.x) - a.scale.x * from.x,
                 (flip_y ? high.y : low.y) - a.scale.y * from.y};
      consider({.kind = kind}, a);
    }
  };
  consider_one(Kind::rows_flipped, false, false, true);
  consider_one(Kind::columns_flipped, false, true, false);
  consider_one(Kind::rotated_180, false, true, true);
  consider_one(Kind::transposed, true, true, true);
  consider_one(Kind::anti_transposed, true, false, false);
  consider_one(Kind::rotated_90, true, true, false);
  consider_one(Kind::rotated_270, true, false, true);
}

void Search::try_heights() {
  double error_sum = 0, products = 0, squares = 0;
  for (const Vec3& p : vertices_) {
    const std::optional<double> ground = height(p);
    if (!ground) continue;
    error_sum += p.z - *ground;
    products += p.z * *ground;
    squares += p.z * p.z;
  }
  const double offset_m = -error_sum / static_cast<double>(given_.vertices);
  Arrangement lifted;
  lifted.offset_m = offset_m;
  consider({.kind = Kind::height_offset, .offset_m = offset_m}, lifted);
  const auto scale = [&](double factor) {
    Arrangement scaled;
    scaled.factor = factor;
    consider({.kind = Kind::height_factor, .factor = factor}, scaled);
  };
  scale(kFoot);
  scale(1 / kFoot);
  constexpr double kSame = 1e-5;  // no better factor than a foot if it is one: it fits roundings
  const double best = products / squares;
  const auto is_near = [&](double factor) { return std::fabs(best / factor - 1) <= kSame; };
  if (squares > 0 && best > 0 && !is_near(kFoot) && !is_near(1 / kFoot)) scale(best);
}

void Search::try_cells_for_samples() {
  const double columns = terrain_.columns, rows = terrain_.rows;
  const Vec2 last{columns - 1, rows - 1};
  struct Stay {  // the point that stays where it is, as a share of the rectangle
    double x, y;
  };
  for (const bool shrink : {true, false}) {
    const Vec2 scale = shrink ? Vec2{last.x / columns, last.y / rows} : Vec2{columns / last.x, rows / last.y};
    for (const Stay stay : {Stay{0.5, 0.5}, Stay{0, 0}, Stay{0, 1}}) {
      Arrangement a;
      a.scale = scale;
      a.shift = {stay.x * last.x * (1 - scale.x), stay.y * last.y * (1 - scale.y)};
      consider({.kind = Kind::cells_for_samples, .factor = scale.x}, a);
    }
  }
}

/// Half samples everywhere in the window with few vertices, then the most promising with all.
void Search::try_shifts() {
  constexpr int kHalves = 2 * kMisplacementWindow;
  constexpr std::size_t kPromising = 16;
  struct Shift {
    double rms_m;
    int x, y;  // half samples
    [[nodiscard]] int length2() const { return x * x + y * y; }
  };
  std::vector<Shift> shifts;
  const auto moved = [](const Shift& s) {
    Arrangement a;
    a.shift = {0.5 * s.x, 0.5 * s.y};
    return a;
  };
  for (int y = -kHalves; y <= kHalves; ++y) {
    for (int x = -kHalves; x <= kHalves; ++x) {
      if (x == 0 && y == 0) continue;
      Shift shift{0, x, y};
      const Fit found = fit(scouts_, moved(shift));
      // Few vertices may agree by chance: as many as half must lie over the terrain.
      if (2 * found.vertices < scouts_.size()) continue;
      shift.rms_m = found.rms_m;
      shifts.push_back(shift);
    }
  }
  const std::size_t kept = std::min(shifts.size(), kPromising);
  std::partial_sort(shifts.begin(), shifts.begin() + static_cast<std::ptrdiff_t>(kept), shifts.end(),
                    [](const Shift& a, const Shift& b) {
                      if (a.rms_m != b.rms_m) return a.rms_m < b.rms_m;
                      if (a.length2() != b.length2()) return a.length2() < b.length2();
                      return a.y != b.y ? a.y < b.y : a.x < b.x;
                    });
  shifts.resize(kept);
  for (const Shift& shift : shifts) {
    const Arrangement a = moved(shift);
    consider({.kind = Kind::shifted, .shift = a.shift}, a);
  }
}

/// Three digits, for people.
std::string in_metres(double metres) {
  const double size = std::fabs(metres);
  constexpr double kLeastShown = 1e-4;
  if (size > 0 && size < kLeastShown) return fmt::format("under {} m", kLeastShown);
  return size >= 100 ? fmt::format("{:.0f} m", metres) : fmt::format("{:.3g} m", metres);
}

std::string remedy(const Misplacement& m) {
  const auto towards = [](double samples, const char* positive, const char* negative) {
    return fmt::format("{} {} {}", std::fabs(samples), std::fabs(samples) == 1 ? "sample" : "samples",
                       samples > 0 ? positive : negative);
  };
  switch (m.kind) {
    case Kind::rows_flipped:
      return "rows are flipped (north and south swapped)";
    case Kind::columns_flipped:
      return "columns are flipped (east and west swapped)";
    case Kind::rotated_180:
      return "rotated by 180 degrees (rows and columns flipped)";
    case Kind::transposed:
      return "transposed (rows and columns of the file swapped: mirrored along the diagonal from north-west "
             "to "
             "south-east)";
    case Kind::anti_transposed:
      return "transposed with rows counted from the south (mirrored along the diagonal from south-west to "
             "north-east)";
    case Kind::rotated_90:
      return "rotated by 90 degrees counter-clockwise, seen from above";
    case Kind::rotated_270:
      return "rotated by 90 degrees clockwise, seen from above";
    case Kind::height_offset:
      return fmt::format("{} by {}", m.offset_m > 0 ? "lifted" : "lowered", in_metres(std::fabs(m.offset_m)));
    case Kind::height_factor:
      if (m.factor == kFoot) return "heights are multiplied by 0.3048 (feet taken for metres)";
      if (m.factor == 1 / kFoot) return "heights are divided by 0.3048 (metres taken for feet)";
      return fmt::format("heights are multiplied by {:.4g}", m.factor);
    case Kind::cells_for_samples:
      return fmt::format("{} by {:.6g} in plan (n samples taken for n cells: {})",
                         m.factor < 1 ? "shrunk" : "stretched", m.factor,
                         m.factor < 1 ? "n samples span n - 1 steps" : "its steps are one in n too short");
    case Kind::shifted: {
      std::string way;
      if (m.shift.x != 0) way = towards(m.shift.x, "east", "west");
      if (m.shift.y != 0) way += (way.empty() ? "" : " and ") + towards(m.shift.y, "north", "south");
      return "moved " + way;
    }
  }
  return {};
}

std::optional<Misplacement> Search::best() {
  if (!worth_a_search()) return {};
  try_symmetries();
  try_heights();
  try_cells_for_samples();
  try_shifts();
  if (!best_) return {};
  Misplacement found = best_->what;
  found.rms_m = best_->fit.rms_m;
  found.given_rms_m = given_.rms_m;
  found.vertices = given_.vertices;
  found.words = fmt::format("matches if {}: RMS {} instead of {}", remedy(found), in_metres(found.rms_m),
                            in_metres(found.given_rms_m));
  return found;
}

}  // namespace

std::string_view misplacement_name(MisplacementKind kind) {
  switch (kind) {
    case Kind::rows_flipped:
      return "rows_flipped";
    case Kind::columns_flipped:
      return "columns_flipped";
    case Kind::rotated_180:
      return "rotated_180";
    case Kind::transposed:
      return "transposed";
    case Kind::anti_transposed:
      return "anti_transposed";
    case Kind::rotated_90:
      return "rotated_90";
    case Kind::rotated_270:
      return "rotated_270";
    case Kind::height_offset:
      return "height_offset";
    case Kind::height_factor:
      return "height_factor";
    case Kind::cells_for_samples:
      return "cells_for_samples";
    case Kind::shifted:
      return "shifted";
  }
  return "";
}

std::optional<Misplacement> recognise_misplacement(std::span<const Vec3> vertices, const Terrain& terrain,
                                                   std::span<const std::uint8_t> has_data) {
  return Search(vertices, terrain, has_data).best();
}

}  // namespace plumbline::oracle
