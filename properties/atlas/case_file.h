// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "properties/laws/law.h"
#include "scenarios/terrain_source.h"

/// A case file: one trial of one law, self-contained, with the outcome that was found (CONTRACT.md). The
/// atlas is a folder of them.
namespace plumbline::properties {

/// A case file: the input, and what the law is to say of it.
struct Case {
  std::string note;  ///< what the case shows, for readers; may be empty
  std::string law;
  LawInput input;  ///< `make` is not part of a case
  /// Where the terrain comes from, if the file names a generator instead of listing samples.
  std::optional<TerrainSource> generator;
  LawOutcome expected;  ///< kind, what, and of the finding: code, kind, at, gap_m
};

/// The file's text: TOML, numbers in the shortest form that reads back to the same bits.
std::string case_text(const Case& c);

/// Writes the file whole or not at all. Throws InputError if it cannot be written.
void write_case(const std::filesystem::path& path, const Case& c);

/// Strict: throws InputError, one line with file and place, for what is not TOML, an unknown or missing key,
/// a wrong type, samples that do not fill the grid, an unknown law or method or outcome.
Case load_case(const std::filesystem::path& path);
/// The same from memory; `name` stands for the file in complaints.
Case parse_case(std::string_view text, const std::string& name);
/// Which laws and methods a case may name: throws InputError for any other.
struct CaseNames {
  std::function<void(const std::string&id)> law, method;
};
/// The same with other names than the registries'.
Case parse_case(std::string_view text, const std::string& name, const CaseNames& names);

/// What a case does when it is run again.
struct ReplayResult {
  LawOutcome outcome;
  bool confirmed = false;  ///< the outcome is the stored one, bit for bit
  std::string difference;  ///< what differs; empty if confirmed
};

/// Runs the case again. Throws InputError if the method takes this terrain or these options no more.
ReplayResult replay(const Case& c);

}  // namespace plumbline::properties
