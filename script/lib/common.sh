# SPDX-FileCopyrightText: The plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
# What the scripts share. Sourced, never run: it leaves the caller in the project's root, in strict mode.

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

# Tools must not answer in the user's language, nor wait for someone to type.
export LC_ALL=C.UTF-8
exec </dev/null

JOBS=${PLUMBLINE_JOBS:-$(nproc)}

say() { printf '%s\n' "$*"; }

die() {
  printf '%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}

# build_preset PRESET [TARGET…]: configures and builds build/PRESET; without a target, everything.
build_preset() {
  local preset=$1
  shift
  cmake --preset "$preset" || return
  if [ $# -gt 0 ]; then
    cmake --build "build/$preset" -j "$JOBS" --target "$@"
  else
    cmake --build "build/$preset" -j "$JOBS"
  fi
}

# our_sources GLOB…: the project's own files that match, as git sees them (so neither build/ nor out/), one a line.
our_sources() { git ls-files --cached --others --exclude-standard --deduplicate -- "$@" | sort | while read -r f; do
  [ -e "$f" ] && printf '%s\n' "$f"
done; }
