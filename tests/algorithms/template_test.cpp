// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// algorithms/_template is compiled into this program as it stands, so that a copy of it starts from something
// that works.
#include <gtest/gtest.h>

#include "algorithms/registry.h"
#include "lattice.h"
#include "scenarios/error.h"

namespace plumbline {

MethodDescription describe_my_method();

namespace {

TEST(Template, IsAMethodThatDraws) {
  const MethodDescription description = describe_my_method();
  EXPECT_FALSE(description.variants.front().promises.empty());
  const Terrain terrain = lattice::rough(6, 4, 1, 3);
  const auto method = description.make("", {});
  method->prepare(terrain);
  LodFrame frame, cloned;
  const Camera camera = make_camera({0, 0, 50}, {2, 2, 0}, 60, 640, 480);
  method->update(camera, frame);
  method->clone()->update(camera, cloned);
  EXPECT_TRUE(lattice::same_mesh(frame, cloned));
  const lattice::Faults faults = lattice::look_at(terrain, frame);
  EXPECT_EQ(faults.t_junctions + faults.turned + faults.doubled + faults.inner_border, 0);
  EXPECT_EQ(faults.double_area, lattice::double_area(terrain));
}

TEST(Template, RefusesATerrainWithoutCells) {
  const Terrain terrain = lattice::flat(1, 5);
  EXPECT_THROW(describe_my_method().make("", {})->prepare(terrain), InputError);
}

}  // namespace
}  // namespace plumbline
