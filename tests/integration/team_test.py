# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Three daemons with their links as real processes, each link in a network namespace, in one simulated building.

usage: team_test.py PROGRAMS SOURCES [unittest's arguments]

Two classes, because robots are dear to start: Standing, where they need not move, and Mission, in which one exploration
goes through all that may befall a team. How long things took is printed, and asserted nowhere."""
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from link_rig import may_make_namespaces  # noqa: E402
from robot_processes import wait_for  # noqa: E402
from team_rig import Rig, Watch, canonical, equal_sets  # noqa: E402

PROGRAMS, SOURCES = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
WHY_NOT = "network namespaces are not permitted here"
CONTACT_S = 60.0  # a handshake of DDS Security that is left half done is begun anew after 15 to 25 s
HOUR_S = 3600


def tell(words):
    print("team_test: " + words, file=sys.stderr, flush=True)


def in_contact(robots):
    """Until each hears all that it can; how long it took."""
    begin = time.monotonic()
    for robot in robots:
        others = [other.number for other in robots if other is not robot]
        wait_for(lambda r=robot, o=others: r.hears(*o), "%s hearing %s" % (robot.name, others), CONTACT_S)
    return time.monotonic() - begin


@unittest.skipUnless(may_make_namespaces(), WHY_NOT)
class Standing(unittest.TestCase):
    """Robots 1 to 3 of a team, in contact; a fourth body in the building, and its radio, are for strangers."""

    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="topo-team-")
        cls.addClassCleanup(holder.cleanup)
        cls.rig = Rig(PROGRAMS, SOURCES, pathlib.Path(holder.name), robots=4, domain=61)
        cls.addClassCleanup(cls.rig.close)
        cls.robots = [cls.rig.robot(number).start() for number in (1, 2, 3)]
        for robot in cls.robots:
            robot.ready()
        tell("contact of three: %.1f s" % in_contact(cls.robots))

    def stranger(self, number, **options):
        """In the fourth body, called `number`; gone after the test."""
        made = self.rig.robot(number, place=4, **options)

        def leave():
            made.close()
            self.rig.robots.remove(made)
        self.addCleanup(leave)
        return made

    def clear(self):
        for robot in self.robots:
            robot.obeys("clear-estop")
        for robot in self.robots:
            robot.ready()

    def test_estop_all_reaches_every_wheel_and_names_whom_it_does_not(self):
        one, two, three = self.robots
        self.addCleanup(self.clear)
        before = self.rig.building.e_stops()
        done = one.obeys("estop", "--all")
        after = self.rig.building.e_stops()
        # When the command ends well, it is on the wire, and not some time later.
        self.assertEqual([b > a for a, b in zip(before, after)], [True, True, True, False], (before, after))
        self.assertEqual(done.stdout.split("\n")[:3], ["this robot obeys", "robot 2 has acknowledged", "robot 3 has acknowledged"])
        for robot in self.robots:
            self.assertTrue(robot.status()["estop"], robot.name)
        self.clear()
        two_before = self.rig.building.e_stops()
        self.rig.air.isolate(1)
        self.rig.air.isolate(3)
        self.addCleanup(lambda: in_contact(self.robots))
        self.addCleanup(self.rig.air.isolate, 1, False)
        self.addCleanup(self.rig.air.isolate, 3, False)
        for far in (1, 3):
            self.rig.air.isolate(far)
        # Robot 3 is now out of robot 1's reach, but robot 2 carries the order on: it is reached all the same.
        done = one.obeys("estop", "--all")
        self.assertIn("robot 3 has acknowledged", done.stdout)
        self.assertEqual([b > a for a, b in zip(two_before, self.rig.building.e_stops())], [True, True, True, False])
        self.clear()
        self.rig.air.isolate(2)
        before = self.rig.building.e_stops()
        done = one.ctl("estop", "--all")
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertIn("robot 2 was NOT reached: stop it by hand", done.stdout)
        self.assertIn("robot 3 was NOT reached: stop it by hand", done.stdout)
        after = self.rig.building.e_stops()
        self.assertEqual([b > a for a, b in zip(before, after)], [True, False, False, False], (before, after))
        self.rig.air.isolate(2, False)

    def test_false_credentials_are_counted_and_told(self):
        stranger = self.stranger(4, credentials=self.rig.credentials(4, authority="false"))
        stranger.start()
        one = self.robots[0]
        wait_for(lambda: one.team()["link"].get("strangers", 0) > 0, "a stranger that is counted", CONTACT_S)
        self.assertFalse(one.peer(4), "it is heard")
        self.assertEqual(stranger.team()["peers"], [], "it hears")
        for robot in (one, stranger):
            self.assertIn("credentials", robot.team()["trouble"])
            self.assertIn("credentials", robot.ctl("team").stdout)
            self.assertIn("BAD  team", robot.ctl("doctor").stdout)
        in_contact(self.robots)


@unittest.skipUnless(may_make_namespaces(), WHY_NOT)
class Mission(unittest.TestCase):
    def test_what_may_befall_a_team(self):
        holder = tempfile.TemporaryDirectory(prefix="topo-team-")
        self.addCleanup(holder.cleanup)
        self.rig = Rig(PROGRAMS, SOURCES, pathlib.Path(holder.name), robots=3, domain=62)
        self.addCleanup(self.rig.close)
        self.begin = time.monotonic()
        # For the whole mission: only robot 3 is heard by both others.
        self.rig.air.isolate(1)
        self.rig.air.isolate(2)
        self.two_explore_of_which_one_has_a_wrong_clock()
        watch = Watch(self.rig)
        watch.start()
        self.addCleanup(watch.ended.set)
        self.the_third_joins_and_is_the_bridge()
        self.a_cut_in_which_a_link_is_stopped()
        self.a_daemon_and_a_link_are_killed()
        self.all_are_stopped()
        watch.end()
        self.judge(watch)

    def tell(self, words):
        tell("%5.1f s  %s" % (time.monotonic() - self.begin, words))

    def pause(self, seconds):
        """Of exploring; what comes is the passage of time itself."""
        time.sleep(seconds)

    def equal(self, what):
        """What the robots hold once nothing new is made: all the same."""
        for robot in self.rig.robots:
            robot.ctl("pause")
        took_s, _ = equal_sets(self.rig.robots, what)
        self.tell("equal sets %s: after %.1f s; %s" % (what, took_s, self.rig.robots[0].held()))

    def resume(self):
        for robot in self.rig.robots:
            robot.ctl("resume")

    def two_explore_of_which_one_has_a_wrong_clock(self):
        one = self.rig.robot(1).start()
        two = self.rig.robot(2, shift_s=-HOUR_S).start()
        for robot in (one, two):
            robot.ready()
            robot.obeys("start")
        self.tell("two explore, out of each other's reach")
        self.pause(20)
        self.assertEqual((one.team()["peers"], two.team()["peers"]), ([], []))

    def the_third_joins_and_is_the_bridge(self):
        one, two = self.rig.robots
        three = self.rig.robot(3).start()
        three.ready()
        three.obeys("start")
        for robot, other in ((one, 3), (two, 3), (three, 1), (three, 2)):
            wait_for(lambda r=robot, o=other: r.hears(o), "%s hearing %d" % (robot.name, other), CONTACT_S)
        self.tell("the third explores too")
        self.pause(8)
        self.equal("with a robot that came later, as the only bridge")
        self.assertFalse(one.peer(2) or two.peer(1), "no bridge is needed")
        offset_s = three.peer(2)["clock_offset_s"]
        self.resume()

    def a_cut_in_which_a_link_is_stopped(self):
        three = self.rig.robots[2]
        self.rig.air.isolate(3)
        self.tell("a cut")
        before = three.team()
        three.link.send_signal(signal.SIGSTOP)
        wait_for(lambda: not three.team()["link"]["joined"], "a daemon that is alone")
        way_m = self.rig.building.truths()[2]["path_m"]
        self.assertIn("says nothing", three.team()["trouble"])
        wait_for(lambda: self.rig.building.truths()[2]["path_m"] > way_m + 0.5, "a robot that goes on")
        three.link.send_signal(signal.SIGCONT)
        wait_for(lambda: three.team()["link"]["joined"], "a link that is there again")
        self.tell("a link was stopped and goes on: %s" % three.team()["link"])
        self.assertEqual(three.team()["held"]["items"] >= before["held"]["items"], True)
        self.pause(20)
        self.rig.air.isolate(3, False)
        self.tell("the cut is over")
        self.equal("after a cut")
        self.resume()

    def a_daemon_and_a_link_are_killed(self):
        one, two, _ = self.rig.robots
        self.pause(5)
        held = one.held()
        one.daemon.kill()
        two.link.kill()
        one.daemon.wait()
        two.link.wait()
        self.tell("a daemon and a link were killed; the daemon held %s" % held)
        one.start_daemon()
        two.start_link()
        place = wait_for(lambda: (lambda p: p if p.get("standing") in ("proposed", "known") else None)(
            one.status().get("session", {}).get("place", {})), "a place, or a proposal")
        if place["standing"] == "proposed":
            one.obeys("session", "confirm")
        one.ready()
        one.obeys("start")
        self.tell("the daemon drives again (%s)" % place["standing"])
        for _ in range(15):
            st=one.status(); print("AT", st.get("pose"), st["activity"], st["reason"], st["goal"], self.rig.building.truths(), flush=True)
            time.sleep(1)
        print(one.daemon_log.read_text(), flush=True)
        return
        self.pause(15)
        self.tell("%s %s" % (one.team()["exchange"], one.status()["session"]))
        self.equal("after a daemon and a link were killed")
        self.resume()

    def all_are_stopped(self):
        self.pause(10)
        for robot in self.rig.robots:
            self.tell("%s: %s" % (robot.name, robot.status()["mission"]))
        done = self.rig.robots[0].obeys("stop", "--all")
        self.tell(done.stdout)

    def judge(self, watch):
        took_s, held = equal_sets(self.rig.robots, "at the end")
        self.tell("equal sets at the end: after %.1f s, %s" % (took_s, held))
        self.tell("longest on one goal: %s in %d looks" % (watch.longest, watch.looks))
        sessions = canonical(self.rig, self.rig.robots)
        print(sessions)
        self.tell(str(self.rig.building.truths()))


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
