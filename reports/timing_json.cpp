// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "reports/json_text.h"
#include "reports/quantile.h"
#include "reports/report.h"

namespace plumbline::reports {
namespace {

/// To the nanosecond, when `value` counts milliseconds: finer digits are the clock's noise.
double to_nanoseconds(double value) { return std::round(value * 1e6) / 1e6; }

}  // namespace

std::string timing_json(const verdict::SuiteTiming& timing) {
  Json out = {{"schema", "plumbline.timing/1"},
              {"plumbline", PLUMBLINE_VERSION},
              {"machine", timing.machine},
              {"compiler", timing.compiler},
              {"build_type", timing.build_type},
              {"jobs", timing.jobs},
              {"total_s", to_nanoseconds(timing.total_s)},
              {"runs", Json::array()}};
  for (const verdict::RunTiming& run : timing.runs) {
    Json frames = Json::array();
    for (const double update_ms : run.update_ms) frames.push_back(to_nanoseconds(update_ms));
    out["runs"].push_back({{"run", run.run},
                           {"prepare_s", to_nanoseconds(run.prepare_s)},
                           {"oracle_s", to_nanoseconds(run.oracle_s)},
                           {"update_ms",
                            {{"median", to_nanoseconds(quantile(run.update_ms, 0.5))},
                             {"p95", to_nanoseconds(quantile(run.update_ms, 0.95))},
                             {"frames", std::move(frames)}}}});
  }
  return json_text(out, 1);
}

}  // namespace plumbline::reports
