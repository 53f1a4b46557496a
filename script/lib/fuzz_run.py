# SPDX-FileCopyrightText: The plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""fuzz_run.py BUILD JOBS [--seconds N] [--seed K] [target…]: builds fuzz targets, runs them JOBS at a time, sums up.

What a target finds interesting is kept in BUILD/found/<target> and read again by the next run, unless a seed is given:
then the run starts from the kept seeds alone, and two runs begin alike.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from typing import NamedTuple

# A reader of the seeds' sizes needs far less of any of these; malloc_limit_mb speaks of one allocation. A minute is no
# verdict on speed: a machine that does something else may stand still for a while, a reader that hangs never ends.
LIMITS = ["-timeout=60", "-report_slow_units=60", "-rss_limit_mb=1024", "-malloc_limit_mb=256"]


class Run(NamedTuple):
    target: str
    executions: int
    per_second: int
    edges: int
    inputs: int
    faults: list[str]


def last(pattern: str, text: str) -> int:
    found = re.findall(pattern, text)
    return int(found[-1]) if found else 0


def fuzz(build: str, target: str, seconds: int, seed: int) -> Run:
    folder = os.path.join(build, "tests", "fuzz")
    found = os.path.join(build, "found", target)
    artifacts = os.path.join(build, "artifacts", target)
    if seed:
        shutil.rmtree(found, ignore_errors=True)
    os.makedirs(found, exist_ok=True)
    os.makedirs(artifacts, exist_ok=True)
    before = set(os.listdir(artifacts))
    with open(os.path.join(folder, f"{target}.seeds"), encoding="utf-8") as file:
        seeds = file.read().split("\n")[:-1]
    dictionary = os.path.join("tests", "fuzz", f"{target}.dict")
    command = [os.path.join(folder, f"{target}_fuzz"), f"-max_total_time={seconds}", f"-seed={seed}", *LIMITS]
    command += [f"-artifact_prefix={artifacts}/", "-print_final_stats=1"]
    command += [f"-dict={dictionary}"] if os.path.exists(dictionary) else []
    log = subprocess.run([*command, found, *seeds], capture_output=True, text=True, errors="replace", check=False)
    with open(os.path.join(build, "found", f"{target}.log"), "w", encoding="utf-8") as file:
        file.write(log.stderr)
    faults = sorted(set(os.listdir(artifacts)) - before)
    if log.returncode != 0 and not faults:
        faults = [f"exit status {log.returncode}"]
    if faults:
        print(log.stderr[-4000:], file=sys.stderr)
    executions = last(r"stat::number_of_executed_units: (\d+)", log.stderr)
    speed = last(r"stat::average_exec_per_sec: +(\d+)", log.stderr)
    return Run(target, executions, speed, last(r"cov: (\d+)", log.stderr), len(os.listdir(found)), faults)


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("build")
    parser.add_argument("jobs", type=int)
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("targets", nargs="*")
    asked = parser.parse_intermixed_args()
    there = sorted(name[: -len(".seeds")] for name in os.listdir(os.path.join(asked.build, "tests", "fuzz")) if name.endswith(".seeds"))
    unknown = [target for target in asked.targets if target not in there]
    if unknown:
        print(f"fuzz-readers: no target '{unknown[0]}'; there are: {' '.join(there)}", file=sys.stderr)
        return 2
    targets = asked.targets or there
    names = [f"{target}_fuzz" for target in targets]
    if subprocess.run(["cmake", "--build", asked.build, "-j", str(asked.jobs), "--target", *names], stdout=sys.stderr, check=False).returncode:
        return 1
    with ThreadPoolExecutor(asked.jobs) as pool:
        runs = list(pool.map(lambda target: fuzz(asked.build, target, asked.seconds, asked.seed), targets))
    lines = ["| target | executions | per second | edges | inputs kept | faults |", "|---|--:|--:|--:|--:|---|"]
    for run in runs:
        faults = " ".join(run.faults) or "none"
        lines.append(f"| {run.target} | {run.executions} | {run.per_second} | {run.edges} | {run.inputs} | {faults} |")
    summary = "\n".join(lines) + "\n"
    with open(os.path.join(asked.build, "summary.md"), "w", encoding="utf-8") as file:
        file.write(summary)
    print(summary, end="")
    idle = [run.target for run in runs if not run.faults and run.executions == 0]
    if idle:
        print(f"fuzz-readers: {' '.join(idle)} ran nothing")
    return 1 if idle or any(run.faults for run in runs) else 0


if __name__ == "__main__":
    sys.exit(main())
