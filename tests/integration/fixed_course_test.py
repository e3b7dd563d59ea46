#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""topometricd and toposim as real processes on real transports: a robot is driven on a fixed course through a drawn
building, and its map is held against the truth.

usage: fixed_course_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]
The driver steers by what the daemon says of the robot's place, never by the simulator's truth. TOPOMETRIC_OUT names a
folder that keeps map, trajectory and truth; TOPOMETRIC_COURSE=whole drives all the way round (about three minutes)."""
import json
import math
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import time

from robot_processes import RobotProcesses, main, wait_for

WORLD = "config/worlds/course.toml"
SHORT = [(7.0, 0.0), (15.9, 0.0), (15.9, 3.0)]  # in map: metres from the start
WHOLE = SHORT + [(15.9, 12.8), (7.0, 12.8), (-1.9, 12.8), (-1.9, 0.0), (2.0, 0.0)]


class Client:
    """One connection to the control socket: JSON-RPC 2.0, one object a line."""

    def __init__(self, path):
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.socket.settimeout(10.0)
        self.socket.connect(str(path))
        self.file = self.socket.makefile("rw")
        self.number = 0

    def call(self, method, **params):
        self.number += 1
        self.file.write(json.dumps({"jsonrpc": "2.0", "id": self.number, "method": method, "params": params}) + "\n")
        self.file.flush()
        answer = json.loads(self.file.readline())
        if "error" in answer:
            raise RuntimeError("%s: %s" % (method, answer["error"]))
        return answer["result"]

    def close(self):
        self.file.close()
        self.socket.close()


def wrap(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


def steer(pose, target):
    """Turn towards the target, then drive; slower the more the nose is off and the nearer it is."""
    dx, dy = target[0] - pose[0], target[1] - pose[1]
    off = wrap(math.atan2(dy, dx) - pose[2])
    turn = max(-0.7, min(0.7, 1.5 * off))
    if abs(off) > 0.5:
        return 0.0, turn
    return max(0.08, min(0.45, 0.9 * math.hypot(dx, dy))) * math.cos(off), turn


class FixedCourse(RobotProcesses):
    def follow(self, client, course):
        for target in course:
            end = time.monotonic() + 90.0
            while True:
                self.assertLess(time.monotonic(), end, "the robot does not get to %s: %s" % (target, client.call("status")))
                status = client.call("status")
                pose = status["pose"]["x_m"], status["pose"]["y_m"], status["pose"]["theta_rad"]
                if math.hypot(target[0] - pose[0], target[1] - pose[1]) < 0.25:
                    break
                v, omega = steer(pose, target)
                client.call("drive", v_mps=v, omega_radps=omega)
                time.sleep(0.05)
        client.call("stop")

    def judge(self, saved):
        done = subprocess.run([str(self.programs / "topobench"), "judge", "--world", str(self.source / WORLD),
                               "--map", str(saved / "map.yaml"), "--truth", str(self.folder / "truth.tsv"), "--json"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def test_the_map_agrees_with_the_truth(self):
        simulator, devices = self.start_simulator(self.source / WORLD, "--tcp", "--seed", 3, "--truth",
                                                  self.folder / "truth.tsv")
        self.write_config(devices)
        daemon = self.start("topometricd", "--config", self.config)
        wait_for(self.socket.exists, "the control socket")
        client = Client(self.socket)
        self.addCleanup(client.close)
        wait_for(lambda: client.call("health")["healthy"] and client.call("status")["map"]["keyframes"] > 0,
                 "a healthy robot with a map")
        whole = os.environ.get("TOPOMETRIC_COURSE") == "whole"
        self.follow(client, WHOLE if whole else SHORT)
        saved = self.folder / "map"
        client.call("map.save", dir=str(saved))
        status, latency = client.call("status"), client.call("latency")
        daemon.send_signal(signal.SIGTERM)
        self.assertEqual(daemon.wait(5.0), 0)
        simulator.send_signal(signal.SIGTERM)
        self.assertEqual(simulator.wait(5.0), 0)

        self.assertEqual(status["map"]["scans_lost"], 0)
        found = self.judge(saved)
        print("keyframes against the truth: %s; %s; %s" % (json.dumps(found), json.dumps(status["map"]), json.dumps(latency)),
              file=sys.stderr)
        self.keep(saved)
        self.assertGreater(found["poses"], 10)
        self.assertLess(found["ate_fitted_rmse_m"], 0.08)
        self.assertLess(found["ate_fitted_worst_m"], 0.25)
        for name in ("map.pgm", "map.yaml", "cloud.ply"):
            self.assertGreater((saved / name).stat().st_size, 100, name)

    def keep(self, saved):
        if "TOPOMETRIC_OUT" not in os.environ:
            return
        out = pathlib.Path(os.environ["TOPOMETRIC_OUT"])
        shutil.copytree(saved, out / "fixed_course", dirs_exist_ok=True)
        shutil.copy(self.folder / "truth.tsv", out / "fixed_course")
        shutil.copy(self.folder / "topometricd.log", out / "fixed_course")


if __name__ == "__main__":
    main()
