# SPDX-FileCopyrightText: The plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""ctest_count.py JUNIT: reads what ctest wrote and prints "<passed> <failed> <skipped>" as its last line.

A test that did not run counts as failed (not built, disabled, skipped without leave), so that green means that every
test ran. One reason is accepted: the test needs data that lies beside the project, says so by the fixed words
"needs ../shared", and the data is not there.
"""
import os
import sys
import xml.etree.ElementTree as ElementTree

LEAVE = "needs ../shared"


def main() -> int:
    passed, failed, skipped = 0, 0, 0
    shared_is_here = os.path.isdir(os.path.join("..", "shared"))
    for case in ElementTree.parse(sys.argv[1]).getroot().iter("testcase"):
        status = case.get("status")
        output = case.findtext("system-out") or ""
        if status == "run" and case.find("failure") is None and case.find("skipped") is None:
            passed += 1
        elif status == "notrun" and LEAVE in output and not shared_is_here:
            skipped += 1
            print(f"skipped: {case.get('name')} ({LEAVE})")
        else:
            failed += 1
            why = "failed" if status == "fail" else f"did not run ({status})"
            print(f"FAILED: {case.get('name')}: {why}")
    if passed == 0:
        failed += 1
        print("FAILED: no test passed")
    print(passed, failed, skipped)
    return 0


if __name__ == "__main__":
    sys.exit(main())
