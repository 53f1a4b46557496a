// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenarios/terrain.h"

/// A paper's table beside ours, as plain data. None of the papers' terrains was published, so ours are run on
/// stand-ins: at most one parameter is fitted to one row of a table, and everything else is a prediction
/// (TABLES, preamble).
namespace plumbline::tables {

/// Where our figure comes from.
enum class Kind {
  fitted,     ///< a parameter was chosen so that this figure meets the paper's: no evidence of anything
  predicted,  ///< came out of the protocol; the paper has a figure to hold it against
  derived,    ///< computed from other figures of the same column, or from the sizes alone
  measured,   ///< the paper has no such figure, or none under a stated condition
};
std::string_view kind_name(Kind kind);

/// How a printed figure stands to the one recomputed from the paper's other numbers.
enum class Agreement {
  not_checked,  ///< not printed, or nothing to recompute it from
  rounded,      ///< the printed digits are the recomputed figure, rounded
  truncated,    ///< cut off, which rounding would have written otherwise
  misprint,     ///< neither
};
std::string_view agreement_name(Agreement agreement);

/// The number that a figure is printed as ("20 569", "4.6"): blanks group digits. Throws
/// std::invalid_argument for anything else.
double printed_number(std::string_view printed);

/// Compares a printed decimal with the value it should show, to the printed number of decimals.
Agreement agreement_of(std::string_view printed, double recomputed);

/// `value` with `decimals` digits after the point and blanks between groups of three before it, as the papers
/// print: "20 569", "4.48".
std::string figure_text(double value, int decimals);

/// One figure of a table: what the paper says. Ours stands in the trials.
struct Figure {
  std::string row;                   ///< "ATL 7a"
  std::string name;                  ///< "triangles"
  std::string unit;                  ///< "", "%", "px", "m"
  int decimals = 0;                  ///< of ours and of the recomputed figure, in text
  Kind kind = Kind::measured;        ///< of ours
  std::string printed;               ///< as the paper prints it; empty: it does not
  std::optional<double> recomputed;  ///< from the paper's other figures, where that is possible

  [[nodiscard]] Agreement agreement() const;
  /// What ours is held against: the recomputed figure (it has all digits), else the printed one, else
  /// nothing.
  [[nodiscard]] std::optional<double> paper() const;
};

/// The one parameter that a trial fits, or one of P0's three τ.
struct Fit {
  std::string parameter;  ///< "camera distance"
  std::string unit;
  double value = 0;
  std::string row, name;  ///< the figure fitted to
  double wanted = 0, reached = 0;
};

/// One stand-in terrain seen one way: a column of ours.
struct Trial {
  std::string terrain;                      ///< a stand-in's id
  std::string view;                         ///< camera, in a few words
  std::vector<Fit> fits;                    ///< in the order of the rows
  std::vector<std::optional<double>> ours;  ///< one a figure, in the table's order; nothing: could not be had
};

/// A terrain, or a mesh, that stands for the paper's.
struct StandIn {
  std::string id;
  std::string origin;         ///< what it is, for people
  std::size_t triangles = 0;  ///< of a mesh; 0: a terrain, and what follows is set
  int columns = 0, rows = 0;
  double spacing_m = 0, lowest_m = 0, highest_m = 0;
};
StandIn describe_stand_in(const Terrain& terrain, std::string origin);

struct Table {
  std::string id;  ///< "P2.1"
  std::string title;
  std::string source;                 ///< the paper, and where in it
  std::vector<std::string> protocol;  ///< what was done, what was decided
  std::vector<StandIn> stand_ins;
  std::vector<Figure> figures;
  std::vector<Trial> trials;
  std::vector<std::string> notes;  ///< readings of the paper: misprints, garbled digits
};

/// ours ÷ paper, where both are known and the paper's is not 0.
std::optional<double> ratio(const Figure& figure, const std::optional<double>& ours);

/// Something that a clock or a memory gauge measured; the paper's figure beside it. Never part of a Table.
struct Timing {
  std::string table, terrain;
  std::string what;   ///< "preprocessing, isolated_quadtree"
  std::string paper;  ///< as the paper says it; empty: it does not
  double wall_s = 0;
  double cpu_s = 0;    ///< of all threads
  double peak_mb = 0;  ///< what it needed beyond what was there before, 10⁶ bytes; 0: not gauged
};

struct Timings {
  std::string machine, compiler, build_type;
  int jobs = 0;
  double total_s = 0;
  double process_peak_mb = 0;  ///< of the whole program
  std::vector<Timing> entries;
};

}  // namespace plumbline::tables
