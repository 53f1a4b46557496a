// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "properties/verdict/check_verdict.h"

/// What a verdict of `plumbline check` says in words: shared by the terminal's text, the page and SARIF.
namespace plumbline::reports {

/// "crack"; of a code that the catalogue does not have "finding_999".
std::string code_name(oracle::FindingCode code);
/// "docs/findings.md#302-crack"; empty if the catalogue does not have the code.
std::string code_link(oracle::FindingCode code);
/// The catalogue's definition; empty if it has none.
std::string_view code_definition(oracle::FindingCode code);
/// "1 crack", "12 cracks".
std::string counted_code(oracle::FindingCode code, std::size_t count);
/// What to do about findings of this code, one sentence.
std::string_view code_remedy(oracle::FindingCode code);

/// All findings of one code.
struct CodeGroup {
  oracle::FindingCode code{};
  std::size_t count = 0;            ///< complete where `exact`
  bool exact = true;                ///< false: more than the list holds, and nobody counted them
  bool hazard = true;               ///< every listed one is
  bool between_meshes = true;       ///< every listed one is
  std::vector<std::size_t> listed;  ///< into CheckVerdict::findings
};
/// Faults before hazards, else in the order of the list: worst first. A code that was counted but is not
/// listed, because the list is capped, comes last.
std::vector<CodeGroup> group_findings(const verdict::CheckVerdict& verdict);

struct SeamTotals {
  std::size_t watertight = 0, covered = 0, open = 0;
  /// Of the open ones, those that are no fault: between levels (SeamVerdict::must_meet), and by no more than
  /// the rounding of heights.
  std::size_t between_levels = 0, rounding = 0;
  [[nodiscard]] std::size_t faulty() const { return open - between_levels - rounding; }
};
/// An open seam that makes the meshes faulty.
bool is_faulty(const verdict::SeamVerdict& seam);
SeamTotals seam_totals(const verdict::CheckVerdict& verdict);
/// "20 watertight, 2 covered by a skirt, 2 open", all three always; and which of the open ones are no fault.
std::string seam_totals_words(const SeamTotals& totals);
/// The seam with the largest gap; null if no seam has one.
const verdict::SeamVerdict* worst_seam(const verdict::CheckVerdict& verdict);
/// A skirt below every border that covers every gap, metres; 0 if none is needed.
double sufficient_skirt_m(const verdict::CheckVerdict& verdict);
/// "A skirt of 12.4 m below every border covers every gap; the worst pair is …"; empty if no gap asks for
/// one.
std::string skirt_advice(const verdict::CheckVerdict& verdict);

/// What sentences call the mesh: CheckedMesh::name, or the file; "?" where the verdict names no mesh.
std::string mesh_name(const verdict::CheckVerdict& verdict, std::uint32_t mesh);
/// "a.ply", or "a.ply | b.ply" of a finding between two.
std::string whose(const verdict::CheckVerdict& verdict, const verdict::CheckFinding& finding);
/// Ten digits in plan, seven of height: enough to go there. check.json has all of them.
std::string place_words(Vec3 at);
std::string place_words(Vec2 at);
/// "0.0123 m", "+4.2 m" if signed.
std::string metres(double value);
/// The same, rounded up: "a skirt of that height suffices".
std::string sufficient_metres(double value);
/// The same without its unit.
std::string sufficient_number(double value);
std::string signed_metres(double value);
/// How large, by what the code measures: "gap +4.2 m, 3.1 px in the picture", "7.25 m off"; empty if nothing
/// does.
std::string size_words(const oracle::Finding& finding);
/// The finding's sentence; made of code, kind and size where it brings none.
std::string message_words(const verdict::CheckFinding& finding);
/// A figure of a finding by which those of one code are compared.
double size_of(const oracle::Finding& finding);

/// What was proved, one clause each, to stand behind "Proved:"; nothing is claimed that a finding
/// contradicts.
std::vector<std::string> proved_sentences(const verdict::CheckVerdict& verdict);
/// "two.ply and 3 more".
std::string subject_words(const verdict::CheckVerdict& verdict);
/// "2 open seams, worst gap +4.2 m between … at …; 1 hole": the verdict's first line without subject and
/// state.
std::string headline_words(const verdict::CheckVerdict& verdict);
/// What a person should do next, most urgent first; empty if there is nothing to do.
std::vector<std::string> next_steps(const verdict::CheckVerdict& verdict);

/// Whether the declared bound holds: at the samples, between them whichever way cells are split, and against
/// the DEM's declared diagonals. Three sentences; empty if none was declared.
struct DeclaredWords {
  bool holds = true;
  std::string_view word;  ///< "holds", "broken", "undecided"
  std::string sentence;
};
std::vector<DeclaredWords> declared_words(const verdict::TerrainVerdict& terrain);
/// Likewise against another mesh, one sentence.
std::vector<DeclaredWords> declared_words(const verdict::ReferenceVerdict& reference);

}  // namespace plumbline::reports
