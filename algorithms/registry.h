// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "algorithms/lod_method.h"
#include "scenarios/suite.h"

namespace plumbline {

/// What a method promises; laws and oracles hold it to these, and list the others as "not promised".
enum class Promise {
  conforming,               ///< no point covered twice, edge to edge, at equal heights, no hole inside
  covers_domain,            ///< reaches the outline of the domain that each frame promises, and not beyond
  monotone_in_tau,          ///< a larger threshold never gives more triangles on the same promised domain
  idempotent,               ///< a second update with the same camera changes nothing
  path_independent,         ///< the mesh depends on the camera, not on the flight before it
  exact_at_zero,            ///< at a vanishing threshold every sample is met
  symmetric,                ///< commutes with the eight symmetries of the grid
  threshold_blind,          ///< ignores the threshold (one run serves all)
  camera_blind,             ///< ignores the camera (one mesh a threshold)
  screen_error_within_tau,  ///< no point of the picture is displaced by more than the threshold
  continuous_in_camera,     ///< while the camera stands still, merging changes nothing visible
};
/// As the enumerator is spelled.
std::string_view promise_name(Promise promise);

/// A variant of a method: what it does differently, and what it promises then.
struct VariantDescription {
  std::string name;  ///< without the method's id; "" is the published default
  std::string summary;
  std::vector<Promise> promises;
};

/// An option that a suite's `[[method]] options` may set; a value of another type than the default's is
/// refused.
struct OptionDescription {
  std::string name;
  std::string summary;
  OptionValue default_value;
};

/// One claim of the paper, as METHODS numbers it.
struct ClaimDescription {
  std::string id;  ///< "M4.C1"
  std::string text;
};

/// A registry entry: one method with its variants.
struct MethodDescription {
  std::string id;  ///< "block_bintree"
  std::string title;
  std::string citation{};  ///< authors, title, venue, year; empty: unpublished
  std::string section{};   ///< where in METHODS / the paper: "M4", "reference"; may be empty
  std::vector<VariantDescription> variants{};  ///< first: the published default, name ""
  std::vector<OptionDescription> options{};
  std::vector<ClaimDescription> claims{};
  bool takes_objects = false;  ///< general meshes too (LodMethod::prepare_objects), not terrains alone
  /// `variant` is one of the names above; options are checked against `options` before the call.
  std::function<std::unique_ptr<LodMethod>(std::string_view variant, const Options& options)> make{};
};

/// The methods that plumbline brings along, in the order of the plumbline_add_method lines.
const std::vector<MethodDescription>& built_in_methods();

/// Enters methods of your own behind the built-in ones, in the order given; run_program (cli/program.h) calls
/// it. Call it before anything looks a method up: the first look-up closes the registry, and what it gave
/// stays valid to the end. Throws InputError, and enters none of them, for an id that is taken or is no name
/// (a small letter, then small letters, digits and '_'), for a description without title, factory or
/// published variant, and for a registry that is closed.
void register_methods(std::vector<MethodDescription> methods);

/// All methods: the built-in ones, then those that were entered. The same list from the first call on.
const std::vector<MethodDescription>& registered_methods();

/// A method with its variant chosen.
struct MethodChoice {
  const MethodDescription* method = nullptr;
  const VariantDescription* variant = nullptr;
  /// Whether this variant promises it.
  [[nodiscard]] bool promises(Promise promise) const;
};

/// Finds "id" or "id:variant" ("id:published" names the default too). Throws InputError naming the nearest
/// known id.
MethodChoice find_method(std::string_view full_id);

/// Makes an unprepared instance. Throws InputError for an unknown option (naming the nearest) or a wrong
/// type.
std::unique_ptr<LodMethod> make_method(std::string_view full_id, const Options& options = {});

/// Typed look-up with the description's default; for use inside `make`.
double option_number(const Options& options, const std::string& name, double fallback);
bool option_flag(const Options& options, const std::string& name, bool fallback);
std::string option_text(const Options& options, const std::string& name, const std::string& fallback);

}  // namespace plumbline
