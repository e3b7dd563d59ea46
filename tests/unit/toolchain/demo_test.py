# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""The parts of toolchain/demo that need no robot; demo_run_test of tests/integration has the rest."""

import mmap
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import tomllib
import types
import unittest

TOP = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(TOP / "toolchain/lib"))

import demo  # noqa: E402
import demo_processes  # noqa: E402
import demo_report  # noqa: E402
import demo_view  # noqa: E402


class CommandLine(unittest.TestCase):
    def demo(self, *words):
        return subprocess.run([TOP / "toolchain/demo", *words], capture_output=True, text=True, check=False, timeout=30)

    def test_help(self):
        done = self.demo("--help")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for option in ("--robots", "--entry-delay", "--world", "--seed", "--strategy", "--finish", "--out", "--time-limit", "--view", "--no-install"):
            self.assertIn(option, done.stdout)

    def test_faults_are_named_before_anything_is_installed_or_built(self):
        for words, expected in (
            (["--sead", "3"], "'--sead'"), (["--seed", "x"], "'x'"), (["--seed"], "takes a value"),
            (["--strategy", "fast"], "nearest_frontier"), (["--finish", "soon"], "essential"),
            (["--robots", "9"], "1 to 8"), (["--entry-delay", "x"], "'x'"),
            (["--time-limit", "0"], "seconds"), (["--world", "/nowhere.toml"], "/nowhere.toml"), (["--world", "/"], "a file"),
            (["--out", ""], "folder"), (["--out", "/dev/null"], "'/dev/null'"), (["--out", "/dev/null/x"], "'/dev/null/x'"),
        ):
            done = self.demo(*words)
            self.assertEqual((done.returncode, done.stdout), (2, ""), words)
            self.assertIn(expected, done.stderr)


class Page(unittest.TestCase):
    def test_the_address_is_what_pair_printed(self):
        address = "http://127.0.0.1:8080/#token=ab-cd"
        self.assertEqual(demo_view.address_of("token    ab-cd\naddress  %s\n\nIt is shown this once.\n" % address), address)
        with self.assertRaisesRegex(demo_processes.Failure, "no right"):
            demo_view.address_of("no right")


class Configuration(unittest.TestCase):
    def test_keys_are_set_in_their_own_section(self):
        text = '[a]\naddress = "1"\n# strategy = "x"  # why\n[b.c]\n# more\naddress = "2"\n'
        made = demo_processes.configure(text, {("b.c", "address"): "tcp:h:1", ("a", "strategy"): "y", ("a", "new"): "n",
                                               ("d", "finish"): "f"})
        self.assertEqual(tomllib.loads(made), {"a": {"address": "1", "strategy": "y", "new": "n"},
                                               "b": {"c": {"address": "tcp:h:1"}}, "d": {"finish": "f"}})

    def test_the_simulations_file_takes_what_the_demo_sets(self):
        values = {("base", "address"): "tcp:h:1", ("scanner.front", "address"): "tcp:h:2", ("scanner.coronal", "address"): "tcp:h:3",
                  ("control", "socket"): "/s", ("exploration", "strategy"): "nearest_frontier", ("exploration", "finish"): "essential",
                  ("view", "port"): 8081, ("view", "state_folder"): "/v"}
        made = tomllib.loads(demo_processes.configure((TOP / "config/simulation.toml").read_text(), values))
        for (section, key), value in values.items():
            found = made
            for name in section.split("."):
                found = found[name]
            self.assertEqual(found[key], value)


class Processes(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        self.processes = demo_processes.Processes(self.folder, self.folder)
        self.addCleanup(self.processes.end_all)

    def program(self, name, text):
        (self.folder / name).write_text("#!/bin/sh\n" + text)
        (self.folder / name).chmod(0o755)

    def test_a_program_that_does_not_start_is_explained(self):
        self.program("broken", "echo the reason >&2\nexit 3\n")
        with self.assertRaisesRegex(demo_processes.Failure, "the reason"):
            self.processes.start_and_read_line("broken")

    def test_all_are_ended_also_those_that_will_not(self):
        self.program("good", "echo ready\nexec sleep 100\n")
        self.program("stubborn", "trap '' TERM\necho ready\nwhile :; do sleep 0.1; done\n")
        for name in ("good", "stubborn"):
            self.assertEqual(self.processes.start_and_read_line(name), "ready\n")
        running = list(self.processes.running)
        limit, demo_processes.STOP_LIMIT_S = demo_processes.STOP_LIMIT_S, 0.5
        self.addCleanup(setattr, demo_processes, "STOP_LIMIT_S", limit)
        self.processes.end_all()
        self.assertEqual([process.returncode for process in running], [-15, -9])

    def test_times_of_threads(self):
        times = demo_processes.ThreadTimes(os.getpid())
        times.begin()
        end = time.thread_time() + 0.3
        while time.thread_time() < end:
            pass
        times.update()
        used = times.percent()
        self.assertGreater(sum(used.values()), 5.0, used)
        self.assertLess(sum(used.values()), 150.0, used)
        self.assertGreater(times.peak_rss_mb(), 1.0)

    def test_page_faults_of_threads(self):
        times = demo_processes.ThreadTimes(os.getpid())
        times.begin()
        pages = 2000
        with mmap.mmap(-1, pages * mmap.PAGESIZE) as memory:
            for page in range(pages):
                memory[page * mmap.PAGESIZE] = 1
        time.sleep(0.05)
        times.update()
        counted = sum(times.faults_per_s().values()) * (times.last_s - times.first_s)
        self.assertGreater(counted, 0.9 * pages)
        self.assertLess(counted, 3 * pages)
        for minutes in (2, 3):
            times.faults.appendleft((times.last_s - minutes * demo_processes.LAST_S, {}))
        times.update()
        self.assertGreater(times.faults[0][0], times.last_s - 2.5 * demo_processes.LAST_S, "only the last minute counts")


class Folder(unittest.TestCase):
    def test_two_demonstrations_do_not_mix_their_results(self):
        with tempfile.TemporaryDirectory() as name:
            out = pathlib.Path(name) / "a/b"
            lock = demo.prepare_folder(out)
            (out / "report.json").write_text("of the first")
            with self.assertRaisesRegex(OSError, "another demonstration"):
                demo.prepare_folder(out)
            self.assertEqual((out / "report.json").read_text(), "of the first")
            os.close(lock)
            os.close(demo.prepare_folder(out))
            self.assertEqual(list(out.iterdir()), [])


class Report(unittest.TestCase):
    def test_coverage_ends_where_it_was_judged(self):
        curve = demo_report.coverage([(i, min(i, 500) * 2.0) for i in range(1001)], 0.98)
        self.assertEqual(curve[-1], [1000, 0.98])
        self.assertLess(len(curve), 260)
        self.assertEqual(demo_report.time_to(curve, 0.49), 250)
        self.assertIsNone(demo_report.time_to(curve, 0.99))
        self.assertEqual(demo_report.coverage([], 0.5), [])

    def test_only_all_three_make_a_pass(self):
        good = {"covered": 0.97, "home_distance_m": 0.2}
        for judged, collisions, before, expected in (
            (good, 0, [], []), ({**good, "covered": 0.94}, 0, [], ["94.0 %"]), (good, 2, [], ["touched something 2 times"]),
            ({**good, "home_distance_m": 0.6}, 0, [], ["0.60 m from its start"]), (good, 0, ["late"], ["late"]),
            ({}, 0, [], ["nothing was judged"]),
        ):
            why = self.reasons(before, [judged], [collisions])
            self.assertEqual(len(why), len(expected), why)
            for text, part in zip(why, expected):
                self.assertIn(part, text)

    @staticmethod
    def reasons(before, judged, collisions):
        robots = [types.SimpleNamespace(name="robot %d" % (i + 1)) for i in range(len(judged))]
        return demo_report.reasons(types.SimpleNamespace(why=before, robots=robots), judged,
                                   [{"collisions": count} for count in collisions])

    def test_of_a_team_every_robot_must_pass(self):
        good, bad = {"covered": 0.97, "home_distance_m": 0.2}, {"covered": 0.9, "home_distance_m": 3.0}
        self.assertEqual(self.reasons([], [good, good], [0, 0]), [])
        why = self.reasons([], [good, bad], [0, 1])
        self.assertEqual(len(why), 3)
        for reason in why:
            self.assertIn("robot 2", reason)


if __name__ == "__main__":
    unittest.main()
