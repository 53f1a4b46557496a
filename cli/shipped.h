// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

/// The files that plumbline brings along: suites/ and assets/ in one folder, its share.
namespace plumbline::cli {

/// Where the share is if there is none beside the program. Once, before any command.
void set_share(const std::filesystem::path& share);

/// `relative` ("assets/jacksboro.vrt") in ../share/plumbline beside the program, as `cmake --install` puts
/// it; else in the folder that was set. Whether the file is there is for its reader to say.
std::filesystem::path shipped(const std::filesystem::path& relative);

}  // namespace plumbline::cli
