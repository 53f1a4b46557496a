# SPDX-FileCopyrightText: The plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""The rules of the house that a machine can hold. Each remark names the file, the line and the way out.

A line that has a good reason to break a rule of LINE_RULES ends with a comment `house: <the reason>`.
"""
import os
import re
import subprocess
import sys
from typing import NamedTuple

# Which folders a folder may include from. The link lines hold the same arrows; this catches a header that needs no
# library, and says what is meant.
ARROWS = {
    "scenarios": ["scenarios"],
    "algorithms": ["algorithms", "scenarios"],
    "oracle": ["oracle", "scenarios"],
    "properties/verdict": ["properties/verdict", "oracle", "scenarios"],
    "properties/faults": ["properties/faults", "oracle", "scenarios"],
    "properties": ["properties", "algorithms", "oracle", "scenarios"],
    "reports": ["reports", "properties/verdict", "oracle", "scenarios"],
}


class LineRule(NamedTuple):
    pattern: str
    where: str  # regular expression over the path
    unless: str  # paths that are excused
    instead: str


CODE = r"\.(cpp|h)$"
LINE_RULES = [
    LineRule(r"\b(TO" r"DO|FIX" r"ME|XX" r"X|HA" r"CK)\b", r"", r"", "do it now, or open an issue and say nothing here"),
    LineRule(r"/(wo" r"rk|ho" r"me|ro" r"ot)/", r"", r"^LICENSE$", "no machine's paths: make it relative, or an argument"),
    LineRule(r"[\"'=(\s]/t" r"mp/", r"", r"", "testing::TempDir(), std::filesystem::temp_directory_path() or mktemp"),
    LineRule(r"registry\.np" r"mjs\.org|/arti" r"factory/", r"", r"", "the user's npm configuration says where packages come from"),
    LineRule(r"#include <CGAL/", CODE, r"^(oracle/[^/]*\.cpp|oracle/.*cgal.*\.h|algorithms/tin/delaunay\.cpp|algorithms/(edge_collapse|greedy_tin)/cgal/|tests/)", "CGAL stays inside oracle/*.cpp, algorithms/tin/delaunay.cpp, algorithms/*/cgal/ and tests"),
    LineRule(r"#include <embree3?/", CODE, r"^(oracle/[^/]*\.cpp|oracle/.*embree.*\.h|tests/)", "Embree stays inside oracle/*.cpp and tests"),
    LineRule(r"#include <(gdal|ogr|cpl_)", CODE, r"^(scenarios/[^/]*\.cpp|tests/)", "GDAL stays inside scenarios/*.cpp"),
    LineRule(r"#include <random>|std::(s?rand|random_shuffle|random_device)\b", CODE, r"", "scenarios/random.h: the same numbers everywhere"),
    LineRule(
        r"std::(sin|cos|tan|asin|acos|atan2?|pow|exp2?|log(10|2|1p)?|hypot|cbrt|sinh|cosh|tanh|fma)f?\(",
        r"^(scenarios|algorithms|oracle|properties)/.*\.(cpp|h)$",
        r"^scenarios/portable_math\.cpp$",
        "scenarios/portable_math.h: libm's last bit differs between machines",
    ),
    LineRule(
        r"std::chrono|#include <(chrono|ctime)>",
        r"^(scenarios|algorithms|oracle|reports|properties)/.*\.(cpp|h)$",
        r"^properties/(harness|fuzz)/",
        "clocks are read in properties/harness (timing.json) and properties/fuzz (--seconds), never where a figure is made",
    ),
    LineRule(r"std::unordered_(map|set|multi)", r"^(properties/verdict|reports)/.*\.(cpp|h)$", r"", "std::map or a sorted vector: what is written must have one order"),
    LineRule(r"\bDISABLED_|GTEST_FLAG_SET\(filter", r"^tests/.*\.cpp$", r"", "a test runs or is gone"),
    LineRule(r"\bGTEST_SKIP\(\)(?!.*needs \.\./shared)", r"^tests/.*\.cpp$", r"", 'a test may only skip for data of ../shared: GTEST_SKIP() << "needs ../shared/…"'),
]

SPDX = ("SPDX-FileCopyrightText: The plumbline authors", "SPDX-License-Identifier: GPL-3.0-or-later")
# Formats without comments, prose, what `plumbline fuzz` and `run --write-expected` write, and files that carry somebody else's terms.
NO_SPDX = re.compile(r"\.(md|json|csv|png|svg|ply|obj|off|stl|glb|gltf|terrain|dem|prj|txt|asc|raw|npz|bin|in)$|^LICENSE|(^|/)\.[a-z-]+$|/vendor/|^properties/atlas/.*\.toml$|\.expected\.toml$")
# Bytes that a reader is fed, hostile ones among them: what they look like is the point.
FUZZ_INPUTS = re.compile(r"^tests/fuzz/(corpus|crashers)/")
PATIENCE_LINES = 500
# Long for a reason that a reader meets anyway.
LONG_FILES = re.compile(r"^(LICENSE|.*\.(json|svg|csv|ply|obj|off|stl|gltf)|.*/vendor/.*)$")


def tracked_files() -> list[str]:
    listing = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", "--deduplicate"],
        capture_output=True,
        check=True,
    ).stdout.decode()
    return sorted(name for name in listing.split("\0") if name and os.path.isfile(name))


def room(path: str) -> str | None:
    """The longest entry of ARROWS that the path lies in."""
    rooms = [name for name in ARROWS if path.startswith(name + "/")]
    return max(rooms, key=len, default=None)


def check_file(path: str, text: str) -> list[str]:
    remarks = []
    lines = text.splitlines()
    if not NO_SPDX.search(path):
        head = "\n".join(lines[:6])
        if not all(line in head for line in SPDX):
            remarks.append(f"{path}:1: the two SPDX lines are missing; copy them from any source file")
    if len(lines) > PATIENCE_LINES and not LONG_FILES.match(path):
        remarks.append(f"{path}: {len(lines)} lines; split it by meaning (limit {PATIENCE_LINES})")
    allowed = ARROWS.get(room(path) or "")
    for number, line in enumerate(lines, 1):
        include = re.match(r'\s*#include "([^"]+)"', line)
        if allowed and include and not any(include[1].startswith(name + "/") for name in allowed):
            remarks.append(
                f"{path}:{number}: {room(path)} may include only from {', '.join(allowed)} (by full path), not {include[1]}"
            )
        if "house: " in line:
            continue
        for rule in LINE_RULES:
            if re.search(rule.where, path) and not (rule.unless and re.search(rule.unless, path)):
                found = re.search(rule.pattern, line)
                if found:
                    remarks.append(f"{path}:{number}: '{found[0].strip()}': {rule.instead}")
    if re.search(r"^tests/.*_test\.cpp$", path) and not re.search(r"^(TEST|TEST_F|TEST_P|TYPED_TEST|RC_GTEST_PROP)\(", text, re.M):
        remarks.append(f"{path}: a test program without a test")
    return remarks


def self_test() -> list[str]:
    """A check that cannot fail is none: each kind of remark is provoked once."""
    spdx = "".join(f"// {line}\n" for line in SPDX)
    provoked = {
        "includes upward": ("scenarios/a.cpp", spdx + '#include "oracle/finding.h"\n'),
        "report reads geometry": ("reports/a.cpp", spdx + '#include "properties/harness/run_suite.h"\n'),
        "no licence": ("oracle/a.cpp", "int a;\n"),
        "long file": ("oracle/a.cpp", spdx + "\n" * PATIENCE_LINES),
        "left for later": ("docs/a.md", "TO" "DO\n"),
        "machine path": ("docs/a.md", "see /ho" "me/me\n"),
        "CGAL outside": ("properties/laws/a.h", spdx + "#include <CGAL/Epick.h>\n"),
        "libm": ("algorithms/x/a.cpp", spdx + "double a = std::pow(2.0, b);\n"),
        "clock": ("oracle/a.cpp", spdx + "#include <chrono>\n"),
        "skipped test": ("tests/oracle/a_test.cpp", spdx + "TEST(A, B) { GTEST_SKIP() << \"later\"; }\n"),
        "empty test": ("tests/oracle/a_test.cpp", spdx),
    }
    silent = [name for name, (path, text) in provoked.items() if not check_file(path, text)]
    clean = check_file("scenarios/a.cpp", spdx + '#include "scenarios/vec.h"\ndouble a = std::sqrt(2.0);\n')
    return [f"house.py: no remark on '{name}'" for name in silent] + [f"house.py: false remark: {r}" for r in clean]


def main() -> int:
    remarks = self_test()
    files = tracked_files()
    for path in files:
        if FUZZ_INPUTS.match(path):
            continue
        with open(path, "rb") as file:
            data = file.read()
        if b"\0" in data:
            continue  # a picture or a raster
        remarks += check_file(path, data.decode("utf-8"))
    for remark in remarks:
        print(remark)
    print(f"house: {len(files)} files, {len(remarks)} remarks")
    return 1 if remarks or not files else 0


if __name__ == "__main__":
    sys.exit(main())
