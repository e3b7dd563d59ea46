#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs a test that keeps to the real clock, and judges it only where the machine kept time.

usage: on_time.py [--tries N] [--limit SECONDS] [--late SECONDS] COMMAND...

A watcher beside the test measures how late it is woken itself. A test that fails on a machine that kept time has
failed. On one that did not, the failure says nothing about the product: the test is run again, up to N times (3), and
when the machine was late in each, the exit status is 77, not judged, which ctest shows as Skipped. What no machine
excuses fails at once: a crash, or a sanitizer's finding, in a process that the test started too. LIMIT is that of one
try. LATE is how late a machine that kept time is at most (0.1): what a test with a stricter bound can ask for.
"""

import argparse
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time

PERIOD_S = 0.02
# A base thread wakes every 50 ms and a laser sends every 25 ms: a machine that wakes nobody for twice that long, or
# is often nearly a scan late, is not one to measure on.
LATE_MAX_S = 0.1
LATE_P99_S = 0.02
NOT_JUDGED = 77
NO_EXCUSE = (b"Sanitizer", b"runtime error:", b"terminate called", b"Assertion `")


class Watcher:
    """How late a thread that does nothing else is woken."""

    def __init__(self):
        self._late_s = [0.0]
        self._end = threading.Event()
        self._thread = threading.Thread(target=self._watch, daemon=True)
        self._thread.start()

    def _watch(self):
        due = time.monotonic() + PERIOD_S
        while not self._end.wait(max(0.0, due - time.monotonic())):
            now = time.monotonic()
            self._late_s.append(now - due)
            due = now + PERIOD_S

    def stop(self):
        """(latest, 99th percentile), in seconds"""
        self._end.set()
        self._thread.join()
        late_s = sorted(self._late_s)
        return late_s[-1], late_s[int(0.99 * (len(late_s) - 1))]


def attempt(command, limit_s):
    """(exit status, whether a machine's lateness could be the reason)"""
    with tempfile.TemporaryDirectory(prefix="on-time-") as reports:
        status, excusable = run(command, limit_s, environment(reports))
        found = sorted(pathlib.Path(reports).iterdir())
        for report in found:
            print("== on_time:", report.name)
            print(report.read_text(errors="replace"), flush=True)
    return (status or 1, False) if found else (status, excusable)


def environment(reports):
    """Sanitizers write what they find into a folder, whatever becomes of the process's own output."""
    own = dict(os.environ)
    for name in ("ASAN_OPTIONS", "UBSAN_OPTIONS", "TSAN_OPTIONS"):
        own[name] = ":".join(filter(None, [own.get(name), "log_path=%s/%s" % (reports, name[:4].lower())]))
    return own


def run(command, limit_s, own_environment):
    out_of_time = threading.Event()
    excusable = True
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True,
                          env=own_environment) as process:

        def kill():
            out_of_time.set()
            os.killpg(process.pid, signal.SIGKILL)

        timer = threading.Timer(limit_s, kill)
        timer.start()
        try:
            for line in process.stdout:
                excusable = excusable and not any(word in line for word in NO_EXCUSE)
                sys.stdout.buffer.write(line)
                sys.stdout.buffer.flush()
            status = process.wait()
        except BaseException:  # an interrupt does not reach a session of its own
            kill()
            raise
        finally:
            timer.cancel()
    if out_of_time.is_set():
        print("== on_time: not done within %.0f s" % limit_s)
        return 1, excusable
    return status, excusable and status > 0


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--tries", type=int, default=3)
    parser.add_argument("--limit", type=float, default=300.0)
    parser.add_argument("--late", type=float, default=LATE_MAX_S)
    parser.add_argument("command", nargs=argparse.REMAINDER)
    arguments = parser.parse_args()
    for number in range(1, arguments.tries + 1):
        watcher = Watcher()
        status, excusable = attempt(arguments.command, arguments.limit)
        latest_s, p99_s = watcher.stop()
        if status == 0:
            return 0
        punctual = latest_s <= arguments.late and p99_s <= LATE_P99_S
        print("== on_time: failed (%d) in try %d of %d; the machine was up to %.0f ms late, 99 of 100 times at most %.1f ms"
              % (status, number, arguments.tries, 1e3 * latest_s, 1e3 * p99_s), flush=True)
        if not excusable or punctual:
            return status if status > 0 else 1
    print("== on_time: NOT JUDGED: this machine did not keep time in any try")
    return NOT_JUDGED


if __name__ == "__main__":
    sys.exit(main())
