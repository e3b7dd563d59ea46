#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs a stress test several times at once on one core, beside programs that only take time.

usage: crowded.py [--copies N] [--hogs N] PROGRAM [ARGUMENTS...]

Threads are then preempted in the middle of what they do. Exit status 0 when all copies passed; what one that failed
said is printed.
"""

import argparse
import os
import subprocess
import sys


def main():
    parser = argparse.ArgumentParser(description="a stress test, several times at once on one core")
    parser.add_argument("--copies", type=int, default=3)
    parser.add_argument("--hogs", type=int, default=2)
    parser.add_argument("command", nargs=argparse.REMAINDER, help="the program and its arguments")
    arguments = parser.parse_args()
    if not arguments.command:
        parser.error("no program to run")
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})  # and so of all that is started here
    hogs = [subprocess.Popen([sys.executable, "-c", "import os\nos.nice(19)\nwhile True: pass"]) for _ in range(arguments.hogs)]
    try:
        copies = [subprocess.Popen(arguments.command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT) for _ in range(arguments.copies)]
        said = [copy.communicate()[0].decode(errors="replace") for copy in copies]
    finally:
        for hog in hogs:
            hog.kill()
            hog.wait()
    failed = [(copy.returncode, text) for copy, text in zip(copies, said) if copy.returncode != 0]
    for status, text in failed:
        print(f"a copy ended with {status}:\n{text}")
    print(f"{arguments.copies - len(failed)} of {arguments.copies} copies passed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
