// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

namespace plumbline {

/// What a piece of work cost.
struct Cost {
  double wall_s = 0;
  double cpu_s = 0;  ///< processor time of all threads
  double peak_mb =
      0;  ///< how far resident memory rose above where it stood, 10⁶ bytes; 0: the system does not say
};

/// Does `work` and says what it cost. All figures are the whole program's, so nothing else should run
/// meanwhile.
Cost gauge(const std::function<void()>& work);

/// Time on the wall since it was made.
class Stopwatch {
 public:
  Stopwatch();
  [[nodiscard]] double elapsed_s() const;

 private:
  double start_s_;
};

/// Largest resident memory of the program up to now, 10⁶ bytes.
double process_peak_mb();

}  // namespace plumbline
