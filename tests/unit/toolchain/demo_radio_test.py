# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""The demonstration's radio: what --radio may say, and what is done to the network when. demo_run_test has the network."""

import math
import pathlib
import subprocess
import sys
import types
import unittest

TOP = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(TOP / "toolchain/lib"))

import demo_air  # noqa: E402
import demo_network  # noqa: E402
import demo_radio  # noqa: E402
import demo_record  # noqa: E402
import team_network  # noqa: E402
from demo_radio import Radio, parse  # noqa: E402


class Words(unittest.TestCase):
    def test_what_it_may_say(self):
        for text, expected in (
            ("perfect", Radio()), ("loss:0.3", Radio(loss=0.3)), ("loss:0", Radio()), ("range:15", Radio(range_m=15.0)),
            ("cut:120:240", Radio(cuts=((120.0, 240.0),))), ("cut:0:1+cut:5:6.5", Radio(cuts=((0.0, 1.0), (5.0, 6.5)))),
            ("loss:0.3+cut:120:240+range:7.5", Radio(0.3, 7.5, ((120.0, 240.0),))),
        ):
            self.assertEqual(parse(text, 1200), expected, text)

    def test_what_it_may_not_say_is_named_with_what_is_right(self):
        for text, found in (
            ("", "''"), ("los:0.3", "'los:0.3'"), ("loss:1", "'loss:1'"), ("loss:0.3x", "'loss:0.3x'"), ("loss:", "'loss:'"),
            ("loss:-0.1", "'loss:-0.1'"), ("loss:nan", "'loss:nan'"), ("loss:1e-1", "'loss:1e-1'"), ("loss", "'loss'"),
            ("range:0", "'range:0'"), ("range:15:3", "'range:15:3'"), ("range:inf", "'range:inf'"), ("cut:120", "'cut:120'"),
            ("cut:5:5", "ends before it begins"), ("cut:9:5", "ends before it begins"), ("cut:1:2:3", "'cut:1:2:3'"),
            ("loss:0.3+", "''"), ("+loss:0.3", "''"), ("loss:0.3,cut:1:2", "'loss:0.3,cut:1:2'"), ("Perfect", "'Perfect'"),
            ("perfect+loss:0.3", "'perfect'"), ("loss:0.3 ", "'loss:0.3 '"), ("range:٣", "'range:٣'"),
        ):
            with self.assertRaises(ValueError, msg=text) as raised:
                parse(text, 1200)
            self.assertIn("found", str(raised.exception))
            self.assertIn(found, str(raised.exception))
            self.assertIn("expected perfect, or items joined by +", str(raised.exception))

    def test_loss_and_range_are_said_once(self):
        for text in ("loss:0.1+loss:0.2", "range:5+range:6"):
            with self.assertRaisesRegex(ValueError, "found (loss|range) 2 times, expected it once"):
                parse(text, 1200)

    def test_a_cut_ends_before_the_time_limit(self):
        with self.assertRaisesRegex(ValueError, "ends after 1300 s, expected an end before the time limit of 1200 s"):
            parse("cut:120:1300", 1200)

    def test_the_command_says_it_before_anything_is_installed_or_built(self):
        for words, expected in ((["--radio", "loss:2"], "found 'loss:2'"), (["--radio"], "takes a value"),
                                (["--radio", "cut:1:99", "--time-limit", "60"], "time limit of 60 s"),
                                (["--radio", "loss:0.1", "--robots", "1"], "a robot alone has no radio")):
            done = subprocess.run([TOP / "toolchain/demo", *words], capture_output=True, text=True, check=False, timeout=30)
            self.assertEqual((done.returncode, done.stdout), (2, ""), words)
            self.assertIn(expected, done.stderr)

    def test_loss_is_drawn_in_the_steps_that_it_is_given_in(self):
        self.assertEqual(round(demo_radio.LOSS_STEPS * parse("loss:0.305", 1200).loss), 305)


class When(unittest.TestCase):
    def test_a_cut_is_from_its_first_moment_to_its_last(self):
        radio = parse("cut:5:6+cut:10:20", 1200)
        self.assertEqual([t for t in range(25) if radio.is_cut(t)], [5, *range(10, 20)])
        self.assertFalse(radio.is_cut(demo_air.BEFORE_S))
        self.assertFalse(parse("cut:0:9", 1200).is_cut(demo_air.BEFORE_S))
        self.assertEqual((radio.last_cut_end_s(), Radio().last_cut_end_s()), (20.0, 0.0))

    def test_who_is_out_of_range(self):
        places = [(0.0, 0.0), (3.0, 4.0), (20.0, 0.0)]
        self.assertEqual(Radio(range_m=5.0).far_pairs(places), {(0, 2), (1, 2)})
        self.assertEqual(Radio(range_m=4.9).far_pairs(places), {(0, 1), (0, 2), (1, 2)})
        self.assertEqual(Radio().far_pairs(places), set())
        self.assertEqual(Radio().range_m, math.inf)


class Refusal(unittest.TestCase):
    def test_a_missing_program_is_named_with_its_package(self):
        with self.assertRaisesRegex(team_network.Unavailable, "no-such-tool is missing .package some-package."):
            team_network.tool("no-such-tool", "some-package")

    def test_it_says_what_needs_namespaces_why_there_are_none_and_what_to_do(self):
        said = demo_network.refusal("loss:0.3", "unshare: Operation not permitted")
        for part in ("--radio 'loss:0.3'", "unshare: Operation not permitted", "as root", "without --radio"):
            self.assertIn(part, said)

    def test_every_robot_has_a_mac_of_its_own(self):
        self.assertEqual(len({team_network.mac(robot) for robot in range(1, 9)}), 8)


class Told:
    """A network that keeps what was done to it."""

    def __init__(self):
        self.done = []

    def switch_all(self, on):
        self.done.append(on)

    def part(self, pairs):
        self.done.append(pairs)


class InTheAir(unittest.TestCase):
    def setUp(self):
        self.network = Told()

    def test_interfaces_go_down_for_the_cut_and_nothing_is_done_twice(self):
        air = demo_air.Air(parse("cut:5:7", 1200), self.network)
        for elapsed_s in (demo_air.BEFORE_S, 0.0, 4.9, 5.0, 6.0, 7.1, 8.0):
            air.follow(elapsed_s, [(0.0, 0.0), (1.0, 0.0)])
        self.assertEqual((self.network.done, air.gaps), ([False, True], [[5.0, 7.1]]))

    def test_robots_part_and_meet_by_their_places(self):
        air = demo_air.Air(parse("range:10", 1200), self.network)
        for elapsed_s, x in ((demo_air.BEFORE_S, 11.0), (1.0, 12.0), (2.0, 9.0), (3.0, 11.0)):
            air.follow(elapsed_s, [(0.0, 0.0), (x, 0.0)])
        far = frozenset({(0, 1)})
        self.assertEqual((self.network.done, air.gaps), ([far, frozenset(), far], [[0.0, 2.0], [3.0, None]]))

    def test_a_gap_lasts_while_one_cause_does(self):
        air = demo_air.Air(parse("range:10+cut:1:3", 1200), self.network)
        for elapsed_s, x in ((0.0, 0.0), (1.0, 0.0), (2.0, 11.0), (3.0, 11.0), (4.0, 0.0)):
            air.follow(elapsed_s, [(0.0, 0.0), (x, 0.0)])
        self.assertEqual(air.gaps, [[1.0, 4.0]])


class Remembered(unittest.TestCase):
    def setUp(self):
        self.record = demo_record.Record()

    def note(self, elapsed_s, held, lacks=(0, 0)):
        self.record.note(elapsed_s, [self.robot(*pair) for pair in zip(held, lacks)])

    @staticmethod
    def robot(held, lack):
        peers = [{"alive": lack is not None, "lacks_here": {"bytes": lack}}]
        return types.SimpleNamespace(status={"known_m2": 10.0 * len(held or "")},
                                     team={"held": {"hash": held}, "peers": peers} if held else {})

    def test_equal_is_what_all_say_after_that_time(self):
        for elapsed_s, held in ((1.0, "aa"), (2.0, "ab"), (3.0, (None, None)), (4.5, "bb"), (5.0, "bb")):
            self.note(elapsed_s, held)
        self.assertEqual([self.record.equal_after(t) for t in (0.0, 1.5, 4.5, 5.5)], [1.0, 3.0, 0.0, None])

    def test_caught_up_is_after_the_greatest_lack_and_in_reach(self):
        for elapsed_s, lacks in ((0.0, (0, 0)), (9.0, (None, None)), (10.0, (0, None)), (11.0, (0, 90e3)), (12.0, (99e3, 20e3)),
                                 (13.0, (14e3, 16e3)), (14.0, (9e3, 9e3)), (15.0, (14e3, 0))):
            self.note(elapsed_s, "ab", lacks)
        self.assertEqual(self.record.caught_up_after(9.5), 4.5)
        self.assertIsNone(self.record.caught_up_after(15.5))

    def test_never_in_reach_is_never_caught_up(self):
        self.note(1.0, "ab", (None, 0))
        self.assertIsNone(self.record.caught_up_after(0.0))

    def test_the_team_knows_what_its_best_informed_robot_knows(self):
        self.note(1.0, ("a", "bbb"))
        self.assertEqual(self.record.best_known(), [(1.0, 30.0)])

    def test_a_goal_on_the_way_back_is_home(self):
        goal = {"goal": {"x_m": 1.234, "y_m": 5.0, "place": 3}}
        self.assertEqual(demo_record.goal_of({**goal, "activity": "exploring"}), [1.23, 5.0])
        self.assertEqual(demo_record.goal_of({**goal, "activity": "returning"}), "home")
        self.assertIsNone(demo_record.goal_of({"activity": "thinking", "goal": None}))


if __name__ == "__main__":
    unittest.main()
