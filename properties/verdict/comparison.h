// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What became better or worse from one result to another, as plain data.
namespace plumbline::verdict {

/// What it means that a figure grows.
enum class Direction {
  more_is_worse,
  less_is_worse,
  neither,  ///< a description ("triangles" are cheaper or dearer, not sounder), or a name not known here
};

/// How the paths of a check's counts begin: "findings_by_code.302".
inline constexpr std::string_view kFindingsByCode = "findings_by_code.";

/// The direction of a figure of a run (Figure::path) or of a check ("vertical_m.certain_max",
/// "conformity.crack", "crack"); of signed gaps, their size counts.
Direction figure_direction(std::string_view path);

enum class Change { worse, better, changed };
std::string_view change_name(Change change);

/// How a figure changed. A value that is not a number says that nothing was judged, and that is worse than
/// any number. Requires: `before` and `after` differ.
Change figure_change(Direction direction, double before, double after);

/// What a difference is about, the gravest first.
enum class Matter {
  verdict,  ///< pass, sound, interrupted, the oracles' own test
  run,      ///< a run, a mesh, a seam that is new or gone
  gate,
  vacuous,  ///< what judged nothing
  finding,
  figure,
  setting,  ///< what was flown or checked, and how
};
std::string_view matter_name(Matter matter);

struct Difference {
  Change change = Change::changed;
  Matter matter = Matter::figure;
  std::string where;                    ///< run id, mesh; empty: the whole
  std::string what;                     ///< figure, gate, finding
  std::optional<double> before, after;  ///< of a figure that is a number
  std::string before_text, after_text;  ///< of everything else: "holds", "fails", "not judged", "—"
  std::string note;                     ///< "fails now", "3 runs"; may be empty
  double weight = 0;                    ///< orders differences of one change and matter, largest first
};

struct Comparison {
  std::string schema;                   ///< of both files: "plumbline.results/1", "plumbline.check/1"
  std::string before, after;            ///< the files, as given
  double tolerance = 0;                 ///< relative, of figures that are no counts; 0: to the last bit
  std::size_t subjects = 0;             ///< runs (or meshes) in both
  std::size_t same = 0;                 ///< figures, gates and findings that both have alike
  std::size_t within_tolerance = 0;     ///< of those, figures that are not equal
  std::vector<Difference> differences;  ///< by change, matter, weight, then the files' order
  std::vector<std::string> notes;       ///< what could not be compared, and what was taken for what

  [[nodiscard]] std::size_t count(Change change) const;
  /// "worse" if anything is, else "better" if anything is, else "changed"; "unchanged" without differences.
  [[nodiscard]] std::string_view word() const;
};

/// Keeps the differences in findings, in their counts, and in what judged nothing: "no new violations",
/// though figures move and bounds are missed. A note says so.
Comparison findings_only(Comparison comparison);

}  // namespace plumbline::verdict
