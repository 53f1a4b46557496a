// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/portable_math.h"

#include <mpfr.h>

namespace plumbline {
namespace {

template <class Function>
double rounded(Function function) {
  mpfr_t value;
  mpfr_init2(value, 53);
  function(value);
  const double result = mpfr_get_d(value, MPFR_RNDN);
  mpfr_clear(value);
  return result;
}

}  // namespace

double exact_sin(double radians) {
  return rounded([&](mpfr_ptr v) {
    mpfr_set_d(v, radians, MPFR_RNDN);
    mpfr_sin(v, v, MPFR_RNDN);
  });
}

double exact_cos(double radians) {
  return rounded([&](mpfr_ptr v) {
    mpfr_set_d(v, radians, MPFR_RNDN);
    mpfr_cos(v, v, MPFR_RNDN);
  });
}

double exact_tan(double radians) {
  return rounded([&](mpfr_ptr v) {
    mpfr_set_d(v, radians, MPFR_RNDN);
    mpfr_tan(v, v, MPFR_RNDN);
  });
}

double exact_pow(double base, double exponent) {
  return rounded([&](mpfr_ptr v) {
    mpfr_t power;
    mpfr_init2(power, 53);
    mpfr_set_d(power, exponent, MPFR_RNDN);
    mpfr_set_d(v, base, MPFR_RNDN);
    mpfr_pow(v, v, power, MPFR_RNDN);
    mpfr_clear(power);
  });
}

double exact_atan2(double y, double x) {
  return rounded([&](mpfr_ptr v) {
    mpfr_t east;
    mpfr_init2(east, 53);
    mpfr_set_d(east, x, MPFR_RNDN);
    mpfr_set_d(v, y, MPFR_RNDN);
    mpfr_atan2(v, v, east, MPFR_RNDN);
    mpfr_clear(east);
  });
}

}  // namespace plumbline
