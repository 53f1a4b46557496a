// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// An oracle as a library: two squares side by side, the left one with a vertex in the shared edge that the
// right one does not know.
//
//   3---2-------6      Vertex 4 stands in the middle of the right square's edge 1–2, half a metre too high:
//   |   4       |      a T-junction, and a crack of 0.5 m.
//   0---1-------5
#include <cstdio>

#include "oracle/conformity.h"

int main() {
  using namespace plumbline;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}, {1, 1, 0.5}, {3, 0, 0}, {3, 2, 0}};
  mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {3, 4, 2}, {1, 5, 6}, {1, 6, 2}};  // counter-clockwise from above
  PlanDomain domain;                                                         // what it should cover
  domain.add_rectangle({0, 0}, {3, 2});

  const oracle::ConformityReport report = oracle::check_conformity(mesh, domain);
  for (const oracle::Finding& finding : report.findings) {
    std::printf("%d at (%g, %g, %g): gap %g m\n", static_cast<int>(finding.code), finding.at.x, finding.at.y,
                finding.at.z, finding.gap_m);
  }
  return report.clean() ? 0 : 1;
}
