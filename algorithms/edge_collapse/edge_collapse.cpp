// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "algorithms/edge_collapse/edge_collapse.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace plumbline::edge_collapse {
namespace {

class Replayed final : public decimation::Simplifier {
 public:
  Replayed(Mesh full, std::vector<Collapse> collapses)
      : full_(std::move(full)), collapses_(std::move(collapses)) {}
  [[nodiscard]] std::size_t full_triangles() const override { return full_.triangles.size(); }
  [[nodiscard]] decimation::Decimated at(std::size_t triangles) const override {
    if (triangles >= full_.triangles.size()) return replay(full_, {}, 0);
    const auto enough = std::find_if(collapses_.begin(), collapses_.end(),
                                     [=](const Collapse& c) { return c.triangles_left <= triangles; });
    const auto all = static_cast<std::size_t>(enough - collapses_.begin());
    return replay(full_, collapses_, std::min(collapses_.size(), all + 1));
  }

 private:
  Mesh full_;
  std::vector<Collapse> collapses_;
};

}  // namespace

decimation::Decimated replay(const Mesh& full, const std::vector<Collapse>& recorded, std::size_t collapses) {
  std::vector<Vec3> positions = full.positions;
  std::vector<std::uint32_t> stands_for(positions.size());
  std::iota(stands_for.begin(), stands_for.end(), 0U);
  std::vector<std::uint32_t> key = stands_for;
  for (std::size_t k = 0; k < collapses; ++k) {
    stands_for[recorded[k].removed] = recorded[k].kept;
    // CGAL may keep one end's number and the other's place (a border vertex's): the place tells which it is.
    if (recorded[k].position == positions[recorded[k].removed])
      key[recorded[k].kept] = key[recorded[k].removed];
    positions[recorded[k].kept] = recorded[k].position;
  }
  // From the last collapse back: what a vertex went into is settled before the vertex itself.
  for (std::size_t k = collapses; k-- > 0;) {
    const Collapse& c = recorded[k];
    stands_for[c.removed] = stands_for[c.kept];
  }
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> index(positions.size(), kUnused);
  decimation::Decimated out;
  for (const auto& triangle : full.triangles) {
    std::array<std::uint32_t, 3> now{};
    std::transform(triangle.begin(), triangle.end(), now.begin(),
                   [&](std::uint32_t v) { return stands_for[v]; });
    if (now[0] == now[1] || now[1] == now[2] || now[2] == now[0]) continue;
    out.mesh.triangles.push_back(now);
    for (const std::uint32_t v : now) index[v] = 0;
  }
  for (std::uint32_t v = 0; v < index.size(); ++v) {
    if (index[v] == kUnused) continue;
    index[v] = static_cast<std::uint32_t>(out.mesh.positions.size());
    out.mesh.positions.push_back(positions[v]);
    out.keys.push_back(key[v]);
  }
  for (auto& triangle : out.mesh.triangles) {
    for (std::uint32_t& v : triangle) v = index[v];
  }
  return out;
}

std::shared_ptr<const decimation::Simplifier> make_simplifier(const Mesh& mesh, Policy policy,
                                                              bool keep_border) {
  decimation::require_sound_indices(mesh);
  return std::make_shared<const Replayed>(mesh, record_collapses(mesh, policy, keep_border, 0).collapses);
}

}  // namespace plumbline::edge_collapse
