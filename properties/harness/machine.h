// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace plumbline {

/// Facts for timing.json only.
std::string machine_name();  ///< processor model and number of cores
std::string compiler_name();
std::string build_type();

}  // namespace plumbline
