// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace plumbline {

/// All bytes of a file, or of a pipe. Throws InputError if it is a folder or a device ("…, not a mesh";
/// `what` says what was hoped for), cannot be opened or read.
std::string read_whole_file(const std::filesystem::path& path, std::string_view what);

/// Writes a file whole or not at all: the bytes go to a temporary name beside it, which then takes its place.
/// Missing folders are made; a link stays one; into a device or a pipe the bytes go as they are. Throws
/// InputError ("cannot write …") and leaves nothing behind if that fails.
void write_whole_file(const std::filesystem::path& path, std::string_view bytes);

/// Whether files can be written into the folder, asked before long work rather than after it. Leaves
/// everything as it was: a missing folder is made and removed again. Throws InputError as write_whole_file
/// does.
void require_writable(const std::filesystem::path& folder);
/// The same of one file: that its folder can be written into, and that it is none itself.
void require_writable_file(const std::filesystem::path& file);

}  // namespace plumbline
