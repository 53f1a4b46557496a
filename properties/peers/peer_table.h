// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "oracle/conformity.h"
#include "scenarios/mesh.h"

/// One fault in a grid mesh of 41 × 41 vertices, judged by plumbline and by a general geometry library.
namespace plumbline::peers {

struct PeerRow {
  std::string_view fault;
  Mesh mesh;
  PlanDomain domain;
  oracle::FindingCode expected{};  ///< what plumbline must find, alone
  bool sound = false;              ///< nothing is wrong: `expected` means nothing
  std::string_view val3dity;       ///< quoted, not run here
};
/// The sound grid first, then the planted faults, in the table's order. No random choice.
std::vector<PeerRow> peer_rows();

struct PeerVerdict {
  std::string_view fault;
  bool sound = false;
  bool cgal_intersects = false, cgal_valid = false;
  std::vector<oracle::Finding> findings;  ///< plumbline's
  bool plumbline_right = false;           ///< only the expected code, at least once; nothing on a sound mesh
  std::string_view val3dity;
};
std::vector<PeerVerdict> judge_peers();

/// The table as Markdown: docs/peers.md.
std::string peer_table_markdown();

}  // namespace plumbline::peers
