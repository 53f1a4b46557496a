// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The registry entry of vertex_tree: variants, options, claims.
#include <cmath>

#include <fmt/format.h>

#include "algorithms/registry.h"
#include "algorithms/vertex_tree/method.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

vertex_tree::Settings read_settings(std::string_view variant, const Options& options) {
  using vertex_tree::ContourRule;
  vertex_tree::Settings s;
  s.contour = variant == "no_contour"       ? ContourRule::none
              : variant == "view_dependent" ? ContourRule::restore
                                            : ContourRule::hold;
  s.build.normal_angle_deg = option_number(options, "normal_angle_deg", s.build.normal_angle_deg);
  s.build.least_quality = option_number(options, "least_quality", s.build.least_quality);
  const double least = option_number(options, "least_triangles", 0);
  if (!(least >= 0 && least <= 1e9) || least != std::floor(least))
    throw InputError(
        fmt::format("vertex_tree: option least_triangles = {} is not a whole number of [0, 10^9]", least));
  s.build.least_triangles = static_cast<std::size_t>(least);
  if (!(s.build.normal_angle_deg > 0 && s.build.normal_angle_deg <= 180))
    throw InputError(fmt::format("vertex_tree: option normal_angle_deg = {} is not inside (0, 180]",
                                 s.build.normal_angle_deg));
  if (!(s.build.least_quality >= 0 && s.build.least_quality < 1))
    throw InputError(
        fmt::format("vertex_tree: option least_quality = {} is not inside [0, 1)", s.build.least_quality));
  return s;
}

}  // namespace

MethodDescription describe_vertex_tree() {
  using enum Promise;
  return {
      .id = "vertex_tree",
      .title = "Vertex tree with identifier-ordered edge collapses",
      .citation =
          "Kalachev, Reshetnikova: \"Dynamic control of the level of detail of 3-D models of complex "
          "measuring instruments\" (in Russian; no venue or year in the text at hand)",
      .section = "M5",
      .variants = {{"",
                    "as published: screen-size ladder, nodes on the contour are not collapsed",
                    {conforming, idempotent, exact_at_zero}},
                   {"no_contour",
                    "the ladder alone",
                    {conforming, monotone_in_tau, idempotent, exact_at_zero}},
                   {"view_dependent",
                    "nodes that turn onto the contour are split again, forced through their neighbours",
                    {conforming, idempotent, exact_at_zero}}},
      .options = {{"normal_angle_deg", "a safe collapse turns no surviving triangle's normal further", 45.0},
                  {"least_quality", "a safe collapse leaves no triangle of lesser quality", 0.1},
                  {"least_triangles", "building ends at this many triangles", 0.0}},
      .claims = {{"M5.C1",
                  "the two integer tests let each collapse and split meet the neighbourhood of building"},
                 {"M5.C2", "the contour keeps its shape better than without the contour rule"},
                 {"M5.C3", "86802 triangles go to 5381 without visible artefacts"},
                 {"M5.C4", "a split undoes its collapse exactly, bit for bit"}},
      .takes_objects = true,
      .make =
          [](std::string_view variant, const Options& options) {
            return std::make_unique<vertex_tree::VertexTreeMethod>(read_settings(variant, options));
          },
  };
}

}  // namespace plumbline
