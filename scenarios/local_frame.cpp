// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "scenarios/local_frame.h"

#include <cmath>

#include "scenarios/portable_math.h"

namespace plumbline {

LocalFrame::LocalFrame(Geographic origin, double semi_major_m, double inverse_flattening)
    : origin_(origin), a_(semi_major_m) {
  const double f = inverse_flattening > 0 ? 1 / inverse_flattening : 0;  // GDAL and WKT write 0 for a sphere
  e2_ = f * (2 - f);
  arc_at_origin_m_ = meridian_arc_m(origin.latitude);
}

// Snyder (3-21).
double LocalFrame::meridian_arc_m(double latitude) const {
  const double e4 = e2_ * e2_;
  const double e6 = e4 * e2_;
  return a_ * ((1 - e2_ / 4 - 3 * e4 / 64 - 5 * e6 / 256) * latitude -
               (3 * e2_ / 8 + 3 * e4 / 32 + 45 * e6 / 1024) * exact_sin(2 * latitude) +
               (15 * e4 / 256 + 45 * e6 / 1024) * exact_sin(4 * latitude) -
               35 * e6 / 3072 * exact_sin(6 * latitude));
}

// Snyder (8-9), (8-10), k0 = 1.
Vec2 LocalFrame::to_plan(Geographic point) const {
  const double sine = exact_sin(point.latitude);
  const double cosine = exact_cos(point.latitude);
  const double tangent = sine / cosine;
  const double ep2 = e2_ / (1 - e2_);
  const double n = a_ / std::sqrt(1 - e2_ * sine * sine);
  const double t = tangent * tangent;
  const double c = ep2 * cosine * cosine;
  const double a = (point.longitude - origin_.longitude) * cosine;
  const double a2 = a * a;
  const double x = n * a * (1 + a2 * ((1 - t + c) / 6 + a2 * (5 - 18 * t + t * t + 72 * c - 58 * ep2) / 120));
  const double y = meridian_arc_m(point.latitude) - arc_at_origin_m_ +
                   n * tangent * a2 *
                       (0.5 + a2 * ((5 - t + 9 * c + 4 * c * c) / 24 +
                                    a2 * (61 - 58 * t + t * t + 600 * c - 330 * ep2) / 720));
  return {x, y};
}

// Snyder (8-17) to (8-25) with (3-26) for the footpoint latitude, split into what y fixes and what x adds.
LocalFrame::Row LocalFrame::row(double y) const {
  const double e4 = e2_ * e2_;
  const double e6 = e4 * e2_;
  const double root = std::sqrt(1 - e2_);
  const double e1 = (1 - root) / (1 + root);
  const double mu = (arc_at_origin_m_ + y) / (a_ * (1 - e2_ / 4 - 3 * e4 / 64 - 5 * e6 / 256));
  const double phi1 = mu + (3 * e1 / 2 - 27 * e1 * e1 * e1 / 32) * exact_sin(2 * mu) +
                      (21 * e1 * e1 / 16 - 55 * e1 * e1 * e1 * e1 / 32) * exact_sin(4 * mu) +
                      151 * e1 * e1 * e1 / 96 * exact_sin(6 * mu) +
                      1097 * e1 * e1 * e1 * e1 / 512 * exact_sin(8 * mu);
  const double sine = exact_sin(phi1);
  const double cosine = exact_cos(phi1);
  const double tangent = sine / cosine;
  const double ep2 = e2_ / (1 - e2_);
  const double c1 = ep2 * cosine * cosine;
  const double t1 = tangent * tangent;
  const double w = 1 - e2_ * sine * sine;
  const double r1 = a_ * (1 - e2_) / (w * std::sqrt(w));
  Row row;
  row.central_longitude_ = origin_.longitude;
  row.footpoint_latitude_ = phi1;
  row.n1_ = a_ / std::sqrt(w);
  row.n1_tan_over_r1_ = row.n1_ * tangent / r1;
  row.inverse_cos_ = 1 / cosine;
  row.latitude_4_ = (5 + 3 * t1 + 10 * c1 - 4 * c1 * c1 - 9 * ep2) / 24;
  row.latitude_6_ = (61 + 90 * t1 + 298 * c1 + 45 * t1 * t1 - 252 * ep2 - 3 * c1 * c1) / 720;
  row.longitude_3_ = (1 + 2 * t1 + c1) / 6;
  row.longitude_5_ = (5 - 2 * c1 + 28 * t1 - 3 * c1 * c1 + 8 * ep2 + 24 * t1 * t1) / 120;
  return row;
}

Geographic LocalFrame::Row::at(double x) const {
  const double d = x / n1_;
  const double d2 = d * d;
  const double latitude =
      footpoint_latitude_ - n1_tan_over_r1_ * d2 * (0.5 - d2 * (latitude_4_ - d2 * latitude_6_));
  const double longitude =
      central_longitude_ + d * (1 - d2 * (longitude_3_ - d2 * longitude_5_)) * inverse_cos_;
  return {longitude, latitude};
}

double LocalFrame::meridian_radius_m() const {
  const double sine = exact_sin(origin_.latitude);
  const double w = 1 - e2_ * sine * sine;
  return a_ * (1 - e2_) / (w * std::sqrt(w));  // Snyder (4-18)
}

double LocalFrame::parallel_radius_m() const {
  const double sine = exact_sin(origin_.latitude);
  return a_ / std::sqrt(1 - e2_ * sine * sine) * exact_cos(origin_.latitude);  // Snyder (4-20, 4-21)
}

}  // namespace plumbline
