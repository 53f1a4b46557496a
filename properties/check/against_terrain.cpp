// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/check/against.h"

namespace plumbline::checking {
void against_terrain(Examination&, Stage&, std::vector<verdict::CheckFinding>&, verdict::CheckPictures&) {}
}  // namespace plumbline::checking
