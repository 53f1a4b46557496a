# SPDX-FileCopyrightText: The plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""tidy.py BUILD JOBS: clang-tidy 14 over the project's own sources of BUILD/compile_commands.json, JOBS at a time.

Slowest files first is not known beforehand, so the largest are started first: two cores then end together.
"""
import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor


def main() -> int:
    build, jobs = sys.argv[1], int(sys.argv[2])
    root = os.getcwd()
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        sources = {os.path.normpath(os.path.join(entry["directory"], entry["file"])) for entry in json.load(file)}
    ours = [s for s in sources if s.startswith(root + os.sep) and not s.startswith(os.path.join(root, "build") + os.sep)]
    if not ours:
        print("tidy: no source of ours in", build)
        return 1
    ours.sort(key=lambda source: (-os.path.getsize(source), source))

    def check(source: str) -> tuple[str, int, str]:
        result = subprocess.run(
            ["clang-tidy-14", "-p", build, "--quiet", source], capture_output=True, text=True, check=False
        )
        # stderr holds "N warnings generated" for suppressed ones; it matters only if the tool itself fails.
        return source, result.returncode, result.stdout + (result.stderr if result.returncode else "")

    failures = 0
    with ThreadPoolExecutor(jobs) as pool:
        for source, code, text in pool.map(check, ours):
            if code:
                failures += 1
                print(f"tidy: {os.path.relpath(source, root)}\n{text}", flush=True)
    print(f"tidy: {len(ours)} sources, {failures} with remarks")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
