# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Robots that consist of a link and of link_end in place of a daemon, and networks of namespaces to put them into."""
import itertools
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "toolchain/lib"))
import demo_processes  # noqa: E402
import team_network  # noqa: E402

CONFIGURATION = """[robot]
model = "p3dx"
[base]
address = "tcp:localhost:1"
[scanner.front]
address = "tcp:localhost:2"
[team]
name = "{team}"
id = {number}
interface = "{interface}"
peers = {peers}
domain = {domain}
{security}socket = "{socket}"
"""
PATIENCE_S = 30.0


class Robot:
    """`inside`: the words that enter the network namespace that the link runs in."""

    serial = itertools.count()

    def __init__(self, programs, folder, number, **options):
        o = {"team": "office", "interface": "lo", "peers": ["127.0.0.1"], "domain": 0, "security": "off", "inside": (),
             "period_ms": 20, "size": 200, **options}
        self.programs, self.inside, self.number = pathlib.Path(programs), o["inside"], number
        place = pathlib.Path(folder) / ("robot%d-%d" % (number, next(self.serial)))
        place.mkdir()
        self.socket, self.config, self.log = place / "link.sock", place / "robot.toml", place / "link.log"
        security = 'security = "%s"\n' % o["security"] if o["security"] is not None else ""
        self.config.write_text(CONFIGURATION.format(
            team=o["team"], number=number, interface=o["interface"], peers=json.dumps(o["peers"]), domain=o["domain"],
            security=security, socket=self.socket))
        self.status, self.changed = {}, threading.Condition()
        self.end_command = [self.programs / "link_end", self.socket, o["team"], str(number), str(o["period_ms"]),
                            str(o["size"])]
        self.end_log = place / "end.log"
        self.link = None
        self.start_end()

    def start_end(self):
        with open(self.end_log, "a") as log:
            self.end = subprocess.Popen(self.end_command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=log,
                                        text=True)
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def close_end(self):
        self.end.kill()
        self.end.wait()
        self.reader.join()
        self.end.stdin.close()
        self.end.stdout.close()

    def restart_end(self):
        self.close_end()
        self.status = {}
        self.start_end()

    def _read(self):
        for line in self.end.stdout:
            with self.changed:
                self.status = json.loads(line)
                self.changed.notify_all()

    def next_status(self):
        """A line that came after this call, and not one that waited in the pipe."""
        for _ in range(2):
            with self.changed:
                before = self.status
                if not self.changed.wait_for(lambda: self.status is not before, PATIENCE_S):
                    raise AssertionError("no status of robot %d within %g s" % (self.number, PATIENCE_S))

    def command(self, *more):
        return [*self.inside, self.programs / "topolink", "--config", self.config, *more]

    def start(self):
        with open(self.log, "a") as log:
            self.link = subprocess.Popen(self.command(), stdout=subprocess.DEVNULL, stderr=log)
        return self

    def refused(self):
        """Exit status and words of a link that must not start."""
        done = subprocess.run(self.command(), capture_output=True, text=True, timeout=PATIENCE_S, check=False)
        return done.returncode, done.stderr

    def wait(self, what, holds, patience=PATIENCE_S):
        """Until `holds(status)`; the status, and how long it took."""
        begin = time.monotonic()
        with self.changed:
            if not self.changed.wait_for(lambda: self.status and holds(self.status), patience):
                raise AssertionError("robot %d: %s did not come within %.0f s; status %s; log:\n%s" % (
                    self.number, what, patience, self.status, self.log.read_text() if self.log.exists() else "none"))
            return self.status, time.monotonic() - begin

    def heard(self, mate):
        return self.status.get("heard", {}).get(str(mate), 0)

    def hears(self, mate, more=10, patience=PATIENCE_S):
        """Until `more` datagrams of the mate have come than now; how long it took."""
        before = self.heard(mate)
        return self.wait("hearing robot %d" % mate, lambda s: s["heard"].get(str(mate), 0) >= before + more, patience)[1]

    def next_statuses(self, count):
        """Until that many more status lines have come: the end's loop runs."""
        before = self.status.get("turns", 0)
        for _ in range(count):
            self.wait("a turn", lambda s, b=before: s["turns"] > b)
            before = self.status["turns"]

    def stop_link(self, number=signal.SIGTERM):
        """Exit status, and how long it took."""
        begin = time.monotonic()
        self.link.send_signal(number)
        status = self.link.wait(PATIENCE_S)
        return status, time.monotonic() - begin

    def close(self):
        if self.link is not None and self.link.poll() is None:
            self.link.kill()
            self.link.wait()
        self.close_end()


WHY_NOT = team_network.trouble()  # no network namespaces; empty: they can be made


class Network(team_network.Network):
    """Namespaces of robots, which are gone with it."""

    def __init__(self, robots):
        self.folder = tempfile.TemporaryDirectory(prefix="topo-network-")
        place = pathlib.Path(self.folder.name)
        try:
            super().__init__(demo_processes.Processes(place, place), robots)
        except team_network.Unavailable:
            self.folder.cleanup()
            raise

    def lose(self, robot, percent):
        """Of every hundred packets that reach the robot's radio, by chance; once."""
        self.filter(robot, "table netdev loss { chain in { type filter hook ingress device radio priority 0; "
                    "numgen random mod 100 < %d drop; }; }" % percent)

    def close(self):
        self.processes.end_all()
        self.folder.cleanup()
