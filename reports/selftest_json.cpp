// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "reports/report.h"
#include "reports/selftest_text.h"

namespace plumbline::reports {

Json selftest_object(const verdict::SelftestScore& score) {
  const verdict::KindScore all = score.total();
  Json out = {{"seed", score.seed},
              {"pass", score.perfect()},
              {"planted", score.planted()},
              {"expected", all.expected},
              {"found", all.found},
              {"misplaced", all.misplaced},
              {"false_alarms", all.false_alarms},
              {"clean_meshes", score.clean_meshes},
              {"clean_false_alarms", score.clean_false_alarms},
              {"kinds", Json::array()}};
  for (const verdict::KindScore& kind : score.kinds)
    out["kinds"].push_back({{"oracle", kind.oracle},
                            {"kind", kind.kind},
                            {"sound", kind.sound},
                            {"faults", kind.faults},
                            {"expected", kind.expected},
                            {"found", kind.found},
                            {"misplaced", kind.misplaced},
                            {"false_alarms", kind.false_alarms}});
  return out;
}

std::string selftest_json(const verdict::SelftestScore& score) {
  Json out = {{"schema", "plumbline.selftest/1"}};
  out.update(selftest_object(score));
  out["makers"] = Json::array();
  for (const verdict::MakerScore& maker : score.makers)
    out["makers"].push_back({{"name", maker.name}, {"faults", maker.faults}});
  constexpr int kKindsOnLinesOfTheirOwn = 2;
  return json_text(out, kKindsOnLinesOfTheirOwn);
}

}  // namespace plumbline::reports
