// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>

#include "properties/atlas/case_file.h"
#include "scenarios/toml_reader.h"
#include "tests/fuzz/fuzz.h"

namespace {

using namespace plumbline;

/// A generator may be asked for 1025² samples: a second of work that teaches a fuzzer nothing.
bool asks_for_large_terrain(std::string_view text) {
  constexpr std::int64_t kLarge = 33;
  try {
    const TomlTable file = parse_toml(text, "a.toml");
    const TomlTable& terrain = file.at("terrain").table();
    return terrain.has("generator") && terrain.integer_or("size", 0, kLarge, 0) > kLarge;
  } catch (const InputError&) {
    return text.find("generator") != std::string_view::npos && text.find("size") == std::string_view::npos;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  // Names of laws and methods are looked up elsewhere, and their registries take minutes to build.
  const auto any_name = [](const std::string& id) {
    if (id.empty()) throw InputError("a name is empty");
  };
  const properties::CaseNames names{any_name, any_name};
  const auto read = [&](std::string_view from) {
    return fuzz::accepted([&] { return properties::parse_case(from, "a.toml", names); });
  };
  if (asks_for_large_terrain(text)) return 0;
  const auto c = read(text);
  if (!c) return 0;
  const Terrain& terrain = c->input.terrain;
  fuzz::require(terrain.heights_m.size() ==
                    static_cast<std::size_t>(terrain.columns) * static_cast<std::size_t>(terrain.rows),
                "samples fill the grid");
  fuzz::require(c->generator.has_value() || terrain.heights_m.size() <= size,
                "samples are bounded by the file's size");
  const std::string printed = case_text(*c);
  const auto again = read(printed);
  fuzz::require(again.has_value(), "what is printed reads back");
  fuzz::require(case_text(*again) == printed, "and prints the same again");
  return 0;
}
