// SPDX-FileCopyrightText: The plumbline authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "properties/verdict/check_verdict.h"

namespace plumbline::verdict {

std::string_view seam_state_name(SeamState state) {
  switch (state) {
    case SeamState::watertight:
      return "watertight";
    case SeamState::covered_by_skirt:
      return "covered by a skirt";
    case SeamState::open:
      return "open";
  }
  return "open";
}

}  // namespace plumbline::verdict
