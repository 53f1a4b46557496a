// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// edge_collapse: what a user of CGAL would do today. Role: a reference that knows no camera, simplified once
// to a number of triangles.
//
// Paper: Lindstrom & Turk, "Fast and memory efficient polygonal simplification", IEEE Visualization 1998; as
// implemented by CGAL's package Surface Mesh Simplification. Promises and departures: README.md.
#include "algorithms/edge_collapse/lindstrom_turk.h"
#include "algorithms/registry.h"
#include "algorithms/simplified/simplified.h"

namespace plumbline {

MethodDescription describe_edge_collapse() {
  using enum Promise;
  return {
      .id = "edge_collapse",
      .title = "CGAL's edge collapse (Lindstrom-Turk) to a triangle count, view-independent",
      .citation =
          "Lindstrom & Turk, \"Fast and memory efficient polygonal simplification\", IEEE Visualization "
          "1998; "
          "CGAL, Surface Mesh Simplification",
      .section = "reference",
      .variants = {{"",
                    "CGAL's default cost and placement, borders constrained",
                    {covers_domain, monotone_in_tau, idempotent, path_independent, exact_at_zero,
                     continuous_in_camera}}},
      .options = {simplified::triangles_option()},
      .claims = {},
      .takes_objects = true,
      .make =
          [](std::string_view, const Options& options) {
            return simplified::make_simplified(edge_collapse::lindstrom_turk,
                                               simplified::read_settings("edge_collapse", options));
          },
  };
}

}  // namespace plumbline
