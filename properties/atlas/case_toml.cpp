// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The text form of a case file: writing and strict reading.

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "properties/atlas/case_file.h"
#include "scenarios/error.h"
#include "scenarios/nearest.h"
#include "scenarios/toml_reader.h"

namespace plumbline::properties {
namespace {

constexpr std::string_view kSchema = "plumbline.case/1";
/// Samples a side that a case may have; a counterexample is small, and a hostile file asks for no more
/// memory.
constexpr int kSamplesMax = 1025;

// ---- writing
// -----------------------------------------------------------------------------------------------------

/// Shortest decimal that reads back to the same double. Whole numbers are written as such, unless TOML's
/// integers would change them: beyond 2⁵³ the reader refuses them, and minus zero would lose its sign.
std::string number(double x) {
  std::string text = fmt::format("{}", x);
  const bool whole = text.find_first_of(".e") == std::string::npos;
  if (whole && (std::fabs(x) > 0x1p53 || (x == 0 && std::signbit(x)))) text += ".0";
  return text;
}

std::string toml_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    } else {
      result += c;
    }
  }
  return result + "\"";
}

/// A key as TOML takes it: in quotes unless it is a bare one.
std::string toml_key(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? key : toml_text(key);
}

std::string point(Vec3 p) { return fmt::format("[{}, {}, {}]", number(p.x), number(p.y), number(p.z)); }

std::string option(const OptionValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const double* x = std::get_if<double>(&value)) return number(*x);
  return toml_text(std::get<std::string>(value));
}

// ---- reading
// -----------------------------------------------------------------------------------------------------

Vec3 read_point(const TomlValue& value) {
  const std::vector<double> xyz = value.numbers(3);
  return {xyz[0], xyz[1], xyz[2]};
}

void read_options(const TomlTable& table, Options& options) {
  for (const auto& [name, value] : table.entries()) {
    if (value.is_boolean()) {
      options[name] = value.boolean();
    } else if (value.is_number()) {
      options[name] = value.number();
    } else {
      options[name] = value.text();
    }
  }
}

void read_samples(const TomlTable& table, Terrain& terrain) {
  table.allow_only({"columns", "rows", "spacing_m", "samples_m"});
  terrain.columns = static_cast<int>(table.at("columns").integer_in(2, kSamplesMax));
  terrain.rows = static_cast<int>(table.at("rows").integer_in(2, kSamplesMax));
  terrain.spacing_m = table.at("spacing_m").positive();
  const TomlValue& rows = table.at("samples_m");
  if (rows.array().size() != static_cast<std::size_t>(terrain.rows)) {
    rows.fail(fmt::format("has {} rows; 'rows' says {}", rows.array().size(), terrain.rows));
  }
  for (const TomlValue& row : rows.array()) {
    const std::vector<double> heights = row.numbers(static_cast<std::size_t>(terrain.columns));
    terrain.heights_m.insert(terrain.heights_m.end(), heights.begin(), heights.end());
  }
}

TerrainSource read_generator(const TomlTable& table) {
  table.allow_only({"generator", "seed", "size", "spacing_m", "relief_m"});
  TerrainSource source;
  source.generator = table.at("generator").text();
  source.seed =
      static_cast<std::uint64_t>(table.integer_or("seed", 0, std::numeric_limits<std::int64_t>::max(), 1));
  source.size = static_cast<int>(table.at("size").integer_in(2, kSamplesMax));
  if (const TomlValue* spacing = table.find("spacing_m")) source.spacing_m = spacing->positive();
  if (const TomlValue* relief = table.find("relief_m")) source.relief_m = relief->positive();
  return source;
}

LawOutcome read_expected(const TomlTable& table) {
  table.allow_only({"outcome", "what", "code", "kind", "at", "gap_m"});
  LawOutcome expected;
  const TomlValue& outcome = table.at("outcome");
  std::vector<std::string> names;
  bool known = false;
  for (const auto kind : {LawOutcome::Kind::held, LawOutcome::Kind::vacuous, LawOutcome::Kind::violated}) {
    names.emplace_back(outcome_name(kind));
    if (outcome.text() == names.back()) {
      expected.kind = kind;
      known = true;
    }
  }
  if (!known) outcome.fail(unknown_name("outcome", outcome.text(), names));
  expected.what = table.text_or("what", "");
  if (const TomlValue* code = table.find("code")) {
    oracle::Finding finding;
    const std::int64_t number = code->integer_in(100, 999);
    bool listed = false;
    for (const oracle::FindingDescription& entry : oracle::finding_catalogue()) {
      listed = listed || static_cast<std::int64_t>(entry.code) == number;
    }
    if (!listed) code->fail("is no code of the catalogue of findings");
    finding.code = static_cast<oracle::FindingCode>(number);
    finding.kind = table.text_or("kind", "");
    finding.at = read_point(table.at("at"));
    finding.gap_m = table.number_or("gap_m", 0);
    expected.finding = finding;
  } else if (expected.kind == LawOutcome::Kind::violated) {
    table.fail("[expected] says violated, but names no finding; give 'code' and 'at'");
  }
  return expected;
}

Case read_case(const TomlTable& file, const CaseNames& names) {
  file.allow_only({"schema", "note", "law", "method", "threshold_px", "fov_y_deg", "viewport", "options",
                   "terrain", "pose", "expected"});
  if (file.at("schema").text() != kSchema) {
    file.at("schema").fail(fmt::format("is not \"{}\", the only form of case file that is read", kSchema));
  }
  Case c;
  c.note = file.text_or("note", "");
  const auto known = [](const TomlValue& value, auto&& look_up) {
    try {
      look_up(value.text());
    } catch (const InputError& error) {
      value.fail(fmt::format(": {}", error.what()));  // the look-up's complaint, with its place
    }
    return value.text();
  };
  c.law = known(file.at("law"), names.law);
  c.input.method = known(file.at("method"), names.method);
  c.input.threshold_px = file.at("threshold_px").positive();
  c.input.fov_y_deg = file.at("fov_y_deg").positive();
  const TomlValue& viewport = file.at("viewport");
  if (viewport.array().size() != 2) viewport.fail("is not [width, height]");
  c.input.width_px = static_cast<int>(viewport.array()[0].integer_in(1, 16384));
  c.input.height_px = static_cast<int>(viewport.array()[1].integer_in(1, 16384));
  if (const TomlValue* options = file.find("options")) read_options(options->table(), c.input.options);

  const TomlTable& terrain = file.at("terrain").table();
  if (terrain.has("generator")) {
    c.generator = read_generator(terrain);
    c.input.terrain = load_terrain(*c.generator);
  } else {
    read_samples(terrain, c.input.terrain);
  }
  for (const TomlTable* pose : file.tables("pose")) {
    pose->allow_only({"position", "look_at"});
    c.input.poses.push_back({read_point(pose->at("position")), read_point(pose->at("look_at"))});
  }
  if (c.input.poses.empty()) file.fail("no [[pose]]; give at least one");
  c.expected = read_expected(file.at("expected").table());
  return c;
}

}  // namespace

std::string case_text(const Case& c) {
  const LawInput& input = c.input;
  std::string text = fmt::format("schema = {}\n", toml_text(kSchema));
  if (!c.note.empty()) text += fmt::format("note = {}\n", toml_text(c.note));
  text += fmt::format("law = {}\nmethod = {}\n", toml_text(c.law), toml_text(input.method));
  text += fmt::format("threshold_px = {}\nfov_y_deg = {}\nviewport = [{}, {}]\n", number(input.threshold_px),
                      number(input.fov_y_deg), input.width_px, input.height_px);
  if (!input.options.empty()) {
    text += "\n[options]\n";
    for (const auto& [name, value] : input.options)
      text += fmt::format("{} = {}\n", toml_key(name), option(value));
  }
  text += "\n[terrain]\n";
  if (c.generator) {
    const TerrainSource& source = *c.generator;
    text += fmt::format("generator = {}\nseed = {}\nsize = {}\n", toml_text(source.generator), source.seed,
                        source.size.value_or(input.terrain.columns));
    if (source.spacing_m) text += fmt::format("spacing_m = {}\n", number(*source.spacing_m));
    if (source.relief_m) text += fmt::format("relief_m = {}\n", number(*source.relief_m));
  } else {
    const Terrain& terrain = input.terrain;
    text += fmt::format("columns = {}\nrows = {}\nspacing_m = {}\nsamples_m = [ # rows from the south\n",
                        terrain.columns, terrain.rows, number(terrain.spacing_m));
    for (int j = 0; j < terrain.rows; ++j) {
      text += "  [";
      for (int i = 0; i < terrain.columns; ++i) text += (i > 0 ? ", " : "") + number(terrain.z(i, j));
      text += "],\n";
    }
    text += "]\n";
  }
  for (const CameraPose& pose : input.poses) {
    text +=
        fmt::format("\n[[pose]]\nposition = {}\nlook_at = {}\n", point(pose.position), point(pose.look_at));
  }
  text += fmt::format("\n[expected]\noutcome = {}\n", toml_text(outcome_name(c.expected.kind)));
  if (!c.expected.what.empty()) text += fmt::format("what = {}\n", toml_text(c.expected.what));
  if (c.expected.finding) {
    const oracle::Finding& finding = *c.expected.finding;
    text += fmt::format("code = {} # {}\n", static_cast<int>(finding.code), finding_name(finding.code));
    if (!finding.kind.empty()) text += fmt::format("kind = {}\n", toml_text(finding.kind));
    text += fmt::format("at = {}\n", point(finding.at));
    if (finding.gap_m != 0) text += fmt::format("gap_m = {}\n", number(finding.gap_m));
  }
  return text;
}

Case parse_case(std::string_view text, const std::string& name, const CaseNames& names) {
  return read_case(parse_toml(text, name), names);
}

}  // namespace plumbline::properties
