// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "properties/verdict/paper_table.h"

/// The papers' tables as text. Markdown, JSON and CSV depend on the tables alone: same tables, same bytes.
/// What a clock measured stands apart.
namespace plumbline::reports {

/// For people: for each table what was done, then the paper's figures beside ours, a block a terrain, a
/// column a view; what was fitted; readings of the paper. Columns line up on a terminal too.
std::string tables_md(std::span<const tables::Table> tables);

/// Schema "plumbline.tables/1": tables → figures (the paper's) and trials (ours, one value a figure).
std::string tables_json(std::span<const tables::Table> tables);

/// RFC 4180: one line a figure and trial.
std::string tables_csv(std::span<const tables::Table> tables);

/// Preprocessing times and memory beside the paper's, for people.
std::string tables_timing_md(const tables::Timings& timings);

/// Schema "plumbline.tables_timing/1".
std::string tables_timing_json(const tables::Timings& timings);

/// Writes tables.md, tables.json, tables.csv and tables_timing.json into `out`, each whole or not at all.
/// Throws InputError ("cannot write …") when the system refuses.
void write_tables(std::span<const tables::Table> tables, const tables::Timings& timings,
                  const std::filesystem::path& out);

}  // namespace plumbline::reports
