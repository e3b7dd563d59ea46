#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Faults of the whole machine (its clock, suspend, memory, read-only disk, real-time time limit, a hog above the daemon)
while the daemon drives a simulated robot, in an emulated guest with Debian's kernel (guest.py): the suite Guest of
wire_faults_test, unchanged.

usage: machine_faults_test.py BUILD_FOLDER [GTEST_FILTER]

Needs what can_test.py needs. With TOPOMETRIC_FAULT_TABLE set its rows go into that file. Exit status 77: not run; with
TOPOMETRIC_VM=required that is a failure, with TOPOMETRIC_VM=off nothing is tried."""
import os
import pathlib
import re
import shutil
import sys
import tempfile
import time

import guest
from can_test import hidden_folders

LIMIT_S = 850
TRIES = 2  # an emulated machine on a busy one: a test that failed is run once more


def cannot(why):
    required = os.environ.get("TOPOMETRIC_VM") == "required"
    print("%s: %s; NO FAULT OF THE MACHINE WAS TESTED" % ("FAILED" if required else "SKIPPED", why))
    sys.exit(1 if required else 77)


def script(build, table, wanted):
    """Each test in a process of its own, so that one that leaves its machine spoilt says so itself."""
    program = "%s/tests/integration/wire_faults_test" % build
    return """mount -t cgroup2 none /sys/fs/cgroup && echo +memory >/sys/fs/cgroup/cgroup.subtree_control &&
  mkdir /sys/fs/cgroup/topometric || exit 3
export TOPOMETRIC_GUEST=1 TOPOMETRIC_FAULT_TABLE=%s
failed=0
for test in $(%s --gtest_list_tests --gtest_filter='%s' | sed -n 's,^  \\([^ ]*\\).*,Guest/ContentFaults.\\1,p'); do
  for try in %s; do
    %s --gtest_color=no --gtest_filter=$test && echo "== passed $test" && break
    [ $try = %d ] && failed=1
  done
done
exit $failed
""" % (table, program, wanted, " ".join(str(n + 1) for n in range(TRIES)), program, TRIES)


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    wanted = sys.argv[2] if len(sys.argv) > 2 else "Guest/*"
    if os.environ.get("TOPOMETRIC_VM") == "off":
        cannot("TOPOMETRIC_VM=off")
    cache = pathlib.Path(os.environ.get("XDG_CACHE_HOME", pathlib.Path.home() / ".cache")) / "topometric"
    cache.mkdir(parents=True, exist_ok=True)
    begin = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="topometric-host-") as holder:
        table = pathlib.Path(holder) / "faults.md"
        named = os.environ.get("TOPOMETRIC_FAULT_TABLE")
        if named:
            shutil.copy(named, table)
        try:
            status, text = guest.run(cache, script(build, table, wanted), pathlib.Path(holder), hidden_folders(build), LIMIT_S)
        except guest.CannotRun as why:
            cannot(str(why))
        if named and status == 0:
            shutil.copy(table, named)
    passed = set(re.findall(r"^== passed (\S+)", text, re.MULTILINE))
    if status == 0 and not passed:
        print("FAILED: no test was run")
        status = 1
    print("faults of the machine, %.1f s, %d passed: %s" % (time.monotonic() - begin, len(passed),
                                                          "ok" if status == 0 else "FAILED (%d)" % status))
    return 0 if status == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
