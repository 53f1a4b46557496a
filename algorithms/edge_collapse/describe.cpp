// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// edge_collapse: CGAL's edge collapse, view-independent. Role: what a CGAL user would do today (METHODS,
// reference methods).
#include "algorithms/edge_collapse/edge_collapse.h"
#include "algorithms/registry.h"

namespace plumbline {

MethodDescription describe_edge_collapse() {
  using enum Promise;
  const std::vector<Promise> promises = {covers_domain,    monotone_in_tau, idempotent,
                                         path_independent, exact_at_zero,   camera_blind};
  return {
      .id = "edge_collapse",
      .title = "CGAL's edge collapse",
      .citation =
          "Cacciola, Rouxel-Labbé, Şenbaşlar, Komaromy: CGAL 5.5, Triangulated Surface Mesh Simplification; "
          "Lindstrom, Turk: Fast and memory efficient polygonal simplification, IEEE Visualization 1998",
      .section = "reference",
      .variants = {{"", "cost and placement by Lindstrom and Turk, CGAL's default", promises},
                   {"garland_heckbert", "cost and placement by Garland and Heckbert's plane quadrics",
                    promises},
                   {"free_border",
                    "a terrain's border may move too: no triangle is spent on keeping it",
                    {monotone_in_tau, idempotent, path_independent, exact_at_zero, camera_blind}}},
      .options = {decimation::triangles_at_1px_option()},
      .claims = {},
      .takes_objects = true,
      .make = [](std::string_view variant, const Options& options) -> std::unique_ptr<LodMethod> {
        const auto policy = variant == "garland_heckbert" ? edge_collapse::Policy::garland_heckbert
                                                          : edge_collapse::Policy::lindstrom_turk;
        const bool free = variant == "free_border";
        return std::make_unique<decimation::ViewIndependent>(
            "edge_collapse",
            [policy, free](const Mesh& mesh, bool keep_border) {
              return edge_collapse::make_simplifier(mesh, policy, keep_border && !free);
            },
            decimation::read_triangles_at_1px("edge_collapse", options));
      },
  };
}

}  // namespace plumbline
