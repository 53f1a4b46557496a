// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/compare_report.h"
#include "reports/json_text.h"

namespace plumbline::reports {
namespace {

Json value_json(const std::optional<double>& value, const std::string& text) {
  return value ? Json(*value) : Json(text);
}

}  // namespace

std::string compare_json(const verdict::Comparison& comparison) {
  using verdict::Change;
  Json out = {{"schema", "plumbline.compare/1"},
              {"of", comparison.schema},
              {"old", comparison.before},
              {"new", comparison.after},
              {"tolerance", comparison.tolerance},
              {"verdict", comparison.word()},
              {"worse", comparison.count(Change::worse)},
              {"better", comparison.count(Change::better)},
              {"changed", comparison.count(Change::changed)},
              {"same", comparison.same},
              {"within_tolerance", comparison.within_tolerance},
              {"compared", comparison.subjects},
              {"notes", comparison.notes},
              {"differences", Json::array()}};
  for (const verdict::Difference& one : comparison.differences) {
    Json row = {{"change", change_name(one.change)},
                {"matter", matter_name(one.matter)},
                {"where", one.where},
                {"what", one.what},
                {"old", value_json(one.before, one.before_text)},
                {"new", value_json(one.after, one.after_text)}};
    if (!one.note.empty()) row["note"] = one.note;
    out["differences"].push_back(std::move(row));
  }
  return json_text(out, 1);
}

}  // namespace plumbline::reports
