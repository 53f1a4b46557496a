// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "properties/compare/json_reader.h"
#include "properties/compare/result_file.h"

/// What reading both kinds of result files takes.
namespace plumbline::compare {

/// Where a value stands, for complaints: "new.json: run "a.b.c.1"".
struct Place {
  std::string file, part;
  /// "file: part what" as an InputError.
  [[noreturn]] void fail(std::string_view what) const;
};

/// Members of an object, of the type asked for; InputError for anything else.
std::string text_at(const Json& object, const char* key, const Place& place);
bool truth_at(const Json& object, const char* key, const Place& place);
const Json& object_at(const Json& object, const char* key, const Place& place);
const Json& array_at(const Json& object, const char* key, const Place& place);
/// A number or null; InputError for anything else.
Reading read_number(const Json& value, std::string path, const Place& place);
Reading text_reading(std::string path, std::string text);
/// A value as people read it: strings bare, everything else as JSON.
std::string plain_text(const Json& value);

/// A file of kCheckSchema. Every number in an object is a figure and every string a setting, whatever its
/// name, so that a later plumbline's files can be read; lists other than meshes, seams and findings are
/// passed over.
ResultFile read_check(const Json& root, const Place& place);

}  // namespace plumbline::compare
