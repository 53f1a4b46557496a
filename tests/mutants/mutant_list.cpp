// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/mutants/mutant_list.h"

#include <array>

namespace plumbline::mutants {
namespace {

constexpr std::string_view kM1 = "haar_quadtree", kM1Morph = "haar_quadtree:morph";
constexpr std::string_view kM2 = "ring_tin", kM2Fixpoint = "ring_tin:fixpoint",
                           kM2Guarded = "ring_tin:guarded";
constexpr std::string_view kM3 = "isolated_quadtree", kM3NoCos = "isolated_quadtree:no_cos",
                           kM3Repaired = "isolated_quadtree:repaired";
constexpr std::string_view kM4 = "block_bintree", kM4TriCull = "block_bintree:tri_cull",
                           kM4Repaired = "block_bintree:repaired";
constexpr std::string_view kM5 = "vertex_tree", kM5NoContour = "vertex_tree:no_contour",
                           kM5View = "vertex_tree:view_dependent";
constexpr std::string_view kRestricted = "restricted_quadtree";
constexpr std::string_view kGreedy = "greedy_tin", kGreedySamples = "greedy_tin:samples";

constexpr auto kMutants = std::to_array<Mutant>({
    // M1: the Haar vertex quadtree.
    {"m1_haar_sign", kM1, "wrong sign in one of the three Haar details", "M1_C7"},
    {"m1_diagonal_detail_forgotten", kM1, "the error is the larger of two details, the diagonal one left out",
     "M1_C7"},
    {"m1_mean_of_three", kM1, "a node's height takes one child twice and one not at all", "M1_C7"},
    {"m1_cull_radius_halved", kM1, "the ball that is culled has half its radius", "M1_C5"},
    {"m1_single_level", kM1, "the bottom-up pass never merges: one level of detail", "nothing_judged"},
    {"m1_budget_off_by_one_split", kM1, "the node budget is exceeded by one split", "M1_C5"},
    {"m1_split_late", kM1, "later frames split at twice the threshold", "M1_C5"},
    {"m1_merge_early", kM1, "later frames merge up to twice the threshold", "M1_C5"},
    {"m1_patch_border_skipped", kM1, "the last patch of a row is not sewn to its northern neighbour",
     "conforming"},
    {"m1_neighbour_one_level_down", kM1, "looks at the wrong child of a finer neighbour", "conforming"},
    {"m1_diagonal_swapped", kM1, "a cell of four vertices is cut along the other diagonal", "M1_C6"},
    {"m1_fan_triangle_dropped", kM1, "a triangle is dropped where its neighbour is degenerate", "conforming"},
    {"m1_wrong_winding", kM1, "one of a cell's two triangles turns the other way", "conforming"},
    {"m1_morph_clamped_wrongly", kM1Morph, "the morph weight stops at a half instead of 0", "M1_C4"},
    {"m1_morph_weights_swapped", kM1Morph, "child and parent have each other's morph weight", "M1_C4"},
    {"m1_clone_shares_state", kM1, "a clone starts from the cut of its original", "starts_afresh"},
    {"m1_reset_forgotten", kM1, "reset() keeps the cut of the flight before", "starts_afresh"},
    // M2: a TIN under edge collapse in rings.
    {"m2_tolerance_of_next_ring", kM2, "each ring has the tolerance of the next one out", "M2_C3"},
    {"m2_error_halved", kM2, "an edge's error is halved", "M2_C3"},
    {"m2_reset_forgotten", kM2, "reset() keeps the collapses of the flight before", "starts_afresh"},
    {"m2_trees_never_reset", kM2, "trees that come nearer are not returned to zero", "M2_C3"},
    {"m2_restored_not_simplified", kM2, "a returned tree is not simplified again", "idempotent"},
    {"m2_folds_not_mended", kM2Guarded, "a reset folds its neighbours, which stay folded", "conforming"},
    {"m2_guard_lets_flat_through", kM2Guarded, "the guard against folds lets triangles without area through",
     "conforming"},
    {"m2_single_level", kM2, "no edge ever collapses: one level of detail", "nothing_judged"},
    {"m2_mixed_cells_stale", kM2, "cells that a ring's border cuts keep the levels they had", "M2_C3"},
    {"m2_stale_price", kM2Fixpoint, "an edge keeps the error it had at full resolution", "M2_C3"},
    {"m2_wrong_end_collapses", kM2, "the dearer end of an edge collapses at the price of the cheaper",
     "M2_C3"},
    {"m2_border_collapses", kM2Guarded, "vertices on the terrain's border collapse too", "covers_domain"},
    {"m2_depth_cap_off_by_one", kM2, "trees may be one level deeper than the cap", "M2_C5"},
    {"m2_depth_stale", kM2, "a returned vertex keeps the depth of the tree it was in", "M2_C5"},
    {"m2_members_left_behind", kM2Guarded, "a collapse moves the vertex but not those it represents",
     "conforming"},
    // M3: isolated division of a tiled quadtree.
    {"m3_cull_box_flat", kM3Repaired, "tiles are culled by a box without height", "covers_picture"},
    {"m3_tile_border_off_by_one", kM3Repaired, "the last tile's domain is one sample too wide",
     "covers_domain"},
    {"m3_no_data_test_missing", kM3Repaired, "nodes over the terrain's edge are taken for whole",
     "conforming"},
    {"m3_single_level", kM3Repaired, "the split test has no threshold: one level of detail",
     "nothing_judged"},
    {"m3_distance_squared", kM3NoCos, "error and squared distance are compared", "scaling_keeps_topology"},
    {"m3_west_not_announced", kM3Repaired, "a tile takes split points from its southern neighbour only",
     "conforming"},
    {"m3_border_not_shared", kM3Repaired, "one border of a tile is drawn without its neighbour's vertices",
     "conforming"},
    {"m3_upper_not_averaged", kM3, "heights are averaged against the left neighbour only",
     "gate largest_gap_m"},
    {"m3_average_from_wrong_end", kM3, "the average is measured from the wrong end", "gate largest_gap_m"},
    {"m3_tile_left_stale", kM3Repaired, "vertices of the tile before stay in the table", "conforming"},
    {"m3_split_point_dropped", kM3Repaired, "the finest split points of an edge are not drawn", "conforming"},
    {"m3_wrong_winding", kM3Repaired, "a fan's northern triangles turn the other way", "conforming"},
    {"m3_coarse_heights_shifted", kM3Repaired, "coarse vertices have the height of the sample beside",
     "vertices_are_samples"},
    {"m3_centre_height_forgotten", kM3Repaired, "distances are measured to the node's centre at height 0",
     "lifting"},
    {"m3_error_not_maxed", kM3, "a node's error is not the largest of its own and its children's", "M3_C2"},
    {"m3_spoke_forgotten", kM3, "a node's error leaves out some of its sixteen samples", "M3_C2"},
    // M4: block quadtree and bintree.
    {"m4_saturation_too_small", kM4, "q = 1 + e_d/4 where the paper has e_d/2", "M4_C2"},
    {"m4_saturation_forgotten", kM4, "the saturation leaves out q", "M4_C2"},
    {"m4_last_child_forgotten", kM4, "the saturation takes three of four children", "M4_C2"},
    {"m4_apex_pair_forgotten", kM4, "the deviation is measured along one of the diamond's diagonals",
     "M4_C2"},
    {"m4_threshold_squared", kM4Repaired, "the pixel ratio is divided by the threshold twice",
     "pixels_and_tau"},
    {"m4_single_level", kM4Repaired, "the error term is lost: the threshold decides nothing",
     "nothing_judged"},
    {"m4_length_term_forgotten", kM4Repaired, "the split test leaves out the length of the hypotenuse",
     "M4_C3"},
    {"m4_length_of_wrong_level", kM4Repaired, "the split test has the hypotenuse of the level above",
     "M4_C3"},
    {"m4_heights_of_first_child", kM4Repaired, "a block's height range is its first child's",
     "covers_picture"},
    {"m4_cull_radius_halved", kM4Repaired, "the ball around a block has half its radius", "covers_picture"},
    {"m4_culls_in_front", kM4TriCull, "triangles near the camera are culled", "covers_picture"},
    {"m4_left_half_twice", kM4Repaired, "at the last level the left half is drawn twice", "conforming"},
    {"m4_last_cluster_skipped", kM4Repaired, "the last cluster of a row is not drawn", "covers_domain"},
    {"m4_last_level_lost", kM4Repaired, "descent ends one level above the samples", "exact_at_zero"},
    {"m4_stale_vertices", kM4Repaired, "vertex numbers of the frame before are taken for this frame's",
     "conforming"},
    {"m4_wrong_winding", kM4Repaired, "triangles on one side of a square turn the other way", "conforming"},
    // M5: the vertex tree.
    {"m5_single_level", kM5NoContour, "the partner counts among the neighbours: nothing ever collapses",
     "nothing_judged"},
    {"m5_identifier_test_missing", kM5, "collapses without the identifier test", "conforming"},
    {"m5_split_not_forced", kM5View, "splits without the neighbours that are in the way", "conforming"},
    {"m5_refines_too_far", kM5NoContour, "refinement overshoots the rung by eight triangles", "M5_ladder"},
    {"m5_second_triangle_lost", kM5NoContour, "a split brings back one of its two triangles", "conforming"},
    {"m5_threshold_ignored", kM5NoContour, "the ladder ignores the threshold", "nothing_judged"},
    {"m5_distance_squared", kM5NoContour, "the screen size divides by the squared distance",
     "scaling_keeps_topology"},
    {"m5_contour_inverted", kM5, "nodes off the contour are held, those on it collapse", "M5_C2"},
    {"m5_refine_forgotten", kM5, "what one collapse too many took is not given back", "idempotent"},
    {"m5_reset_forgotten", kM5, "reset() keeps the cut of the flight before", "starts_afresh"},
    {"m5_clone_shares_state", kM5, "a clone starts from the cut of its original", "starts_afresh"},
    {"m5_stale_height", kM5NoContour, "a made node has the height of one child", "M5_tree"},
    {"m5_normal_limit_dropped", kM5NoContour, "collapses may turn normals at will", "M5_tree"},
    {"m5_quality_limit_dropped", kM5NoContour, "collapses may leave triangles of any shape", "M5_tree"},
    {"m5_border_lines_forgotten", kM5NoContour, "vertices leave the terrain's border", "covers_domain"},
    {"m5_ball_without_ring", kM5NoContour, "a node's ball leaves out its ring", "M5_tree"},
    {"m5_cone_without_children", kM5, "a node's cone leaves out its children's", "M5_tree"},
    // The reference methods.
    {"rq_second_parent_forgotten", kRestricted, "a vertex is enabled with one of its two parents",
     "conforming"},
    {"rq_error_not_maxed", kRestricted, "a vertex' error leaves out those that depend on it",
     "exact_at_zero"},
    {"rq_ball_forgotten", kRestricted, "the search ends at vertices whose own error is small", "monotone"},
    {"gt_least_error_first", kGreedySamples, "the heap gives the least error first",
     "triangles_fall_with_tau"},
    {"gt_between_samples_not_seen", kGreedy, "the error is bounded at samples only",
     "screen_error_within_tau"},
    {"gt_displaced_depth_forgotten", kGreedy, "the bound divides by the undisplaced depth",
     "screen_error_within_tau"},
});

}  // namespace

std::span<const Mutant> mutant_list() { return kMutants; }

}  // namespace plumbline::mutants
