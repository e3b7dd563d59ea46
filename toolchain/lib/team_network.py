# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Network namespaces for the links of a team: one for each robot, with a veth `radio` to a bridge in one of its own. Each
lives as long as the process that holds it, so that nothing is left behind whatever ends the program that laid it."""

import json
import os
import pathlib
import shutil
import subprocess
import tempfile

import demo_processes

PATIENCE_S = 20


class Unavailable(demo_processes.Failure):
    """This machine has no namespaces for us, or not the programs for them."""


def tool(name, package):
    found = shutil.which(name, path="%s:/usr/sbin:/sbin" % os.environ.get("PATH", "/usr/bin:/bin"))
    if not found:
        raise Unavailable("%s is missing (package %s)" % (name, package))
    return found


def mac(robot):
    return "02:00:00:00:00:%02x" % robot


def address(robot):
    return "10.77.0.%d" % robot


class Network:
    """`robots`: their numbers, from 1 on; each has a namespace, and no radio before plug()."""

    def __init__(self, processes, robots):
        self.processes = processes
        self.ip = tool("ip", "iproute2")
        self.air = self.first()
        self.rooms = {robot: self.hold(self.air) for robot in robots}
        self.in_air("link", "add", "bridge", "type", "bridge", "mcast_snooping", "0")
        self.in_air("link", "set", "bridge", "up")
        for robot in self.rooms:
            self.inside(robot, "link", "set", "lo", "up")

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
        """What the command says."""
        done = subprocess.run([*where, *words], input=text, capture_output=True, text=True, timeout=PATIENCE_S, check=False,
                              start_new_session=True)
        if done.returncode != 0:
            raise Unavailable("%s: %s" % (" ".join(map(os.path.basename, words[:4])), done.stderr.strip() or "failed"))
        return done.stdout

    def in_air(self, *words):
        return self.do(self.air, self.ip, *words)

    def inside(self, robot, *words):
        return self.do(self.rooms[robot], self.ip, *words)

    def filter(self, robot, rules):
        """Rules of nft for what comes in at the robot's radio."""
        self.do(self.rooms[robot], tool("nft", "nftables"), "-f", "-", text=rules)

    def plug(self, robot, at=None):
        """The robot's radio comes into being, and is switched on; `at`: its address."""
        port = "to%d" % robot
        self.in_air("link", "add", port, "type", "veth", "peer", "name", "radio", "address", mac(robot), "netns",
                    self.rooms[robot][2])
        self.in_air("link", "set", port, "master", "bridge", "up")
        self.inside(robot, "addr", "add", (at or address(robot)) + "/24", "dev", "radio")
        self.inside(robot, "link", "set", "radio", "up")

    def unplug(self, robot):
        self.inside(robot, "link", "del", "radio")

    def switch(self, robot, on):
        """The robot's radio; its link sees the interface go and come."""
        self.inside(robot, "link", "set", "radio", "up" if on else "down")

    def isolate(self, robot, on=True):
        """Isolated robots hear only those that are not."""
        self.in_air("link", "set", "to%d" % robot, "type", "bridge_slave", "isolated", "on" if on else "off")

    def packets(self, robot):
        """Sent over the robot's radio."""
        said = self.inside(robot, "-s", "-j", "link", "show", "radio")
        return json.loads(said)[0]["stats64"]["tx"]["packets"]


def trouble(lay=lambda processes: Network(processes, [1])):
    """Why no network can be laid here; empty: it can. `lay`: lays the one that is needed."""
    with tempfile.TemporaryDirectory(prefix="topometric-network-") as name:
        processes = demo_processes.Processes(pathlib.Path(name), pathlib.Path(name))
        try:
            lay(processes)
            return ""
        except Unavailable as why:
            return str(why)
        finally:
            processes.end_all()
