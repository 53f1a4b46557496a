// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// meshopt: meshoptimizer's simplify, view-independent. Role: what an engine programmer would do today
// (METHODS, reference methods).
#include "algorithms/meshopt/meshopt.h"
#include "algorithms/registry.h"

namespace plumbline {

MethodDescription describe_meshopt() {
  using enum Promise;
  return {
      .id = "meshopt",
      .title = "meshoptimizer's simplify",
      .citation = "Kapoulkine: meshoptimizer 0.18, meshopt_simplify (2022)",
      .section = "reference",
      .variants = {{"",
                    "to the count, whatever the error",
                    {covers_domain, idempotent, path_independent, exact_at_zero, camera_blind}},
                   {"free_border",
                    "a terrain's border is not locked: no triangle is spent on keeping it",
                    {idempotent, path_independent, exact_at_zero, camera_blind}}},
      .options = {decimation::triangles_at_1px_option()},
      .claims = {},
      .takes_objects = true,
      .make = [](std::string_view variant, const Options& options) -> std::unique_ptr<LodMethod> {
        const bool free = variant == "free_border";
        return std::make_unique<decimation::ViewIndependent>(
            "meshopt",
            [free](const Mesh& mesh, bool keep_border) {
              return meshopt::make_simplifier(mesh, keep_border && !free);
            },
            decimation::read_triangles_at_1px("meshopt", options));
      },
  };
}

}  // namespace plumbline
