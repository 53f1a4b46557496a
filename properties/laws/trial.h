// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "properties/laws/law.h"

/// What the laws share: to make, fly and compare.
namespace plumbline::properties {

/// The input's method, made and prepared on its terrain, with its threshold set. `input` must outlive it.
std::unique_ptr<LodMethod> prepared_method(const LawInput& input);

/// A clone as `prepared_method` would give it: clones take their threshold from the flight, not from the
/// original.
std::unique_ptr<LodMethod> flyer(const LodMethod& prepared, double threshold_px);

/// The input's flight, one camera a pose.
std::vector<Camera> cameras(const LawInput& input);
Camera judged_camera(const LawInput& input);

/// The frame of the last of `flight`, after all the others.
LodFrame fly(LodMethod& method, std::span<const Camera> flight);

/// For a scene that is scaled: options of the input's method that are lengths on the ground go along (rings,
/// given or by default), and so do roads.
void scale_lengths(LawInput& input, double scale);

/// What differs first between two frames: mesh, vertex keys and domain, compared bit by bit. Empty: nothing.
/// Counters are not compared: the second update of a method with memory does less work.
std::string first_difference(const LodFrame& a, const LodFrame& b);

/// Whether triangles of different size stand in the mesh (plan areas a factor of 1.5 apart; levels of a
/// hierarchy differ by 2 or more). A mesh of one level has no seam at which anything could break.
bool has_several_levels(const Mesh& mesh);

LawOutcome held();
LawOutcome vacuous(std::string why);
LawOutcome violated(std::string what, oracle::Finding finding);
/// A finding of the laws' own (401) at a place.
oracle::Finding law_finding(std::string kind, Vec3 at);

/// Whether the chosen method ignores the threshold, so that one level of detail is all there is to judge.
bool is_threshold_blind(const LawInput& input);
/// Whether the method promises to ignore the camera.
bool is_camera_blind(const LawInput& input);

// Each law's maker, defined in the file named after the law; laws of one method alone in that method's
// (m1_laws.cpp, …), covers_picture with screen_error_within_tau, which looks at the same picture.
Law law_conforming();
Law law_covers_domain();
Law law_error_is_monotone();
Law law_split_test_is_monotone();
Law law_triangles_fall_with_tau();
Law law_idempotent();
Law law_path_independent();
Law law_exact_at_zero();
Law law_scaling_keeps_topology();
Law law_symmetric();
Law law_screen_error_within_tau();
Law law_continuous_in_camera();
Law law_covers_picture();
Law law_starts_afresh();
Law law_lifting_keeps_topology();
Law law_threshold_is_in_pixels();
Law law_vertices_are_samples();
Law law_haar_nodes_are_means();
Law law_haar_morphs_by_error();
Law law_restricted_selects();
Law law_haar_walk_is_collapsed_grid();
Law law_haar_cut_settles_within_tau();
Law law_ring_prices_are_distances();
Law law_ring_collapses_within_tolerance();
Law law_isolated_error_is_conservative();
Law law_vertex_tree_is_as_built();
Law law_vertex_tree_keeps_neighbourhoods();
Law law_vertex_tree_holds_contour();
Law law_vertex_tree_meets_ladder();

}  // namespace plumbline::properties
