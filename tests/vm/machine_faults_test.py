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
import subprocess
import sys
import tempfile
import time

import guest
from can_test import hidden_folders

LIMIT_S = 850
TABLE = re.compile(r"^== table\n(.*?)^== end of the table$", re.MULTILINE | re.DOTALL)
# The programs run from the guest's memory: what is shared with this machine is gone once the guest was suspended, because
# the kernel's 9p over virtio does not come back.
RAM = """R=/run/ram
mkdir $R && mount -t tmpfs ram $R || exit 3
programs="%(programs)s /bin/bash /bin/cat"
for file in $programs $(ldd $programs | grep -o '/[^ ]*[^ :]' | sort -u) /etc/passwd /etc/group /etc/nsswitch.conf; do
  cp -L --parents $file $R || exit 3
done
mkdir -p $R/tmp $R/dev $R/proc $R/sys
for kept in dev proc sys; do mount --rbind /$kept $R/$kept || exit 3; done
mount -t cgroup2 none $R/sys/fs/cgroup && echo +memory >$R/sys/fs/cgroup/cgroup.subtree_control &&
  mkdir $R/sys/fs/cgroup/topometric || exit 3
cp %(shared)s/faults.md $R/tmp
exec chroot $R /bin/bash -c '
%(tests)s'
"""
# Each in a process of its own, so that one that leaves its machine spoilt says so itself.
TESTS = """export TOPOMETRIC_GUEST=1 TOPOMETRIC_FAULT_TABLE=/tmp/faults.md
failed=0
for test in %(tests)s; do
  %(program)s --gtest_color=no --gtest_filter=$test || failed=1
done
echo "== table"; cat /tmp/faults.md; echo "== end of the table"
exit $failed
"""


def cannot(why):
    required = os.environ.get("TOPOMETRIC_VM") == "required"
    print("%s: %s; NO FAULT OF THE MACHINE WAS TESTED" % ("FAILED" if required else "SKIPPED", why))
    sys.exit(1 if required else 77)


def tests_of(program, wanted):
    """Names of the tests of the suite; listed here, where it is quicker."""
    listed = subprocess.run([program, "--gtest_list_tests", "--gtest_filter=" + wanted], capture_output=True, text=True,
                            check=True, env={**os.environ, "TOPOMETRIC_GUEST": "1"}).stdout
    suite, tests = "", []
    for line in listed.splitlines():
        name = line.split("#")[0].rstrip()
        if not line.startswith(" "):
            suite = name
        else:
            tests.append(suite + name.strip())
    return tests


def script(build, shared, tests):
    program = build / "tests/integration/wire_faults_test"
    programs = [program, *(build / "bin" / name for name in ("topometricd", "topometric-estop"))]
    return RAM % {"programs": " ".join(map(str, programs)), "shared": shared,
                  "tests": TESTS % {"tests": " ".join(tests), "program": program}}


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    wanted = sys.argv[2] if len(sys.argv) > 2 else "Guest/*"
    if os.environ.get("TOPOMETRIC_VM") == "off":
        cannot("TOPOMETRIC_VM=off")
    cache = pathlib.Path(os.environ.get("XDG_CACHE_HOME", pathlib.Path.home() / ".cache")) / "topometric"
    cache.mkdir(parents=True, exist_ok=True)
    begin = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="topometric-host-") as holder:
        shared, named = pathlib.Path(holder), os.environ.get("TOPOMETRIC_FAULT_TABLE")
        (shared / "faults.md").write_text(pathlib.Path(named).read_text() if named else "")
        tests = tests_of(build / "tests/integration/wire_faults_test", wanted)
        try:
            status, text = guest.run(cache, script(build, shared, tests), shared, hidden_folders(build), LIMIT_S,
                                     guest.PUNCTUAL)
        except guest.CannotRun as why:
            cannot(str(why))
        table = TABLE.search(text)
        if named and status == 0:
            pathlib.Path(named).write_text(table.group(1))
    passed = set(re.findall(r"\[       OK \] (\S+)", text))
    if status == 0 and passed != set(tests) or not tests:
        print("FAILED: not run: %s" % (", ".join(set(tests) - passed) or "any test"))
        status = 1
    print("faults of the machine, %.1f s, %d passed: %s" % (time.monotonic() - begin, len(passed),
                                                          "ok" if status == 0 else "FAILED (%d)" % status))
    return 0 if status == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
