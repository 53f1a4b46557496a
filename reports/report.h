// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "properties/verdict/verdict.h"

/// Turns verdicts into files. Decides nothing: what passes and what fails was settled before.
///
/// results.json, results.csv, junit.xml and the pictures depend on the verdict alone: same verdict, same
/// bytes. What a clock measured stands in timing.json, and besides in summary.md and report.html, which are
/// for people.
namespace plumbline::reports {

/// `results.json`, schema "plumbline.results/1". Numbers have the fewest digits that read back as the same
/// double; a number that is not finite is null, negative zero is 0. One frame, gate or terrain a line, so
/// that a diff names it.
std::string results_json(const verdict::SuiteVerdict& verdict);

/// `timing.json`, schema "plumbline.timing/1": update times of every frame with median and 95th percentile,
/// preparation times, machine facts.
std::string timing_json(const verdict::SuiteTiming& timing);

/// `results.csv` (RFC 4180: CRLF, quotes where needed): one line a frame, units in the column names.
std::string results_csv(const verdict::SuiteVerdict& verdict);

/// `junit.xml`: a test suite per run, a test case per gate; whatever judged nothing is a failed case.
std::string junit_xml(const verdict::SuiteVerdict& verdict);

/// An expectation file (scenarios/expected_file.h) of what fails and of what was expected, unless the gates
/// hold by now: an entry per run and figure with the value found. Reasons are kept; a gate that was not
/// expected to fail is its own reason. Comments name what no entry can stand for.
std::string expected_toml(const verdict::SuiteVerdict& verdict);

/// `summary.md`: the verdict, method × finding, the worst offenders, and triangles, error and time per
/// threshold.
std::string summary_md(const verdict::SuiteVerdict& verdict, const verdict::SuiteTiming& timing);

/// `report.html`: one file that needs no network, drawn from the two JSON texts inside it. `command` is shown
/// as the line that repeats the run.
std::string report_html(const verdict::SuiteVerdict& verdict, const verdict::SuiteTiming& timing,
                        std::span<const verdict::FramePictures> pictures, const std::string& command);

/// What `plumbline selftest` prints: the score of each oracle, then of each kind of fault.
std::string selftest_md(const verdict::SelftestScore& score);

/// The same as JSON, schema "plumbline.selftest/1".
std::string selftest_json(const verdict::SelftestScore& score);

/// Writes the verdict's files and images/<run>.{mesh,error,reference}.png into `out`, which is made if
/// missing. Each file appears whole or not at all, and replaces its namesake; files of other names stay.
/// Throws InputError ("cannot write …") when the system refuses.
void write_reports(const verdict::SuiteVerdict& verdict, const verdict::SuiteTiming& timing,
                   std::span<const verdict::FramePictures> pictures, const std::filesystem::path& out,
                   const std::string& command = {});

}  // namespace plumbline::reports
