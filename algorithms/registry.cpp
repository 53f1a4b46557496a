// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The list of all methods: the built-in ones (written by cmake/PlumblineMethods.cmake), then a user's own. A
// call enters these, not a static initialiser: a linker drops an archive's member that nobody calls.
#include "algorithms/registry.h"

#include <algorithm>
#include <iterator>
#include <mutex>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "scenarios/error.h"

namespace plumbline {
namespace {

struct Entered {
  std::mutex mutex;
  std::vector<MethodDescription> methods;
  bool closed = false;
};

Entered& entered() {
  static Entered one;
  return one;
}

/// Names stand in file names, run ids and TOML keys, and before and behind a colon.
bool is_name(std::string_view text) {
  const auto small = [](char c) { return c >= 'a' && c <= 'z'; };
  return !text.empty() && small(text.front()) && std::all_of(text.begin(), text.end(), [&](char c) {
    return small(c) || (c >= '0' && c <= '9') || c == '_';
  });
}

void check_names(const std::string& id, const char* what, const std::vector<std::string>& names) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (!is_name(name)) {
      throw InputError(fmt::format(
          "method '{}': {} '{}' is no name; give a small letter, then small letters, digits and '_'", id,
          what, name));
    }
    if (!seen.insert(name).second) {
      throw InputError(fmt::format("method '{}': {} '{}' is there twice; rename one", id, what, name));
    }
  }
}

void check_description(const MethodDescription& method) {
  if (!is_name(method.id)) {
    throw InputError(fmt::format(
        "method id '{}' is no name; give a small letter, then small letters, digits and '_'", method.id));
  }
  if (method.title.empty()) {
    throw InputError(fmt::format("method '{}' has no title; say in a few words what it is", method.id));
  }
  if (!method.make) {
    throw InputError(fmt::format("method '{}' has no factory; set MethodDescription::make", method.id));
  }
  if (method.variants.empty() || !method.variants.front().name.empty()) {
    throw InputError(fmt::format(
        "method '{}' has no published variant; give its promises in a first variant named \"\"", method.id));
  }
  std::vector<std::string> names{"published"};  // the other name of the first
  for (std::size_t k = 1; k < method.variants.size(); ++k) names.push_back(method.variants[k].name);
  check_names(method.id, "variant", names);
  names.clear();
  for (const OptionDescription& option : method.options) names.push_back(option.name);
  check_names(method.id, "option", names);
}

}  // namespace

void register_methods(std::vector<MethodDescription> methods) {
  Entered& list = entered();
  const std::lock_guard lock(list.mutex);
  if (methods.empty()) return;
  if (list.closed) {
    throw InputError(fmt::format(
        "method '{}' comes too late: methods were looked up already; register it first", methods[0].id));
  }
  std::set<std::string> taken;
  for (const MethodDescription& method : built_in_methods()) taken.insert(method.id);
  for (const MethodDescription& method : list.methods) taken.insert(method.id);
  for (const MethodDescription& method : methods) {
    check_description(method);
    if (!taken.insert(method.id).second) {
      throw InputError(fmt::format("method id '{}' is taken; give yours another", method.id));
    }
  }
  std::move(methods.begin(), methods.end(), std::back_inserter(list.methods));
}

const std::vector<MethodDescription>& registered_methods() {
  static const std::vector<MethodDescription> all = [] {
    Entered& list = entered();
    const std::lock_guard lock(list.mutex);
    list.closed = true;
    std::vector<MethodDescription> methods = built_in_methods();
    std::move(list.methods.begin(), list.methods.end(), std::back_inserter(methods));
    return methods;
  }();
  return all;
}

}  // namespace plumbline
