# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""A simulated robot in one room, its daemon and its page, for tests of the page."""
import json
import re
import signal
import socket
import subprocess

from page_client import Page
from robot_processes import ONE_ROOM, PATIENCE_S, RobotProcesses, wait_for

START_M = (2.0, 2.0)  # the map begins there


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class ViewProcesses(RobotProcesses):
    def setUp(self):
        super().setUp()
        world = self.folder / "world.toml"
        world.write_text(ONE_ROOM)
        self.simulator, devices = self.start_simulator(world)
        self.write_config(devices)
        self.port = free_port()
        self.configure("")
        self.daemon = self.start_daemon()

    def configure(self, more):
        text = self.config.read_text()
        self.assertIn("\n[view]", text)
        text = text[:text.index("\n[view]")]
        self.config.write_text(text + '\n[view]\nport = %d\nstate_folder = "%s"\n%s' % (self.port, self.folder / "view", more))

    def start_daemon(self):
        daemon = self.start("topometricd", "--config", self.config)
        wait_for(lambda: self.status().get("map", {}).get("keyframes", 0) > 0, "a daemon with a map")
        return daemon

    def start_view(self, *words):
        view = self.start("topoview", "--config", self.config, *words)

        def answers():
            self.assertIsNone(view.poll(), (self.folder / "topoview.log").read_text())
            with socket.socket() as probe:
                return probe.connect_ex(("127.0.0.1", self.port)) == 0

        wait_for(answers, "a page")
        return view

    def view_command(self, *words):
        return subprocess.run([self.programs / "topoview", "--config", self.config, *words], capture_output=True, text=True,
                              timeout=PATIENCE_S, check=True).stdout

    def page(self, **options):
        page = Page(self.port, **options)
        self.addCleanup(page.close)
        return page

    def make_token(self, name):
        return re.search(r"token +(\S+)", self.view_command("pair", "--name", name)).group(1)

    def e_stops(self):
        return self.simulator_says("status")["robots"][0]["base"]["e_stops"]


class DrivenOnce(ViewProcesses):
    """A daemon has driven a little, saved its map, and ended: its session, mission log and recording are there."""

    def write_config(self, devices, sections=""):
        self.sessions = self.folder / "sessions"
        self.sessions.mkdir()
        super().write_config(devices, '[session]\nfolder = "%s"\njournal_period_s = 0.2\n\n[view]\n' % self.sessions)

    def start_daemon(self):
        """Drives a little, and records it."""
        daemon = self.start("topometricd", "--config", self.config, "--record", self.folder / "drive.rec")
        wait_for(lambda: self.status().get("map", {}).get("keyframes", 0) > 0, "a daemon with a map")
        ready = self.ctl("wait", "ready", "--timeout", "30")
        self.assertEqual(ready.returncode, 0, ready.stderr)
        self.assertEqual(self.ctl("area", "draw", 3, 1, 3.4, 1, 3.4, 1.4).returncode, 0)
        self.assertEqual(self.ctl("start").returncode, 0)
        wait_for(lambda: self.status().get("map", {}).get("keyframes", 0) > 4, "a drive")
        self.assertEqual(self.ctl("stop").returncode, 0)
        wait_for(lambda: self.status()["twist"] == {"v_mps": 0.0, "omega_radps": 0.0}, "a robot that stands")
        self.assertEqual(self.ctl("map", "save", self.folder / "saved").returncode, 0)
        keyframes = self.status()["map"]["keyframes"]
        wait_for(lambda: any(line.get("map", {}).get("keyframes") == keyframes for line in self.log()), "a log with all of it")
        daemon.send_signal(signal.SIGTERM)
        self.assertEqual(daemon.wait(30), 0)
        return daemon

    def log(self):
        """The whole lines of the mission log: the daemon may be writing the next."""
        text = "".join(log.read_text() for log in self.sessions.glob("log-*.jsonl"))
        return [json.loads(line) for line in text[:text.rfind("\n") + 1].splitlines()]
