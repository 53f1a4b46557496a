# SPDX-FileCopyrightText: The plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""tidy.py BUILD JOBS: clang-tidy 14 over the project's own sources of BUILD/compile_commands.json, JOBS at a time.

Slowest files first is not known beforehand, so the largest are started first: two cores then end together.

As ccache does for objects, what was found clean is remembered: by a hash of the command, the source, every header of
ours that it includes, .clang-tidy, and the versions of all installed packages. PLUMBLINE_TIDY_CACHE names the folder
(~/.cache/plumbline-tidy); without it everything is looked at, which takes some twenty minutes on two cores.
"""
import hashlib
import json
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import lru_cache
from pathlib import Path

INCLUDE = re.compile(rb'^[ \t]*#[ \t]*include[ \t]*"([^"]+)"', re.MULTILINE)


@lru_cache(maxsize=None)
def content(path: str) -> bytes:
    return Path(path).read_bytes()


def included(source: str, folders: list[str]) -> list[str]:
    """The source and all headers of ours below it, sorted; whatever #if says."""
    seen, left = {source}, [source]
    while left:
        one = left.pop()
        for name in INCLUDE.findall(content(one)):
            for folder in [os.path.dirname(one), *folders]:
                header = os.path.normpath(os.path.join(folder, name.decode()))
                if os.path.isfile(header):
                    if header not in seen:
                        seen.add(header)
                        left.append(header)
                    break
    return sorted(seen)


def key_of(entry: dict, root: str, machine: str) -> str:
    source = os.path.normpath(os.path.join(entry["directory"], entry["file"]))
    folders = [os.path.normpath(f) for f in re.findall(r"-I ?(\S+)", entry["command"])] + [root]
    digest = hashlib.sha256(machine.encode())
    digest.update(entry["command"].replace(root, "").encode())
    for path in included(source, folders):
        digest.update(os.path.relpath(path, root).encode() + b"\0" + hashlib.sha256(content(path)).digest())
    return digest.hexdigest()


def main() -> int:
    build, jobs = sys.argv[1], int(sys.argv[2])
    root = os.getcwd()
    with open(os.path.join(build, "compile_commands.json"), encoding="utf-8") as file:
        entries = {os.path.normpath(os.path.join(e["directory"], e["file"])): e for e in json.load(file)}
    ours = [s for s in entries if s.startswith(root + os.sep) and not s.startswith(os.path.join(root, "build") + os.sep)]
    if not ours:
        print("tidy: no source of ours in", build)
        return 1
    ours.sort(key=lambda source: (-os.path.getsize(source), source))

    cache = Path(os.environ.get("PLUMBLINE_TIDY_CACHE", os.path.expanduser("~/.cache/plumbline-tidy")))
    cache.mkdir(parents=True, exist_ok=True)
    packages = subprocess.run(["dpkg-query", "-W"], capture_output=True, text=True, check=True).stdout
    machine = hashlib.sha256(packages.encode() + content(os.path.join(root, ".clang-tidy"))).hexdigest()
    keys = {source: cache / key_of(entries[source], root, machine) for source in ours}
    known = [source for source in ours if keys[source].exists()]

    def check(source: str) -> tuple[str, int, str]:
        result = subprocess.run(
            ["clang-tidy-14", "-p", build, "--quiet", source], capture_output=True, text=True, check=False
        )
        if result.returncode == 0:
            keys[source].touch()
        # stderr holds "N warnings generated" for suppressed ones; it matters only if the tool itself fails.
        return source, result.returncode, result.stdout + (result.stderr if result.returncode else "")

    failures = 0
    with ThreadPoolExecutor(jobs) as pool:
        for source, code, text in pool.map(check, [source for source in ours if source not in set(known)]):
            if code:
                failures += 1
                print(f"tidy: {os.path.relpath(source, root)}\n{text}", flush=True)
    print(f"tidy: {len(ours)} sources, {failures} with remarks; {len(known)} known to be clean")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
