// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "algorithms/greedy_tin/delaunay.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>

namespace plumbline::greedy_tin {
namespace {

/// A triangle's number, none at first.
struct Number {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t value = kNone;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_2<Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<Number, Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation = CGAL::Delaunay_triangulation_2<Kernel, Structure>;
using Face = Triangulation::Face_handle;

// CGAL takes the lexicographically last of four points on a circle for the one outside. With y pointing south
// that is a cell's (i+1, j) corner, which leaves the diagonal from (i, j) to (i+1, j+1).
Kernel::Point_2 mirrored(Sample s) { return {static_cast<double>(s.i), -static_cast<double>(s.j)}; }

}  // namespace

struct Delaunay::State {
  Triangulation triangulation;
  std::vector<Face> faces;  ///< by number; insertions inside the hull delete none

  void number(Face face, std::vector<std::uint32_t>& free) {
    if (face->info().value != Number::kNone) return;
    if (free.empty()) {
      free.push_back(static_cast<std::uint32_t>(faces.size()));
      faces.emplace_back();
    }
    face->info().value = free.back();
    faces[free.back()] = face;
    free.pop_back();
  }
};

Delaunay::Delaunay(int columns, int rows) : state_(std::make_unique<State>()) {
  for (const Sample s :
       {Sample{0, 0}, Sample{columns - 1, 0}, Sample{0, rows - 1}, Sample{columns - 1, rows - 1}}) {
    state_->triangulation.insert(mirrored(s));
  }
  std::vector<std::uint32_t> none;
  for (auto f = state_->triangulation.finite_faces_begin(); f != state_->triangulation.finite_faces_end();
       ++f) {
    state_->number(f, none);
  }
}

Delaunay::~Delaunay() = default;

void Delaunay::insert(Sample sample, std::uint32_t near, std::vector<std::uint32_t>& changed) {
  changed.clear();
  const auto vertex = state_->triangulation.insert(mirrored(sample), state_->faces[near]);
  const auto first = state_->triangulation.incident_faces(vertex);
  // On the hull a face may have come to lie outside of it: its number goes to another.
  std::vector<std::uint32_t> free;
  auto face = first;
  do {
    if (state_->triangulation.is_infinite(face) && face->info().value != Number::kNone) {
      free.push_back(std::exchange(face->info().value, Number::kNone));
    }
  } while (++face != first);
  do {
    if (state_->triangulation.is_infinite(face)) continue;
    state_->number(face, free);
    changed.push_back(face->info().value);
  } while (++face != first);
}

std::array<Sample, 3> Delaunay::corners(std::uint32_t triangle) const {
  const Face face = state_->faces[triangle];
  std::array<Sample, 3> out;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& point = face->vertex(static_cast<int>(2 - k))->point();  // mirrored back: turned round
    out[k] = {static_cast<int>(point.x()), static_cast<int>(-point.y())};
  }
  const auto first = std::min_element(out.begin(), out.end(),
                                      [](Sample a, Sample b) { return a.j != b.j ? a.j < b.j : a.i < b.i; });
  std::rotate(out.begin(), first, out.end());
  return out;
}

std::size_t Delaunay::triangle_count() const { return state_->faces.size(); }

}  // namespace plumbline::greedy_tin
