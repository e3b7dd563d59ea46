#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""A mission of two real daemons with a link between them is shown again, as one of them knew it: the joined map, the mate,
what it meant to do, orders, and where it was last when it was lost.

usage: team_replay_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]; exit status 77: skipped, no network namespaces here"""
import json
import pathlib
import shutil
import signal
import sys
import tempfile
import unittest

from link_rig import WHY_NOT
from page_client import Page
from robot_processes import wait_for
from team_rig import Rig, equal_sets, in_contact
from view_rig import free_port
from view_test import saved_cells

PROGRAMS = SOURCES = None
LIVE_S = 1.4  # of the page: a mate that was heard longer ago is grey


def lines_of(robot):
    """The whole lines of its mission log: the daemon may be writing the next."""
    text = "".join(log.read_text() for log in robot.sessions.glob("log-*.jsonl"))
    return [json.loads(line) for line in text[:text.rfind("\n") + 1].splitlines()]


def mate_in(state):
    return (state.get("team") or [{}])[0]


def close_to(a, b):
    return max(abs(a[name] - b[name]) for name in ("x_m", "y_m")) < 0.001


class TeamReplay(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="topo-team-replay-")
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        rig = Rig(PROGRAMS, SOURCES, cls.folder, robots=2, domain=63)
        cls.addClassCleanup(rig.close)
        cls.one, cls.two = robots = [rig.robot(number).start() for number in (1, 2)]
        for robot in robots:
            robot.ready()
        in_contact(robots)
        for robot in robots:
            robot.obeys("start")
        wait_for(lambda: len((cls.one.look("map.trails").get("mates") or [[]])[0]) > 2
                 and any((mate_in(line).get("here") or {}).get("claim") for line in lines_of(cls.one)), "a mate's way and goal")
        cls.one.obeys("stop", "--all")
        equal_sets(robots, "after the stop")
        wait_for(lambda: cls.one.status()["twist"] == {"v_mps": 0.0, "omega_radps": 0.0}, "a robot that stands")
        cls.two.kill(cls.two.link)
        cls.saved = {}  # folders by revision of the map
        wait_for(cls.is_saved_as_it_ends, "a log with a mate that was lost, and the map that was saved")
        cls.one.daemon.send_signal(signal.SIGTERM)
        if cls.one.daemon.wait(30) != 0:
            raise AssertionError("the daemon did not end in order: " + cls.one.daemon_log.read_text()[-2000:])
        cls.log = lines_of(cls.one)
        cls.begin_s = min(line["t_s"] for line in cls.log)

    @classmethod
    def is_saved_as_it_ends(cls):
        """True when the log has the mate lost with a map that is saved. A relation may be found after the robots stand: then
        the map is saved again."""
        if not any(mate_in(line).get("alive") is False for line in lines_of(cls.one)):
            return False
        revision = cls.one.status()["map"]["revision"]
        if revision not in cls.saved:
            folder = cls.folder / ("saved-%d" % revision)
            cls.one.obeys("map", "save", folder)
            if cls.one.status()["map"]["revision"] == revision:
                cls.saved[revision] = folder
        newest = lines_of(cls.one)[-1]
        return mate_in(newest).get("alive") is False and newest.get("map", {}).get("revision") in cls.saved

    def show(self, sessions):
        port, log = free_port(), self.folder / "topoview.log"
        view = self.one.spawn(log, PROGRAMS / "topoview", "--config", self.one.config, "--port", port, "--replay", sessions)
        self.addCleanup(self.one.kill, view)
        wait_for(lambda: "port %d" % port in log.read_text(), "a page")
        page = Page(port)
        self.addCleanup(page.close)
        page.receive_until(lambda: page.known.get("replay") and page.known.get("past"))
        return page

    def seek(self, page, position_s):
        answer = page.act("replay", position_s=position_s, playing=False)
        self.assertTrue(answer["ok"], answer)

    def test_the_team_is_shown_as_its_robot_knew_it(self):
        page = self.show(self.one.sessions)
        heard = [line for line in self.log if line["kind"] == "state" and mate_in(line).get("alive") and mate_in(line).get("here")]
        middle = heard[len(heard) // 2]
        at_s = middle["t_s"] - self.begin_s
        self.seek(page, at_s)
        here = mate_in(middle)["here"]
        page.receive_until(lambda: (page.known["team"].get("peers") or [{}])[0].get("here")
                           and close_to(page.known["team"]["peers"][0]["here"]["pose"], here["pose"]))
        early = len(page.cells())
        # Between two states a mate that is heard is not grey.
        for share in (0.3, 0.6, 0.9):
            self.seek(page, at_s + share)
            before = page.known["team"]
            page.receive_until(lambda b=before: page.known["team"] is not b)
            self.assertLess(page.known["team"]["peers"][0]["heard_s_ago"], LIVE_S)
        # At its end: the joined map, the mate's way, and where it was when it was lost.
        length_s = page.known["replay"]["length_s"]
        self.seek(page, length_s)
        last = mate_in([line for line in self.log if line["kind"] == "state"][-1])
        page.receive_until(lambda: page.known["team"]["peers"][0]["alive"] is False)
        mate = page.known["team"]["peers"][0]
        self.assertTrue(close_to(mate["here"]["pose"], last["here"]["pose"]))
        self.assertAlmostEqual(mate["heard_s_ago"], last["heard_s_ago"], delta=0.01)
        wanted = saved_cells(self.saved[max(self.saved)])
        page.receive_until(lambda: page.cells() == wanted)
        self.assertLess(early, len(wanted))
        page.receive_until(lambda: page.known["trails"]["mates"] and len(page.known["trails"]["mates"][0]) > 2)
        page.receive_until(lambda: "out of reach" in [event.get("what") for event in page.known["past"]["events"]])
        told = page.known["past"]["events"]
        for what in ("in reach", "goes for"):
            self.assertIn((2, what), [(event.get("robot"), event.get("what")) for event in told])
        self.assertIn([2], [event["acknowledged"] for event in told if event["event"] == "team_word"])

    def test_without_a_log_the_mate_is_where_its_keyframes_are(self):
        bare = self.folder / "bare"
        shutil.copytree(self.one.sessions, bare, ignore=shutil.ignore_patterns("log-*"))
        page = self.show(bare)
        self.seek(page, page.known["replay"]["length_s"])
        page.receive_until(lambda: page.known["team"].get("peers") and page.known["trails"]["mates"])
        mate = page.known["team"]["peers"][0]
        self.assertEqual((mate["robot"], mate["alive"], mate["by_map"]), (2, False, True))
        place = mate["here"]["pose"]
        x, y = page.known["trails"]["mates"][0][-1]
        self.assertLess(max(abs(place["x_m"] - x), abs(place["y_m"] - y)), 0.01)


if __name__ == "__main__":
    PROGRAMS, SOURCES = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
    if WHY_NOT:
        print("skipped: %s" % WHY_NOT)
        sys.exit(77)
    unittest.main(verbosity=2)
