#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""topobench explore-table as a user runs it: a small table is made, made again without a run to the same byte, summed up,
and goes on where it was after Ctrl-C.

usage: topobench_table_test.py TOPOBENCH [unittest options]"""
import json
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from topobench_explore_test import WORLD

TOPOBENCH = ""
TIMES = ("t50_s", "t90_s", "t95_s", "t99_s", "t_home_s")


class Table(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "rooms.toml").write_text(WORLD)
        self.out = self.folder / "out"
        self.runs = self.out / "runs.jsonl"

    def command(self, *arguments):
        return [TOPOBENCH, "explore-table", "--worlds", str(self.folder / "rooms.toml"), "--out", str(self.out),
                *map(str, arguments)]

    def table(self, *arguments):
        done = subprocess.run(self.command(*arguments), capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def test_the_second_time_runs_nothing_and_says_the_same(self):
        arguments = ("--strategies", "topometric,nearest_frontier,greedy_frontier", "--seeds", 2, "--json")
        first = self.table(*arguments)
        self.assertIn("12 runs, 0 of them done before", first.stderr)
        files = {file.name: file.read_bytes() for file in self.out.iterdir()}
        self.assertEqual(set(files), {"runs.jsonl", "bounds.jsonl", "table.md", "table.json", "coverage-rooms-1.png", "coverage-all-1.png",
                                      "coverage-rooms-2.png", "coverage-all-2.png"})
        self.assertEqual(files["runs.jsonl"].count(b"\n"), 12)
        second = self.table(*arguments)
        self.assertIn("12 runs, 12 of them done before", second.stderr)
        self.assertEqual(second.stdout, first.stdout)
        self.assertEqual({file.name: file.read_bytes() for file in self.out.iterdir()}, files)
        self.assertEqual(self.table(*arguments, "--no-runs").stdout, first.stdout)
        self.check(json.loads(first.stdout), [json.loads(line) for line in files["runs.jsonl"].splitlines()])

    @staticmethod
    def failed(report):
        return report["collisions"] > 0 or not all(report["home"])

    def paired_ratios(self, ratio, lines):
        """The different ratios of times to 95 % that the runs of one contest have, seed by seed."""
        def times(side):
            runs = {}
            for line in lines:
                run, report = line["run"], line["report"]
                named = side["strategy"] in (run["strategy"], "best_baseline") and run["robots"] == side["robots"]
                if not named or (side["strategy"] == "best_baseline" and run["strategy"] == "topometric"):
                    continue
                time_s = report["limit_s"] if self.failed(report) else report["t95_s"]
                runs[run["seed"]] = min(time_s, runs.get(run["seed"], time_s))
            return runs
        a, b = times(ratio["a"]), times(ratio["b"])
        return {a[seed] / b[seed] for seed in a}

    def check(self, table, lines):
        """What the table says is what its runs say."""
        failures = [line["run"] for line in lines if self.failed(line["report"])]
        self.assertEqual(sorted((run["strategy"], run["robots"], run["seed"]) for run in failures),
                         sorted((run["strategy"], run["robots"], run["seed"]) for run in table["failures"]))
        for mean in table["means"]:
            of = [line["report"] for line in lines if line["run"]["strategy"] == mean["strategy"]
                  and line["run"]["robots"] == mean["robots"]]
            self.assertEqual((len(of), mean["runs"], mean["failed"]), (2, 2, sum(map(self.failed, of))))
            for key in TIMES:
                times = [report["limit_s"] if self.failed(report) else report[key] for report in of]
                self.assertAlmostEqual(mean[key], sum(times) / 2)
                self.assertEqual(mean[key.replace("_s", "_worst_s")], max(times))
        starts = {(line["run"]["seed"], *line["run"]["start"]) for line in lines}
        self.assertEqual(len(starts), 2, "a start for each seed, the same for all")
        contests = [(ratio["a"]["robots"], ratio["b"]["strategy"], ratio["b"]["robots"]) for ratio in table["ratios"]]
        for contest in ((1, "nearest_frontier", 1), (1, "best_baseline", 1), (2, "nearest_frontier", 1),
                        (2, "best_baseline", 2)):
            self.assertIn(contest, contests)
        for ratio in table["ratios"]:
            self.assertEqual((ratio["t95"]["pairs"], ratio["t95"]["worlds"]), (2, 1))
            low, high = ratio["t95"]["over_runs"]
            if len(self.paired_ratios(ratio, lines)) > 1:
                self.assertLess(low, high)
            else:
                self.assertEqual((low, high), (ratio["t95"]["ratio"],) * 2, "runs that agree leave no interval")
            self.assertIsNone(ratio["t95"]["over_worlds"], "one building says nothing of others")
            self.assertIsNone(ratio["t95"]["bootstrap"], "nor does it by drawing it again")
        for row in table["breakdown"]:
            self.assertEqual(row["runs"], 2)
            self.assertAlmostEqual(sum(row["time"].values()), 1.0)
            self.assertLess(sum(row["lost"].values()), 1.0)
            self.assertGreater(row["way_over_bound"]["ratio"], 0.9, "no way is much shorter than the tours")

    def test_goes_on_after_an_interruption(self):
        arguments = ("--strategies", "topometric,min_pos", "--robots", 1, "--seeds", 4, "--jobs", 1)
        with subprocess.Popen(self.command(*arguments), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            end = time.monotonic() + 120
            while process.poll() is None and not (self.runs.exists() and b"\n" in self.runs.read_bytes()):
                self.assertLess(time.monotonic(), end, "not one run is done")
                time.sleep(0.01)
            process.send_signal(signal.SIGINT)
            self.assertEqual(process.wait(20), -signal.SIGINT)
        before = self.runs.read_bytes()
        self.assertLess(before.count(b"\n"), 8)
        done = self.table(*arguments)
        self.assertIn(f"8 runs, {before.count(bytes([10]))} of them done before", done.stderr)
        after = self.runs.read_bytes()
        self.assertTrue(after.startswith(before))
        self.assertEqual(after.count(b"\n"), 8)

    def test_counts_the_limit_for_what_is_not_done_and_names_it(self):
        table = json.loads(self.table("--strategies", "topometric,nearest_frontier", "--robots", 1, "--seeds", 1, "--limit",
                                      8, "--json").stdout)
        for mean in table["means"]:
            self.assertEqual((mean["failed"], mean["t99_s"], mean["t_home_s"]), (1, 8.0, 8.0))
        self.assertEqual([failure["strategy"] for failure in table["failures"]], ["topometric", "nearest_frontier"])
        self.assertIn("- rooms, 1 x topometric, `--seed 1 --start 1.2,1,0`: ", (self.out / "table.md").read_text())

    def test_draws_the_same_buildings_from_the_same_seed(self):
        def suite(out, seed):
            done = subprocess.run([TOPOBENCH, "suite", "--seed", str(seed), "--buildings", "2", "--out", str(self.folder / out)],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(f"| fresh, seed {seed} | 2 |", done.stdout)
            return {file.name: file.read_bytes() for file in (self.folder / out).iterdir()}

        first = suite("first", 5)
        self.assertEqual(set(first), {f"fresh-5-0{n}.{ending}" for n in (1, 2) for ending in ("png", "yaml")})
        self.assertEqual(suite("again", 5), first)
        self.assertNotEqual(list(suite("other", 6).values()), list(first.values()))

    def test_bounds_what_full_knowledge_needs(self):
        done = subprocess.run([TOPOBENCH, "bound", "--world", str(self.folder / "rooms.toml"), "--robots", "2", "--json"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        bound = json.loads(done.stdout)
        self.assertTrue(bound["feasible"])
        for share in ("0.9", "0.95", "0.99"):
            self.assertLessEqual(bound["lower_m_per_robot"][share], bound["m_per_robot"][share])
            self.assertAlmostEqual(bound["seconds_at_full_speed"][share], bound["m_per_robot"][share] / 0.7, delta=0.02)
            self.assertGreaterEqual(bound["seconds_at_own_motion"][share], bound["seconds_at_full_speed"][share] - 0.5)

    def test_refuses_with_a_reason(self):
        for option, value, word in (("--strategies", "luck", "luck"), ("--compare", "a:1", "STRATEGY:ROBOTS"),
                                    ("--robots", 0, "--robots"), ("--worlds", "nowhere.toml", "nowhere.toml"),
                                    ("--share", "t42", "t42"), ("--no-runs", None, "found none of the 80 runs")):
            with self.subTest(option):
                given = [option] if value is None else [option, value]
                done = subprocess.run(self.command(*given), capture_output=True, text=True, check=False)
                self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                self.assertIn(word, done.stderr)


if __name__ == "__main__":
    TOPOBENCH = sys.argv.pop(1)
    unittest.main(verbosity=2)
