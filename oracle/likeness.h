// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "oracle/image.h"
#include "scenarios/mesh.h"

namespace plumbline::oracle {

/// O7, general meshes (ORACLES O7): what they are in space, whatever camera looks at them. Decided by CGAL's
/// Polygon Mesh Processing; one thread, so the bits depend on the meshes alone.

/// Two triangles of a mesh, the lesser index first.
using TrianglePair = std::array<std::uint32_t, 2>;

/// Pairs of triangles that meet elsewhere than in a corner or an edge they share, sorted. Exact. Triangles
/// without area, or with a corner that is not finite, which oracle::check_soundness reports, are left out.
/// Nothing if the mesh is no oriented manifold (nobody's business here: check_soundness says where).
std::optional<std::vector<TrianglePair>> self_intersections(const Mesh& mesh);

/// Some of them, and how many there are.
struct SomeIntersections {
  std::vector<TrianglePair> pairs;
  std::size_t total = 0;
};
/// The same of a mesh that may be anything: all pairs are counted, `most` of them kept (the same each time),
/// for their number may grow with the square of the triangles'.
std::optional<SomeIntersections> some_self_intersections(const Mesh& mesh, std::size_t most);

/// A distance that is known to lie within [least_m, most_m].
struct CertifiedDistance {
  double least_m = 0, most_m = 0;
};

/// How like a mesh is to the object that it stands for, in space.
struct Likeness {
  CertifiedDistance to_mesh;    ///< largest distance of a point of the reference from the mesh
  CertifiedDistance from_mesh;  ///< of a point of the mesh from the reference
  /// Angle between the normals of a reference triangle and of the mesh's triangle nearest to its centroid,
  /// degrees: the largest, and the mean over the reference's area.
  double normal_max_deg = 0, normal_mean_deg = 0;
  double turned_share = 0;  ///< of the reference's area where that angle exceeds 90 degrees

  /// The two-sided Hausdorff distance.
  [[nodiscard]] CertifiedDistance hausdorff() const {
    return {std::max(to_mesh.least_m, from_mesh.least_m), std::max(to_mesh.most_m, from_mesh.most_m)};
  }
};

/// Compares two triangle meshes in space. Distances are certified to `within_m`: the interval is at most
/// twice that wide, by construction of CGAL's bounded-error algorithm, apart from the rounding of doubles.
/// Requires: both have a triangle with area, all coordinates are finite, indices valid, within_m > 0. Nothing
/// if one of them is no oriented manifold.
std::optional<Likeness> compare_in_space(const Mesh& mesh, const Mesh& reference, double within_m);

/// Of all vertices of the two meshes the one that is farthest from the other mesh's surface: where to look
/// first. Rounded; where neither has area (no triangle to be near to), the origin. Requires as
/// compare_in_space.
Vec3 farthest_vertex(const Mesh& mesh, const Mesh& reference);

/// The object's area in the picture against the reference's, as a share of it: pixels that see the mesh less
/// those that see the reference, divided by these; 0 where neither is seen, +∞ where only the mesh is.
double projected_area_error(const PixelHits& reference_hits, const PixelHits& mesh_hits);

}  // namespace plumbline::oracle
