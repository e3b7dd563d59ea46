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


class Words(unittest.TestCase):
    def refused(self, program, *words):
        done = run(program, *words)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        return done.stderr

    def test_a_misspelt_command_is_named_with_the_one_that_is_near(self):
        for program, words, found, near in (("topoctl", ("statsu",), "statsu", "status"),
                                            ("topoctl", ("map", "sav", "x"), "sav", "save"),
                                            ("topobench", ("slm",), "slm", "slam")):
            with self.subTest(words):
                said = self.refused(program, *words)
                self.assertIn('%s: found "%s", expected one of ' % (program, found), said)
                self.assertIn('did you mean "%s"?' % near, said)
        self.assertNotIn("did you mean", self.refused("topoctl", "xylophone"))
        self.assertIn("subcommand is required", self.refused("topoctl"))

    def test_no_number_is_no_number(self):
        for program, *words in (("topoctl", "goto", "nan", "1"), ("topoctl", "goto", "1", "inf"),
                                ("topoctl", "drive", "nan", "0"), ("topoctl", "drive", "0.1", "0", "--for", "nan"),
                                ("topoctl", "session", "load", "x", "--pose", "0", "0", "nan"),
                                ("topoctl", "watch", "--every", "nan"), ("toposim", "--start", "0", "0", "nan"),
                                ("topobench", "slam", "--simulate", "w", "--minutes", "nan"),
                                ("topobench", "explore", "--world", "w", "--contact", "nan")):
            with self.subTest(words):
                self.assertRegex(self.refused(program, *words), "found (nan|inf), expected a")

    def test_what_counts_is_not_negative(self):
        for words in (("slam", "--simulate", "w", "--seed", "-1"), ("explore", "--world", "w", "--seed", "-1"),
                      ("session", "--log", "l", "--localise", "-5")):
            with self.subTest(words):
                self.assertIn(words[-2], self.refused("topobench", *words))

    def test_an_option_that_would_do_nothing_is_refused(self):
        for words, said in ((("slam", "--log", "l", "--people", "3"), "--people requires --simulate"),
                            (("slam", "--log", "l", "--minutes", "3"), "--minutes requires --simulate"),
                            (("slam", "--log", "l", "--seed", "3"), "--seed requires --simulate"),
                            (("slam", "--simulate", "w", "--split", "known"), "--split requires --log"),
                            (("analyse", "--map", "m.yaml", "--resolution", "0.5"), "--resolution: found 0.5 for m.yaml"),
                            (("explore", "--world", "w", "--radio", "foo"), "foo")):
            with self.subTest(words):
                self.assertIn(said, self.refused("topobench", *words))

    def test_every_program_has_a_version(self):
        for program in ("topometricd", "topoctl", "topobench", "toposim"):
            self.assertRegex(run(program, "--version").stdout, r"^%s \d+\.\d+\.\d+\n$" % program)


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
