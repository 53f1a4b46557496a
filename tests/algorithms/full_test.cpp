// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "algorithms/registry.h"
#include "lattice.h"

namespace plumbline {
namespace {

TEST(Full, IsTheReferenceMeshForAnySize) {
  for (const auto& [columns, rows] : {std::pair{2, 2}, std::pair{2, 7}, std::pair{12, 5}}) {
    const Terrain terrain = lattice::rough(columns, rows, 1, 5, 30);
    const auto method = make_method("full");
    method->prepare(terrain);
    LodFrame frame;
    method->update(make_camera({0, 0, 100}, {1, 1, 0}, 60, 640, 480), frame);
    const Mesh expected = reference_mesh(terrain);
    EXPECT_EQ(frame.mesh.positions, expected.positions);
    EXPECT_EQ(frame.mesh.triangles, expected.triangles);
    const lattice::Faults faults = lattice::look_at(terrain, frame);
    EXPECT_EQ(faults.t_junctions + faults.turned + faults.doubled + faults.inner_border, 0);
    EXPECT_EQ(faults.double_area, lattice::double_area(terrain));
    EXPECT_NEAR(lattice::double_area(frame.domain, 30), static_cast<double>(faults.double_area),
                lattice::kAreaRoundingCells);
  }
}

}  // namespace
}  // namespace plumbline
