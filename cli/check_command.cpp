// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <charconv>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/commands.h"
#include "properties/check/check.h"
#include "reports/check_report.h"
#include "reports/escape.h"
#include "scenarios/error.h"
#include "scenarios/nearest.h"
#include "scenarios/pose.h"
#include "scenarios/whole_file.h"

namespace plumbline::cli {
namespace {

struct CheckArguments {
  std::vector<std::string> meshes;
  std::string terrain, placing = "guess", holes = "leave_out", reference, declared, camera, up = "guess",
                       kind = "guess", unit = "1", skirt, json, sarif, report;
  double tau_px = 1;
  int jobs = 0;
  bool strict = false, quiet = false, all = false;
};

double number(const std::string& option, const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    throw InputError(fmt::format("{} '{}': give a number", option, one_line(text, 60)));
  return value;
}

double positive(const std::string& option, const std::string& text, double most) {
  const double value = number(option, text);
  if (!(value > 0 && value <= most))
    throw InputError(
        fmt::format("{} {}: give a number above 0, at most {}", option, one_line(text, 60), most));
  return value;
}

template <class Value>
Value chosen(const std::string& option, const std::string& text, const std::map<std::string, Value>& known) {
  if (const auto found = known.find(text); found != known.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : known) names.push_back(entry.first);
  throw InputError(unknown_name(option, text, names));
}

/// Bounds on what a person could mean: metres per unit, a bound in metres, a skirt.
constexpr double kLargestUnit = 1e9, kLargestBound = 1e9, kLeastTauPx = 1e-9, kMostTauPx = 1e9;

CheckRequest request_of(const CheckArguments& arguments) {
  CheckRequest request;
  for (const std::string& mesh : arguments.meshes) request.inputs.emplace_back(mesh);
  request.terrain = arguments.terrain;
  request.placing = arguments.placing;
  request.holes = chosen<DemHoles>("--holes", arguments.holes,
                                   {{"leave_out", DemHoles::leave_out},
                                    {"crop", DemHoles::crop},
                                    {"fill", DemHoles::fill},
                                    {"refuse", DemHoles::refuse}});
  request.reference = arguments.reference;
  if (!arguments.declared.empty()) {
    const double declared = number("--declared", arguments.declared);
    if (!(declared >= 0 && declared <= kLargestBound))
      throw InputError(fmt::format("--declared {}: give a bound in metres, from 0 to {}", arguments.declared,
                                   kLargestBound));
    request.declared_m = declared;
  }
  if (!arguments.camera.empty()) {
    const Pose pose = parse_pose(arguments.camera);
    request.camera = {pose.position, pose.look_at, pose.fov_y_deg, pose.width_px, pose.height_px};
  }
  using Up = CheckRequest::Up;
  request.up =
      chosen<Up>("--up", arguments.up, {{"guess", Up::guess}, {"x", Up::x}, {"y", Up::y}, {"z", Up::z}});
  using Kind = CheckRequest::Kind;
  request.kind = chosen<Kind>("--kind", arguments.kind,
                              {{"guess", Kind::guess}, {"terrain", Kind::terrain}, {"object", Kind::object}});
  constexpr double kFootM = 0.3048;
  request.unit_m = arguments.unit == "feet" ? kFootM : positive("--unit", arguments.unit, kLargestUnit);
  if (arguments.skirt == "cesium") {
    request.cesium_skirt = true;
  } else if (!arguments.skirt.empty()) {
    const double skirt = number("--skirt", arguments.skirt);
    if (!(skirt >= 0 && skirt <= kLargestBound))
      throw InputError(fmt::format("--skirt {}: give its height in metres, or 'cesium'", arguments.skirt));
    request.skirt_m = skirt;
  }
  request.threshold_px = arguments.tau_px;
  request.strict = arguments.strict;
  request.pictures = !arguments.report.empty();
  request.jobs = arguments.jobs;
  return request;
}

/// The line that repeats the check; where its files go changes no figure.
std::string repeat_line(const CheckArguments& arguments) {
  std::string line = "plumbline check";
  for (const std::string& mesh : arguments.meshes) line += " " + reports::shell_word(mesh);
  const auto option = [&](const char* name, const std::string& value, const std::string& usual = {}) {
    if (value != usual) line += fmt::format(" {} {}", name, reports::shell_word(value));
  };
  option("--terrain", arguments.terrain);
  option("--placing", arguments.placing, "guess");
  option("--holes", arguments.holes, "leave_out");
  option("--reference", arguments.reference);
  option("--declared", arguments.declared);
  option("--camera", arguments.camera);
  option("--tau", fmt::format("{}", arguments.tau_px), "1");
  option("--up", arguments.up, "guess");
  option("--kind", arguments.kind, "guess");
  option("--unit", arguments.unit, "1");
  option("--skirt", arguments.skirt);
  if (arguments.strict) line += " --strict";
  return line;
}

int run_check(const CheckArguments& arguments) {
  const CheckRequest request = request_of(arguments);
  end_at_interrupt();
  // Known before the work, not after.
  if (!arguments.report.empty()) require_writable(arguments.report);
  for (const std::string& file : {arguments.json, arguments.sarif}) {
    if (!file.empty()) require_writable_file(file);
  }
  const CheckOutcome outcome = check(request);
  if (!arguments.json.empty()) write_whole_file(arguments.json, reports::check_json(outcome.verdict));
  if (!arguments.sarif.empty()) write_whole_file(arguments.sarif, reports::check_sarif(outcome.verdict));
  if (!arguments.report.empty())
    reports::write_check_report(outcome.verdict, outcome.pictures, arguments.report, repeat_line(arguments));
  if (!arguments.quiet) {
    fmt::print("{}", reports::check_text(outcome.verdict,
                                         arguments.all ? reports::Listing::full : reports::Listing::brief));
    if (!arguments.report.empty())
      fmt::print("report: {}\n", (std::filesystem::path(arguments.report) / "check.html").string());
  }
  return outcome.verdict.sound ? kPass : kFinding;
}

}  // namespace

void add_check(CLI::App& program, int& status) {
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App* command = program.add_subcommand(
      "check",
      "Judge meshes that any program made: cracks, T-junctions, fold-overs, seams between tiles, exactly; "
      "with a DEM the true vertical error; with a camera the error in the picture");
  command
      ->add_option(
          "mesh", arguments->meshes,
          "PLY, OBJ, STL, OFF, GLB/glTF, quantized-mesh .terrain, or a folder of such tiles; several "
          "are taken to fit together")
      ->required();
  command->add_option("--terrain", arguments->terrain,
                      "the DEM that the meshes stand for (anything GDAL opens)");
  command
      ->add_option("--placing", arguments->placing,
                   "how the meshes lie over the DEM: guess, crs, crs_units, local (metres from its "
                   "south-west sample), samples (column, row from the north), samples_up, samples_scaled, "
                   "centred, fit")
      ->capture_default_str();
  command
      ->add_option("--holes", arguments->holes,
                   "samples of the DEM without data: leave_out, crop, fill, refuse")
      ->capture_default_str();
  command->add_option("--reference", arguments->reference,
                      "a mesh that the one given stands for: certified distances in space");
  command->add_option("--declared", arguments->declared,
                      "the error bound that the maker declares, metres: is it true?");
  command->add_option("--camera", arguments->camera, "x,y,z:x,y,z[:fov_y_deg[:WxH]]: position, look-at");
  command->add_option("--tau", arguments->tau_px, "threshold of the picture, pixels")
      ->capture_default_str()
      ->check(CLI::Range(kLeastTauPx, kMostTauPx));
  command->add_option("--up", arguments->up, "which axis is up: guess, x, y, z")->capture_default_str();
  command->add_option("--kind", arguments->kind, "guess, terrain, object")->capture_default_str();
  command->add_option("--unit", arguments->unit, "metres per unit of the files, or 'feet'")
      ->capture_default_str();
  command->add_option("--skirt", arguments->skirt,
                      "height in metres of the skirt that the client adds, or 'cesium' for CesiumJS's rule");
  command->add_flag("--strict", arguments->strict, "hazards make a mesh faulty, too");
  command->add_option("--json", arguments->json, "write the verdict as JSON there");
  command->add_option("--sarif", arguments->sarif, "write the findings as SARIF 2.1.0 there");
  command->add_option("--report", arguments->report,
                      "write a page with pictures there, and each bad spot as GLB");
  command->add_option("--jobs", arguments->jobs, "threads; 0: one a core")->check(CLI::Range(0, 1024));
  command->add_flag("--all", arguments->all, "list every finding that was kept");
  command->add_flag("--quiet", arguments->quiet, "print nothing but errors");
  command->callback([arguments, &status] { status = run_check(*arguments); });
}

}  // namespace plumbline::cli
