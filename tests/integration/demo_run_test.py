#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What toolchain/demo runs, in a flat of three rooms: explored, home again, judged; and what it leaves when it is
interrupted or has too little time.

usage: demo_run_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]"""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "toolchain/lib"))
import demo_network  # noqa: E402

BIN = SOURCE = None
NO_NAMESPACES = demo_network.trouble("cut:4:64")
FILES = ("map.pgm", "map.yaml", "cloud.ply", "places.geojson", "overview.png", "judge.png", "report.json",
         "ways.png", "coverage.png", "goals.png", "samples.json")
KEYS = ("world", "strategy", "robots", "seed", "fidelity", "finish", "reachable_m2", "t50_s", "t90_s", "t95_s", "t99_s",
        "t_home_s", "limit_s", "distance_m", "goals_issued", "clusters_sum", "goals_sum", "decision_ms", "collisions", "home",
        "coverage", "cpu_percent", "peak_rss_mb", "ate_rmse_m", "passed", "why")


class DemoRun(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.out = self.folder / "results/of/today"

    def start(self, limit_s, robots=1, world="flat", radio="perfect"):
        command = [sys.executable, "-B", SOURCE / "toolchain/lib/demo.py", "--bin", BIN, "--world",
                   SOURCE / ("tests/integration/%s.toml" % world), "--seed", "5", "--strategy", "topometric", "--finish", "complete",
                   "--out", self.out, "--time-limit", limit_s, "--robots", robots, "--radio", radio]
        process = subprocess.Popen([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                   env={**os.environ, "TMPDIR": str(self.folder), "PYTHONUNBUFFERED": "1"})
        self.addCleanup(process.kill)
        return process

    def nothing_is_left(self):
        """Its folder is gone, and no process has it in its command line."""
        self.assertEqual([path.name for path in self.folder.iterdir() if path.name.startswith("topometric-demo-")], [])
        for path in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
            try:
                self.assertNotIn(str(self.folder), path.read_bytes().decode(errors="replace"))
            except OSError:
                pass  # it has ended meanwhile

    def two_explore(self, radio):
        """Two daemons share one map, and both come home: the report."""
        process = self.start(600, robots=2, world="wings", radio=radio)
        said = process.communicate(timeout=900)[0]
        print(said, file=sys.stderr)
        self.nothing_is_left()
        report = json.loads((self.out / "report.json").read_text())
        self.assertEqual((process.returncode, report["passed"], report["why"]), (0, True, []))
        first, second = report["each"]
        self.assertEqual(first["held_hash"], second["held_hash"])
        self.assertGreater(min(report["distance_m"]), 3.0, "both drove")
        self.assertGreater(min(first["received_bytes"], second["received_bytes"]), 10000)
        self.assertTrue((self.out / "robot2/overview.png").exists())
        return report

    @unittest.skipUnless(NO_NAMESPACES, "the same over a cut, below")
    def test_two_daemons_share_one_map_and_both_come_home(self):
        self.two_explore("perfect")

    @unittest.skipIf(NO_NAMESPACES, "no network namespaces here: %s" % NO_NAMESPACES)
    def test_a_minute_apart_while_both_explore_loses_nothing(self):
        report = self.two_explore("cut:4:64")
        self.assertEqual(report["radio"]["links"], "namespaces")
        ((apart_s, together_s),) = report["radio"]["gaps_s"]
        self.assertTrue(4.0 <= apart_s < 6.0 and 64.0 <= together_s < 66.0, report["radio"])
        samples = json.loads((self.out / "samples.json").read_text())
        known = [row for t, row in zip(samples["t_s"], samples["known_m2"]) if apart_s <= t <= together_s]
        for robot in (0, 1):
            self.assertGreater(known[-1][robot], known[0][robot] + 10.0, "robot %d explored during the cut" % (robot + 1))
        # No robot heard another meanwhile: the links were away and came back.
        for number in (1, 2):
            self.assertRegex((self.out / ("topolink%d.log" % number)).read_text(),
                             "(?s)radio is gone or down.*radio is back or has another address")
        (cut,) = report["radio"]["cuts"]
        self.assertIsNotNone(cut["caught_up_s"], report["radio"])
        self.assertIsNotNone(cut["equal_s"], report["radio"])
        for name in ("ways.png", "coverage.png", "goals.png"):
            self.assertTrue((self.out / name).exists(), name)

    def test_a_flat_is_explored_and_the_robot_comes_home(self):
        process = self.start(600)
        said = process.communicate(timeout=900)[0]
        print(said, file=sys.stderr)
        self.nothing_is_left()
        for name in FILES:
            self.assertTrue((self.out / name).exists(), name)
        report = json.loads((self.out / "report.json").read_text())
        self.assertEqual([key for key in KEYS if key not in report], [])
        self.assertEqual((process.returncode, report["passed"], report["why"]), (0, True, []))
        self.assertEqual(report["coverage"][-1][1], round(report["covered"], 4))
        self.assertIn("PASSED", said)

    def test_too_little_time_is_a_failure_in_words(self):
        process = self.start(3)
        said = process.communicate(timeout=120)[0]
        self.assertEqual(process.returncode, 1, said)
        self.assertIn("the robot was not home after", said)
        self.assertFalse(json.loads((self.out / "report.json").read_text())["passed"])
        self.nothing_is_left()

    def test_ctrl_c_leaves_nothing_behind(self):
        process = self.start(600)
        while not process.stdout.readline().startswith("daemon:"):
            self.assertIsNone(process.poll())
        time.sleep(1.0)  # in the middle of it, wherever that is
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=60)[0]
        self.assertEqual(process.returncode, 130, said)
        self.nothing_is_left()


if __name__ == "__main__":
    BIN, SOURCE = pathlib.Path(sys.argv.pop(1)).resolve(), pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)
