#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""The daemon is killed (SIGKILL) while its robot drives at full speed. Where does the robot stop, with nothing but the
firmware's watchdog and with topometric-estop as the service runs it; and do the wheels ever turn by themselves when a
daemon comes back?

usage: kill_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]
What the robot does is read from the simulator's truth; the daemon sees its wires only."""
import math
import subprocess
import sys
import time

from robot_processes import PATIENCE_S, RobotProcesses, main, wait_for

V_MAX_MPS = 0.7
DECELERATION_MPS2 = 0.3  # the least of what the firmware and the configuration brake with
WATCHDOG_S = 2.0
COMMAND_AGE_S = 0.3  # the daemon sends a setpoint every 50 ms; a busy machine may be late
HALL = """
[[start]]
x_m = 2.0
y_m = 5.0
[[wall]]
points_m = [[-0.1, -0.1], [30.1, -0.1], [30.1, 10.1], [-0.1, 10.1]]
closed = true
thickness_m = 0.2
"""


class KilledAtFullSpeed(RobotProcesses):
    def setUp(self):
        super().setUp()
        world = self.folder / "hall.toml"
        world.write_text(HALL)
        _, devices = self.start_simulator(world)
        self.write_config(devices)

    def start_daemon(self):
        daemon = self.start("topometricd", "--config", self.config)
        wait_for(lambda: self.base().get("working"), "a daemon with its base")
        return daemon

    def base(self):
        return self.status().get("devices", {}).get("base", {})

    def truth(self):
        answer = self.simulator_says("truth")
        return answer["sim_s"], answer["robots"][0]

    def device(self):
        return self.simulator_says("status")["robots"][0]["base"]

    def speed(self):
        (t0, a), (t1, b) = self.truth(), (time.sleep(0.05), self.truth())[1]
        return (b["path_m"] - a["path_m"]) / (t1 - t0) if t1 > t0 else math.nan

    def drive_at_full_speed(self):
        """A person drives; the daemon's stop zone is 20 m from the wall, so that nothing limits the speed."""
        driver = self.start("topoctl", "--socket", self.socket, "drive", V_MAX_MPS, 0, "--for", 30,
                            stdout=subprocess.DEVNULL)
        wait_for(lambda: self.speed() > 0.95 * V_MAX_MPS, "full speed")
        return driver

    def way_until_it_stands(self, before_m):
        wait_for(lambda: self.speed() == 0.0, "a robot that stands")
        return self.truth()[1]["path_m"] - before_m

    def stands_when_a_daemon_comes_back(self):
        """From before the connection until four seconds after it: not a millimetre, not a milliradian."""
        before = self.truth()[1]
        daemon = self.start_daemon()
        end = time.monotonic() + 4.0
        while time.monotonic() < end:
            self.assertEqual(self.truth()[1], before, "the wheels turned by themselves")
            time.sleep(0.05)
        self.assertEqual(self.base()["working"], True)
        self.assertEqual(self.device()["state"], "open")
        return daemon

    def drives_again_when_told(self):
        before_m = self.truth()[1]["path_m"]
        self.assertEqual(self.ctl("drive", "0.2", "0", "--for", "1").returncode, 0)
        self.assertGreater(self.truth()[1]["path_m"], before_m + 0.02)

    def test_the_firmware_stops_it_and_the_next_daemon_leaves_it_standing(self):
        daemon = self.start_daemon()
        self.drive_at_full_speed()
        before_m = self.truth()[1]["path_m"]
        daemon.kill()
        daemon.wait()
        way_m = self.way_until_it_stands(before_m)
        bound_m = V_MAX_MPS * (WATCHDOG_S + COMMAND_AGE_S) + V_MAX_MPS**2 / (2 * DECELERATION_MPS2)
        print("killed at %.2f m/s: stands %.2f m on (watchdog %.0f s; at most %.2f m)" %
              (V_MAX_MPS, way_m, WATCHDOG_S, bound_m), file=sys.stderr)
        self.assertTrue(self.device()["watchdog_holds"])
        self.assertLess(way_m, bound_m)
        self.stands_when_a_daemon_comes_back()
        self.drives_again_when_told()

    def test_the_helper_stops_it_within_a_second(self):
        daemon = self.start_daemon()
        self.drive_at_full_speed()
        refused = subprocess.run([self.programs / "topometric-estop", "--config", self.config], capture_output=True, text=True,
                                 timeout=PATIENCE_S)
        self.assertEqual(refused.returncode, 3, refused)  # the daemon lives: its port is its own
        before_m = self.truth()[1]["path_m"]
        daemon.kill()
        daemon.wait()
        begin = time.monotonic()
        done = subprocess.run([self.programs / "topometric-estop", "--config", self.config], capture_output=True, text=True,
                              timeout=PATIENCE_S)
        seconds = time.monotonic() - begin
        self.assertEqual(done.returncode, 0, done)
        self.assertIn("the robot stands", done.stdout)
        way_m = self.way_until_it_stands(before_m)
        print("killed at %.2f m/s, topometric-estop after it (%.2f s): stands %.2f m on" % (V_MAX_MPS, seconds, way_m),
              file=sys.stderr)
        self.assertLess(way_m, V_MAX_MPS * WATCHDOG_S)
        self.assertEqual((self.device()["state"], self.device()["motors_on"]), ("wait", False))
        self.stands_when_a_daemon_comes_back()
        self.drives_again_when_told()

    def test_a_daemon_that_comes_back_at_once_stops_it(self):
        """Before the watchdog bites: the first bytes on the port are E_STOP, VEL 0, RVEL 0, CLOSE."""
        daemon = self.start_daemon()
        self.drive_at_full_speed()
        before_m = self.truth()[1]["path_m"]
        daemon.kill()
        daemon.wait()
        self.start_daemon()
        way_m = self.way_until_it_stands(before_m)
        print("killed at %.2f m/s, a new daemon at once: stands %.2f m on" % (V_MAX_MPS, way_m), file=sys.stderr)
        self.assertLess(way_m, V_MAX_MPS * WATCHDOG_S)
        before = self.truth()[1]
        end = time.monotonic() + 3.0
        while time.monotonic() < end:
            self.assertEqual(self.truth()[1], before, "the wheels turned by themselves")
            time.sleep(0.05)


if __name__ == "__main__":
    main()
