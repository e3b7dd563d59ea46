#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""tests/integration/on_time.py: what is judged, what is tried again, what nothing excuses."""

import io
import pathlib
import sys
import tempfile
import unittest
from contextlib import redirect_stdout
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "integration"))
import on_time


class Clock:
    """A watcher that tells what it is told."""

    def __init__(self, late_s):
        self.late_s = late_s

    def stop(self):
        return self.late_s, 0.001


class OnTime(unittest.TestCase):
    def run_with(self, late_s, script, *more):
        """(exit status, number of tries) of a shell script, with the machine as late as said in each try."""
        with tempfile.NamedTemporaryFile() as tries:
            command = ["on_time.py", *more, "sh", "-c", "echo >>%s; %s" % (tries.name, script.format(tries=tries.name))]
            watchers = [Clock(late) for late in late_s]
            said = io.TextIOWrapper(io.BytesIO())
            with mock.patch.object(sys, "argv", command), mock.patch.object(on_time, "Watcher", side_effect=watchers):
                with redirect_stdout(said):
                    status = on_time.main()
            return status, len(tries.readlines())

    def test_success_is_success_however_late(self):
        self.assertEqual((0, 1), self.run_with([0.5], "true"))

    def test_a_failure_on_time_is_a_failure(self):
        self.assertEqual((3, 1), self.run_with([0.03], "exit 3"))

    def test_a_failure_on_a_late_machine_is_tried_again(self):
        self.assertEqual((0, 2), self.run_with([0.5, 0.5], "test $(wc -l <{tries}) -ge 2"))
        self.assertEqual((3, 2), self.run_with([0.5, 0.01], "exit 3"))

    def test_a_machine_that_is_always_late_judges_nothing(self):
        self.assertEqual((on_time.NOT_JUDGED, 2), self.run_with([0.5, 0.5], "exit 3", "--tries", "2"))

    def test_a_strict_bound_is_judged_on_a_machine_that_keeps_it(self):
        self.assertEqual((0, 2), self.run_with([0.039, 0.039], "test $(wc -l <{tries}) -ge 2", "--late", "0.005"))
        self.assertEqual((3, 1), self.run_with([0.004], "exit 3", "--late", "0.005"))
        self.assertEqual((on_time.NOT_JUDGED, 3), self.run_with([0.039] * 3, "exit 3", "--late", "0.005"))

    def test_nothing_excuses_a_crash_or_a_finding(self):
        self.assertEqual((1, 1), self.run_with([0.5], "kill -SEGV $$"))
        self.assertEqual((3, 1), self.run_with([0.5], "echo ==1==ERROR: AddressSanitizer: heap-use-after-free; exit 3"))

    def test_a_finding_in_a_process_whose_output_nobody_reads_is_one(self):
        report = "for o in $ASAN_OPTIONS; do echo found >${{o##*log_path=}}.1; done; exit 0"
        self.assertEqual((1, 1), self.run_with([0.5], report))

    def test_what_hangs_is_ended(self):
        self.assertEqual((1, 1), self.run_with([0.01], "sleep 600", "--limit", "0.3"))

    def test_the_watcher_sees_a_process_that_is_stopped(self):
        watcher = on_time.Watcher()
        with mock.patch.object(on_time.time, "monotonic", side_effect=lambda real=on_time.time.monotonic: real() + 1.0):
            on_time.time.sleep(0.1)
        latest_s, _ = watcher.stop()
        self.assertGreater(latest_s, 0.9)


if __name__ == "__main__":
    unittest.main()
