// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// P4 (TABLES). Kalachev & Reshetnikova: an instrument of 86 802 triangles goes to 5 381, and a ladder of
// screen sizes grants shares of the triangles. Not said there, and decided here: the mesh itself, the limits
// of building, the place in a rung at which it is looked at, and every figure of what is lost.
#include "properties/tables/p4.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "algorithms/vertex_tree/method.h"
#include "oracle/likeness.h"
#include "scenarios/error.h"
#include "scenarios/mesh_file/mesh_file.h"

namespace plumbline::tables {
namespace {

/// A rung of the ladder: the screen size it is looked at from, and the share it grants.
struct Rung {
  double size_px;
  const char* percent;
};
/// The middle of each; 25 px beside the outermost.
constexpr Rung kRungs[] = {{325, "100"}, {275, "80"}, {225, "60"}, {175, "40"}, {125, "20"}, {75, "10"}};
/// The mesh of the building step's least count is looked at from here, where the ladder would show
/// everything.
constexpr double kCloseSizePx = 325;

constexpr const char* kLeast = "least count";
constexpr const char* kShare = "share of the triangles";
constexpr const char* kTriangles = "triangles";
constexpr const char* kSilhouette = "silhouette pixels that differ";
constexpr const char* kSilhouetteMax = "largest distance of one to the other's silhouette";
constexpr const char* kHausdorff = "Hausdorff distance, at most, of the diameter";
constexpr const char* kNormals = "mean deviation of normals";
constexpr const char* kTurned = "area turned by more than 90°";
constexpr const char* kIntersections = "self-intersections beside the full mesh's";
constexpr const char* kParallax = "parallax, p99";

std::string row_of(const Rung& rung) { return fmt::format("{} px", rung.size_px); }

/// What a trial's frames are held against.
struct Scene {
  const Mesh& mesh;
  oracle::RaySurface surface;
  Vec3 center;
  double radius_m;
  std::size_t intersections;
};

/// From in front, a little aside and above, so that the ball around the object is `size_px` wide.
Camera look(const Scene& scene, double size_px, const Picture& picture) {
  const Vec3 from{0.45, -0.8, 0.4};
  const Camera unit =
      make_camera({0, 0, 1}, {0, 0, 0}, picture.fov_y_deg, picture.width_px, picture.height_px);
  // 2κ·r/√(d² − r²) = size
  const double free_m = 2 * unit.kappa_px * scene.radius_m / size_px;
  const double distance_m = std::sqrt(free_m * free_m + scene.radius_m * scene.radius_m);
  return make_camera(scene.center + from * (distance_m / length(from)), scene.center, picture.fov_y_deg,
                     picture.width_px, picture.height_px);
}

void measure(const Table& table, Trial& trial, const std::string& row, const Scene& scene, const Mesh& mesh,
             const Camera& camera, const Workshop& workshop) {
  const double full = static_cast<double>(scene.mesh.triangles.size());
  const auto triangles = static_cast<double>(mesh.triangles.size());
  put(table, trial, row, kTriangles, triangles);
  put(table, trial, row, kShare, 100 * triangles / full);
  const oracle::RaySurface surface(workshop.device, mesh);
  const oracle::PixelHits truth = scene.surface.look(camera), hits = surface.look(camera);
  const oracle::ImageError error = oracle::ray_error(camera, truth, hits);
  const auto seen = static_cast<double>(
      truth.triangle.size() - static_cast<std::size_t>(std::count(
                                  truth.triangle.begin(), truth.triangle.end(), oracle::PixelHits::kNoHit)));
  put(table, trial, row, kSilhouette, per(100 * static_cast<double>(error.silhouette_pixels), seen));
  put(table, trial, row, kSilhouetteMax, error.silhouette_max_px);
  put(table, trial, row, kParallax, error.parallax_px.p99);
  constexpr double kWithinShare = 0x1p-10;  // of the radius: certified to a thousandth
  const auto likeness = oracle::compare_in_space(mesh, scene.mesh, kWithinShare * scene.radius_m);
  if (likeness) {
    put(table, trial, row, kHausdorff, 100 * likeness->hausdorff().most_m / (2 * scene.radius_m));
    put(table, trial, row, kNormals, likeness->normal_mean_deg);
    put(table, trial, row, kTurned, 100 * likeness->turned_share);
  }
  if (const auto pairs = oracle::self_intersections(mesh)) {
    put(table, trial, row, kIntersections,
        static_cast<double>(pairs->size()) - static_cast<double>(scene.intersections));
  }
  workshop.step();
}

}  // namespace

const std::vector<P4View>& p4_views() {
  static const std::vector<P4View> views{{"contour held (published)", ""},
                                         {"no contour rule", "no_contour"},
                                         {"contour restored", "view_dependent"}};
  return views;
}

std::size_t p4_steps() { return std::size(kRungs) + 1; }

Table p4_table() {
  Table table;
  table.id = "P4";
  table.title = "An instrument of 86 802 triangles, brought to 5 381 and down the ladder";
  table.source = "Kalachev & Reshetnikova, steps 4 and 6, figure 10";
  table.protocol = {
      "The mesh: an instrument of exactly 86 802 triangles made for it (generator `instrument`), and the "
      "meshes "
      "given by --mesh. Limits of building: normals turn by less than 45°, quality over 0.1.",
      "Least count: building ends at 5 381 triangles (of other meshes: at the same share), the tree is "
      "collapsed "
      "as far as it goes and looked at where the ladder would show everything.",
      "Ladder: one flight away from the object, in the middle of each rung; pictures of 1024 × 768, 45°.",
      "Silhouettes and parallax by rays, one a pixel; distances certified by CGAL to a thousandth of the "
      "radius; "
      "normals at the full mesh's centroids.",
  };
  table.notes = {
      "5 381 is 6.20 % of 86 802, below the ladder's lowest rung: it is the least count that building was "
      "given.",
      "5 381 is odd: the paper's mesh has a border. Every part of ours is closed, and a collapse inside a "
      "closed "
      "part takes two triangles, so ours ends at 5 380.",
      "With the contour held the published method keeps far more than a rung grants: what may lie on the "
      "contour "
      "by its normal cone is not collapsed, and stops its neighbours (M5.S3).",
  };
  const auto add = [&](const std::string& row, const char* name, const char* unit, int decimals, Kind kind,
                       const char* printed, std::optional<double> recomputed = std::nullopt) {
    table.figures.push_back({row, name, unit, decimals, kind, printed, recomputed});
  };
  const auto add_lost = [&](const std::string& row) {
    add(row, kSilhouette, "%", 2, Kind::measured, "");
    add(row, kSilhouetteMax, "px", 1, Kind::measured, "");
    add(row, kParallax, "px", 2, Kind::measured, "");
    add(row, kHausdorff, "%", 2, Kind::measured, "");
    add(row, kNormals, "°", 1, Kind::measured, "");
    add(row, kTurned, "%", 2, Kind::measured, "");
    add(row, kIntersections, "", 0, Kind::measured, "");
  };
  add(kLeast, kTriangles, "", 0, Kind::fitted, "5 381");
  add(kLeast, kShare, "%", 2, Kind::derived, "6.20", 100 * 5381.0 / 86802.0);
  add_lost(kLeast);
  for (const Rung& rung : kRungs) {
    const std::string row = row_of(rung);
    add(row, kTriangles, "", 0, Kind::measured, "");
    add(row, kShare, "%", 1, Kind::predicted, rung.percent);
    add_lost(row);
  }
  return table;
}

Trial p4_trial(const Table& table, const P4Settings& settings, const MeshStandIn& stand_in,
               const P4View& view, const Workshop& workshop) {
  using vertex_tree::ContourRule;
  Trial trial;
  trial.terrain = stand_in.id;
  trial.view = view.name;
  const ContourRule rule = view.variant == "no_contour"       ? ContourRule::none
                           : view.variant == "view_dependent" ? ContourRule::restore
                                                              : ContourRule::hold;
  workshop.check();
  const auto tree =
      std::make_shared<const vertex_tree::VertexTree>(vertex_tree::build_tree(stand_in.mesh, {}));
  const auto intersections = oracle::self_intersections(stand_in.mesh);
  const Scene scene{stand_in.mesh, oracle::RaySurface(workshop.device, stand_in.mesh), tree->center,
                    tree->radius_m, intersections ? intersections->size() : 0};
  Mesh mesh;
  std::vector<std::uint64_t> keys;
  {
    vertex_tree::BuildSettings build;
    build.least_triangles = static_cast<std::size_t>(
        std::floor(settings.least_share * static_cast<double>(stand_in.mesh.triangles.size()) + 0.5));
    vertex_tree::Cut cut(
        std::make_shared<const vertex_tree::VertexTree>(vertex_tree::build_tree(stand_in.mesh, build)));
    cut.coarsen(0);
    cut.extract(mesh, keys);
    trial.fits.push_back({"least count of building", "", static_cast<double>(build.least_triangles), kLeast,
                          kTriangles, static_cast<double>(build.least_triangles),
                          static_cast<double>(mesh.triangles.size())});
    measure(table, trial, kLeast, scene, mesh, look(scene, kCloseSizePx, workshop.picture), workshop);
  }
  vertex_tree::Object object(tree, rule);
  for (const Rung& rung : kRungs) {
    workshop.check();
    const Camera camera = look(scene, rung.size_px, workshop.picture);
    Counters counters;
    object.update(camera, 1, counters);
    object.cut().extract(mesh, keys);
    measure(table, trial, row_of(rung), scene, mesh, camera, workshop);
  }
  return trial;
}

MeshStandIn load_mesh_stand_in(const std::string& path) {
  MeshStandIn out;
  const std::filesystem::path file(path);
  out.id = one_line(file.stem().string());
  out.origin = "read from a file";
  out.mesh = cut_to_manifold(welded(triangulate(read_mesh_file(file))));
  if (out.mesh.triangles.empty()) throw InputError(fmt::format("{}: holds no triangle", one_line(path, 200)));
  return out;
}

}  // namespace plumbline::tables
