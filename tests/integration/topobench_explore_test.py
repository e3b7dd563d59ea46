#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""topobench explore as a user runs it: a small building is explored at both fidelities and with both strategies, the
robot comes home, the report has the agreed keys, and the same arguments give the same report.

usage: topobench_explore_test.py TOPOBENCH [unittest options]"""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOPOBENCH = ""

# A corridor with two rooms to the north and a recess, 12 x 7 m.
WORLD = """
name = "three rooms"
[[start]]
x_m = 1.2
y_m = 1.0
[[wall]]
points_m = [[0.0, 0.0], [12.0, 0.0], [12.0, 7.0], [0.0, 7.0]]
closed = true
thickness_m = 0.2
clutter = [{ side = "left", fraction = 0.3, seed = 1, margin_m = 1.0, depth_m = [0.2, 0.3] }]
[[wall]]
points_m = [[0.0, 2.0], [12.0, 2.0]]
thickness_m = 0.15
openings = [{ at_m = 3.0, width_m = 1.2 }, { at_m = 9.0, width_m = 1.2 }]
alcoves = [{ at_m = 6.0, width_m = 0.9, depth_m = 0.3, side = "left" }]
[[wall]]
points_m = [[6.0, 2.0], [6.0, 7.0]]
thickness_m = 0.15
"""

# REPORTS "topobench explore", but for `overlap`, which one robot has none of.
KEYS = {"world": str, "strategy": str, "robots": int, "seed": int, "fidelity": str, "finish": str, "radio": str,
        "reachable_m2": float, "t50_s": (float, int, None), "t90_s": (float, int, None), "t95_s": (float, int, None),
        "t99_s": (float, int, None), "t_home_s": (float, int, None), "limit_s": (float, int), "distance_m": list,
        "goals_issued": int, "clusters_sum": int, "goals_sum": int, "decision_ms": dict, "collisions": int, "home": list,
        "speedup_over_real_time": float, "coverage": list}
TIMES = ("decision_ms", "planning_ms", "wall_s", "cpu_s", "speedup_over_real_time", "speedup_by_cpu_time")


def is_of(value, kinds):
    kinds = kinds if isinstance(kinds, tuple) else (kinds,)
    return any(value is None if kind is None else isinstance(value, kind) for kind in kinds)


class Explore(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "rooms.toml").write_text(WORLD)

    def start(self, *arguments):
        return subprocess.run([TOPOBENCH, "explore", "--world", str(self.folder / "rooms.toml"), "--json",
                               *map(str, arguments)], capture_output=True, text=True, check=False)

    def explore(self, *arguments):
        done = self.start(*arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("\n"), 1, "one object on one line, nothing else")
        return json.loads(done.stdout)

    def check_success(self, found):
        why = json.dumps({key: value for key, value in found.items() if key != "coverage"})
        self.assertGreaterEqual(found["coverage"][-1][1], 0.95, why)
        self.assertEqual(found["home"], [True], why)
        self.assertIsNotNone(found["t_home_s"], why)
        self.assertEqual(found["collisions"], 0, why)
        self.assertGreater(found["goals_issued"], 0, why)
        self.assertLess(found["t50_s"], found["t95_s"] + 1e-9, why)

    def test_keys_and_files(self):
        out = self.folder / "out"
        found = self.explore("--fidelity", "plan", "--limit", 12, "--out", out)
        for key, kinds in KEYS.items():
            self.assertIn(key, found)
            self.assertTrue(is_of(found[key], kinds), (key, found[key]))
        self.assertEqual(set(found["decision_ms"]), {"mean", "p99", "max"})
        self.assertEqual([t for t, _ in found["coverage"]], [float(t) for t in range(1, 13)])
        self.assertTrue(all(0.0 <= share <= 1.0 for _, share in found["coverage"]))
        self.assertEqual((found["robots"], found["seed"], found["limit_s"]), (1, 1, 12.0))
        self.assertIsNone(found["t_home_s"], "a run that was cut off came not home")
        for name in ("explore.png", "coverage.png"):
            self.assertTrue((out / name).read_bytes().startswith(b"\x89PNG"), name)
        self.assertTrue((out / "map.pgm").read_bytes().startswith(b"P5"))
        self.assertIn("taken", (out / "decisions.txt").read_text())
        self.assertEqual(len((out / "poses.tsv").read_text().splitlines()), 1 + 12)

    def test_both_strategies_explore_and_come_home(self):
        for strategy in ("topometric", "nearest_frontier"):
            with self.subTest(strategy):
                found = self.explore("--fidelity", "plan", "--strategy", strategy, "--limit", 600)
                self.assertEqual(found["strategy"], strategy)
                self.check_success(found)

    def test_says_where_the_time_went(self):
        for robots in (1, 2):
            with self.subTest(robots):
                found = self.explore("--fidelity", "plan", "--robots", robots, "--limit", 600, "--bound")
                self.assertEqual(set(found["time_s"]), {"full_speed", "slower", "turning", "standing", "waiting"})
                time_s = sum(found["time_s"].values())
                self.assertLessEqual(time_s, robots * found["end_s"] + 0.2)
                self.assertGreater(time_s, 0.8 * found["end_s"], "until each is home")
                driven_m = sum(found["distance_m"])
                lost_s = sum(found["lost_s"].values())
                self.assertAlmostEqual(time_s - lost_s, driven_m / found["permitted_mps"], delta=0.05 * time_s)
                self.assertLessEqual(found["way_m"]["0.9"], found["way_m"]["0.99"])
                self.assertLessEqual(found["way_m"]["0.99"], max(found["distance_m"]))
                self.assertTrue(0.0 <= found["goals_left_for_another"] <= 1.0)
                self.assertAlmostEqual(found["last_share_of_time"], 1.0 - found["t90_s"] / found["t99_s"], delta=1e-3)
                self.assertGreaterEqual(found["corridors_crossed"]["squares"], found["corridors_crossed"]["over_twice"])
                self.assertGreater(found["bound_m"], 0.0)
                self.assertAlmostEqual(found["way_over_bound"], found["way_m"]["0.99"] / found["bound_m"])

    def test_full_fidelity_explores_and_comes_home(self):
        found = self.explore("--fidelity", "full", "--limit", 600)
        self.check_success(found)
        self.assertLess(found["ate_rmse_m"], 0.15)

    def test_the_same_arguments_give_the_same_report(self):
        for fidelity, limit in (("plan", 40), ("full", 15)):
            with self.subTest(fidelity):
                reports = [self.explore("--fidelity", fidelity, "--limit", limit, "--seed", 3) for _ in range(2)]
                for report in reports:
                    for key in TIMES:
                        report.pop(key)
                self.assertEqual(reports[0], reports[1])

    def test_another_seed_is_another_run(self):
        runs = [self.explore("--fidelity", "plan", "--limit", 20, "--seed", seed)["distance_m"] for seed in (1, 2)]
        self.assertNotEqual(runs[0], runs[1])

    def refused(self, *arguments_and_words, words):
        done = self.start(*arguments_and_words)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertEqual(done.stdout, "")
        for word in words:
            self.assertIn(word, done.stderr)

    def explore_together(self, *arguments):
        return self.explore("--fidelity", "plan", "--robots", 2, *arguments)

    def test_two_robots_explore_and_come_home_by_every_strategy(self):
        for strategy in ("topometric", "nearest_frontier", "greedy_frontier", "utility_frontier", "min_pos"):
            with self.subTest(strategy):
                found = self.explore_together("--strategy", strategy, "--limit", 600)
                self.assertEqual((found["strategy"], found["robots"], found["radio"]), (strategy, 2, "perfect"))
                self.assertEqual(found["home"], [True, True], found["reason"])
                self.assertGreaterEqual(found["coverage"][-1][1], 0.95)
                self.assertEqual(found["collisions"], 0)
                self.assertIsNotNone(found["t_home_s"])
                self.assertEqual(len(found["distance_m"]), 2)
                self.assertTrue(0.0 <= found["overlap"] <= 1.0)

    def test_two_robots_at_full_fidelity_join_what_they_see(self):
        found = self.explore("--fidelity", "full", "--robots", 2, "--radio", "loss:0.3", "--limit", 600)
        self.assertEqual(found["home"], [True, True], found["reason"])
        self.assertEqual(found["collisions"], 0)
        self.assertEqual(len(found["maps"]), 2)
        for joined in found["maps"]:
            self.assertGreater(joined["mates_keyframes"], 10, joined)
            self.assertLess(joined["joined_s"], 10.0, joined)
            self.assertLess(joined["rmse_m"], 0.06, joined)
            self.assertLess(joined["mates_rmse_m"], 0.08, joined)

    def test_a_bad_radio_costs_time_and_not_the_building(self):
        # Who hears nothing cannot be asked to make room: where it stands for good another has to get by.
        (self.folder / "rooms.toml").write_text(WORLD.replace(", 2.0]", ", 2.8]"))
        # Without a radio and with seed 1 a mate stood on the way home of the other, and stayed in its map.
        for radio, seed in (("loss:0.5", 1), ("range:5", 1), ("none", 1), ("none", 2), ("none", 3)):
            with self.subTest(radio, seed=seed):
                found = self.explore_together("--radio", radio, "--limit", 600, "--seed", seed)
                self.assertEqual(found["radio"], radio)
                self.assertEqual(found["home"], [True, True], found["reason"])
                self.assertGreaterEqual(found["coverage"][-1][1], 0.95)
                self.assertEqual(found["collisions"], 0)

    def test_a_team_gives_the_same_report_again_and_writes_its_files(self):
        out = self.folder / "out"
        reports = [self.explore_together("--limit", 30, "--radio", "loss:0.3", "--out", out) for _ in range(2)]
        for report in reports:
            for key, kinds in KEYS.items():
                self.assertTrue(is_of(report[key], kinds), (key, report[key]))
            for key in TIMES:
                report.pop(key)
        self.assertEqual(reports[0], reports[1])
        for robot in (0, 1):
            self.assertEqual(len((out / f"poses-{robot}.tsv").read_text().splitlines()), 1 + 30)
            self.assertTrue((out / f"decisions-{robot}.txt").exists())
        self.assertTrue((out / "explore.png").read_bytes().startswith(b"\x89PNG"))

    def test_a_team_that_cannot_be_is_refused(self):
        self.refused("--robots", 0, words=("--robots", "found 0", "expected 1 to 8"))
        self.refused("--robots", 2, "--fidelity", "plan", "--starts", "unknown",
                     words=("--starts", "fidelity plan", "expected fidelity full"))
        for radio in ("range:0", "loss:1", "loss:x", "carrier pigeon"):
            self.refused("--robots", 2, "--fidelity", "plan", "--radio", radio, words=("--radio", radio, "range:M"))

    def test_an_unknown_strategy_is_refused(self):
        self.refused("--strategy", "random_walk", words=("--strategy", "random_walk"))

    def test_a_start_in_a_wall_is_refused(self):
        self.refused("--start", "6.0,4.0,0.0", words=("start",))

    def test_a_missing_world_is_the_users_fault(self):
        (self.folder / "rooms.toml").unlink()
        self.refused(words=("rooms.toml",))


if __name__ == "__main__":
    TOPOBENCH = sys.argv.pop(1)
    unittest.main(verbosity=2)
