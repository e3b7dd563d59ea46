#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""topoctl setup with toposim's devices and scripted answers: scanners exchanged and upside down, on terminals and on TCP.

usage: setup_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]"""
import json
import math
import os
import pathlib
import re
import select
import subprocess
import sys
import tempfile
import time
import tomllib
import unittest

from sim_client_tools import Simulation

BIN = pathlib.Path()
PATIENCE_S = 100
PROMPT = re.compile(r"\[([^\]\n]*)\] $")


class Setup:
    """The program on pipes, and somebody who answers it and stands where it wants him."""

    def __init__(self, simulation, config, *options):
        self.simulation, self.person, self.answers, self.said = simulation, None, 0, ""
        command = [BIN / "topoctl", "setup", "--config", config, *options]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.wait()
        self.process.stdin.close()
        self.process.stdout.close()
        self.stand(None)

    def read(self):
        """What it says until it asks, or ends."""
        text, limit = "", time.monotonic() + PATIENCE_S
        while not PROMPT.search(text):
            wait = limit - time.monotonic()
            assert wait > 0 and select.select([self.process.stdout], [], [], wait)[0], "no question: " + text
            piece = os.read(self.process.stdout.fileno(), 65536)
            if not piece:
                break
            text += piece.decode()
        self.said += text
        return text

    def stand(self, at):
        if self.person is not None:
            self.simulation.ctl("remove-obstacle", id=self.person)
        self.person = None if at is None else self.simulation.ctl("person", x_m=at[0], y_m=at[1])["id"]

    def answer(self, text=""):
        self.answers += 1
        self.process.stdin.write((text + "\n").encode())
        self.process.stdin.flush()

    def run(self, answers):
        """Answers by what is asked: {part of the question: [answers]}, Enter to the rest. The exit status."""
        while PROMPT.search(text := self.read()):
            if "Let nobody" in text:
                self.stand(None)
            elif "1 m before" in text:
                self.stand((1.25, 0.05))
            elif "to the left" in text and "Stand" in text:
                self.stand((0.1, 1.1))
            given = next((given for part, given in answers.items() if part in text and given), [""])
            self.answer(given.pop(0) if given != [""] else "")
        return self.process.wait(PATIENCE_S)


def read(path):
    with open(path, "rb") as file:
        return tomllib.load(file)


class TestSetup(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.config = os.path.join(self.folder, "etc", "robot.toml")  # the folder is made

    def check(self):
        done = subprocess.run([BIN / "topometricd", "--check-config", self.config], capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_from_nothing_on_terminals(self):
        """The level scanner has the coronal one's name, and hangs upside down; the coronal one is rolled."""
        at = {name: os.path.join(self.folder, name) for name in ("ttyACM0", "ttyACM1", "ttyUSB0")}
        with Simulation(BIN / "toposim", self.folder, "--front-pty", at["ttyACM1"], "--coronal-pty", at["ttyACM0"],
                        "--base-pty", at["ttyUSB0"], "--front-upside-down", "--coronal-roll", "4", "--coronal-backward") as sim, \
                Setup(sim, self.config, "--serial", os.path.join(self.folder, "tty*")) as setup:
            status = setup.run({"What is the robot called": ["two words", "dx-7"], "level scanner": ["0.021 0 0.31"]})
            self.assertEqual(status, 0, setup.said)
            self.assertLessEqual(setup.answers, 12)
            self.assertIn('found "two words", expected a string: 1 to 32 letters', setup.said)
            self.assertIn("#", setup.said)
            seconds = int(re.search(r"(\d+) s of this program's time", setup.said)[1])
            self.assertLess(seconds, 300)
            self.check()
            got = read(self.config)
            self.assertEqual(got["robot"]["name"], "dx-7")
            self.assertEqual(got["base"]["address"], "serial:" + at["ttyUSB0"])
            front, coronal = got["scanner"]["front"], got["scanner"]["coronal"]
            self.assertEqual((front["address"], front["serial_number"]),
                             ("serial:" + at["ttyACM1"], sim.robot["front"]["serial_number"]))
            self.assertEqual((coronal["address"], coronal["serial_number"]),
                             ("serial:" + at["ttyACM0"], sim.robot["coronal"]["serial_number"]))
            self.assertTrue(front["mirrored"])
            self.assertEqual((front["x_m"], front["z_m"]), (0.021, 0.31))
            self.assertTrue(coronal["mirrored"])
            self.assertAlmostEqual(coronal["roll_rad"], math.radians(4), delta=0.015)
            self.assertAlmostEqual(coronal["z_m"], 0.40, delta=0.02)
            self.assertFalse(os.path.exists(self.config + ".1"))

    def test_a_file_of_before_and_the_daemon(self):
        """On TCP, with plugs exchanged; what the file says else stays, the doctor finds the right devices."""
        before = """[robot]
model = "p3dx"
name = "before"
[base]
address = "tcp:127.0.0.1:1"
v_max_mps = 0.4  # a narrow house
[scanner.front]
address = "tcp:127.0.0.1:2"
serial_number = "H1111111"
x_m = 0.021
[control]
socket = "%s/ctl.sock"
state_folder = ""
[realtime]
policy = "off"
""" % self.folder
        os.mkdir(os.path.dirname(self.config))
        pathlib.Path(self.config).write_text(before)
        with Simulation(BIN / "toposim", self.folder, "--tcp", "--coronal-roll", "-3") as sim:
            sim.ctl("swap")
            address = {name: "%s:%d" % (sim.robot[name]["host"], sim.robot[name]["port"]) for name in ("base", "front", "coronal")}
            options = ("--tcp", address["front"], "--tcp", address["coronal"], "--base", "tcp:" + address["base"])
            with Setup(sim, self.config, *options) as setup:
                self.assertEqual(setup.run({"Write this": ["perhaps", "n"]}), 1, setup.said)
                self.assertIn('found "perhaps", expected y or n', setup.said)
                self.assertIn("nothing was written", setup.said)
            self.assertEqual(pathlib.Path(self.config).read_text(), before)
            self.assertFalse(os.path.exists(self.config + ".1"))
            with Setup(sim, self.config, *options) as setup:
                self.assertEqual(setup.run({}), 0, setup.said)
            self.assertEqual(pathlib.Path(self.config + ".1").read_text(), before)
            self.check()
            self.assertIn("v_max_mps = 0.4  # a narrow house", pathlib.Path(self.config).read_text())
            got = read(self.config)
            self.assertEqual(got["robot"]["name"], "before")
            self.assertEqual(got["scanner"]["front"]["address"], "tcp:" + address["coronal"])
            self.assertAlmostEqual(got["scanner"]["coronal"]["roll_rad"], math.radians(-3), delta=0.015)
            self.identities_are_good()

    def doctor(self):
        done = subprocess.run([BIN / "topoctl", "--socket", self.folder + "/ctl.sock", "--json", "doctor"], capture_output=True,
                              text=True, timeout=60)
        return {check["check"]: check for check in json.loads(done.stdout)["checks"]} if done.returncode in (0, 1) else {}

    def identities_are_good(self):
        with open(os.path.join(self.folder, "log"), "wb") as log:
            daemon = subprocess.Popen([BIN / "topometricd", "--config", self.config], stderr=log)
        try:
            limit = time.monotonic() + PATIENCE_S
            devices = ("base", "front", "coronal")
            while not all(checks.get(d, {}).get("ok") for checks in [self.doctor()] for d in devices):
                self.assertLess(time.monotonic(), limit, self.doctor())
                time.sleep(0.2)
            numbers = self.doctor()["serial numbers"]
            self.assertEqual((numbers["ok"], numbers["warning"]), (True, False), numbers)
        finally:
            daemon.terminate()
            daemon.wait(20)

    def test_without_a_base_nothing_is_asked(self):
        with Simulation(BIN / "toposim", self.folder, "--tcp") as sim, \
                Setup(sim, self.config, "--tcp", "127.0.0.1:%d" % sim.robot["front"]["port"]) as setup:
            self.assertEqual(setup.run({}), 1)
            self.assertEqual(setup.answers, 0)
            self.assertIn("no base was found", setup.said)
            self.assertIn("nothing was written", setup.said)
        self.assertFalse(os.path.exists(os.path.dirname(self.config)))

    def test_where_it_may_not_write_nothing_is_asked(self):
        done = subprocess.run([BIN / "topoctl", "setup", "--config", os.path.join(self.folder, "no", "such", "robot.toml")],
                              capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=60)
        self.assertEqual((done.returncode, done.stdout), (1, ""))
        self.assertIn("no: writing there: ", done.stderr)


def main():
    global BIN
    BIN = pathlib.Path(sys.argv[1])
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)


if __name__ == "__main__":
    main()
