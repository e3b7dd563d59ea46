# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""A simulated robot and its daemon as processes of their own, for tests of what they do together."""
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest

PATIENCE_S = 90
ONE_ROOM = """
[[start]]
x_m = 2.0
y_m = 2.0
[[wall]]
points_m = [[-0.1, -0.1], [9.1, -0.1], [9.1, 6.1], [5.0, 6.1], [-0.1, 5.1]]
closed = true
thickness_m = 0.2
"""


def wait_for(condition, what, seconds=PATIENCE_S):
    """What the condition gives as soon as it is true."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.02)  # between two looks; the deadline decides, not the sleep
    raise AssertionError("%s did not come within %g s" % (what, seconds))


class RobotProcesses(unittest.TestCase):
    """A folder, and processes that end with the test."""

    programs = source = None  # folders; set by main()

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.sim_control = self.folder / "sim.sock"
        self.socket = self.folder / "control.sock"
        self.config = self.folder / "robot.toml"
        self.processes = []
        self.addCleanup(self.kill_all)

    def kill_all(self):
        for process in self.processes:
            if process.poll() is None:
                process.kill()
                process.wait()

    def start(self, name, *arguments, **options):
        with open(self.folder / (name + ".log"), "ab") as log:
            process = subprocess.Popen([str(self.programs / name), *map(str, arguments)], stderr=log, text=True,
                                       **options)
        self.processes.append(process)
        return process

    def start_simulator(self, world, *options):
        """The process, and the devices of its robot."""
        simulator = self.start("toposim", "--world", world, "--control", self.sim_control, "--die-with-parent", *options,
                               stdout=subprocess.PIPE)
        self.addCleanup(simulator.stdout.close)
        return simulator, json.loads(simulator.stdout.readline())["robots"][0]

    def write_config(self, devices, sections=""):
        """config/simulation.toml for these devices; `sections` take the place of [session] and what follows it."""
        text = (self.source / "config/simulation.toml").read_text()
        for section, device in (("base", "base"), ("scanner.front", "front"), ("scanner.coronal", "coronal")):
            pattern = r"(\[%s\].*?\naddress = )\"[^\"]*\"" % re.escape(section)
            text = re.sub(pattern, r'\1"%s"' % devices[device]["address"], text, count=1, flags=re.S)
        text = re.sub(r'(?m)^socket = "[^"]*"', 'socket = "%s"' % self.socket, text, count=1)
        # So that there is something to explore in a single room.
        text, count = re.subn(r'(?m)^# finish = "[^"]*"', 'finish = "complete"', text)
        self.assertEqual(count, 1)
        self.config.write_text(text[:text.index("[session]")] + sections if sections else text)

    def ctl(self, *words):
        return subprocess.run([self.programs / "topoctl", "--socket", self.socket, *map(str, words)],
                              capture_output=True, text=True, timeout=2 * PATIENCE_S)

    def status(self):
        """Empty where no daemon answers."""
        done = self.ctl("--json", "status")
        return json.loads(done.stdout) if done.returncode == 0 else {}

    def simulator_says(self, word):
        done = subprocess.run([self.programs / "toposim", "ctl", self.sim_control, word], capture_output=True, text=True,
                              timeout=PATIENCE_S, check=True)
        return json.loads(done.stdout)


def main():
    """usage: TEST BIN_FOLDER SOURCE_FOLDER [unittest options]"""
    RobotProcesses.programs, RobotProcesses.source = pathlib.Path(sys.argv.pop(1)), pathlib.Path(sys.argv.pop(1))
    done = unittest.main(module="__main__", verbosity=2, exit=False).result
    # A pattern (-k) that names no test would pass without having tested anything.
    sys.exit(0 if done.wasSuccessful() and done.testsRun > 0 else 1)
