// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The registry entry of ring_tin: variants, options, claims.
#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "algorithms/registry.h"
#include "algorithms/ring_tin/ring_tin.h"
#include "scenarios/error.h"

namespace plumbline {
namespace {

using ring_tin::Settings;
using ring_tin::Variant;

constexpr std::size_t kMostRings = 64;
constexpr int kDeepest = 32;  ///< deeper trees than this hold more vertices than a TIN has

/// Numbers separated by blanks or commas.
std::vector<double> read_list(const std::string& name, const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at != end) {
    if (*at == ' ' || *at == ',') {
      ++at;
      continue;
    }
    double number = 0;
    const auto [rest, error] = std::from_chars(at, end, number);
    if (error != std::errc() || !std::isfinite(number) || number < 0) {
      throw InputError(
          fmt::format("ring_tin: option {} = \"{}\" is no list of finite numbers, none below 0; give e.g. "
                      "\"100 250 500\"",
                      name, text));
    }
    numbers.push_back(number);
    at = rest;
  }
  return numbers;
}

Settings read_settings(std::string_view variant, const Options& options) {
  Settings s;
  s.variant = variant == "fixpoint"  ? Variant::fixpoint
              : variant == "guarded" ? Variant::guarded
                                     : Variant::published;
  s.rings.half_size_m = read_list("rings_m", option_text(options, "rings_m", ring_tin::kRingsTable1));
  s.rings.delta_px = read_list("delta_px", option_text(options, "delta_px", ring_tin::kDeltaTable1));
  s.rings.mean_distance = option_flag(options, "mean_distance", false);
  const double depth_cap = option_number(options, "depth_cap", s.depth_cap);
  s.focal_px = option_number(options, "focal_px", s.focal_px);
  s.leave_whole_trees = option_flag(options, "leave_whole_trees", false);
  s.points.share = option_number(options, "point_share", s.points.share);
  const double seed = option_number(options, "point_seed", 1);
  s.database = option_text(options, "database", "");

  const std::vector<double>& d = s.rings.half_size_m;
  if (d.empty() || d.size() > kMostRings) {
    throw InputError(
        fmt::format("ring_tin: option rings_m has {} half sizes; give 1 to {}", d.size(), kMostRings));
  }
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (d[i] > (i == 0 ? 0 : d[i - 1])) continue;
    throw InputError(fmt::format(
        "ring_tin: option rings_m: {} is not above the ring before it; give rising half sizes", d[i]));
  }
  if (s.rings.delta_px.size() != d.size()) {
    throw InputError(fmt::format("ring_tin: option delta_px has {} tolerances for {} rings; give one a ring",
                                 s.rings.delta_px.size(), d.size()));
  }
  if (!(depth_cap >= 1 && depth_cap <= kDeepest) || depth_cap != std::floor(depth_cap)) {
    throw InputError(
        fmt::format("ring_tin: option depth_cap = {} is no whole number from 1 to {}; the paper's is 6",
                    depth_cap, kDeepest));
  }
  s.depth_cap = static_cast<int>(depth_cap);
  if (!(s.focal_px >= 0 && std::isfinite(s.focal_px))) {
    throw InputError(fmt::format(
        "ring_tin: option focal_px = {} is below 0 or not finite; 0 takes the camera's", s.focal_px));
  }
  if (!(s.points.share >= 0 && s.points.share <= 1)) {
    throw InputError(fmt::format("ring_tin: option point_share = {} is not inside [0, 1]", s.points.share));
  }
  if (!(seed >= 0 && seed <= 0x1p53) || seed != std::floor(seed)) {
    throw InputError(fmt::format("ring_tin: option point_seed = {} is no whole number from 0 to 2^53", seed));
  }
  s.points.seed = static_cast<std::uint64_t>(seed);
  return s;
}

}  // namespace

MethodDescription describe_ring_tin() {
  using enum Promise;
  return {
      .id = "ring_tin",
      .title = "TIN simplified by edge collapse inside nested square rings",
      .citation =
          "Yu, Zuo & Li, \"A view-dependent dynamic multi-resolution terrain model of TIN\" (in Chinese; the "
          "text at hand names no venue or year)",
      .section = "M2",
      .variants =
          {
              {"",
               "as published: one scan by edge index; a reset restores exactly its tree",
               {conforming, covers_domain, idempotent}},
              {"fixpoint",
               "collapses by rising error, then index, until no edge qualifies",
               {conforming, covers_domain, idempotent}},
              {"guarded",
               "no collapse turns a triangle over; a reset takes along the trees that it would fold",
               {conforming, covers_domain, idempotent}},
          },
      .options =
          {
              {"rings_m", "half sizes D_i of the rings, metres, rising", std::string(ring_tin::kRingsTable1)},
              {"delta_px", "pixel tolerances of the rings at threshold 1; the threshold multiplies them",
               std::string(ring_tin::kDeltaTable1)},
              {"mean_distance", "tolerances from a ring's mean distance, as the text has it, not D_i", false},
              {"depth_cap", "levels of a tree of collapses; the paper names 4, 5 and 6", 6.0},
              {"focal_px", "f; 0: the camera's; the paper's table has 512", 0.0},
              {"leave_whole_trees", "do not reset a tree that moved wholly into a finer ring", false},
              {"point_share", "share of the samples that become points, drawn at random; corners always do",
               1.0},
              {"point_seed", "of that draw", 1.0},
              {"database", "SQLite file that keeps the prepared TIN; made if it is not there", std::string()},
          },
      .claims =
          {
              {"M2.C1",
               "nearer is finer: triangles per area never rise from ring to ring on uniform terrain"},
              {"M2.C2", "turning on the spot changes nothing; a step changes trees at ring borders (8 %)"},
              {"M2.C3", "screen error at most delta_i"},
              {"M2.C4", "no crossing, overlapping or sliver triangles"},
              {"M2.C5", "about 10 % of the edges are refused by the depth cap"},
              {"M2.C6", "45 to 49 % of the triangles remain (Table 2)"},
              {"M2.C7", "rings at most 500 m apart; their number hardly changes the cost"},
          },
      .make =
          [](std::string_view variant, const Options& options) {
            return std::make_unique<ring_tin::RingTin>(read_settings(variant, options));
          },
  };
}

}  // namespace plumbline
