// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "properties/verdict/selftest_score.h"
#include "reports/json_text.h"

namespace plumbline::reports {

/// The score as an object: totals, then one entry a kind.
Json selftest_object(const verdict::SelftestScore& score);

}  // namespace plumbline::reports
