#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""topobench slam as a user runs it: a drawn log with known truth, bad input, and the real logs when they are here.

usage: topobench_slam_test.py TOPOBENCH [unittest options]
The real logs are found through TOPOMETRIC_DATA; without it their tests say that they were skipped.
TOPOMETRIC_PATROL_MINUTES (5): how long the robot drives through each real floor plan."""
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOPOBENCH = ""
BEAMS = 361


def walls():
    """A room of 10 m x 7 m with a pillar and a step, so that every direction is determined."""
    def box(x0, y0, x1, y1):
        return [((x0, y0), (x1, y0)), ((x1, y0), (x1, y1)), ((x1, y1), (x0, y1)), ((x0, y1), (x0, y0))]
    return box(0, 0, 10, 7) + box(3, 4, 3.5, 4.5) + box(7, 0, 10, 1)


def cast(x, y, angle):
    dx, dy = math.cos(angle), math.sin(angle)
    best = 81.0
    for (ax, ay), (bx, by) in walls():
        ex, ey = bx - ax, by - ay
        det = ex * dy - ey * dx
        if abs(det) < 1e-12:
            continue
        t = (ex * (ay - y) - ey * (ax - x)) / det
        u = (dx * (ay - y) - dy * (ax - x)) / det
        if t > 0 and 0 <= u <= 1:
            best = min(best, t)
    return best


def write_log(path, scans=60):
    """FLASER lines of a drive along an arc; odometry turns 5 % too far. Returns the true path."""
    truth, odometry = (2.0, 2.0, 0.0), (0.0, 0.0, 0.0)
    poses, lines = [], ["# drawn for a test"]

    def step(pose, forward, turn):
        theta = pose[2] + turn
        return pose[0] + forward * math.cos(theta), pose[1] + forward * math.sin(theta), theta

    for i in range(scans):
        x, y, theta = truth
        ranges = [cast(x, y, theta - math.pi / 2 + k * math.pi / (BEAMS - 1)) for k in range(BEAMS)]
        odo = " ".join("%.6f" % v for v in odometry)
        lines.append("FLASER %d %s %s %s %.6f host %.6f" %
                     (BEAMS, " ".join("%.3f" % r for r in ranges), odo, odo, 100.0 + 0.2 * i, 0.2 * i))
        poses.append((100.0 + 0.2 * i, truth))
        truth = step(truth, 0.06, 0.02)
        odometry = step(odometry, 0.06, 0.021)
    pathlib.Path(path).write_text("\n".join(lines) + "\n")
    return poses


def run(*arguments):
    return subprocess.run([TOPOBENCH, "slam", *arguments], capture_output=True, text=True, check=False)


class DrawnLog(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def test_map_trajectory_and_report(self):
        poses = write_log(self.path / "drawn.clf")
        relations = self.path / "drawn.relations"
        lines = []
        for (t1, a), (t2, b) in zip(poses[:-20:4], poses[20::4]):
            c, s = math.cos(a[2]), math.sin(a[2])
            dx, dy = b[0] - a[0], b[1] - a[1]
            lines.append("%.6f %.6f %.6f %.6f 0 0 0 %.6f" % (t1, t2, c * dx + s * dy, -s * dx + c * dy, b[2] - a[2]))
        relations.write_text("\n".join(lines) + "\n")
        out = self.path / "out"
        done = run("--log", str(self.path / "drawn.clf"), "--relations", str(relations), "--out", str(out), "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("\n"), 1, "one object on one line, nothing else")
        report = json.loads(done.stdout)
        self.assertEqual(report["scans"], 60)
        self.assertEqual(report["stamp_inversions"], 0)
        self.assertLessEqual(report["unlike_canonical"], 0.001)
        self.assertEqual(report["relations"]["skipped"], 0)
        self.assertLess(report["relations"]["trans_mean_m"], 0.02)
        self.assertLess(report["relations"]["rot_mean_deg"], 0.3)
        self.assertEqual(set(report["match_ms"]), {"mean", "p50", "p99", "p999", "max"})
        trajectory = (out / "trajectory.txt").read_text().splitlines()
        self.assertEqual(len(trajectory), 60)
        self.assertEqual([float(line.split()[0]) for line in trajectory], [round(t, 6) for t, _ in poses])
        self.assertIn("resolution: 0.05", (out / "map.yaml").read_text())
        self.assertTrue((out / "map.pgm").read_bytes().startswith(b"P5"))
        self.assertTrue((out / "map.png").read_bytes().startswith(b"\x89PNG"))

    def test_the_same_log_gives_the_same_bytes(self):
        write_log(self.path / "drawn.clf")
        contents = []
        for name in ("a", "b"):
            self.assertEqual(run("--log", str(self.path / "drawn.clf"), "--out", str(self.path / name)).returncode, 0)
            contents.append([(self.path / name / f).read_bytes() for f in ("map.pgm", "trajectory.txt")])
        self.assertEqual(contents[0], contents[1])

    def refused(self, text, *words):
        log = self.path / "bad.clf"
        log.write_text(text)
        out = self.path / "out"
        done = run("--log", str(log), "--out", str(out))
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        for word in ("bad.clf", *words):
            self.assertIn(word, done.stderr)
        self.assertFalse(out.exists(), "nothing half-written")

    def test_a_log_cut_off_in_its_last_line_loses_that_line(self):
        write_log(self.path / "whole.clf", 5)
        text = (self.path / "whole.clf").read_text()
        scans = []
        for name, content in (("whole.clf", text), ("cut.clf", text[:len(text) - 300])):
            (self.path / name).write_text(content)
            done = run("--log", str(self.path / name), "--json")
            self.assertEqual(done.returncode, 0, done.stderr)
            scans.append(json.loads(done.stdout)["scans"])
        self.assertIn("cut.clf: passed over the last line, 6, which is FLASER that was cut off", done.stderr)
        self.assertEqual(scans, [5, 4])

    def test_a_number_that_is_none_is_refused_with_its_line(self):
        write_log(self.path / "whole.clf", 3)
        lines = (self.path / "whole.clf").read_text().splitlines()
        words = lines[2].split()
        words[-3] = "nan"
        lines[2] = " ".join(words)
        self.refused("\n".join(lines) + "\n", ":3", "nan")

    def test_a_log_without_scans_is_refused(self):
        self.refused("ODOM 0 0 0 0 0 0 1.0 host 1.0\n", "scan")

    def test_a_missing_log_is_the_users_fault(self):
        done = run("--log", str(self.path / "none.clf"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("none.clf", done.stderr)

    def test_an_unknown_option_is_the_users_fault(self):
        self.assertEqual(run("--lgo", "x").returncode, 2)


class SimulatedPatrol(unittest.TestCase):
    FLAT = str(pathlib.Path(__file__).with_name("flat.toml"))

    def patrol(self, *arguments, world=FLAT):
        done = run("--simulate", world, "--json", *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_the_path_is_the_true_one_to_centimetres(self):
        report = self.patrol("--minutes", "1.5", "--seed", "3")
        self.assertGreater(report["scans"], 3400, "40 a second, and the drive lasts")
        self.assertGreater(report["true_path_m"], 15)
        self.assertEqual((report["lost"], report["collisions"]), (0, 0))
        self.assertLess(report["error"]["rmse_m"], 0.03)
        self.assertLess(report["error"]["heading_rmse_deg"], 0.5)
        self.assertTrue(report["difficulty"].startswith("difficulty: range noise 30 mm"), report["difficulty"])
        self.assertEqual(set(report["stages"]), {"scan", "step", "track", "keyframe", "correction", "loop_search", "graph", "end"})

    def test_the_same_seed_gives_the_same_path(self):
        with tempfile.TemporaryDirectory() as out:
            for name in ("a", "b"):
                self.patrol("--minutes", "0.3", "--seed", "5", "--out", out + "/" + name)
            paths = [pathlib.Path(out, name, "trajectory.txt").read_bytes() for name in ("a", "b")]
        self.assertEqual(paths[0], paths[1])

    def test_people_who_walk_about_do_not_tear_the_map(self):
        report = self.patrol("--minutes", "2", "--seed", "2", "--people", "4")
        self.assertEqual(report["lost"], 0)
        self.assertLess(report["error"]["rmse_m"], 0.03)

    def test_a_log_and_a_building_at_once_are_refused(self):
        self.assertEqual(run("--simulate", self.FLAT, "--log", "x.clf").returncode, 2)
        self.assertEqual(run("--json").returncode, 2)

    def test_a_missing_building_is_the_users_fault(self):
        done = run("--simulate", "none.toml")
        self.assertEqual(done.returncode, 2)
        self.assertIn("none.toml", done.stderr)


@unittest.skipUnless(os.environ.get("TOPOMETRIC_DATA"), "TOPOMETRIC_DATA is not set: no building of real plans was tried")
class FloorPlans(unittest.TestCase):
    MINUTES = os.environ.get("TOPOMETRIC_PATROL_MINUTES", "5")

    def rmse(self, name):
        world = pathlib.Path(os.environ["TOPOMETRIC_DATA"]) / "floorplans" / (name + ".yaml")
        done = run("--simulate", str(world), "--minutes", self.MINUTES, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        report = json.loads(done.stdout)
        self.assertEqual(report["lost"], 0)
        return report["error"]["rmse_m"]

    def test_columbia(self):
        self.assertLess(self.rmse("columbia"), 0.05)

    def test_hospital_section(self):
        self.assertLess(self.rmse("hospital_section"), 0.05)


@unittest.skipUnless(os.environ.get("TOPOMETRIC_DATA"), "TOPOMETRIC_DATA is not set: the real logs were not tried")
class RealLogs(unittest.TestCase):
    def errors(self, name):
        data = pathlib.Path(os.environ["TOPOMETRIC_DATA"])
        with tempfile.TemporaryDirectory() as out:
            done = run("--log", str(data / "slam_logs" / (name + ".clf.bz2")),
                       "--relations", str(data / "relations" / (name + ".relations.bz2")), "--out", out, "--json")
            self.assertEqual(done.returncode, 0, done.stderr)
            report = json.loads(done.stdout)
        self.assertEqual(report["relations"]["skipped"], 0)
        return report["relations"]["trans_mean_m"], report["relations"]["rot_mean_deg"]

    def test_intel(self):
        translation, rotation = self.errors("intel")
        self.assertLess(translation, 0.031)
        self.assertLess(rotation, 1.0)

    def test_freiburg_079(self):
        translation, rotation = self.errors("fr079")
        self.assertLess(translation, 0.056)
        self.assertLess(rotation, 0.6)


if __name__ == "__main__":
    TOPOBENCH = sys.argv.pop(1)
    unittest.main(verbosity=2)
