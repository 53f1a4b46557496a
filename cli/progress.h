// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace plumbline::cli {

/// Shows how far long work has come on standard error: one line rewritten in place on a terminal (with rate
/// and remaining time), a plain line every few seconds elsewhere, nothing when quiet. Thread-safe.
class ProgressLine {
 public:
  ProgressLine(std::string what, std::string unit, bool quiet);
  ~ProgressLine();
  void show(std::size_t done, std::size_t total);

 private:
  using Clock = std::chrono::steady_clock;
  std::mutex mutex_;
  std::string what_, unit_;
  bool quiet_;
  bool terminal_;
  bool shown_ = false;
  std::size_t best_ = 0;
  Clock::time_point start_, last_;
};

/// The same for work without a known end: the latest line of news.
class ProgressTicker {
 public:
  ProgressTicker(std::string what, bool quiet);
  ~ProgressTicker();
  void say(const std::string& news);

 private:
  using Clock = std::chrono::steady_clock;
  std::mutex mutex_;
  std::string what_;
  bool quiet_;
  bool terminal_;
  bool shown_ = false;
  Clock::time_point last_;
};

}  // namespace plumbline::cli
