#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""The base on real CAN interfaces: the programs of the build tree, unchanged, on a virtual one and on a pair of emulated
controllers, in a guest with Debian's kernel (guest.py); as root on a machine that has the interface vcan0, on that.

usage: can_test.py BUILD_FOLDER [--prepare] [--figures]
       (--prepare: only fetch the kernel; --figures: times and loads as well)

The guest needs no privilege; it takes the packages qemu-system-x86, busybox-static, cpio, kmod and iproute2
(toolchain/install-dependencies ci). Exit status 77: not run; with TOPOMETRIC_VM=required that is a failure, with
TOPOMETRIC_VM=off nothing is tried. The guest's kernel (about 10 MB) is kept in $XDG_CACHE_HOME/topometric, by default
~/.cache/topometric."""
import fcntl
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import guest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
LIMIT_S = 600
JUDGE = SOURCE / "tests/integration/on_time.py"
# (program, its tests, how many pass on a virtual bus alone, how many beside controllers, strictest bound): numbers are
# exact, because a filter that finds nothing and a test that is skipped are no success; on a machine that is later than the
# bound a failure says nothing, and the part is run again
PARTS = [("tests/integration/pioneer_sim_test", "*/Can_*", 8, 8, 0.005), ("bin/can_wire_test", "*", 9, 11, 0.1)]
BEGIN = "== part "
VIRTUAL = "vcan0"
CONTROLLERS = "can0:can1"
TRIES, TRY_S = 3, 120
BRING_UP = """ip link add vcan0 type vcan && ip link set vcan0 up || exit 3
for c in can0 can1; do
  ip link set $c txqueuelen 128 up type can bitrate 500000 sample-point 0.875 restart-ms 100 berr-reporting on || exit 3
done
"""


def cannot(why):
    required = os.environ.get("TOPOMETRIC_VM") == "required"
    print("%s: %s; NOTHING WAS TESTED ON CAN" % ("FAILED" if required else "SKIPPED", why))
    sys.exit(1 if required else 77)


def test_script(build, controllers):
    """Each part is judged only while the machine keeps time: on_time.py, status 77 when it never did. What was not
    judged does not hide a failure of another part."""
    judge = "/usr/bin/python3 -B %s --tries %d --limit %d --late %g"
    lines = ["export TOPOMETRIC_CAN='%s' TOPOMETRIC_CAN_CONTROLLERS='%s'" % (VIRTUAL, controllers), "status=0",
             "ended() { [ $1 = 0 ] || { [ $1 = 77 ] && [ $status != 0 ]; } || status=$1; }"]
    for program, tests, _, _, late_s in PARTS:
        lines.append("echo '%s%s'" % (BEGIN, program))
        lines.append("%s %s --gtest_color=no --gtest_filter='%s'; ended $?" %
                     (judge % (JUDGE, TRIES, TRY_S, late_s), build / program, tests))
    return "\n".join(lines) + "\n"


def figures_script(build):
    return "/usr/bin/python3 -B %s/can_figures.py %s %s\n" % (SOURCE / "tests/vm", build, SOURCE)


def miscounted(text, controllers):
    """Where GoogleTest passed another number in the last try of a part than there are: tests that were not there are
    missed."""
    heard = {part.split("\n", 1)[0].strip(): part for part in text.split(BEGIN)[1:]}
    complaints = []
    for program, _, alone, beside, _ in PARTS:
        expected = beside if controllers else alone
        passed = re.findall(r"\[  PASSED  \] (\d+) test", heard.get(program, ""))
        if [int(n) for n in passed[-1:]] != [expected]:
            complaints.append("%s: %s tests passed, expected %d" % (program, passed[-1] if passed else "no", expected))
    return complaints


def skipped(text):
    return sorted(set(re.findall(r"\[  SKIPPED \] (\w[\w./]*)$", text, re.MULTILINE)))


def on_this_machine(build):
    with tempfile.TemporaryDirectory(prefix="topometric-can-") as holder:
        script = pathlib.Path(holder) / "run"
        script.write_text(test_script(build, "") + "exit $status\n")
        ran = subprocess.run(["bash", script], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    print(ran.stdout, end="")
    return ran.returncode, ran.stdout


def in_a_guest(build, cache, figures):
    script = BRING_UP + test_script(build, CONTROLLERS) + (figures_script(build) if figures else "") + "exit $status\n"
    with tempfile.TemporaryDirectory(prefix="topometric-can-") as holder:
        return guest.run(cache, script, pathlib.Path(holder), hidden_folders(build), LIMIT_S)


def hidden_folders(build):
    """Of those that the programs need, what the guest's own /tmp and the like would hide."""
    hidden = ("/tmp/", "/run/", "/root/", "/var/tmp/")
    return sorted({path for path in (build, SOURCE) if str(path).startswith(hidden)})


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    if os.environ.get("TOPOMETRIC_VM") == "off":
        cannot("TOPOMETRIC_VM=off")
    cache = pathlib.Path(os.environ.get("XDG_CACHE_HOME", pathlib.Path.home() / ".cache")) / "topometric"
    cache.mkdir(parents=True, exist_ok=True)
    begin = time.monotonic()
    # Interfaces are switched off and on there, which only root may.
    here = pathlib.Path("/sys/class/net", VIRTUAL).exists() and os.geteuid() == 0
    try:
        if not here or "--prepare" in sys.argv:
            with open(cache / "kernel.lock", "w") as lock:
                fcntl.flock(lock, fcntl.LOCK_EX)  # one unpacks, the others find it
                guest.check_programs()
                guest.kernel(cache)
        if "--prepare" in sys.argv:
            return 0
        status, text = on_this_machine(build) if here else in_a_guest(build, cache, "--figures" in sys.argv)
    except guest.CannotRun as why:
        cannot(str(why))
    for name in skipped(text):
        print("skipped: %s" % name)
    if status == 77:
        cannot("the machine did not keep time in any try")
    for complaint in miscounted(text, not here) if status == 0 else []:
        print("FAILED: %s" % complaint)
        status = 1
    print("CAN, %.1f s: %s" % (time.monotonic() - begin, "ok" if status == 0 else "FAILED (%d)" % status))
    return 0 if status == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
