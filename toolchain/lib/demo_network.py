# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Network namespaces for the links of a team: one for each robot, with a veth `radio` to a bridge in one of its own. Each
lives as long as the process that holds it, so that nothing is left behind whatever ends the demonstration.

usage: demo_network.py SPEC: exit status 2, with the reason, when what a radio does cannot be done on this machine"""

import dataclasses
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

import demo_processes
import demo_radio

PATIENCE_S = 20
# What comes in at a robot's radio: nothing from robots out of range, and of the rest a share is lost by chance.
RULES = """table netdev air {
  set far { type ether_addr; }
  chain in {
    type filter hook ingress device radio priority 0;
    ether saddr @far drop
    numgen random mod %d < %d drop
  }
}
"""


@dataclasses.dataclass(frozen=True)
class Place:
    """Where a link runs. `enter`: the words before its command."""

    interface: str
    peers: tuple
    enter: tuple


LOOPBACK = Place("lo", ("127.0.0.1",), ())


class Unavailable(demo_processes.Failure):
    """This machine has no namespaces for us, or not the programs for them."""


def tool(name, package):
    found = shutil.which(name, path="%s:/usr/sbin:/sbin" % os.environ.get("PATH", "/usr/bin:/bin"))
    if not found:
        raise Unavailable("%s is missing (package %s)" % (name, package))
    return found


def mac(robot):
    return "02:00:00:00:00:%02x" % (robot + 1)


class Network:
    """`robots`: how many; they are counted from 0."""

    def __init__(self, processes, robots, radio):
        self.processes = processes
        self.ip, self.robots = tool("ip", "iproute2"), range(robots)
        self.nft = None if radio.loss == 0.0 and not radio.has_range() else tool("nft", "nftables")
        self.air = self.first()
        self.rooms = [self.hold(self.air) for _ in self.robots]
        self.do(self.air, self.ip, "link", "add", "bridge", "type", "bridge", "mcast_snooping", "0")
        self.do(self.air, self.ip, "link", "set", "bridge", "up")
        for robot in self.robots:
            self.plug(robot)
            if self.nft:
                rules = RULES % (demo_radio.LOSS_STEPS, round(demo_radio.LOSS_STEPS * radio.loss))
                self.do(self.rooms[robot], self.nft, "-f", "-", text=rules)

    def first(self):
        """Without a user namespace where that is permitted, else in one, where everybody is root."""
        try:
            return self.hold(())
        except Unavailable:
            return self.hold((), "--user", "--map-root-user")

    def hold(self, where, *kinds):
        """A new namespace, beside the one that `where` enters; the words that enter it."""
        words = [*where, tool("unshare", "util-linux"), *kinds, "--net", "sh", "-c", "echo in; exec sleep infinity"]
        holder = self.processes.start(*words, log="network", stdout=subprocess.PIPE)
        if holder.stdout.readline() != "in\n":
            self.processes.end(holder)
            said = self.processes.end_of_log("network").strip().splitlines()
            raise Unavailable(said[-1] if said else "unshare failed")
        user = ("--user", "--preserve-credentials") if kinds or "--user" in where else ()
        return (tool("nsenter", "util-linux"), "--target", str(holder.pid), *user, "--net")

    @staticmethod
    def do(where, *words, text=None):
        done = subprocess.run([*where, *words], input=text, capture_output=True, text=True, timeout=PATIENCE_S, check=False,
                              start_new_session=True)
        if done.returncode != 0:
            raise Unavailable("%s: %s" % (" ".join(map(os.path.basename, words[:4])), done.stderr.strip() or "failed"))

    def plug(self, robot):
        room, port = self.rooms[robot], "to%d" % (robot + 1)
        self.do(self.air, self.ip, "link", "add", port, "type", "veth", "peer", "name", "radio", "address", mac(robot),
                "netns", room[2])
        self.do(self.air, self.ip, "link", "set", port, "master", "bridge", "up")
        self.do(room, self.ip, "link", "set", "lo", "up")
        self.do(room, self.ip, "addr", "add", "10.77.0.%d/24" % (robot + 1), "dev", "radio")
        self.do(room, self.ip, "link", "set", "radio", "up")

    def place(self, robot):
        return Place("radio", (), self.rooms[robot])

    def switch(self, on):
        """Every robot's radio; a link sees its interface go and come."""
        for room in self.rooms:
            self.do(room, self.ip, "link", "set", "radio", "up" if on else "down")

    def part(self, pairs):
        """The robots of these pairs hear nothing of each other; all others do."""
        for robot in self.robots:
            far = [mac(a + b - robot) for a, b in sorted(pairs) if robot in (a, b)]
            rules = "flush set netdev air far\n"
            if far:
                rules += "add element netdev air far { %s }\n" % ", ".join(far)
            self.do(self.rooms[robot], self.nft, "-f", "-", text=rules)


def refusal(text, why):
    return ("--radio '%s' needs network namespaces, and there are none here: %s. Run it as root or where users may make "
            "namespaces; without --radio the links run on the loopback" % (text, why))


def trouble(text):
    """Why what the radio does cannot be done here; empty: it can."""
    with tempfile.TemporaryDirectory(prefix="topometric-demo-") as name:
        processes = demo_processes.Processes(pathlib.Path(name), pathlib.Path(name))
        try:
            Network(processes, 1, demo_radio.parse(text, math.inf))
            return ""
        except Unavailable as why:
            return str(why)
        finally:
            processes.end_all()


def main():
    why = trouble(sys.argv[1])
    if why:
        print("demo: %s" % refusal(sys.argv[1], why), file=sys.stderr)
    return 2 if why else 0


if __name__ == "__main__":
    sys.exit(main())
