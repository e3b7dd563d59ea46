# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Inside the guest, for `can_test.py --figures`: the daemon explores the demonstration's building with its base on vcan0,
as long as asked, and every frame is weighed: load at 500 and 250 kbit/s, by direction. What is printed is the figure.

usage: can_figures.py BUILD_FOLDER SOURCE_FOLDER [SECONDS]"""
import json
import pathlib
import re
import select
import socket
import struct
import subprocess
import sys
import time

INTERFACE = "vcan0"
FOLDER = pathlib.Path("/tmp/can-figures")
STREAMS = {0x688: "stops", 0x690: "to the robot", 0x698: "from the robot", 0x6A0: "heartbeats"}
SHOWN = 45  # frames of the connection


def bits(size):
    """(without, with most) stuffing, of a frame with an 11-bit identifier and the gap behind it: PROTOCOLS section 14.2"""
    return 47 + 8 * size, 47 + 8 * size + (34 + 8 * size - 1) // 4


class Scale:
    """Weighs what is on the bus."""

    def __init__(self):
        self.bus = socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW)
        self.bus.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
        self.bus.bind((INTERFACE,))
        self.reset()
        self.first = []

    def reset(self):
        self.begin = time.monotonic()
        self.frames = {name: 0 for name in STREAMS.values()}
        self.least = self.most = 0

    def weigh(self, seconds):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if not select.select([self.bus], [], [], max(0.0, end - time.monotonic()))[0]:
                continue
            identifier, size, data = struct.unpack("=IB3x8s", self.bus.recv(16))
            if len(self.first) < SHOWN:
                self.first.append("%9.4f  %03X  [%d]  %s" % (time.monotonic(), identifier, size, data[:size].hex(" ").upper()))
            name = STREAMS.get(identifier & 0x7F8)
            if name:
                self.frames[name] += 1
            least, most = bits(size)
            self.least += least
            self.most += most

    def report(self, what):
        seconds = time.monotonic() - self.begin
        print("[figure] %s, %.0f s: frames/s %s" % (what, seconds, ", ".join(
            "%s %.1f" % (name, count / seconds) for name, count in self.frames.items())))
        print("[figure] %s: %.1f to %.1f kbit/s = %.1f to %.1f %% of 500k, %.1f to %.1f %% of 250k" % (
            what, self.least / seconds / 1e3, self.most / seconds / 1e3, self.least / seconds / 5e3,
            self.most / seconds / 5e3, self.least / seconds / 2.5e3, self.most / seconds / 2.5e3), flush=True)
        self.reset()


def configuration(source, devices):
    text = (source / "config/simulation.toml").read_text()
    for section, name in (("base", "base"), (r"scanner\.front", "front"), (r"scanner\.coronal", "coronal")):
        text = re.sub(r'(\[%s\][^\[]*?\naddress = )"[^"]*"' % section, r'\1"%s"' % devices[name]["address"], text)
    text = re.sub(r'\nsocket = "[^"]*"', '\nsocket = "%s"' % (FOLDER / "control"), text)
    (FOLDER / "robot.toml").write_text(text)


def main():
    build, source = map(pathlib.Path, sys.argv[1:3])
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 60.0
    FOLDER.mkdir(exist_ok=True)
    scale = Scale()
    with open(FOLDER / "sim.log", "w") as log, subprocess.Popen(
            [build / "bin/toposim", "--world", source / "config/worlds/office.toml", "--can", INTERFACE, "--laser", "URG-04LX",
             "--die-with-parent"], stdout=subprocess.PIPE, stderr=log, text=True) as simulator:
        configuration(source, json.loads(simulator.stdout.readline())["robots"][0])

        def operator(*words):
            told = subprocess.run([build / "bin/topoctl", "--socket", FOLDER / "control", *words], capture_output=True, text=True,
                                  check=False)
            return told.stdout + told.stderr

        with open(FOLDER / "daemon.log", "w") as told, subprocess.Popen(
                [build / "bin/topometricd", "--config", FOLDER / "robot.toml"], stdout=told, stderr=told) as daemon:
            scale.weigh(6)
            scale.report("connecting and standing")
            print(operator("doctor"))
            scale.weigh(10)
            scale.report("standing")
            print(operator("start"))
            scale.reset()
            for _ in range(int(seconds / 20)):
                scale.weigh(20)
                print(operator("status"), flush=True)
            scale.report("exploring")
            print(operator("estop"))
            scale.weigh(2)
            daemon.terminate()
            daemon.wait()
        simulator.terminate()
        simulator.wait()
    print("the first frames\n" + "\n".join(scale.first))
    print((FOLDER / "sim.log").read_text() + (FOLDER / "daemon.log").read_text()[-4000:])


if __name__ == "__main__":
    main()
