// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "properties/verdict/check_verdict.h"

/// What `plumbline check` found out, as files. Decides nothing: what is sound and what is not was settled
/// before. All of it depends on the verdict alone: same verdict, same bytes.
namespace plumbline::reports {

/// How much of long lists a text shows; a line says how much is left out, and the counts are complete.
enum class Listing { brief, full };

/// What the terminal shows: the verdict in one sentence, what was looked at, what was proved, findings by
/// code, worst first, seams, the error against the DEM or the reference, the picture, shape, notes. UTF-8, at
/// most 100 columns where names allow it, no colours.
std::string check_text(const verdict::CheckVerdict& verdict, Listing listing = Listing::brief);

/// `check.json`, schema "plumbline.check/1". Numbers have the fewest digits that read back as the same
/// double; a number that is not finite is null, negative zero is 0. One mesh, finding or seam a line. "at" is
/// in the coordinates of the file, "frame_at" in the frame of the check.
std::string check_json(const verdict::CheckVerdict& verdict);

/// `check.sarif`: SARIF 2.1.0 (OASIS, 2020), one run, a rule for each code of the catalogue ("PL302"), a
/// result for each listed finding. Fingerprints hash code, kind, files and place, so that a finding keeps its
/// own from run to run.
std::string check_sarif(const verdict::CheckVerdict& verdict);

/// `check.html`: one file without a script that needs no network; light and dark, and for paper. Links to
/// spots/<name>.glb beside it. `command` is shown as the line that repeats the check; empty: "plumbline
/// check" with the meshes' files.
std::string check_html(const verdict::CheckVerdict& verdict, const verdict::CheckPictures& pictures,
                       const std::string& command = {});

/// glTF 2.0, binary: the neighbourhood of a finding, its marked triangles red, both sides drawn; y up,
/// metres; the node's extras say what is wrong and where. Triangles with a bad index or a corner that is not
/// finite are left out; empty if none is left.
std::string spot_glb(const verdict::CheckVerdict& verdict, const verdict::CheckSpot& spot);

/// Writes check.json, check.sarif, check.txt, spots/<name>.glb, images/… and, last, check.html into `out`,
/// which is made if missing; pictures and spots of an earlier report there are removed. Throws InputError
/// ("cannot write …") when the system refuses.
void write_check_report(const verdict::CheckVerdict& verdict, const verdict::CheckPictures& pictures,
                        const std::filesystem::path& out, const std::string& command = {});

}  // namespace plumbline::reports
