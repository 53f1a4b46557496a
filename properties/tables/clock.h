// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "properties/tables/table.h"

namespace plumbline::tables {

/// Does `work` and notes what it cost: time on the wall, processor time of all threads, and how far the
/// program's resident memory rose above where it stood (0 where the system does not say). All are the whole
/// program's, so nothing else should run meanwhile.
void gauge(Timing& timing, const std::function<void()>& work);

/// Largest resident memory of the program up to now, 10⁶ bytes.
double process_peak_mb();

}  // namespace plumbline::tables
