// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

#include "oracle/conformity.h"
#include "oracle/image.h"
#include "oracle/likeness.h"
#include "oracle/shape.h"
#include "oracle/vertical.h"
#include "reports/json_text.h"
#include "scenarios/camera.h"
#include "scenarios/trajectory.h"

/// The oracles' figures as JSON: the same names in every file that has them (CONTRACT.md).
namespace plumbline::reports {

Json xy(Vec2 p);
Json xyz(Vec3 p);
/// A figure that nothing was judged for is null, which no reader can take for a perfect score.
Json judged(bool any, double value);

Json camera_json(const Camera& camera);
/// Of an object in space, what only makes sense over a plan is null.
Json conformity_json(const oracle::ConformityCounts& counts, Subject subject);
Json vertical_json(const oracle::VerticalError& error);
/// `plan`: whether the figures that need one were asked.
Json displacement_json(const oracle::ImageError& image, bool plan);
Json parallax_json(const oracle::ImageError& image);
Json depth_json(const oracle::ImageError& image);
Json shape_json(const oracle::ShapeReport& shape, bool plan);
Json distance_json(bool any, oracle::CertifiedDistance distance);

std::string_view severity_name(oracle::Severity severity);
Json finding_json(const oracle::Finding& finding);

}  // namespace plumbline::reports
