#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""tests/vm/can_test.py: how the parts are judged together, and what number of tests is a success."""

import pathlib
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "vm"))
import can_test

PARTS = [("first", "*", 2, 3, 0.005), ("second", "*", 1, 1, 0.1)]
PLAIN_JUDGE = "import subprocess, sys\nsys.exit(subprocess.call(sys.argv[7:]))\n"


def told(first, second):
    return "== part first\n%s\n== part second\n%s\n" % (first, second)


def passed(*numbers):
    return "\n".join("[  PASSED  ] %d tests." % n for n in numbers)


@mock.patch.object(can_test, "PARTS", PARTS)
class CanTest(unittest.TestCase):
    def status_of(self, *statuses):
        """Of all parts together, when each ends with its own."""
        with tempfile.TemporaryDirectory() as folder:
            build = pathlib.Path(folder)
            (build / "judge.py").write_text(PLAIN_JUDGE)
            for (name, *_), status in zip(PARTS, statuses):
                (build / name).write_text("#!/bin/sh\nexit %d\n" % status)
                (build / name).chmod(0o755)
            with mock.patch.object(can_test, "JUDGE", build / "judge.py"):
                script = can_test.test_script(build, "") + "exit $status\n"
            return subprocess.run(["bash", "-c", script], stdout=subprocess.DEVNULL, check=False).returncode

    def test_success_of_all_is_success(self):
        self.assertEqual(0, self.status_of(0, 0))

    def test_a_failure_is_a_failure_whatever_the_other_part_says(self):
        for other in (0, 1, 77):
            self.assertEqual(1, self.status_of(1, other))
            self.assertEqual(1, self.status_of(other, 1))

    def test_what_was_not_judged_is_no_success(self):
        self.assertEqual(77, self.status_of(77, 0))
        self.assertEqual(77, self.status_of(0, 77))

    def test_the_number_of_tests_is_exact(self):
        self.assertEqual([], can_test.miscounted(told(passed(2), passed(1)), False))
        self.assertEqual([], can_test.miscounted(told(passed(3), passed(1)), True))
        for first, second in ((passed(3), passed(1)), (passed(2), passed(0)), (passed(2), ""), ("", passed(1))):
            self.assertEqual(1, len(can_test.miscounted(told(first, second), False)))

    def test_the_last_try_of_each_part_counts(self):
        self.assertEqual([], can_test.miscounted(told(passed(1, 2), passed(0, 1)), False))
        self.assertEqual(2, len(can_test.miscounted(told(passed(2, 1), passed(2, 1, 0)), False)))

    def test_skips_are_named_once(self):
        text = "[  SKIPPED ] A.B/vcan0 (3 ms)\n[  SKIPPED ] 1 test, listed below:\n[  SKIPPED ] A.B/vcan0\n"
        self.assertEqual(["A.B/vcan0"], can_test.skipped(text))


if __name__ == "__main__":
    unittest.main()
