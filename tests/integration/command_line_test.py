#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What all programs do alike at the shell, without a robot.

usage: command_line_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]"""
import os
import pathlib
import subprocess
import sys
import unittest

BIN = SOURCE = pathlib.Path()


def run(program, *arguments, stdout=subprocess.PIPE, **options):
    return subprocess.run([BIN / program, *arguments], stdout=stdout, stderr=subprocess.PIPE, text=True, timeout=60,
                          check=False, **options)


class Output(unittest.TestCase):
    def printers(self):
        yield "topometricd", "--config", SOURCE / "config" / "simulation.toml", "--print-config"
        for program in ("topometricd", "topoctl", "topobench", "toposim"):
            yield program, "--help"

    def test_what_cannot_be_written_is_no_success(self):
        for command in self.printers():
            with self.subTest(command), open("/dev/full", "w") as full:
                self.assertEqual(run(*command).returncode, 0)
                done = run(*command, stdout=full)
                self.assertEqual(done.returncode, 1)
                self.assertIn(command[0] + ": standard output: cannot be written", done.stderr)

    def test_a_closed_output_is_no_success(self):
        for command in self.printers():
            with self.subTest(command):
                done = run(*command, stdout=None, preexec_fn=lambda: os.close(1))
                self.assertEqual(done.returncode, 1)
                self.assertIn(command[0] + ": standard output: cannot be written", done.stderr)


if __name__ == "__main__":
    BIN, SOURCE = pathlib.Path(sys.argv.pop(1)), pathlib.Path(sys.argv.pop(1))
    unittest.main()
