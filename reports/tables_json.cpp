// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "reports/json_text.h"
#include "reports/tables_report.h"
#include "scenarios/whole_file.h"

namespace plumbline::reports {
namespace {

Json value_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json figure_json(const tables::Figure& figure) {
  return {{"row", figure.row},
          {"figure", figure.name},
          {"unit", figure.unit},
          {"kind", kind_name(figure.kind)},
          {"printed", figure.printed.empty() ? Json() : Json(figure.printed)},
          {"recomputed", value_or_null(figure.recomputed)},
          {"agreement", agreement_name(figure.agreement())}};
}

Json trial_json(const tables::Table& table, const tables::Trial& trial) {
  Json fits = Json::array();
  for (const tables::Fit& fit : trial.fits) {
    fits.push_back({{"parameter", fit.parameter},
                    {"unit", fit.unit},
                    {"value", fit.value},
                    {"row", fit.row},
                    {"figure", fit.name},
                    {"wanted", fit.wanted},
                    {"reached", fit.reached}});
  }
  Json values = Json::array();
  for (std::size_t k = 0; k < table.figures.size(); ++k) {
    values.push_back({{"row", table.figures[k].row},
                      {"figure", table.figures[k].name},
                      {"ours", value_or_null(trial.ours.at(k))},
                      {"ours_to_paper", value_or_null(ratio(table.figures[k], trial.ours.at(k)))}});
  }
  return {{"terrain", trial.terrain}, {"view", trial.view}, {"fits", fits}, {"values", values}};
}

Json table_json(const tables::Table& table) {
  Json stand_ins = Json::array(), figures = Json::array(), trials = Json::array();
  for (const tables::StandIn& s : table.stand_ins) {
    if (s.triangles > 0) {
      stand_ins.push_back({{"id", s.id}, {"origin", s.origin}, {"triangles", s.triangles}});
      continue;
    }
    stand_ins.push_back({{"id", s.id},
                         {"origin", s.origin},
                         {"columns", s.columns},
                         {"rows", s.rows},
                         {"spacing_m", s.spacing_m},
                         {"lowest_m", s.lowest_m},
                         {"highest_m", s.highest_m}});
  }
  for (const tables::Figure& figure : table.figures) figures.push_back(figure_json(figure));
  for (const tables::Trial& trial : table.trials) trials.push_back(trial_json(table, trial));
  return {{"id", table.id},         {"title", table.title},
          {"source", table.source}, {"protocol", table.protocol},
          {"stand_ins", stand_ins}, {"figures", figures},
          {"trials", trials},       {"notes", table.notes}};
}

/// A CSV field: quoted where it must be.
std::string field(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + "\"";
}

std::string field(const std::optional<double>& value) { return value ? number_text(*value) : std::string(); }

/// To the microsecond: finer digits are the clock's noise.
double to_microseconds(double value_s) { return std::round(value_s * 1e6) / 1e6; }

}  // namespace

std::string tables_json(std::span<const tables::Table> tables) {
  Json all = Json::array();
  for (const tables::Table& table : tables) all.push_back(table_json(table));
  return json_text({{"schema", "plumbline.tables/1"}, {"tables", all}}, 5);
}

std::string tables_csv(std::span<const tables::Table> tables) {
  std::string out =
      "table,terrain,view,row,figure,unit,kind,printed,recomputed,agreement,ours,ours_to_paper\r\n";
  for (const tables::Table& table : tables) {
    for (const tables::Trial& trial : table.trials) {
      for (std::size_t k = 0; k < table.figures.size(); ++k) {
        const tables::Figure& f = table.figures[k];
        const std::optional<double>& ours = trial.ours.at(k);
        for (const std::string& cell :
             {field(table.id), field(trial.terrain), field(trial.view), field(f.row), field(f.name),
              field(f.unit), field(kind_name(f.kind)), field(std::string_view(f.printed)),
              field(f.recomputed), field(agreement_name(f.agreement())), field(ours)}) {
          out += cell + ",";
        }
        out += field(ratio(f, ours)) + "\r\n";
      }
    }
  }
  return out;
}

std::string tables_timing_json(const tables::Timings& timings) {
  Json entries = Json::array();
  for (const tables::Timing& entry : timings.entries) {
    entries.push_back({{"table", entry.table},
                       {"terrain", entry.terrain},
                       {"what", entry.what},
                       {"paper", entry.paper.empty() ? Json() : Json(entry.paper)},
                       {"wall_s", to_microseconds(entry.wall_s)},
                       {"cpu_s", to_microseconds(entry.cpu_s)},
                       {"peak_mb", entry.peak_mb > 0 ? Json(entry.peak_mb) : Json()}});
  }
  return json_text({{"schema", "plumbline.tables_timing/1"},
                    {"plumbline", PLUMBLINE_VERSION},
                    {"machine", timings.machine},
                    {"compiler", timings.compiler},
                    {"build_type", timings.build_type},
                    {"jobs", timings.jobs},
                    {"total_s", to_microseconds(timings.total_s)},
                    {"process_peak_mb", timings.process_peak_mb},
                    {"entries", entries}},
                   1);
}

void write_tables(std::span<const tables::Table> tables, const tables::Timings& timings,
                  const std::filesystem::path& out) {
  write_whole_file(out / "tables.json", tables_json(tables));
  write_whole_file(out / "tables.csv", tables_csv(tables));
  write_whole_file(out / "tables_timing.json", tables_timing_json(timings));
  write_whole_file(out / "tables.md", tables_md(tables));
}

}  // namespace plumbline::reports
