// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plumbline {

/// Correctly rounded elementary functions (GNU MPFR). A C library's own may differ in the last bit between
/// machines, since it picks code by the processor's instruction set; what is stored or branched on must not.
/// Slow (microseconds a call): for set-up, never for inner loops. Angles in radians.
double exact_sin(double radians);
double exact_cos(double radians);
double exact_tan(double radians);
double exact_pow(double base, double exponent);
/// The angle of (x, y) from the positive x axis, in [−π, π].
double exact_atan2(double y, double x);

/// π and a degree, rounded to double.
inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kRadiansPerDegree = kPi / 180;

}  // namespace plumbline
