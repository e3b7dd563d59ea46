#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What all programs do alike at the shell, without a robot.

usage: command_line_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]"""
import os
import pathlib
import subprocess
import sys
import tempfile
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


class OutFolder(unittest.TestCase):
    FLAT = str(pathlib.Path(__file__).with_name("flat.toml"))

    def refused(self, *command):
        """Within the time limit of run(), and with nothing said but the one line of the error."""
        done = run("topobench", *command)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        return done.stderr

    def test_one_that_cannot_be_made_is_refused_before_the_work(self):
        with tempfile.NamedTemporaryFile() as file:
            out = file.name + "/out"
            for command in (("slam", "--simulate", self.FLAT, "--minutes", "600"),
                            ("explore", "--world", self.FLAT, "--fidelity", "plan")):
                with self.subTest(command):
                    said = self.refused(*command, "--out", out)
                    self.assertEqual(said.count("\n"), 1, said)
                    self.assertIn(out + ": cannot make the folder", said)

    def test_an_empty_name_is_refused(self):
        for command in (("slam", "--simulate", self.FLAT), ("explore", "--world", self.FLAT), ("analyse", "--map", "m.png"),
                        ("session", "--log", "x.clf")):
            with self.subTest(command):
                self.assertIn("--out: found an empty path", self.refused(*command, "--out", ""))


if __name__ == "__main__":
    BIN, SOURCE = pathlib.Path(sys.argv.pop(1)), pathlib.Path(sys.argv.pop(1))
    unittest.main()
