// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The meshes over the DEM that they stand for: where they lie, how far they are off, whether a declared bound
// is true.
#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "oracle/error_map.h"
#include "oracle/placement.h"
#include "oracle/vertical.h"
#include "properties/check/against.h"
#include "scenarios/error.h"
#include "scenarios/placing.h"

namespace plumbline::checking {
namespace {

using oracle::Finding;
using oracle::FindingCode;

constexpr int kErrorMapPx = 1024;

Mesh surface_of(const Examination& exam) {
  Mesh out;
  for (const Subject& subject : exam.subjects) {
    if (subject.tile && !subject.tile->drawn) continue;
    const auto base = static_cast<std::uint32_t>(out.positions.size());
    const Mesh& surface = subject.sheet.surface;
    const auto count = static_cast<std::uint32_t>(surface.positions.size());
    if (subject.tile) {
      out.positions.insert(out.positions.end(), subject.places.begin(), subject.places.end());
    } else {
      for (Vec3 p : surface.positions) {
        p.z *= exam.frame.unit_m;
        out.positions.push_back(p);
      }
    }
    for (const auto& t : surface.triangles) {
      if (std::any_of(t.begin(), t.end(), [count](std::uint32_t v) { return v >= count; })) continue;
      out.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
      if (exam.frame.turned && !subject.tile) std::swap(out.triangles.back()[1], out.triangles.back()[2]);
    }
  }
  return out;
}

/// The vertices that triangles use: the feet of skirts do not lie on the ground.
std::vector<Vec3> used_vertices(const Mesh& mesh) {
  std::vector<bool> used(mesh.positions.size(), false);
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) used[v] = true;
  }
  std::vector<Vec3> out;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) out.push_back(mesh.positions[v]);
  }
  return out;
}

double plan_area(const Mesh& mesh) {
  double twice = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (std::isfinite(area)) twice += std::fabs(area);
  }
  return 0.5 * twice;
}

class AgainstTerrain {
 public:
  AgainstTerrain(Examination& exam, std::vector<verdict::CheckFinding>& findings)
      : exam_(exam), findings_(findings) {}

  void judge(Stage& stage, verdict::CheckPictures& pictures) {
    for (const Subject& subject : exam_.subjects) {
      if (!subject.facts.terrain)
        throw InputError(
            fmt::format("--terrain: {} is an object in space, no surface over a plan; --kind "
                        "terrain says otherwise",
                        one_line(subject.facts.file)));
      if (subject.tile && !subject.tile->placed)
        throw InputError(
            fmt::format("--terrain: {} does not say where it lies: its path must end in "
                        "level/x/y.terrain",
                        one_line(subject.facts.file)));
    }
    const Mesh mesh = surface_of(exam_);
    const CheckRequest& request = exam_.request;
    const std::array<const Mesh*, 1> meshes{&mesh};
    const bool tiles = exam_.subjects.front().tile.has_value();
    laid_ = lay_over_dem({request.terrain, request.holes},
                         tiles && request.placing == "guess" ? std::string("crs") : request.placing, meshes,
                         tiles ? 1 : exam_.frame.unit_m);
    const Dem& dem = laid_.dem;
    if (tiles && !dem.geographic)
      throw InputError(
          fmt::format("--terrain: {} is not in longitude and latitude, which tiles are; warp it: "
                      "gdalwarp -t_srs EPSG:4326",
                      one_line(request.terrain.string())));
    const Mesh placed = laid_over(mesh, laid_.placing, laid_.turned);
    const oracle::VerticalError error = oracle::vertical_error_where_data(placed, dem.samples, dem.has_data);
    verdict::TerrainVerdict& out = exam_.verdict.terrain.emplace();
    out.file = request.terrain.generic_string();
    out.diagonal_ambiguity_m = oracle::diagonal_ambiguity_m(dem.samples, dem.has_data);
    out.reading = reading_in_words(dem, out.diagonal_ambiguity_m);
    out.placing = tiles ? "by the tiles' own longitude and latitude" : laid_.words;
    out.vertical_m = error;
    out.vertical_m.area_m2 = error.area_m2 * dem.metres_x * dem.metres_y;
    out.at = laid_.placing.from_samples(error.at);
    out.certain_at = laid_.placing.from_samples(error.certain_at);
    out.samples_max_m = error.samples_max;
    out.samples_at = laid_.placing.from_samples(error.samples_at);
    const double area = plan_area(placed);
    out.judged_share = area > 0 ? std::min(1.0, error.area_m2 / area) : 0;
    if (!(error.area_m2 > 0)) {
      add(FindingCode::nothing_judged, "terrain", {},
          "nothing of the mesh lies over data of the DEM: no height was judged; --placing says how it lies");
      return;
    }
    judge_placement(placed, out);
    if (laid_.guessed && laid_.placing.name == "fit" && out.better_match.empty())
      add(FindingCode::nothing_judged, "stretched", laid_.placing.from_samples(error.at),
          "no placing lays the mesh over the DEM but stretching its box over it; if that is meant, say "
          "--placing "
          "fit");
    judge_declared(out);
    if (request.pictures) {
      oracle::ErrorMap map = oracle::vertical_error_map(placed, dem.samples, dem.has_data, kErrorMapPx,
                                                        {dem.metres_x, dem.metres_y});
      pictures.error_map_m = std::move(map.error_m);
      const Vec2 low = laid_.placing.from_samples(map.low), high = laid_.placing.from_samples(map.high);
      pictures.error_map_box = {{low.x, low.y, 0}, {high.x, high.y, 0}};
    }
    if (exam_.request.camera) set(stage);
  }

 private:
  void add(FindingCode code, std::string kind, Vec2 at, std::string message, double size_m = 0) {
    verdict::CheckFinding found;
    found.finding.code = code;
    found.finding.kind = std::move(kind);
    found.finding.distance_m = size_m;
    found.mesh = owner_of(at, found.finding);
    const Vec3 place = found.finding.at;
    found.at = exam_.subjects[found.mesh].tile ? place : exam_.frame.to_file(place);
    found.message = std::move(message);
    findings_.push_back(std::move(found));
  }

  /// The mesh over the place, its triangle there and the height; the first if there is none.
  std::uint32_t owner_of(Vec2 at, Finding& finding) const {
    finding.at = {at.x, at.y, 0};
    for (std::uint32_t k = 0; k < exam_.subjects.size(); ++k) {
      const Subject& subject = exam_.subjects[k];
      const verdict::Extent& box = subject.facts.box;
      if (subject.tile && !subject.tile->drawn) continue;
      if (at.x < box.low.x || at.x > box.high.x || at.y < box.low.y || at.y > box.high.y) continue;
      const std::vector<Vec3>& places = subject.tile ? subject.places : subject.mesh.positions;
      for (std::uint32_t t = 0; t < subject.mesh.triangles.size(); ++t) {
        const auto& corners = subject.mesh.triangles[t];
        if (std::any_of(corners.begin(), corners.end(), [&](auto v) { return v >= places.size(); })) continue;
        const Vec3 &a = places[corners[0]], &b = places[corners[1]], &c = places[corners[2]];
        const auto turn = [&](const Vec3& p, const Vec3& q) {
          return (q.x - p.x) * (at.y - p.y) - (q.y - p.y) * (at.x - p.x);
        };
        const double u = turn(b, c), v = turn(c, a), w = turn(a, b), sum = u + v + w;
        if (!(sum > 0) || u < 0 || v < 0 || w < 0) continue;
        finding.at.z = (u * a.z + v * b.z + w * c.z) / sum;
        finding.triangles = {t};
        return k;
      }
    }
    return 0;
  }

  void judge_placement(const Mesh& placed, verdict::TerrainVerdict& out) {
    const auto better =
        oracle::recognise_misplacement(used_vertices(placed), laid_.dem.samples, laid_.dem.has_data);
    if (!better) return;
    constexpr std::string_view kIf = "matches if ";
    out.better_match = better->words.starts_with(kIf) ? better->words.substr(kIf.size()) : better->words;
    add(FindingCode::misplaced, std::string(oracle::misplacement_name(better->kind)), out.at,
        fmt::format("{}: the figures against the DEM speak of the arrangement, not of the mesh",
                    better->words),
        better->given_rms_m);
  }

  void judge_declared(verdict::TerrainVerdict& out) {
    if (!exam_.request.declared_m) return;
    const double declared = *exam_.request.declared_m;
    // A bound is called broken only where the rounding of the figure cannot explain it.
    const double bound = declared + rounding_m();
    out.declared_m = declared;
    out.declared_at_samples = out.samples_max_m <= bound;
    out.declared_certain = out.vertical_m.certain_max <= bound;
    out.declared_everywhere = out.vertical_m.max <= bound;
    if (!out.declared_at_samples) {
      add(FindingCode::declared_error, "samples", out.samples_at,
          fmt::format("{} were declared; at a sample the mesh is {} off, between samples up to {}, whichever "
                      "way cells are split",
                      length_text(declared), length_text(out.samples_max_m),
                      length_text(out.vertical_m.certain_max)),
          out.samples_max_m);
    } else if (!out.declared_certain) {
      add(FindingCode::declared_error, "between", out.certain_at,
          fmt::format("{} were declared and hold at the samples; between them the mesh is {} off, whichever "
                      "way cells are split",
                      length_text(declared), length_text(out.vertical_m.certain_max)),
          out.vertical_m.certain_max);
    }
  }

  /// What a visited height may err by (vertical.h).
  double rounding_m() const {
    double low = laid_.dem.samples.lowest_m(), high = laid_.dem.samples.highest_m();
    for (const Subject& subject : exam_.subjects) {
      const double unit = subject.tile ? 1 : exam_.frame.unit_m;
      low = std::min(low, subject.facts.box.low.z * unit);
      high = std::max(high, subject.facts.box.high.z * unit);
    }
    return oracle::kVerticalRoundingFactor * 0x1p-53 * (high - low);
  }

  /// The camera stands in the DEM's local frame: metres from its south-west sample.
  void set(Stage& stage) const {
    const Dem& dem = laid_.dem;
    const Placing placing = laid_.placing;
    const Vec2 step{dem.metres_x, dem.metres_y};
    const double unit = exam_.frame.unit_m;
    stage.place = [placing, step, unit](const Subject& subject, std::uint32_t v) {
      Vec3 p = subject.tile ? subject.places[v] : subject.mesh.positions[v];
      if (!subject.tile) p.z *= unit;
      const Vec3 s = placing.to_samples(p);
      return Vec3{s.x * step.x, s.y * step.y, s.z};
    };
    Mesh reference = reference_mesh(dem.samples);
    for (Vec3& p : reference.positions) {
      p.x *= step.x;
      p.y *= step.y;
    }
    if (!dem.has_data.empty()) {
      std::erase_if(reference.triangles, [&](const auto& t) {
        return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return dem.has_data[v] == 0; });
      });
    }
    stage.reference = std::move(reference);
  }

  Examination& exam_;
  std::vector<verdict::CheckFinding>& findings_;
  LaidDem laid_;
};

}  // namespace

void against_terrain(Examination& exam, Stage& stage, std::vector<verdict::CheckFinding>& findings,
                     verdict::CheckPictures& pictures) {
  AgainstTerrain(exam, findings).judge(stage, pictures);
}

}  // namespace plumbline::checking
