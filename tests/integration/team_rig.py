# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""A team of real processes: one simulated building, and for each robot its daemon and its link, the links in network
namespaces of their own. What the daemons say is read from their control sockets, what is true from the building."""
import json
import math
import os
import pathlib
import signal
import socket
import subprocess
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "toolchain/lib"))
from demo_processes import configure, end_with_parent  # noqa: E402
from link_rig import Network  # noqa: E402
from robot_processes import wait_for  # noqa: E402

TEAM = """
[team]
name = "trio"
id = {number}
interface = "radio"
domain = {domain}
security = "{security}"
start = [{x}, {y}, {yaw_deg}]
socket = "{socket}"
"""
PATIENCE_S = 60.0
SAME_GOAL_M = 1.5  # team::kSameGoal_m
CONTACT_S = 0.8  # presence is told every 0.5 s, a status every 0.4 s


def ask(path, request, patience_s=20.0):
    """One line of JSON to a Unix socket, and the line that answers it."""
    with socket.socket(socket.AF_UNIX) as client:
        client.settimeout(patience_s)
        client.connect(str(path))
        client.sendall(json.dumps(request).encode() + b"\n")
        return json.loads(client.makefile().readline())


def look(path, method):
    """What a daemon answers to a method without parameters; empty where none does."""
    try:
        return ask(path, {"jsonrpc": "2.0", "method": method, "id": 1}).get("result", {})
    except (OSError, ValueError):
        return {}


class Building:
    def __init__(self, programs, folder, world, robots, seed=1):
        self.control = folder / "sim.sock"
        self.programs = programs
        with open(folder / "toposim.log", "ab") as log:
            self.process = subprocess.Popen(
                [str(word) for word in (programs / "toposim", "--world", world, "--tcp", "--seed", seed, "--robots", robots,
                                        "--control", self.control, "--die-with-parent")],
                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=log, text=True)
        line = self.process.stdout.readline()
        if not line:
            raise AssertionError("toposim did not start: " + (folder / "toposim.log").read_text())
        self.devices = json.loads(line)["robots"]

    def says(self, command):
        return ask(self.control, {"command": command})

    def truths(self):
        return self.says("truth")["robots"]

    def e_stops(self):
        """E_STOP packets on each robot's wire since the start."""
        return [robot["base"]["e_stops"] for robot in self.says("status")["robots"]]

    def close(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()


class TeamRobot:
    """`devices`: the simulated robot that it drives. `number`: what it is called in the team."""

    def __init__(self, rig, number, devices, name=None, credentials=None, shift_s=0):
        self.rig, self.number, self.devices = rig, number, devices
        self.name = name or "robot%d" % number
        self.folder = rig.folder / self.name
        self.folder.mkdir()
        self.sessions = self.folder / "sessions"
        self.sessions.mkdir()
        self.socket, self.config = self.folder / "control.sock", self.folder / "robot.toml"
        self.daemon_log, self.link_log = self.folder / "topometricd.log", self.folder / "topolink.log"
        self.daemon = self.link = None
        self.environment = {**os.environ}
        if shift_s:  # of the processes' own time of day
            self.environment.update({"LD_PRELOAD": str(rig.programs / "clock_shift.so"), "CLOCK_SHIFT_S": str(shift_s)})
        self.write_config(credentials or rig.credentials(number))

    def write_config(self, credentials):
        values = {("control", "socket"): str(self.socket), ("robot", "id"): self.number,
                  ("exploration", "finish"): "complete"}  # there is more to explore then
        for section, device in (("base", "base"), ("scanner.front", "front"), ("scanner.coronal", "coronal")):
            values[section, "address"] = self.devices[device]["address"]
        values["session", "folder"] = str(self.sessions)
        text = configure((self.rig.sources / "config/simulation.toml").read_text(), values)
        text = text.replace("# journal_period_s = 2.0", "journal_period_s = 0.5")
        x, y, theta = self.devices["start"]
        self.config.write_text(text + TEAM.format(
            number=self.number, domain=self.rig.domain, security=credentials, x=x, y=y, yaw_deg=math.degrees(theta),
            socket=self.folder / "link.sock"))

    def spawn(self, log, *words):
        with open(log, "ab") as stream:
            return subprocess.Popen([str(word) for word in words], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                    stderr=stream, env=self.environment, preexec_fn=end_with_parent)

    def start_daemon(self):
        self.daemon = self.spawn(self.daemon_log, self.rig.programs / "topometricd", "--config", self.config)
        wait_for(lambda: self.status().get("map", {}).get("keyframes", 0) > 0, "%s with a map" % self.name, PATIENCE_S)

    def start_link(self):
        self.link = self.spawn(self.link_log, *self.rig.air.rooms[self.namespace()], self.rig.programs / "topolink", "--config", self.config)

    def namespace(self):
        """The place of the robot in the building, and not its number: two may have one."""
        return self.rig.building.devices.index(self.devices) + 1

    def start(self):
        self.start_link()
        self.start_daemon()
        return self

    def ready(self):
        done = self.ctl("wait", "ready", "--timeout", PATIENCE_S)
        if done.returncode != 0:
            raise AssertionError("%s is not ready: %s\n%s" % (self.name, done.stderr, self.daemon_log.read_text()[-2000:]))

    def ctl(self, *words, patience_s=100.0):
        return subprocess.run([str(self.rig.programs / "topoctl"), "--socket", str(self.socket), *map(str, words)],
                              capture_output=True, text=True, timeout=patience_s, check=False)

    def obeys(self, *words):
        done = self.ctl(*words)
        if done.returncode != 0:
            raise AssertionError("%s: topoctl %s: %s" % (self.name, " ".join(map(str, words)), done.stderr or done.stdout))
        return done

    def look(self, method):
        return look(self.socket, method)

    def status(self):
        return self.look("status")

    def team(self):
        return self.look("team")

    def peer(self, number):
        """The run of that robot that was heard last: those before a restart are in the table for a while."""
        runs = [peer for peer in self.team().get("peers", []) if peer["robot"] == number]
        return min(runs, key=lambda peer: peer["heard_s_ago"], default={})

    def hears(self, *numbers):
        return all(self.peer(number).get("alive") for number in numbers)

    def held(self):
        return self.team().get("held", {})

    @staticmethod
    def kill(process):
        if process is not None and process.poll() is None:
            process.send_signal(signal.SIGCONT)
            process.kill()
            process.wait()

    def close(self):
        self.kill(self.link)
        self.kill(self.daemon)


class Rig:
    """`domain`: of DDS; another one for each rig, so that none hears what an earlier one leaves. `world`: the building."""

    def __init__(self, programs, sources, folder, robots, domain, world=None):
        self.programs, self.sources, self.folder, self.domain = pathlib.Path(programs), pathlib.Path(sources), folder, domain
        self.robots, self.teams = [], {}
        self.air = Network(range(1, robots + 1))
        for number in range(1, robots + 1):
            self.air.plug(number)
        self.building = Building(self.programs, folder, world or self.sources / "tests/integration/trio.toml", robots)

    def credentials(self, number, authority="office"):
        """Folder of a robot's credentials; another authority of the same team's name makes false ones."""
        team = self.folder / authority
        tool = self.sources / "daemon/link/topometric-team"
        if authority not in self.teams:
            self.teams[authority] = set()
            subprocess.run([tool, "new", team, "--name", "trio"], check=True, capture_output=True)
        if number not in self.teams[authority]:
            subprocess.run([tool, "add", str(number), team], check=True, capture_output=True)
            self.teams[authority].add(number)
        return team / ("robot-%d" % number)

    def robot(self, number, place=None, **options):
        """`place`: of the simulated robot that it is, from 1; else its number's."""
        made = TeamRobot(self, number, self.building.devices[(place or number) - 1], **options)
        self.robots.append(made)
        return made

    def close(self):
        for robot in self.robots:
            robot.close()
        self.building.close()
        self.air.close()


def in_contact(robots, patience_s=PATIENCE_S):
    """Until each hears all others; how long it took."""
    begin = time.monotonic()
    for robot in robots:
        others = [other.number for other in robots if other is not robot]
        wait_for(lambda r=robot, o=others: r.hears(*o), "%s hearing %s" % (robot.name, others), patience_s)
    return time.monotonic() - begin


def equal_sets(robots, what, patience_s=PATIENCE_S):
    """Until all hold the same; how long it took, and the hash."""
    begin = time.monotonic()

    def same():
        hashes = {robot.held().get("hash") for robot in robots}
        return hashes if len(hashes) == 1 and None not in hashes else None
    try:
        (held,) = wait_for(same, "equal sets", patience_s)
    except AssertionError:
        raise AssertionError("%s: no equal sets within %g s:\n%s" % (
            what, patience_s, "\n".join(robot.ctl("team").stdout for robot in robots))) from None
    return time.monotonic() - begin, held


class Watch(threading.Thread):
    """Looks at robots while they explore, some times a second: for how long two of them, in contact, go for one goal
    although each has heard that the other does. What it measures is at most what it was."""

    PERIOD_S = 0.25

    def __init__(self, rig):
        super().__init__(daemon=True)
        self.rig, self.ended = rig, threading.Event()
        self.since, self.longest, self.looks = {}, {}, 0

    def run(self):
        while not self.ended.wait(self.PERIOD_S):
            self.look()

    def look(self):
        now = time.monotonic()
        seen = [(robot, robot.status(), robot.team()) for robot in list(self.rig.robots)]
        self.looks += 1
        for i, (a, status_a, team_a) in enumerate(seen):
            for b, status_b, team_b in seen[:i]:
                pair = (b.name, a.name)
                places = goal_of(status_a), goal_of(status_b), claim_heard(team_a, b), claim_heard(team_b, a)
                if None in places or any(not near(places[0], place) for place in places):
                    self.since.pop(pair, None)
                    continue
                seconds = now - self.since.setdefault(pair, now)
                if seconds >= self.longest.get(pair, (0.0,))[0]:
                    self.longest[pair] = (seconds, *places)

    def end(self):
        self.ended.set()
        self.join()


def near(a, b):
    return math.hypot(a[0] - b[0], a[1] - b[1]) < SAME_GOAL_M


def goal_of(status):
    """None while it goes for none."""
    goal = status.get("goal")
    return (goal["x_m"], goal["y_m"]) if goal and status["mission"]["state"] == "under way" else None


def claim_heard(team, robot):
    """What a robot knows of a mate's goal; None out of contact: one that is out of reach counts as alive for a while."""
    for peer in team.get("peers", []):
        if peer["robot"] == robot.number and peer["heard_s_ago"] < CONTACT_S and peer["map_joined"] and peer["status"]:
            claim = peer["status"]["claim"]
            return (claim["x_m"], claim["y_m"]) if claim else None
    return None


def canonical(rig, robots):
    """Of each robot's saved session, what topobench canonical says of it."""
    files = []
    for robot in robots:
        robot.obeys("session", "save", "end")
        files.append(robot.sessions / "end.session")
    done = subprocess.run([str(rig.programs / "topobench"), "canonical", *map(str, files)], capture_output=True, text=True,
                          timeout=PATIENCE_S, check=False)
    if done.returncode != 0:
        raise AssertionError(done.stderr)
    return [{key: value for key, value in each.items() if key != "session"} for each in json.loads(done.stdout)]
