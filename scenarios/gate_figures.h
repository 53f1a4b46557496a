// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string_view>

namespace plumbline {

/// The figures of a run's summary that a gate may limit, by their path in results.json (conformity's counts
/// stand alone), in its order. Kept here as names only, so that a suite can be checked before anything is
/// run; a test in tests/properties holds the list against the verdict's own.
inline constexpr std::array kGateFigures{
    std::string_view{"triangles"},
    std::string_view{"triangles_max"},
    std::string_view{"crack"},
    std::string_view{"t_junction"},
    std::string_view{"fold_over"},
    std::string_view{"degenerate"},
    std::string_view{"hole"},
    std::string_view{"overlap"},
    std::string_view{"outline"},
    std::string_view{"non_manifold"},
    std::string_view{"duplicate"},
    std::string_view{"non_finite"},
    std::string_view{"bad_index"},
    std::string_view{"unused_vertex"},
    std::string_view{"visible_cracks"},
    std::string_view{"largest_gap_m"},
    std::string_view{"largest_gap_px"},
    std::string_view{"nothing_judged"},
    std::string_view{"vertical_m.max"},
    std::string_view{"vertical_m.certain_max"},
    std::string_view{"vertical_m.rms"},
    std::string_view{"vertical_m.mean"},
    std::string_view{"displacement_px.max"},
    std::string_view{"displacement_px.p999"},
    std::string_view{"displacement_px.p99"},
    std::string_view{"displacement_px.rms"},
    std::string_view{"displacement_px.mean"},
    std::string_view{"displacement_px.over_threshold"},
    std::string_view{"displacement_px.uncovered_px"},
    std::string_view{"parallax_px.max"},
    std::string_view{"parallax_px.p999"},
    std::string_view{"parallax_px.p99"},
    std::string_view{"parallax_px.rms"},
    std::string_view{"parallax_px.mean"},
    std::string_view{"depth_rel.max"},
    std::string_view{"depth_rel.p99"},
    std::string_view{"silhouette_px.pixels"},
    std::string_view{"silhouette_px.max"},
    std::string_view{"pop_px.max"},
    std::string_view{"pop_px.p99"},
    std::string_view{"stability.cuts"},
    std::string_view{"stability.recovery_frames"},
    std::string_view{"stability.unrecovered"},
    std::string_view{"stability.lag_frames"},
    std::string_view{"stability.unsettled"},
    std::string_view{"stability.toggles"},
    std::string_view{"stability.jitter_vertices"},
    std::string_view{"stability.jitter_px"},
    std::string_view{"stability.path_share"},
    std::string_view{"stability.path_px"},
    std::string_view{"stability.revisit_share"},
    std::string_view{"economy.excess"},
    std::string_view{"economy.slack"},
    std::string_view{"economy.slack_in_view"},
    std::string_view{"self_intersection"},
    std::string_view{"hausdorff_m.least"},
    std::string_view{"hausdorff_m.most"},
    std::string_view{"normal_deg.max"},
    std::string_view{"normal_deg.mean"},
    std::string_view{"normal_deg.turned_share"},
    std::string_view{"projected_area"},
    std::string_view{"shape.slivers"},
    std::string_view{"shape.min_quality"},
};

}  // namespace plumbline
