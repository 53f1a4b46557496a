// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "properties/harness/gauge.h"

#include <algorithm>
#include <ctime>
#include <fstream>
#include <string>

#include <malloc.h>
#include <sys/resource.h>

namespace plumbline {
namespace {

double seconds_on(clockid_t clock) {
  std::timespec now{};
  ::clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

/// A line of /proc/self/status in 10⁶ bytes; 0 if it is not there.
double status_mb(const std::string& key) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kib = 0;
    if (word == key + ":" && status >> kib) return kib * 1024e-6;
  }
  return 0;
}

/// Lets the gauge of peak memory begin anew at what is resident now (proc(5), clear_refs).
bool reset_peak() {
  std::ofstream refs("/proc/self/clear_refs");
  refs << "5" << std::flush;
  return refs.good();
}

/// The highest peak seen before a reset.
double g_earlier_peak_mb = 0;

}  // namespace

Stopwatch::Stopwatch() : start_s_(seconds_on(CLOCK_MONOTONIC)) {}
double Stopwatch::elapsed_s() const { return seconds_on(CLOCK_MONOTONIC) - start_s_; }

double process_peak_mb() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return std::max({g_earlier_peak_mb, status_mb("VmHWM"), static_cast<double>(usage.ru_maxrss) * 1024e-6});
}

Cost gauge(const std::function<void()>& work) {
  g_earlier_peak_mb = process_peak_mb();
  ::malloc_trim(0);  // what was freed before must not serve the work unseen
  const bool gauged = reset_peak();
  const double before_mb = status_mb("VmRSS");
  const double wall_s = seconds_on(CLOCK_MONOTONIC);
  const double cpu_s = seconds_on(CLOCK_PROCESS_CPUTIME_ID);
  work();
  Cost cost;
  cost.wall_s = seconds_on(CLOCK_MONOTONIC) - wall_s;
  cost.cpu_s = seconds_on(CLOCK_PROCESS_CPUTIME_ID) - cpu_s;
  cost.peak_mb = gauged ? std::max(0.0, status_mb("VmHWM") - before_mb) : 0;
  return cost;
}

}  // namespace plumbline
