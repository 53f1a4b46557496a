// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Looking up methods, variants and options by name.
#include <algorithm>

#include <fmt/format.h>

#include "algorithms/registry.h"
#include "scenarios/error.h"
#include "scenarios/nearest.h"

namespace plumbline {
namespace {

std::string_view type_name(const OptionValue& value) {
  if (std::holds_alternative<bool>(value)) return "true or false";
  if (std::holds_alternative<double>(value)) return "a number";
  return "a text";
}

template <class Value>
Value option_or(const Options& options, const std::string& name, Value fallback) {
  const auto found = options.find(name);
  if (found == options.end()) return fallback;
  if (const Value* value = std::get_if<Value>(&found->second)) return *value;
  throw InputError(fmt::format("option {} is {}; give {}", name, type_name(found->second),
                               type_name(OptionValue(fallback))));
}

void check_options(const MethodDescription& method, const Options& options) {
  for (const auto& option_and_value : options) {
    const std::string& name = option_and_value.first;  // clang 14 lets no lambda see a structured binding
    const OptionValue& value = option_and_value.second;
    const auto known = std::find_if(method.options.begin(), method.options.end(),
                                    [&](const OptionDescription& option) { return option.name == name; });
    if (known == method.options.end()) {
      if (method.options.empty()) {
        throw InputError(fmt::format("{}: takes no options; remove '{}'", method.id, name));
      }
      std::vector<std::string> names;
      for (const OptionDescription& option : method.options) names.push_back(option.name);
      throw InputError(fmt::format("{}: {}", method.id, unknown_name("option", name, names)));
    }
    if (known->default_value.index() != value.index()) {
      throw InputError(fmt::format("{}: option {} is {}; give {}", method.id, name, type_name(value),
                                   type_name(known->default_value)));
    }
  }
}

}  // namespace

std::string_view promise_name(Promise promise) {
  switch (promise) {
    case Promise::conforming:
      return "conforming";
    case Promise::covers_domain:
      return "covers_domain";
    case Promise::monotone_in_tau:
      return "monotone_in_tau";
    case Promise::idempotent:
      return "idempotent";
    case Promise::path_independent:
      return "path_independent";
    case Promise::exact_at_zero:
      return "exact_at_zero";
    case Promise::symmetric:
      return "symmetric";
    case Promise::threshold_blind:
      return "threshold_blind";
    case Promise::camera_blind:
      return "camera_blind";
    case Promise::screen_error_within_tau:
      return "screen_error_within_tau";
    case Promise::continuous_in_camera:
      return "continuous_in_camera";
  }
  return "unknown";
}

bool MethodChoice::promises(Promise promise) const {
  return std::find(variant->promises.begin(), variant->promises.end(), promise) != variant->promises.end();
}

MethodChoice find_method(std::string_view full_id) {
  const std::size_t colon = full_id.find(':');
  const std::string_view id = full_id.substr(0, colon);
  const bool has_variant = colon != std::string_view::npos;
  const std::string_view variant_name = has_variant ? full_id.substr(colon + 1) : std::string_view();

  const std::vector<MethodDescription>& methods = registered_methods();
  const auto method = std::find_if(methods.begin(), methods.end(),
                                   [&](const MethodDescription& candidate) { return candidate.id == id; });
  if (method == methods.end()) {
    std::vector<std::string> ids;
    for (const MethodDescription& candidate : methods) ids.push_back(candidate.id);
    throw InputError(unknown_name("method", id, ids));
  }
  if (!has_variant || variant_name == "published") return {&*method, &method->variants.front()};
  std::vector<std::string> names{"published"};
  for (const VariantDescription& variant : method->variants) {
    if (variant.name.empty()) continue;
    if (variant.name == variant_name) return {&*method, &variant};
    names.push_back(variant.name);
  }
  throw InputError(fmt::format("{}: {}", method->id, unknown_name("variant", variant_name, names)));
}

std::unique_ptr<LodMethod> make_method(std::string_view full_id, const Options& options) {
  const MethodChoice choice = find_method(full_id);
  check_options(*choice.method, options);
  return choice.method->make(choice.variant->name, options);
}

double option_number(const Options& options, const std::string& name, double fallback) {
  return option_or<double>(options, name, fallback);
}

bool option_flag(const Options& options, const std::string& name, bool fallback) {
  return option_or<bool>(options, name, fallback);
}

std::string option_text(const Options& options, const std::string& name, const std::string& fallback) {
  return option_or<std::string>(options, name, fallback);
}

}  // namespace plumbline
