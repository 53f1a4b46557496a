// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "cli/progress.h"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace plumbline::cli {
namespace {

double pause_s(bool terminal) { return terminal ? 0.1 : 5.0; }

void print_line(bool terminal, const std::string& line) {
  if (terminal) {
    fmt::print(stderr, "\r{}\x1b[K", line);
  } else {
    fmt::print(stderr, "{}\n", line);
  }
  std::fflush(stderr);
}

}  // namespace

ProgressLine::ProgressLine(std::string what, std::string unit, bool quiet)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      quiet_(quiet),
      terminal_(::isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_) {}

ProgressLine::~ProgressLine() {
  if (shown_ && terminal_) fmt::print(stderr, "\n");
}

void ProgressLine::show(std::size_t done, std::size_t total) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  if (done < best_) return;  // a slower thread reports late
  best_ = done;
  const Clock::time_point now = Clock::now();
  if (done < total && std::chrono::duration<double>(now - last_).count() < pause_s(terminal_)) return;
  last_ = now;
  shown_ = true;
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const double rate = elapsed_s > 0 ? static_cast<double>(done) / elapsed_s : 0;
  const double left_s = rate > 0 ? static_cast<double>(total - done) / rate : 0;
  const std::string line =
      fmt::format("{}: {} of {} {}, {:.1f} a second, {:.0f} s left", what_, done, total, unit_, rate, left_s);
  print_line(terminal_, line);
}

ProgressTicker::ProgressTicker(std::string what, bool quiet)
    : what_(std::move(what)), quiet_(quiet), terminal_(::isatty(STDERR_FILENO) != 0), last_(Clock::now()) {}

ProgressTicker::~ProgressTicker() {
  if (shown_ && terminal_) fmt::print(stderr, "\n");
}

void ProgressTicker::say(const std::string& news) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  if (std::chrono::duration<double>(now - last_).count() < pause_s(terminal_)) return;
  last_ = now;
  shown_ = true;
  print_line(terminal_, fmt::format("{}: {}", what_, news));
}

}  // namespace plumbline::cli
