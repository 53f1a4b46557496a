// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "properties/laws/trial.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <sstream>

#include <fmt/format.h>

namespace plumbline::properties {
namespace {

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool same_bits(Vec3 a, Vec3 b) { return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z); }

}  // namespace

std::unique_ptr<LodMethod> prepared_method(const LawInput& input) {
  std::unique_ptr<LodMethod> method = input.make ? input.make() : make_method(input.method, input.options);
  method->prepare(input.terrain);
  method->set_threshold_px(input.threshold_px);
  return method;
}

std::unique_ptr<LodMethod> flyer(const LodMethod& prepared, double threshold_px) {
  std::unique_ptr<LodMethod> clone = prepared.clone();
  clone->set_threshold_px(threshold_px);
  return clone;
}

std::vector<Camera> cameras(const LawInput& input) {
  std::vector<Camera> flight;
  flight.reserve(input.poses.size());
  for (const CameraPose& pose : input.poses) {
    flight.push_back(
        make_camera(pose.position, pose.look_at, input.fov_y_deg, input.width_px, input.height_px));
  }
  return flight;
}

Camera judged_camera(const LawInput& input) {
  const CameraPose& pose = input.poses.back();
  return make_camera(pose.position, pose.look_at, input.fov_y_deg, input.width_px, input.height_px);
}

LodFrame fly(LodMethod& method, std::span<const Camera> flight) {
  LodFrame frame;
  for (const Camera& camera : flight) method.update(camera, frame);
  return frame;
}

void scale_lengths(LawInput& input, double scale) {
  for (auto& road : input.terrain.roads) {
    for (Vec2& p : road) p = p * scale;
  }
  if (input.make) return;
  for (const OptionDescription& option : find_method(input.method).method->options) {
    if (option.name != "rings_m") continue;
    std::istringstream words(
        option_text(input.options, option.name, std::get<std::string>(option.default_value)));
    std::string scaled;
    for (double length_m = 0; words >> length_m;) {
      scaled += fmt::format("{}{}", scaled.empty() ? "" : " ", length_m * scale);
    }
    input.options[option.name] = scaled;
  }
}

std::string first_difference(const LodFrame& a, const LodFrame& b) {
  const auto& p = a.mesh.positions;
  const auto& q = b.mesh.positions;
  if (a.mesh.triangles.size() != b.mesh.triangles.size()) {
    return fmt::format("{} triangles against {}", a.mesh.triangles.size(), b.mesh.triangles.size());
  }
  if (p.size() != q.size()) return fmt::format("{} vertices against {}", p.size(), q.size());
  for (std::size_t v = 0; v < p.size(); ++v) {
    if (!same_bits(p[v], q[v])) {
      return fmt::format("vertex {} at ({}, {}, {}) against ({}, {}, {})", v, p[v].x, p[v].y, p[v].z, q[v].x,
                         q[v].y, q[v].z);
    }
  }
  for (std::size_t t = 0; t < a.mesh.triangles.size(); ++t) {
    if (a.mesh.triangles[t] != b.mesh.triangles[t]) return fmt::format("triangle {} has other corners", t);
  }
  if (a.vertex_keys != b.vertex_keys) return "the vertex keys differ";
  if (a.domain.loops != b.domain.loops) return "the promised domains differ";
  return {};
}

bool has_several_levels(const Mesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  double greatest = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    if (std::max({a, b, c}) >= mesh.positions.size()) continue;
    const Vec3 u = mesh.positions[b] - mesh.positions[a];
    const Vec3 v = mesh.positions[c] - mesh.positions[a];
    const double area = std::fabs(u.x * v.y - u.y * v.x);
    least = std::min(least, area);
    greatest = std::max(greatest, area);
  }
  return greatest > 1.5 * least;
}

LawOutcome held() { return {.kind = LawOutcome::Kind::held, .what = {}, .finding = {}, .parts = {}}; }

LawOutcome vacuous(std::string why) {
  return {.kind = LawOutcome::Kind::vacuous, .what = std::move(why), .finding = {}, .parts = {}};
}

LawOutcome violated(std::string what, oracle::Finding finding) {
  return {.kind = LawOutcome::Kind::violated,
          .what = std::move(what),
          .finding = std::move(finding),
          .parts = {}};
}

oracle::Finding law_finding(std::string kind, Vec3 at) {
  oracle::Finding finding;
  finding.code = oracle::FindingCode::law_violated;
  finding.kind = std::move(kind);
  finding.at = at;
  return finding;
}

bool is_threshold_blind(const LawInput& input) {
  return !input.make && find_method(input.method).promises(Promise::threshold_blind);
}

bool is_camera_blind(const LawInput& input) {
  return !input.make && find_method(input.method).promises(Promise::camera_blind);
}

}  // namespace plumbline::properties
