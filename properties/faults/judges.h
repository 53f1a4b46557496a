// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "oracle/conformity.h"
#include "oracle/economy.h"
#include "oracle/image.h"
#include "oracle/likeness.h"
#include "oracle/placement.h"
#include "oracle/seams.h"
#include "oracle/shape.h"
#include "oracle/stability.h"
#include "oracle/tile_conformance.h"
#include "oracle/vertical.h"
#include "scenarios/random.h"

/// The oracles as functions of plain data: what is put to the test. A test of the test puts blinded ones in
/// their place.
namespace plumbline::faults {

/// O3 of one picture, with the displacement of each pixel.
struct PictureVerdict {
  oracle::ImageError error;
  Raster displacement_px;
};

/// O4's slack, vertex by vertex.
struct SlackVerdict {
  oracle::Slack slack;
  std::vector<std::uint8_t> removable;
};

/// One frame's change, as ToggleWatch takes it.
struct FrameChange {
  std::vector<std::uint64_t> entered, left;
};

struct Judges {
  std::function<oracle::ConformityReport(const Mesh&, const PlanDomain&)> conformity;
  std::function<oracle::VerticalError(const Mesh&, const Terrain&)> vertical;
  std::function<PictureVerdict(const Camera&, const Mesh& reference, const Mesh& mesh, double threshold_px)>
      picture;
  std::function<SlackVerdict(const Camera&, const Mesh& reference, const Mesh& mesh, double threshold_px)>
      slack;
  /// Per frame: how many changes are a toggle's second.
  std::function<std::vector<std::size_t>(std::span<const FrameChange>)> toggles;
  /// For (cut, good) of each frame: the most frames that a cut was followed by before it was good.
  std::function<int(std::span<const std::pair<bool, bool>>)> recovery;
  /// In how many vertices two meshes differ, by their vertices' keys (sorted).
  std::function<std::size_t(std::span<const std::uint64_t>, std::span<const std::uint64_t>)> keys;
  std::function<oracle::ShapeReport(const Mesh&)> shape;
  std::function<oracle::ConformityReport(const Mesh&)> soundness;
  std::function<std::optional<std::vector<std::array<std::uint32_t, 2>>>(const Mesh&)> intersections;
  std::function<std::optional<oracle::Likeness>(const Mesh& mesh, const Mesh& reference, double within_m)>
      likeness;
  /// A mesh's border, its skirts told by its walls.
  std::function<oracle::Border(const Mesh&)> border;
  std::function<std::optional<oracle::Seam>(const oracle::Border&, const oracle::Border&)> seam;
  std::function<std::optional<oracle::Slit>(const oracle::Border&, const oracle::Border&, double within)>
      slit;
  std::function<std::vector<oracle::TileFinding>(const QuantizedMesh&, const TileBounds&)> tile;
  std::function<std::optional<oracle::Misplacement>(std::span<const Vec3>, const Terrain&)> placement;
};

/// This build's oracles.
Judges real_judges();

/// Makes closed, sound meshes to plant in, every vertex of which is used.
using MakeSolid = std::function<Mesh(Random&)>;

}  // namespace plumbline::faults
