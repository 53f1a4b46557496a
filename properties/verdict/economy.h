// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "properties/verdict/verdict.h"

namespace plumbline::verdict {

/// O4's excess: how many triangles a frame needs, by what the yardstick method drew at the same camera.
///
/// The yardstick's runs over a terrain and trajectory give, at each frame, points (p99 displacement,
/// triangles), one a threshold. Between two of them triangles are taken linear in 1/p99, since the error of a
/// piecewise linear approximation falls as its triangles rise, one to one. A frame whose p99 lies outside of
/// the yardstick's is not extrapolated: nothing is said of it. Writes `needed` of all other runs' frames and
/// of their summaries; the result depends on the verdict alone.
void add_excess(SuiteVerdict& suite, const std::string& yardstick);

}  // namespace plumbline::verdict
