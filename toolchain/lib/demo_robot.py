# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""One robot of the demonstration: its daemon and, in a team, its link, and what they say."""

import json
import math
import os
import pathlib
import subprocess
import time

import demo_processes
import demo_view

SOURCE = pathlib.Path(__file__).resolve().parents[2]
READY_LIMIT_S = 60
TEAM = """
[team]
name = "%s"
id = %d
interface = "%s"
peers = %s
security = "%s"
start = [%r, %r, %r]
socket = "%s"
"""


def team_name():
    """Of its own, so that another demonstration on the same loopback is another team."""
    return "demo-%d" % os.getpid()


def credentials(folder, robot):
    return folder / "team" / ("robot-%d" % robot)


def make_credentials(processes, folder, robots):
    """For as long as the folder is there: a team of its own, and an identity for each robot."""
    tool, team = SOURCE / "daemon/link/topometric-team", folder / "team"
    for words in [("new", team, "--name", team_name()), *(("add", robot, team) for robot in range(1, robots + 1))]:
        done = processes.run(tool, *words)
        if done.returncode != 0:
            raise demo_processes.Failure("the team has no credentials: %s" % done.stderr.strip())


class Robot:
    """`devices`: the simulator's description of this robot, with addresses and start; `place`: where its link runs
    (demo_network.Place)."""

    def __init__(self, number, devices, options, folder, processes, place):
        self.place, self.folder = place, folder
        self.number, self.devices, self.options, self.processes = number, devices, options, processes
        suffix = str(number) if options.robots > 1 else ""
        self.name = "robot %d" % number if options.robots > 1 else "the robot"
        self.daemon_log = "topometricd" + suffix
        self.link_log = "topolink" + suffix
        self.socket = folder / ("control%s.sock" % suffix)
        self.config = folder / ("topometric%s.toml" % suffix)
        self.view_folder, self.view_port = folder / ("view%s" % suffix), demo_view.free_port()
        self.link_socket = folder / ("link%s.sock" % suffix)
        self.status, self.team, self.begin_s, self.home_s, self.waiter = {}, {}, None, None, None

    def topoctl(self, *words, patience_s=150.0):
        return self.processes.run("topoctl", "--socket", self.socket, *words, patience_s=patience_s)

    def answer(self, *words):
        done = self.topoctl("--json", *words)
        return json.loads(done.stdout) if done.returncode == 0 else {}

    def configuration(self):
        values = {("control", "socket"): str(self.socket), ("view", "state_folder"): str(self.view_folder),
                  ("view", "port"): self.view_port, ("exploration", "strategy"): self.options.strategy,
                  ("exploration", "finish"): self.options.finish, ("base", "v_max_mps"): self.options.speed}
        for section, device in (("base", "base"), ("scanner.front", "front"), ("scanner.coronal", "coronal")):
            values[section, "address"] = self.devices[device]["address"]
        text = demo_processes.configure((SOURCE / "config/simulation.toml").read_text(), values)
        if self.options.robots == 1:
            return text
        x, y, theta = self.devices["start"]
        text = demo_processes.configure(text, {("robot", "id"): self.number})
        return text + TEAM % (team_name(), self.number, self.place.interface, json.dumps(self.place.peers),
                              credentials(self.folder, self.number), x, y, math.degrees(theta), self.link_socket)

    def start(self):
        self.config.write_text(self.configuration())
        self.daemon = self.processes.start("topometricd", "--config", self.config, log=self.daemon_log)
        self.threads = demo_processes.ThreadTimes(self.daemon.pid)
        if self.options.robots > 1:
            self.link = self.processes.start("topolink", "--config", self.config, log=self.link_log,
                                              enter=self.place.enter)
            self.link_threads = demo_processes.ThreadTimes(self.link.pid)

    def wait_ready(self):
        end = time.monotonic() + READY_LIMIT_S
        while not self.socket.exists() and self.daemon.poll() is None and time.monotonic() < end:
            time.sleep(0.05)
        ready = self.topoctl("wait", "ready", "--timeout", READY_LIMIT_S)
        if ready.returncode != 0:
            raise demo_processes.Failure("%s did not get ready: %s\n%s" %
                                         (self.name, ready.stderr.strip(), self.processes.end_of_log(self.daemon_log)))

    def begin(self, now_s):
        begun = self.topoctl("start")
        if begun.returncode != 0:
            raise demo_processes.Failure("topoctl start, %s: %s" % (self.name, begun.stderr.strip()))
        self.begin_s = now_s
        self.waiter = self.processes.start("topoctl", "--socket", self.socket, "wait", "done", stdout=subprocess.DEVNULL)
        self.threads.begin()
        if self.options.robots > 1:
            self.link_threads.begin()

    def update(self, now_s):
        self.status = self.answer("status") or self.status
        if self.begin_s is not None and self.home_s is None:
            self.threads.update()
            if self.options.robots > 1:
                self.link_threads.update()
        if self.has_ended() and self.home_s is None:
            self.home_s = now_s

    def ask_team(self):
        """What it holds; of all robots right after each other, because it changes while they drive."""
        self.team = self.answer("team") or self.team

    def has_ended(self):
        return self.waiter is not None and self.waiter.poll() is not None

    def check_alive(self):
        if self.daemon.poll() is not None:
            raise demo_processes.Failure("topometricd of %s ended with status %d:\n%s" %
                                         (self.name, self.daemon.returncode, self.processes.end_of_log(self.daemon_log)))

    def end_mission(self):
        """Why the mission was none; empty: it is done."""
        self.processes.end(self.waiter)
        self.status = self.answer("status") or self.status
        mission = self.status.get("mission", {})
        if mission.get("state") == "done":
            return ""
        return "the mission of %s ended as '%s': %s" % (self.name, mission.get("state", "-"), mission.get("reason", "-"))
