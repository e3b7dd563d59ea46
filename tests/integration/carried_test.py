#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""A robot is killed and carried to a place that looks alike: it stands and names both places until the operator says
where it is, and a wrong word is found out within the first metres.

usage: carried_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]
The robot is carried by a new simulator that starts it elsewhere; the daemon sees its wires only."""
import math
import re
import sys

from robot_processes import PATIENCE_S, RobotProcesses, main, wait_for

# Two rooms alike to the last corner, 8 m apart, and a corridor along both, whose ends differ in distance.
WORLD = """
[[start]]
x_m = %f
y_m = 7.0
[[wall]]
points_m = [[-0.1, -0.1], [16.1, -0.1], [16.1, 10.1], [-0.1, 10.1]]
closed = true
thickness_m = 0.2
[[wall]]
points_m = [[8.0, 3.0], [8.0, 10.0]]
thickness_m = 0.1
[[wall]]
points_m = [[0.0, 3.0], [2.8, 3.0]]
thickness_m = 0.1
[[wall]]
points_m = [[4.2, 3.0], [10.8, 3.0]]
thickness_m = 0.1
[[wall]]
points_m = [[12.2, 3.0], [16.0, 3.0]]
thickness_m = 0.1
[[wall]]
points_m = [[5.0, 8.0], [6.5, 8.0], [6.5, 9.0], [5.0, 9.0]]
closed = true
thickness_m = 0.1
[[wall]]
points_m = [[13.0, 8.0], [14.5, 8.0], [14.5, 9.0], [13.0, 9.0]]
closed = true
thickness_m = 0.1
"""
START, TWIN_M = (3.5, 7.0), 8.0


class Carried(RobotProcesses):
    def setUp(self):
        super().setUp()
        self.sessions = self.folder / "sessions"
        self.sessions.mkdir()
        self.simulator = None

    def put_robot(self, x_m):
        """A simulator with the robot there; the one before ends."""
        if self.simulator is not None:
            self.simulator.kill()
            self.simulator.wait()
        world = self.folder / "world.toml"
        world.write_text(WORLD % x_m)
        self.simulator, devices = self.start_simulator(world)
        self.write_config(devices, '[session]\nfolder = "%s"\njournal_period_s = 0.2\n' % self.sessions)
        self.config.write_text(self.config.read_text().replace("# keep_out_m = []", "keep_out_m = %s" % self.keep_out))

    def start_daemon(self):
        daemon = self.start("topometricd", "--config", self.config)
        wait_for(lambda: self.status().get("map", {}).get("keyframes", 0) > 0, "a daemon with a map")
        return daemon

    def must(self, *words):
        done = self.ctl(*words)
        self.assertEqual(done.returncode, 0, done)
        return done

    def place(self):
        return self.status().get("session", {}).get("place", {})

    def stands(self, standing):
        return wait_for(lambda: self.place().get("standing") == standing, "a place that is " + standing)

    def truth(self):
        return self.simulator_says("truth")["robots"][0]

    def pose_in_map(self):
        truth = self.truth()
        return truth["x_m"] - START[0], truth["y_m"] - START[1], truth["theta_rad"]

    def assert_said_everywhere(self, *words):
        texts = {"status": self.ctl("status").stdout, "health": self.ctl("health").stdout,
                 "doctor": self.ctl("doctor").stdout, "start": self.ctl("start").stderr,
                 "log": (self.folder / "topometricd.log").read_text()}
        for where, text in texts.items():
            for word in words:
                self.assertIn(word, text, where)

    def assert_does_not_move(self):
        before = self.truth()
        for refused in (self.ctl("start"), self.ctl("goto", 0, -5), self.ctl("drive", 0.3, 0)):
            self.assertEqual(refused.returncode, 1, refused)
        self.assertEqual(self.truth(), before)

    def map_the_building(self):
        self.put_robot(START[0])
        daemon = self.start_daemon()
        self.must("wait", "ready", "--timeout", PATIENCE_S)
        self.must("start")
        self.must("wait", "done", "--timeout", 400)
        status = self.status()
        self.assertGreater(status["map"]["keyframes"], 30, status)
        wait_for(lambda: self.status()["session"]["journal"]["keyframes"] >= status["map"]["keyframes"], "a journal")
        daemon.kill()
        daemon.wait()

    def test_carried_to_a_twin_room(self):
        self.keep_out = "[]"
        self.map_the_building()
        self.put_robot(START[0] + TWIN_M)
        self.start_daemon()
        self.stands("proposed")
        self.assert_said_everywhere("is a proposal", "another place looks alike", "topoctl session confirm")
        obstacle = self.status()["session"]["obstacle"]
        named = sorted(float(x) for x in re.findall(r"at x (-?[\d.]+) y", obstacle))
        self.assertEqual(len(named), 2, obstacle)
        self.assertAlmostEqual(named[0], 0.0, delta=0.15)
        self.assertAlmostEqual(named[1], TWIN_M, delta=0.15)
        self.assert_does_not_move()
        wait_for(lambda: "BAD  motion" in self.ctl("doctor").stdout, "a gate that says why the robot stands")

        # A wrong word: the scan fits there, so that only driving shows it.
        self.must("session", "confirm", "--pose", 0.0, 0.0, 0.0)
        self.must("wait", "ready", "--timeout", PATIENCE_S)
        self.stands("known")
        self.assertTrue(self.place()["on_trial"])
        self.assertIn("on trial in session journal-", self.ctl("status").stdout)
        begin_m = self.truth()["path_m"]
        self.must("goto", 2.0, -5.5)
        self.stands("dropped")
        wait_for(lambda: self.status()["twist"]["v_mps"] == 0, "a robot that stands")
        way_m = self.truth()["path_m"] - begin_m
        print("wrong place dropped after %.1f m" % way_m, file=sys.stderr)
        self.assertLess(way_m, 8.0)
        self.assert_said_everywhere("was dropped", "contradict", "topoctl session confirm --pose")
        self.assertEqual(self.status()["mission"]["state"], "failed")
        self.assert_does_not_move()
        self.assertEqual(len(list(self.sessions.glob("journal-*.session"))), 1, "the wrong map was kept")
        needs = self.ctl("session", "confirm")
        self.assertEqual(needs.returncode, 1)
        self.assertIn("expected --pose", needs.stderr)

        # The right one.
        self.must("session", "confirm", "--pose", *self.pose_in_map())
        self.stands("known")
        self.must("goto", 0.0, 0.0)
        self.must("wait", "done", "--timeout", 120)
        x_m, y_m, _ = self.pose_in_map()
        self.assertLess(math.hypot(x_m, y_m), 0.5, "home is where the first daemon began")
        wait_for(lambda: self.place()["trial"]["verdict"] == "passed", "first metres that match")
        wait_for(lambda: len(list(self.sessions.glob("journal-*.session"))) == 2, "a journal that goes on")

    def test_with_area_limits_every_place_is_a_proposal(self):
        self.keep_out = "[[[3.0, -6.9], [5.0, -6.9], [5.0, -4.1], [3.0, -4.1]]]"
        self.put_robot(START[0])
        daemon = self.start_daemon()
        self.must("wait", "ready", "--timeout", PATIENCE_S)
        self.must("drive", 0.0, 0.8, "--for", 3)
        self.must("drive", 0.3, 0.0, "--for", 2)
        wait_for(lambda: self.status()["session"]["journal"]["keyframes"] >= 5, "a journal")
        daemon.kill()
        daemon.wait()
        self.start_daemon()
        self.stands("proposed")
        self.assert_said_everywhere("is a proposal", "there are area limits")
        self.assert_does_not_move()
        self.must("session", "confirm")
        self.stands("known")
        self.must("drive", 0.0, 0.5, "--for", 1)


if __name__ == "__main__":
    main()
