#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""A latched e-stop outlives its daemon, however that ends, until the operator clears it.

usage: estop_latch_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]"""
import signal

from robot_processes import ONE_ROOM, RobotProcesses, main, wait_for


class LatchOutlivesTheDaemon(RobotProcesses):
    def setUp(self):
        super().setUp()
        self.state = self.folder / "state"
        self.state.mkdir()
        self.latch = self.state / "estop.latch"
        world = self.folder / "world.toml"
        world.write_text(ONE_ROOM)
        _, devices = self.start_simulator(world)
        self.write_config(devices)
        text = self.config.read_text()
        self.assertIn('state_folder = ""', text)
        self.config.write_text(text.replace('state_folder = ""', 'state_folder = "%s"' % self.state))

    def start_daemon(self):
        daemon = self.start("topometricd", "--config", self.config)
        wait_for(lambda: self.status().get("map", {}).get("keyframes", 0) > 0, "a daemon with a map")
        return daemon

    def end(self, daemon, number):
        daemon.send_signal(number)
        daemon.wait()

    def kept(self):
        return self.status().get("estop_latch", {}).get("kept")

    def estop(self):
        self.assertEqual(self.ctl("estop").returncode, 0)
        wait_for(lambda: self.kept() == "yes", "a latch that is kept")
        self.assertIn("kept in %s" % self.latch, self.ctl("status").stdout)

    def assert_latched_since_before(self):
        status = self.status()
        self.assertIs(status["estop"], True)
        self.assertEqual(status["state"], "stopped: emergency stop, to be cleared by the operator")
        for words in (["start"], ["home"], ["drive", "0.2", "0"]):
            done = self.ctl(*words)
            self.assertEqual(done.returncode, 1, done)
            self.assertIn("latched since before the daemon's start", done.stderr)
            self.assertIn("topoctl clear-estop", done.stderr)

    def clear_and_start(self):
        done = self.ctl("clear-estop")
        self.assertEqual(done.returncode, 0, done)
        self.assertFalse(self.latch.exists())
        self.assertEqual(self.ctl("wait", "ready", "--timeout", "30").returncode, 0)
        done = self.ctl("start")
        self.assertEqual(done.returncode, 0, done)

    def path_m(self):
        return self.simulator_says("truth")["robots"][0]["path_m"]

    def test_kill_and_orderly_end(self):
        for number in (signal.SIGKILL, signal.SIGTERM):
            with self.subTest(number=number):
                daemon = self.start_daemon()
                self.estop()
                self.end(daemon, number)
                daemon = self.start_daemon()
                self.assert_latched_since_before()
                self.end(daemon, signal.SIGKILL)  # once more: nothing but the clear releases it
                daemon = self.start_daemon()
                self.assert_latched_since_before()
                before_m = self.path_m()
                self.clear_and_start()
                wait_for(lambda: self.path_m() > before_m + 0.1, "a robot that moves")
                self.assertEqual(self.ctl("stop").returncode, 0)
                self.end(daemon, signal.SIGTERM)
        daemon = self.start_daemon()
        self.assertIs(self.status()["estop"], False)
        self.end(daemon, signal.SIGTERM)

    def test_damaged_file_is_a_latch(self):
        self.latch.write_bytes(b"\0" * 40)
        self.start_daemon()
        self.assert_latched_since_before()
        self.assertIn("damaged", self.ctl("start").stderr)
        self.assertIn("damaged", (self.folder / "topometricd.log").read_text())
        self.clear_and_start()

    def test_what_cannot_be_kept_is_told(self):
        self.state.rmdir()
        self.start_daemon()
        self.assertEqual(self.ctl("estop").returncode, 0)
        wait_for(lambda: self.kept() == "no", "a latch that cannot be kept")
        self.assertIn("NOT kept over a restart", self.ctl("status").stdout)
        health = self.ctl("health")
        self.assertIn("not kept over a restart", health.stdout)
        self.assertIn(str(self.state), health.stdout)
        self.assertIn("control.state_folder", self.ctl("doctor").stdout)
        self.state.mkdir()
        wait_for(lambda: self.kept() == "yes", "a latch that is kept after all")


if __name__ == "__main__":
    main()
