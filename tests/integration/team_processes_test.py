# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Three daemons with their links as real processes, each link in a network namespace, in one simulated building.

usage: team_processes_test.py PROGRAMS SOURCES [unittest's arguments]

Two classes, because robots are dear to start: Standing, where they need not move, and Mission, in which one exploration
goes through all that may befall a team. How long things took is printed, and asserted nowhere."""
import itertools
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from link_rig import WHY_NOT  # noqa: E402
from robot_processes import wait_for  # noqa: E402
from team_rig import Rig, Watch, canonical, equal_sets, in_contact  # noqa: E402

PROGRAMS, SOURCES = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
CONTACT_S = 60.0  # a handshake of DDS Security that is left half done is begun anew after 15 to 25 s
HOUR_S = 3600
ONE_GOAL_S = 1.0
CORRIDOR_ENDS_M = ((3.0, 4.5), (17.0, 4.5))  # of trio.toml


def tell(words):
    print("team: " + words, file=sys.stderr, flush=True)


@unittest.skipIf(WHY_NOT, "no network namespaces here: %s" % WHY_NOT)
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

    def assert_e_stops(self, at_places, before):
        after = self.rig.building.e_stops()
        self.assertEqual([place for place, (b, a) in enumerate(zip(before, after), 1) if a > b], at_places, (before, after))

    def test_estop_all_reaches_every_wheel_and_names_whom_it_does_not(self):
        one = self.robots[0]
        self.addCleanup(in_contact, self.robots)
        self.addCleanup(self.clear)
        for place in (1, 2, 3):
            self.addCleanup(self.rig.air.isolate, place, False)
        before = self.rig.building.e_stops()
        said = one.obeys("estop", "--all").stdout
        # When the command ends well, it is on the wires, and not some time later.
        self.assert_e_stops([1, 2, 3], before)
        self.assertEqual(said.split("\n")[:3], ["this robot obeys", "robot 2 has acknowledged", "robot 3 has acknowledged"])
        self.assertEqual([robot.status()["estop"] for robot in self.robots], [True] * 3)
        self.clear()
        # Robot 3 is out of robot 1's reach: robot 2 carries the order on.
        for place in (1, 3):
            self.rig.air.isolate(place)
        before = self.rig.building.e_stops()
        self.assertIn("robot 3 has acknowledged", one.obeys("estop", "--all").stdout)
        self.assert_e_stops([1, 2, 3], before)
        self.clear()
        self.rig.air.isolate(2)
        before = self.rig.building.e_stops()
        done = one.ctl("estop", "--all")
        self.assertEqual(done.returncode, 1, done.stdout)
        for number in (2, 3):
            self.assertIn("robot %d was NOT reached: stop it by hand" % number, done.stdout)
        self.assert_e_stops([1], before)
        # An order is repeated for a minute: a robot that comes into reach by then stops too.
        self.rig.air.isolate(2, False)
        wait_for(lambda: all(robot.status()["estop"] for robot in self.robots), "the order, late", CONTACT_S)

    def test_false_credentials_are_counted_and_told(self):
        stranger = self.stranger(5, name="false", credentials=self.rig.credentials(5, authority="false-authority")).start()
        everybody = [*self.robots, stranger]

        def refusals():
            return [robot.team()["link"].get("dropped", {}).get("not trusted", 0) for robot in everybody]
        # Of two, one judges the other's certificate first: which one, is drawn at their start.
        wait_for(lambda: sum(refusals()) >= 3, "refused handshakes", CONTACT_S)
        in_contact(self.robots)
        for robot, refused in zip(everybody, refusals()):
            if refused > 0:
                self.assertIn("handshakes were refused", robot.ctl("team").stdout)
                self.assertRegex(robot.ctl("doctor").stdout, r"warn team .*\n.*handshakes were refused")
        self.assertEqual([peer["robot"] for robot in self.robots for peer in robot.team()["peers"] if peer["robot"] == 5], [])
        self.assertEqual(stranger.team()["peers"], [])
        self.assertLessEqual(stranger.held()["items"], 1, "it was given something")

    def test_one_number_twice_is_refused_by_both_and_by_all_who_hear_them(self):
        two, three = self.robots[1:]
        twin = self.stranger(2, name="twin").start()
        for robot in (two, twin):
            wait_for(lambda r=robot: "which is this robot's" in r.team()["trouble"], "%s that knows it" % robot.name, CONTACT_S)
            robot.obeys("clear-estop")  # an order of the last minute reaches a robot that comes later too
            wait_for(lambda r=robot: "two robots have the number 2" in r.ctl("start").stderr, "a refusal to start")
        for robot in (two, twin, three):
            self.assertIn("two robots have the number 2", wait_for(lambda r=robot: r.team()["trouble"], "trouble", CONTACT_S))
            self.assertIn("BAD  team", robot.ctl("doctor").stdout)
            self.assertIn("two robots have the number 2", robot.ctl("team").stdout)
        before = three.team()["exchange"]["dropped"]["duplicate_ids"]
        wait_for(lambda: three.team()["exchange"]["dropped"]["duplicate_ids"] > before, "datagrams that are refused")
        twin.close()
        for robot in self.robots:
            wait_for(lambda r=robot: r.team()["trouble"] == "", "%s without trouble" % robot.name)
        equal_sets(self.robots, "after one number twice")

    def test_noise_inside_the_team_changes_nothing(self):
        """Valid credentials, a valid session, and a program that has gone mad."""
        stranger = self.stranger(4, name="mad")
        noise = subprocess.Popen([str(word) for word in (PROGRAMS / "link_end", stranger.folder / "link.sock", "trio", 4, 5, 1200, 7)],
                                 stdin=subprocess.PIPE, stdout=subprocess.DEVNULL)
        self.addCleanup(noise.stdin.close)  # cleaned up in the opposite order
        self.addCleanup(noise.wait)
        self.addCleanup(noise.kill)
        stranger.start_link()
        for robot in self.robots:
            wait_for(lambda r=robot: r.team()["exchange"]["dropped"]["malformed"] > 300, "noise that is counted", CONTACT_S)
        self.addCleanup(self.clear)
        before = self.rig.building.e_stops()
        self.assertIn("robot 3 has acknowledged", self.robots[0].ctl("estop", "--all").stdout, "an order in noise")
        self.assert_e_stops([1, 2, 3], before)
        noise.kill()
        took_s, _ = equal_sets(self.robots, "after noise")
        tell("equal sets after noise: %.1f s; dropped: %s" % (took_s, self.robots[0].team()["exchange"]["dropped"]))
        for robot in self.robots:
            self.assertIsNone(robot.daemon.poll())
            self.assertIsNone(robot.link.poll())


@unittest.skipIf(WHY_NOT, "no network namespaces here: %s" % WHY_NOT)
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
        watch = Watch(self.rig)
        self.addCleanup(watch.ended.set)
        try:
            self.two_explore_of_which_one_has_a_wrong_clock()
            watch.start()
            self.the_third_joins_and_is_the_bridge()
            self.a_cut_in_which_a_link_is_stopped()
            self.a_daemon_and_a_link_are_killed()
            self.all_are_stopped()
            watch.end()
            self.judge(watch)
        except AssertionError:
            self.tell("what they say:\n" + "\n".join(map(str, [*map(self.summary, self.rig.robots), self.rig.building.truths()])))
            raise

    @staticmethod
    def summary(robot):
        status = robot.status()
        return robot.name, {key: status.get(key) for key in ("state", "activity", "reason", "goal", "mission", "pose", "session")}, \
            robot.ctl("team").stdout, robot.daemon_log.read_text()[-3000:]

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

    @staticmethod
    def is_under_way(robot):
        return robot.status()["mission"]["state"] == "under way"

    def drive(self, robot, until, what):
        """By orders, up and down the corridor: whether there is anything left to explore then is not known."""
        ends = itertools.cycle(CORRIDOR_ENDS_M)

        def driven():
            if not self.is_under_way(robot):
                robot.ctl("goto", *next(ends))
            return until()
        wait_for(driven, what)

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
        self.assertIsNotNone(wait_for(lambda: three.peer(2).get("round_trip_s"), "a round trip"))
        with open("/proc/%d/environ" % two.daemon.pid, "rb") as environment:
            self.assertIn(b"CLOCK_SHIFT_S=-3600", environment.read(), "its clock is right: nothing is tried")
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
        self.drive(three, lambda: self.rig.building.truths()[2]["path_m"] > way_m + 0.5, "a robot that goes on")
        three.link.send_signal(signal.SIGCONT)
        wait_for(lambda: three.team()["link"]["joined"], "a link that is there again")
        not_sent = three.team()["link"]["not_sent"]
        self.tell("a link was stopped and goes on; not sent: %s" % not_sent)
        self.assertGreater(not_sent["alone"] + not_sent["full"], before["link"]["not_sent"]["alone"], "nothing was left out")
        self.pause(8)
        self.rig.air.isolate(3, False)
        self.tell("the cut is over")
        self.equal("after a cut")
        self.resume()

    def a_daemon_and_a_link_are_killed(self):
        one, two, three = self.rig.robots
        self.pause(5)
        self.kept = one.status()["session"]["journal"]["keyframes"]
        one.daemon.kill()
        two.link.kill()
        one.daemon.wait()
        two.link.wait()
        self.tell("a daemon and a link are killed")
        one.start_daemon()
        two.start_link()
        place = wait_for(lambda: (lambda p: p if p.get("standing") in ("proposed", "known") else None)(
            one.status().get("session", {}).get("place", {})), "a place, or a proposal")
        if place["standing"] == "proposed":
            one.obeys("session", "confirm")
        one.ready()
        for robot, other in ((one, 3), (two, 3), (three, 1), (three, 2)):
            wait_for(lambda r=robot, o=other: r.hears(o), "%s hearing %d again" % (robot.name, other), CONTACT_S)
        wait_for(lambda: one.held()["bytes"] > 0.9 * three.held()["bytes"], "what it held before")
        fetched = one.team()["exchange"]["received_bytes"]
        self.tell("the daemon is back (%s): %d bytes received, %d held" % (place["standing"], fetched, one.held()["bytes"]))
        self.assertLess(fetched, 0.3 * one.held()["bytes"], "it fetched again what its journal has")
        self.drive(one, lambda: not one.status()["session"]["place"]["on_trial"], "first metres that match")
        one.ctl("stop")
        one.obeys("start")
        self.assertEqual(one.status()["session"]["obstacle"], "")
        self.equal("after a daemon and a link were killed")
        self.resume()

    def all_are_stopped(self):
        self.pause(5)
        self.drive(self.rig.robots[0], lambda: self.is_under_way(self.rig.robots[0]), "a robot under way")
        under_way = [robot.number for robot in self.rig.robots if self.is_under_way(robot)]
        done = self.rig.robots[0].obeys("stop", "--all")
        self.assertEqual(done.stdout.split("\n")[:3], ["this robot obeys", "robot 2 has acknowledged", "robot 3 has acknowledged"])
        states = {robot.number: robot.status()["mission"]["state"] for robot in self.rig.robots}
        self.assertEqual([states[number] for number in under_way], ["stopped"] * len(under_way))
        self.assertIn(1, under_way, "nobody was stopped")

    def judge(self, watch):
        robots = self.rig.robots
        took_s, held = equal_sets(robots, "at the end")
        self.tell("equal sets at the end: after %.1f s, %s" % (took_s, held))

        def agreed():
            """What is held by all is in all maps a moment later."""
            first, *others = canonical(self.rig, robots)
            return first if all(other == first for other in others) else None
        first = wait_for(agreed, "equal keyframes, relations and canonical maps")
        self.tell("%d keyframes in %d map, %d relations" % (sum(first["origins"].values()), len(first["maps"]), first["relations_count"]))
        self.assertEqual(len(first["maps"]), 1, "robots whose maps are not joined")
        self.assertGreaterEqual(sum(first["origins"].values()), self.kept, "keyframes are lost")
        self.tell("on one goal, at most: %s; %d looks" % (watch.longest, watch.looks))
        self.assertGreater(watch.looks, 50)
        for pair, (seconds, *goals) in watch.longest.items():
            self.assertLessEqual(seconds, ONE_GOAL_S, (pair, goals))
        truths = self.rig.building.truths()
        self.assertEqual([truth["collisions"] for truth in truths], [0, 0, 0])
        self.assertGreater(min(truth["path_m"] for truth in truths), 3.0, "all drove")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
