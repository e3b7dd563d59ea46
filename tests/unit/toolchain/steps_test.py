# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""toolchain/lib/steps.sh and the command lines of the scripts: a failed step is never a green run."""

import pathlib
import subprocess
import tempfile
import unittest

TOP = pathlib.Path(__file__).resolve().parents[3]


def bash(text):
    return subprocess.run(
        ["bash", "-c", f"set -uo pipefail; . '{TOP}/toolchain/lib/steps.sh'; {text}"],
        capture_output=True, text=True, check=False,
    )


def script(*command):
    return subprocess.run([TOP / command[0], *command[1:]], capture_output=True, text=True, check=False)


class Steps(unittest.TestCase):
    def test_all_steps_well_is_status_0_with_a_line_for_each(self):
        done = bash("step one true; step two true; summary all-of-it")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"(?m)^  one +0\.0 min  ok$")
        self.assertRegex(done.stdout, r"(?m)^  two +0\.0 min  ok$")

    def test_a_failed_step_fails_the_run_and_does_not_stop_it(self):
        done = bash("step bad false; step good echo still-running; summary all-of-it")
        self.assertEqual(done.returncode, 1)
        self.assertIn("still-running", done.stdout)
        self.assertRegex(done.stdout, r"(?m)^  bad +0\.0 min  FAILED \(1\)$")
        self.assertIn("FAILED: 1 step(s)", done.stdout)

    def test_a_step_that_was_not_run_is_a_failure(self):
        done = bash("skip_step 'all tests' 'no build'; summary all-of-it")
        self.assertEqual(done.returncode, 1)
        self.assertIn("NOT RUN", done.stdout)

    def test_a_step_sees_no_terminal_and_no_input(self):
        done = bash("step read read -r line; summary all-of-it")
        self.assertEqual(done.returncode, 1)

    def test_a_step_tells_its_status(self):
        done = bash("step three sh -c 'exit 3'; echo status $?")
        self.assertIn("status 3", done.stdout)

    def test_tests_that_judged_nothing_are_named(self):
        log = ("1/3 Test #4: grid_test .......   Passed    0.10 sec\n"
               " 2/3 Test #12: kill_test ......***Skipped   9.31 sec\n"
               "3/3 Test #5: odd_test ....***Failed   0.10 sec\n")
        with tempfile.TemporaryDirectory() as name:
            (pathlib.Path(name) / "build/release").mkdir(parents=True)
            (pathlib.Path(name) / "build/release/tests.log").write_text(log)
            done = bash(f"cd '{name}'; say_skipped release; say_skipped tsan")
        self.assertEqual(done.stdout, "skipped (release): kill_test\n")
        self.assertEqual(done.stderr, "")

    def test_the_deadline_ends_a_step_with_all_that_it_started_and_begins_no_other(self):
        with tempfile.TemporaryDirectory() as name:
            # A child of the step's holds the pipe: it is gone when the pipe gives its end.
            done = bash(f"steps_deadline=$(($(date +%s) + 2)); mkfifo '{name}/held'; "
                        f"step long bash -c 'echo begun; sleep 1000 > {name}/held & wait' & cat '{name}/held'; wait; "
                        "step long bash -c 'sleep 1000'; step late echo never; summary all-of-it")
        self.assertEqual(done.returncode, 1)
        self.assertIn("begun", done.stdout)
        self.assertNotIn("\nnever", done.stdout)
        self.assertIn("== long: OUT OF TIME", done.stdout)
        self.assertRegex(done.stdout, r"(?m)^  late +0\.0 min  NOT RUN$")

    def test_what_runs_meanwhile_gives_way_and_ends_with_the_script(self):
        with tempfile.TemporaryDirectory() as name:
            # The pipe gives its end when nothing holds it any more.
            done = bash(f"cd '{name}'; mkfifo held; cat held > seen & "
                        "meanwhile ahead bash -c 'chrt --pid $$; cat /proc/self/autogroup; echo begun > held; sleep 1000 > held'; "
                        "until [ -s seen ]; do sleep 0.02; done; step good echo done; summary all-of-it")
            log = (pathlib.Path(name) / "ahead/log").read_text()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("SCHED_IDLE", log)
        if pathlib.Path("/proc/self/autogroup").exists():
            self.assertIn("nice 19", log)
        self.assertRegex(done.stdout, r"(?m)^  good +0\.0 min  ok$")

    def test_what_became_of_a_part_is_known_as_soon_as_it_ended(self):
        with tempfile.TemporaryDirectory() as name:
            parts = (f". '{TOP}/toolchain/lib/steps.sh'; part ahead good echo done; part ahead bad sh -c 'echo no; exit 3'; "
                     "sleep 1000")
            done = bash(f"cd '{name}'; meanwhile ahead bash -c \"{parts}\"; step one became_of_part good; "
                        "step two became_of_part bad; summary all-of-it")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, r"(?s)== one\n.*\ndone\n== one: ok.*\nno\n== two: FAILED \(3\)")

    def test_a_part_that_never_was_has_failed(self):
        with tempfile.TemporaryDirectory() as name:
            done = bash(f"cd '{name}'; meanwhile ahead true; step one became_of_part good; summary all-of-it")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, r"(?m)^  one +\d\.\d min  FAILED \(1\)$")

    def test_with_a_deadline_a_step_in_time_is_as_without(self):
        done = bash("steps_deadline=$(($(date +%s) + 600)); step good echo done; step three sh -c 'exit 3'; "
                    "echo status $?; summary all-of-it")
        self.assertEqual(done.returncode, 1)
        self.assertIn("status 3", done.stdout)
        self.assertRegex(done.stdout, r"(?m)^  good +0\.0 min  ok$")
        self.assertRegex(done.stdout, r"(?m)^  three +0\.0 min  FAILED \(3\)$")


class Build(unittest.TestCase):
    def test_two_builds_in_one_folder_go_one_after_the_other(self):
        with tempfile.TemporaryDirectory() as name:
            cmake = pathlib.Path(name) / "cmake"
            cmake.write_text("#!/bin/sh\nmkdir '%s/inside' && sleep 0.05 && rmdir '%s/inside'\n" % (name, name))
            cmake.chmod(0o755)
            done = bash(f"cd '{name}'; PATH='{name}':$PATH; jobs=1; build x & build x; mine=$?; wait $! && exit $mine")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


class CommandLines(unittest.TestCase):
    def test_help_is_there(self):
        for name in ("toolchain/test", "toolchain/install-dependencies", "toolchain/check-layers", "tests/canary/run"):
            done = script(name, "--help")
            self.assertEqual(done.returncode, 0, name)
            self.assertIn("usage", done.stdout.lower(), name)

    def test_an_unknown_argument_is_the_users_fault(self):
        for name in ("toolchain/test", "toolchain/install-dependencies", "toolchain/check-names", "tests/canary/run"):
            done = script(name, "--no-such-thing")
            self.assertEqual(done.returncode, 2, name)
            self.assertIn("no-such-thing", done.stderr, name)

    def test_a_wrong_number_of_jobs_is_refused_before_anything_is_done(self):
        done = script("toolchain/test", "--jobs", "none")
        self.assertEqual(done.returncode, 2)
        self.assertIn("'none'", done.stderr)

    def test_a_profile_holds_the_smaller_ones(self):
        run, build, ci = (
            set(script("toolchain/install-dependencies", profile, "--list").stdout.split())
            for profile in ("run", "build", "ci")
        )
        self.assertTrue(run < build < ci)


if __name__ == "__main__":
    unittest.main()
