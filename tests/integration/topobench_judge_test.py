#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""topobench judge on a map and a path made by hand, whose coverage and errors are known by arithmetic.

usage: topobench_judge_test.py TOPOBENCH [unittest options]"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOPOBENCH = ""
START = (2.0, 3.0, math.pi / 2)  # the map's origin in the building

WORLD = """
[[start]]
x_m = 2.0
y_m = 3.0
theta_rad = 1.5707963267948966
[[wall]]
points_m = [[0.0, 0.0], [8.0, 0.0], [8.0, 6.0], [0.0, 6.0]]
closed = true
thickness_m = 0.2
"""


LEFT, LOW, WIDTH, HEIGHT = -3.5, -7.0, 140, 180  # of the map's picture, metres and cells


def to_map(x, y, turn=0.0):
    """From the building into the map, which is turned a quarter, and by `turn` more as its own error."""
    x, y = y - START[1], -(x - START[0])
    return x * math.cos(turn) - y * math.sin(turn), x * math.sin(turn) + y * math.cos(turn)


class Judge(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "room.toml").write_text(WORLD)
        self.write_map(known_to_m=4.0)
        self.write_truth([(100.0 + 0.1 * i, 2.0 + 0.02 * i, 3.0, 0.0) for i in range(101)])

    def write_map(self, known_to_m, turn=0.0):
        """Free where the building's x is below known_to_m, in cells of 0.05 m: 0 is free and 205 unknown."""
        rows = []
        for row in range(HEIGHT):  # the uppermost first
            y = LOW + (HEIGHT - row - 0.5) * 0.05
            x_building = START[0] - y
            rows.append(bytes([254 if 0.1 < x_building < known_to_m else 205]) * WIDTH)
        (self.folder / "map.pgm").write_bytes(b"P5\n%d %d\n255\n" % (WIDTH, HEIGHT) + b"".join(rows))
        left, low = to_map(START[0] - LOW, START[1] + LEFT, turn)
        (self.folder / "map.yaml").write_text(
            "image: map.pgm\nresolution: 0.05\norigin: [%r, %r, %r]\nnegate: 0\n"
            "occupied_thresh: 0.65\nfree_thresh: 0.196\n" % (left, low, turn))

    def write_truth(self, poses):
        lines = ["# difficulty", "# t_s x_m y_m theta_rad"] + ["%.6f\t%.5f\t%.5f\t%.6f" % p for p in poses]
        (self.folder / "truth.tsv").write_text("\n".join(lines) + "\n")

    def write_trajectory(self, poses):
        (self.folder / "trajectory.txt").write_text("".join("%.6f %.6f %.6f %.6f\n" % p for p in poses))

    def run_judge(self, *more):
        return subprocess.run([TOPOBENCH, "judge", "--world", str(self.folder / "room.toml"), "--map",
                               str(self.folder / "map.yaml"), "--truth", str(self.folder / "truth.tsv"), "--start",
                               ",".join("%r" % v for v in START), "--json", *more],
                              capture_output=True, text=True, check=False)

    def judge(self, *more):
        done = self.run_judge(*more)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("\n"), 1, "one object on one line, nothing else")
        return json.loads(done.stdout)

    def test_area_coverage_and_way(self):
        found = self.judge("--picture", str(self.folder / "judge.png"))
        self.assertAlmostEqual(found["reachable_m2"], 7.8 * 5.8, delta=1.5)
        self.assertAlmostEqual(found["covered"], 0.5, delta=0.01)
        self.assertAlmostEqual(found["known"], 0.5, delta=0.01)
        self.assertAlmostEqual(found["distance_m"][0], 2.0, delta=1e-3)
        self.assertAlmostEqual(found["home_distance_m"], 2.0, delta=1e-3)
        self.assertEqual(found["home"], [False])
        self.assertAlmostEqual(found["end_s"], 10.0, delta=1e-6)
        self.assertNotIn("ate_rmse_m", found, "no trajectory beside the map")
        self.assertTrue((self.folder / "judge.png").read_bytes().startswith(b"\x89PNG"))

    def test_a_whole_map_covers_everything(self):
        self.write_map(known_to_m=9.0)
        self.assertGreater(self.judge()["covered"], 0.995)

    def test_the_robot_that_came_back_is_home(self):
        out = [(100.0 + 0.1 * i, 2.0 + 0.02 * min(i, 100 - i), 3.0, 0.0) for i in range(96)]
        self.write_truth(out)
        found = self.judge()
        self.assertEqual(found["home"], [True])
        self.assertAlmostEqual(found["home_distance_m"], 0.1, delta=1e-3)

    def test_a_path_beside_the_truth(self):
        """0.3 m aside everywhere: all of it counts with the map laid on the start, nothing after the best fit."""
        path = []
        for i in range(5, 95, 5):
            x, y = to_map(2.0 + 0.02 * i, 3.3)
            path.append((100.0 + 0.1 * i, x, y, -math.pi / 2))
        self.write_trajectory(path)
        found = self.judge()
        self.assertEqual(found["poses"], 18)
        self.assertAlmostEqual(found["ate_rmse_m"], 0.3, delta=1e-3)
        self.assertAlmostEqual(found["ate_worst_m"], 0.3, delta=1e-3)
        self.assertLess(found["ate_fitted_rmse_m"], 1e-3)

    def test_stamps_between_the_truths_are_interpolated(self):
        self.write_trajectory([(100.05 + 0.1 * i, *to_map(2.01 + 0.02 * i, 3.0), -math.pi / 2) for i in range(90)])
        self.assertLess(self.judge()["ate_worst_m"], 1e-3)

    def turned_run(self, steps):
        """A map and a path that are right in themselves and turned by half a radian; the way there and back along the room."""
        turn = 0.5
        self.write_map(known_to_m=9.0, turn=turn)
        way = [(100.0 + 0.1 * i, 2.0 + 0.1 * (i % 80 if i % 80 <= 40 else 80 - i % 80), 3.0) for i in range(steps)]
        self.write_truth([(t, x, y, 0.0) for t, x, y in way])
        self.write_trajectory([(t, *to_map(x, y, turn), -math.pi / 2 + turn) for t, x, y in way[::2]])
        inside = cells = 0
        for i in range(156):
            for k in range(116):
                x, y = to_map(0.125 + 0.05 * i, 0.125 + 0.05 * k, -turn)  # in the picture, with the map laid on the start
                cells += 1
                inside += LEFT <= x < LEFT + 0.05 * WIDTH and LOW <= y < START[0] - 0.1
        return self.judge(), inside / cells

    def test_a_turned_map_is_laid_on_the_building_as_its_path_fits_best(self):
        found, at_start = self.turned_run(steps=131)
        self.assertAlmostEqual(found["distance_m"][0], 13.0, delta=1e-3)
        self.assertGreater(found["covered"], 0.995)
        self.assertLess(found["ate_fitted_rmse_m"], 1e-3)
        self.assertLess(at_start, 0.95)
        self.assertAlmostEqual(found["covered_at_start"], at_start, delta=0.02)
        self.assertGreater(found["ate_rmse_m"], 0.5)

    def test_a_path_too_short_to_tell_leaves_the_map_at_the_start(self):
        found, at_start = self.turned_run(steps=31)
        self.assertEqual(found["covered"], found["covered_at_start"])
        self.assertAlmostEqual(found["covered"], at_start, delta=0.02)

    def refused(self, *words):
        done = self.run_judge()
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_a_trajectory_of_another_run_is_refused(self):
        self.write_trajectory([(5.0, 0.0, 0.0, 0.0)])
        self.refused("trajectory.txt", "one run")

    def test_a_bad_truth_is_refused_with_its_line(self):
        (self.folder / "truth.tsv").write_text("# t x y theta\n1.0 2.0 3.0 0.0\n1.1 2.0 oops 0.0\n")
        self.refused("truth.tsv", "line 3", "oops")

    def test_times_that_run_backwards_are_refused(self):
        self.write_truth([(2.0, 2.0, 3.0, 0.0), (1.0, 2.0, 3.0, 0.0)])
        self.refused("truth.tsv", "line 4", "later")

    def test_a_missing_truth_is_the_users_fault(self):
        (self.folder / "truth.tsv").unlink()
        self.refused("truth.tsv")


if __name__ == "__main__":
    TOPOBENCH = sys.argv.pop(1)
    unittest.main(verbosity=2)
