// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "reports/encoded_frame.h"
#include "reports/escape.h"
#include "reports/report.h"
#include "scenarios/whole_file.h"

namespace plumbline::reports {

namespace {

/// Pictures of an earlier report in the same folder would pass for this one's.
void remove_old_pictures(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    for (const char* kind : {".mesh.png", ".error.png", ".reference.png"}) {
      if (name.ends_with(kind)) old.push_back(entry.path());
    }
  }
  for (const std::filesystem::path& path : old) std::filesystem::remove(path, error);
}

}  // namespace

void write_reports(const verdict::SuiteVerdict& verdict, const verdict::SuiteTiming& timing,
                   std::span<const verdict::FramePictures> pictures, const std::filesystem::path& out,
                   const std::string& command) {
  write_whole_file(out / "results.json", results_json(verdict));
  write_whole_file(out / "timing.json", timing_json(timing));
  write_whole_file(out / "results.csv", results_csv(verdict));
  write_whole_file(out / "junit.xml", junit_xml(verdict));
  write_whole_file(out / "summary.md", summary_md(verdict, timing));
  remove_old_pictures(out / "images");
  const std::vector<EncodedFrame> frames = encode(pictures);
  for (const EncodedFrame& frame : frames) {
    const std::string stem = file_stem(frame.run);
    write_whole_file(out / "images" / fmt::format("{}.mesh.png", stem), frame.mesh);
    write_whole_file(out / "images" / fmt::format("{}.error.png", stem), frame.error);
    write_whole_file(out / "images" / fmt::format("{}.reference.png", stem), frame.reference);
  }
  // Last: who finds a page finds what it speaks of.
  write_whole_file(out / "report.html", page_html(verdict, timing, frames, command));
}

}  // namespace plumbline::reports
