// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include <fmt/format.h>

#include "reports/escape.h"
#include "reports/picture.h"
#include "reports/report.h"
#include "scenarios/whole_file.h"

namespace plumbline::reports {

void write_reports(const verdict::SuiteVerdict& verdict, const verdict::SuiteTiming& timing,
                   std::span<const verdict::FramePictures> pictures, const std::filesystem::path& out,
                   const std::string& command) {
  write_whole_file(out / "results.json", results_json(verdict));
  write_whole_file(out / "timing.json", timing_json(timing));
  write_whole_file(out / "results.csv", results_csv(verdict));
  write_whole_file(out / "junit.xml", junit_xml(verdict));
  write_whole_file(out / "summary.md", summary_md(verdict, timing));
  for (const verdict::FramePictures& frame : pictures) {
    const std::string stem = file_stem(frame.run);
    const auto write = [&](const char* what, const Picture& picture) {
      write_whole_file(out / "images" / fmt::format("{}.{}.png", stem, what), png_bytes(picture));
    };
    write("mesh", shaded_picture(frame.shaded));
    write("error", heat_map(frame.displacement_px, frame.threshold_px));
    write("reference", shaded_picture(frame.reference));
  }
  // Last: who finds a page finds what it speaks of.
  write_whole_file(out / "report.html", report_html(verdict, timing, pictures, command));
}

}  // namespace plumbline::reports
