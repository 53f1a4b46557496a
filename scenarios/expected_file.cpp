// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/expected_file.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "scenarios/error.h"
#include "scenarios/gate_figures.h"
#include "scenarios/gate_reader.h"
#include "scenarios/nearest.h"

namespace plumbline {
namespace {

constexpr std::size_t kMostPatterns = 1000;  // each is held against every run
constexpr std::size_t kLongestPattern = 300;
constexpr std::size_t kLongestReason = 200;

bool chosen(const std::vector<std::string>& list, const std::string& id) {
  return list.empty() || std::find(list.begin(), list.end(), id) != list.end();
}

class ExpectedReader {
 public:
  explicit ExpectedReader(const Suite& suite) : ids_(possible_run_ids(suite)) {
    sorted_.insert(ids_.begin(), ids_.end());
    figures_.assign(kGateFigures.begin(), kGateFigures.end());
  }

  Expectation read(const TomlTable& entry) {
    entry.allow_only({"run", "figure", "value", "why"});
    Expectation expectation;
    expectation.run = read_run(entry.at("run"));
    const TomlValue& figure = entry.at("figure");
    if (std::find(figures_.begin(), figures_.end(), figure.text()) == figures_.end()) {
      figure.fail(fmt::format("is \"{}\", which is no figure; did you mean \"{}\"?",
                              one_line(figure.text(), 80), nearest_name(figure.text(), figures_)));
    }
    expectation.limit = read_limit(entry.at("value"), figure.text());
    const TomlValue& why = entry.at("why");
    if (why.text().empty() || why.text().size() > kLongestReason || one_line(why.text()) != why.text())
      why.fail(fmt::format("must be 1 to {} bytes on one line; give the reason", kLongestReason));
    expectation.why = why.text();
    if (!taken_.insert({expectation.run, figure.text()}).second)
      entry.at("run").fail(fmt::format("and '{}' stand here twice; keep one entry", figure.text()));
    return expectation;
  }

 private:
  std::string read_run(const TomlValue& run) {
    const std::string& pattern = run.text();
    if (pattern.size() > kLongestPattern)
      run.fail(fmt::format("has {} bytes; give at most {}", pattern.size(), kLongestPattern));
    if (pattern.find('*') == std::string::npos) {
      if (sorted_.count(pattern) == 0) {
        run.fail(fmt::format("is \"{}\", and the suite has no such run; did you mean \"{}\"?",
                             one_line(pattern, 80), nearest_name(pattern, ids_)));
      }
      return pattern;
    }
    if (++patterns_ > kMostPatterns)
      run.fail(fmt::format("is a pattern, and there are more than {}; name runs in full", kMostPatterns));
    if (std::none_of(ids_.begin(), ids_.end(),
                     [&](const std::string& id) { return run_matches(pattern, id); })) {
      run.fail(fmt::format("is \"{}\", which matches no run of the suite; a run is called like \"{}\"",
                           one_line(pattern, 80), nearest_name(pattern, ids_)));
    }
    return pattern;
  }

  std::vector<std::string> ids_, figures_;
  std::set<std::string> sorted_;
  std::set<std::pair<std::string, std::string>> taken_;
  std::size_t patterns_ = 0;
};

}  // namespace

bool run_matches(std::string_view pattern, std::string_view run_id) {
  // Greedy with one step back: the last '*' takes a byte more whenever what follows it does not fit.
  std::size_t p = 0, r = 0, star = std::string_view::npos, retry = 0;
  while (r < run_id.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      retry = r;
    } else if (p < pattern.size() && pattern[p] == run_id[r]) {
      ++p;
      ++r;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      r = ++retry;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

std::vector<std::string> possible_run_ids(const Suite& suite, const std::vector<std::string>& methods) {
  std::vector<std::string> ids;
  const auto fly = [&](const std::string& subject, Subject kind) {
    for (const TrajectorySpec& trajectory : suite.trajectories) {
      if (trajectory.around != kind) continue;
      for (const MethodSpec& method : suite.methods) {
        if (!chosen(methods, method.id) || !chosen(method.subjects, subject) ||
            !chosen(method.trajectories, trajectory.id)) {
          continue;
        }
        for (const double threshold_px : method.thresholds_px)
          ids.push_back(run_id(subject, trajectory.id, method.id, threshold_px));
      }
    }
  };
  for (const TerrainSource& terrain : suite.terrains) fly(terrain.id, Subject::terrain);
  for (const MeshSource& mesh : suite.meshes) fly(mesh.id, Subject::mesh);
  return ids;
}

std::vector<Expectation> read_expected(const std::filesystem::path& path, const Suite& suite) {
  return parse_expected(read_toml_text(path), path.string(), suite);
}

std::vector<Expectation> parse_expected(std::string_view text, const std::string& name, const Suite& suite) {
  const TomlTable file = parse_toml(text, name);
  file.allow_only({"expected"});
  // An empty list is what is left when everything is mended; no list is a mistake.
  if (!file.has("expected")) file.fail("has no 'expected'; add one, a list of entries");
  const auto entries = file.tables("expected");
  ExpectedReader reader(suite);
  std::vector<Expectation> expected;
  expected.reserve(entries.size());
  for (const TomlTable* entry : entries) expected.push_back(reader.read(*entry));
  return expected;
}

}  // namespace plumbline
