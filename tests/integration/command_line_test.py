#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What all programs do alike at the shell, without a robot.

usage: command_line_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]"""
import os
import pathlib
import re
import socket
import subprocess
import sys
import tempfile
import threading
import unittest

BIN = SOURCE = pathlib.Path()
PROGRAMS = ("topometricd", "topoctl", "topometric-estop", "topobench", "toposim")


def run(program, *arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options):
    return subprocess.run([BIN / program, *arguments], stdout=stdout, stderr=stderr, text=True, timeout=60, check=False,
                          **options)


class Output(unittest.TestCase):
    def printers(self):
        yield "topometricd", "--config", SOURCE / "config" / "simulation.toml", "--print-config"
        for program in PROGRAMS:
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


class StopWithoutListeners(unittest.TestCase):
    """What topometric-estop has to say is heard by nobody, and the robot is stopped all the same."""

    E_STOP = b"\xfa\xfb\x03\x37\x00\x37"

    def written_to_the_base(self, **options):
        """Beside a daemon that hangs, of which it speaks before it stops the robot."""
        with tempfile.TemporaryDirectory() as folder, socket.socket(socket.AF_UNIX) as hung, \
                socket.create_server(("127.0.0.1", 0)) as base:
            hung.bind(folder + "/s")
            hung.listen()
            text = (SOURCE / "config" / "simulation.toml").read_text()
            text = re.sub(r'"tcp:127.0.0.1:8101"', '"tcp:127.0.0.1:%d"' % base.getsockname()[1], text)
            text = re.sub(r'"/tmp/topometric.sock"', '"%s/s"' % folder, text)
            config = pathlib.Path(folder, "c.toml")
            config.write_text(text)
            base.settimeout(60)
            heard = []

            def hear():
                with base.accept()[0] as client:
                    while piece := client.recv(100):
                        heard.append(piece)

            listener = threading.Thread(target=hear, daemon=True)
            listener.start()
            run("topometric-estop", "--config", config, **options)
            listener.join(60)
            return b"".join(heard)

    def test_on_a_full_disk(self):
        with open("/dev/full", "w") as full:
            self.assertIn(self.E_STOP, self.written_to_the_base(stdout=full, stderr=full))

    def test_on_closed_streams(self):
        self.assertIn(self.E_STOP, self.written_to_the_base(stdout=None, stderr=None, preexec_fn=lambda: os.closerange(0, 3)))

    def test_on_a_pipe_that_nobody_reads(self):
        reader, writer = os.pipe()
        os.close(reader)
        self.assertIn(self.E_STOP, self.written_to_the_base(stdout=writer, stderr=writer))
        os.close(writer)


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
        for words in (("--summary", "r", "--config", "c"), ("--summary", "r", "--check-config", "c"),
                      ("--summary", "r", "--print-config"), ("--summary", "r", "--record", "s"),
                      ("--summary", "r", "--replay", "s"), ("--check-config", "c", "--config", "d"),
                      ("--check-config", "c", "--record", "r"), ("--check-config", "c", "--replay", "r")):
            with self.subTest(words):
                said = self.refused("topometricd", *words)
                self.assertIn("excludes", said)
                self.assertIn(words[0], said)
                self.assertIn(words[2], said)

    def test_every_program_has_a_version(self):
        for program in PROGRAMS:
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
