#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""An ARCOS client that is not ours: written from the published protocol, it connects to toposim's base as ARIA does,
drives it, is killed and comes back, and sees what a real firmware does after its watchdog.

usage: independent_arcos_client.py TOPOSIM
"""
import json
import os
import signal
import struct
import subprocess
import sys
import tempfile
import time

from sim_client_tools import Link, Simulation

PULSE, OPEN, CLOSE, ENABLE, SETV, VEL, CONFIG, ENCODER, RVEL = 0, 1, 2, 4, 6, 11, 18, 19, 21
HOSTBAUD, E_STOP = 50, 55


def check_sum(payload):
    total = 0
    for high, low in zip(payload[0::2], payload[1::2]):
        total = (total + (high << 8 | low)) & 0xFFFF
    return total ^ payload[-1] if len(payload) % 2 else total


def frame(number, value=None):
    payload = bytes([number])
    if value is not None:
        payload += bytes([0x1B if value < 0 else 0x3B]) + struct.pack("<H", abs(value))
    return b"\xfa\xfb" + bytes([len(payload) + 2]) + payload + struct.pack(">H", check_sum(payload))


class Sip:
    def __init__(self, payload):
        (self.kind, self.x, self.y, self.th, self.left, self.right, self.battery, self.stall_bump, _, self.flags, _,
         count) = struct.unpack_from("<BHHhhhBHHHBB", payload)
        self.sonar = {}
        for i in range(count):
            index, value = struct.unpack_from("<BH", payload, 20 + 3 * i)
            self.sonar[index] = value
        assert len(payload) == 37 - 5 + 3 * count, "all fields through FAULTFLAGS"
        self.motors, self.button, self.e_stall = self.flags & 1, self.flags >> 5 & 1, self.flags >> 6 & 1


class Arcos:
    def __init__(self, device, speed=9600):
        self.link = Link(device, speed)
        self.bad = 0

    def send(self, number, value=None):
        self.link.write(frame(number, value))
        time.sleep(0.004)  # the firmware wants 3 to 5 ms between commands

    def packet(self, seconds=1.5):
        """Payload of the next good packet."""
        deadline = time.monotonic() + seconds
        while True:
            data = self.link.buffer
            start = data.find(b"\xfa\xfb")
            if start >= 0 and len(data) >= start + 3 and len(data) >= start + 3 + data[start + 2]:
                end = start + 3 + data[start + 2]
                payload = data[start + 3:end - 2]
                if payload and struct.pack(">H", check_sum(payload)) == data[end - 2:end]:
                    self.link.buffer = data[end:]
                    return payload
                self.bad += 1
                self.link.buffer = data[start + 2:]
                continue
            if start < 0:
                self.link.fill(deadline)
            else:
                self.fill_or_skip(start, deadline)

    def fill_or_skip(self, start, deadline, silence=0.3):
        """More of the packet that begins there. One that a reset cut short has no more: what came after it counts."""
        try:
            self.link.fill(min(deadline, time.monotonic() + silence))
        except TimeoutError:
            if time.monotonic() >= deadline:
                raise
            self.bad += 1
            self.link.buffer = self.link.buffer[start + 2:]

    def sip(self):
        while True:
            payload = self.packet()
            if payload[0] & 0xF0 == 0x30:
                return Sip(payload)

    def sips_for(self, seconds, feed=None):
        deadline = time.monotonic() + seconds
        got = []
        while time.monotonic() < deadline:
            if feed is not None:
                self.send(feed)
            got.append(self.sip())
        return got

    def until(self, condition, what, seconds=5.0, feed=PULSE):
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            if feed is not None:
                self.send(feed)
            sip = self.sip()
            if condition(sip):
                return sip
        raise AssertionError("not seen in %g s: %s" % (seconds, what))

    def synchronise(self, serial):
        if serial:
            self.link.write(b"WMS2\r")  # ARIA's radio-modem attach comes first
        for step in (0, 1):
            self.send(step)
            assert self.packet() == bytes([step])
        self.send(2)
        name = self.packet()
        assert name[0] == 2
        return [part.decode() for part in name[1:].split(b"\0")[:3]]

    def open(self, serial):
        names = self.synchronise(serial)
        time.sleep(0.1)
        self.send(OPEN, 1)
        return names

    def config(self):
        self.send(CONFIG, 1)
        while True:
            payload = self.packet()
            if payload[0] == 0x20:
                break
        texts = payload[1:].split(b"\0", 3)[:3]
        at = 1 + sum(len(text) + 1 for text in texts)
        four, rot_top, trans_top, rot_acc, trans_acc, _ = struct.unpack_from("<BHHHHH", payload, at)
        at += 11
        at = payload.index(b"\0", at) + 1
        cycle, baud, _, _, front, rear, low, rev, watchdog = struct.unpack_from("<BBBHHBHHH", payload, at)
        return {"subtype": texts[1].decode(), "four_motors": four, "trans_top": trans_top, "cycle": cycle,
                "watchdog": watchdog, "baud": baud, "rear_sonar": rear, "front_sonar": front}


def connect_and_read(robot, serial, subclass):
    names = robot.open(serial)
    assert names[1:] == ["Pioneer", subclass], names
    sip = robot.sip()
    assert sip.kind == 0x32 and not sip.motors
    config = robot.config()
    assert config["subtype"] == subclass and config["watchdog"] == 2000 and config["cycle"] == 100, config
    assert config["trans_top"] > 0 and config["front_sonar"] == 1
    robot.send(62, 1)  # BATTERYINFO, which ARIA always sends: unknown and ignored


def drive(robot, simulation):
    before = simulation.truth()
    robot.send(SETV, 400)
    robot.send(VEL, 300)
    sips = robot.sips_for(0.5, PULSE)
    assert max(sip.left for sip in sips) == 0, "motors are off after OPEN"
    robot.send(VEL, 0)
    robot.send(ENABLE, 1)
    robot.until(lambda sip: sip.motors, "motors on")
    robot.send(VEL, 250)
    # Skip the SIPs that were under way: each leaves up to 60 ms late.
    start = robot.sip()
    moving = robot.until(lambda sip: sip.left == 250 and sip.right == 250, "250 mm/s")
    assert moving.kind == 0x33
    end = robot.until(lambda sip: sip.x - start.x >= 500, "half a metre of odometry")
    robot.send(VEL, 0)
    robot.until(lambda sip: sip.kind == 0x32, "standing again")
    after = simulation.truth()
    way = after["x_m"] - before["x_m"]
    assert 0.45 < way < 1.0, way
    assert end.sonar is not None
    sonar = {}
    for sip in robot.sips_for(1.0, PULSE):
        sonar.update(sip.sonar)
    assert set(sonar) == set(range(16)), sorted(sonar)
    # The front sonars 3 and 4 look at the wall at x = 8 m, or beyond their 5 m.
    expected = (8.0 - after["x_m"] - 0.166) * 1e3
    assert min(abs(sonar[i] - expected) for i in (3, 4)) < 200, (sonar, expected)
    robot.send(RVEL, 30)
    turning = robot.until(lambda sip: sip.right > 0 > sip.left, "turning left")
    robot.send(RVEL, 0)
    robot.until(lambda sip: sip.kind == 0x32, "standing after the turn")
    assert turning.right == -turning.left or abs(turning.right + turning.left) <= 2


def watchdog_resumes(robot, simulation):
    """The danger: the last setpoint comes back with any packet."""
    robot.send(VEL, -150)
    robot.until(lambda sip: sip.left == -150, "-150 mm/s")
    robot.sips_for(2.8)  # not a word
    silent = robot.sip()
    assert silent.left == silent.right == 0, "the watchdog has stopped it, the stream goes on"
    stood = simulation.truth()
    robot.send(PULSE)
    robot.until(lambda sip: sip.left == -150, "the old setpoint again, by a PULSE", feed=None, seconds=1.9)
    assert simulation.truth() != stood
    robot.send(E_STOP)
    robot.send(VEL, 0)
    robot.until(lambda sip: sip.kind == 0x32, "stopped")


def see_faults(robot, simulation):
    simulation.ctl("stop-button", pressed=True)
    robot.until(lambda s: s.button and s.e_stall and not s.motors and s.stall_bump & 0x0101 == 0x0101, "STOP button")
    simulation.ctl("stop-button", pressed=False)
    robot.until(lambda s: not s.button and not s.motors, "button released, motors still off")
    robot.send(ENABLE, 1)
    robot.until(lambda s: s.motors, "motors on again")
    simulation.ctl("bumper", front=3, rear=4, seconds=1)
    robot.until(lambda s: s.stall_bump == 3 << 9 | 4 << 1, "bumper bits")
    simulation.ctl("battery", volts=11.2)
    robot.until(lambda s: s.battery == 112, "battery")


def hit_an_obstacle(robot, simulation):
    before = simulation.truth()["collisions"]
    simulation.ctl("obstacle", distance_m=0.3)
    robot.send(VEL, 200)
    robot.until(lambda s: s.stall_bump & 0xFE00 and s.stall_bump & 0x0101, "front bumpers and stall at the box", 10)
    robot.send(VEL, 0)
    assert simulation.truth()["collisions"] == before + 1
    robot.send(VEL, -100)
    robot.until(lambda s: s.stall_bump == 0, "free again")
    robot.send(VEL, 0)


def killed_and_back(simulation, device, speed):
    """A driving client dies; the next one finds its session."""
    child = subprocess.Popen([sys.executable, os.path.abspath(__file__), "--drive", json.dumps(device), str(speed)],
                             stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "driving\n"
    child.send_signal(signal.SIGKILL)
    child.wait()
    child.stdout.close()
    robot = Arcos(device, speed)
    robot.send(0)
    assert robot.packet()[0] & 0xF0 == 0x30, "SYNC0 is a PULSE to an open session: SIPs, no echo"
    for number, value in ((E_STOP, None), (VEL, 0), (RVEL, 0), (CLOSE, 1)):
        robot.send(number, value)
    robot.link.flush(0.3)
    robot.open(device["transport"] == "pty")
    assert not robot.sip().motors
    return robot


def drive_until_killed(device, speed):
    robot = Arcos(device, speed)
    robot.open(device["transport"] == "pty")
    robot.send(ENABLE, 1)
    robot.send(RVEL, 20)
    robot.until(lambda sip: sip.kind == 0x33, "driving")
    print("driving", flush=True)
    while True:
        robot.sips_for(0.2, PULSE)


def reset(robot, simulation):
    simulation.ctl("reset", device="base")
    deadline = time.monotonic() + 2
    while robot.packet()[0] != 0xFF:
        assert time.monotonic() < deadline, "no 0xFF"
    robot.link.flush(0.2)
    robot.send(1)
    assert robot.packet() == b"\xff", "wrong order of the handshake"
    robot.open(False)
    robot.sip()


def scan_rates(device):
    """Only one speed of the terminal gives packets: Player's order of trying."""
    robot = Arcos(device)
    for speed in (38400, 115200, 57600, 19200):
        robot.link.set_speed(speed)
        robot.link.write(frame(0) + frame(0))
        try:
            robot.packet(0.15)
            raise AssertionError("an answer at %d bit/s" % speed)
        except TimeoutError:
            robot.link.buffer = b""
    robot.link.set_speed(9600)
    robot.open(True)
    robot.sip()
    robot.send(HOSTBAUD, 4)
    time.sleep(0.01)
    robot.link.set_speed(115200)
    time.sleep(0.01)
    robot.send(PULSE)
    robot.link.flush(0.1)
    robot.bad = 0
    robot.sip()
    assert robot.config()["baud"] == 4 and robot.bad == 0
    robot.send(CLOSE, 1)
    time.sleep(0.05)
    robot.link.close()


def pacing(device):
    """At 9600 bit/s a packet of 37 bytes and more takes 38 ms and more: it comes in pieces."""
    robot = Arcos(device)
    robot.open(True)
    robot.sip()
    first = None
    robot.link.buffer = b""
    deadline = time.monotonic() + 2
    while len(robot.link.buffer) < 37:
        robot.link.fill(deadline)
        first = first or (time.monotonic(), len(robot.link.buffer))
    seconds = time.monotonic() - first[0]
    rate = (len(robot.link.buffer) - first[1]) / seconds if seconds > 0 else float("inf")
    assert rate < 2000, "bytes came at %g a second" % rate
    robot.send(CLOSE, 1)
    time.sleep(0.05)
    robot.link.close()


def session(program, folder, model, options, serial):
    with Simulation(program, folder, "--model", model, *options) as simulation:
        device = simulation.robot["base"]
        if serial:
            scan_rates(device)
            pacing(device)
        robot = Arcos(device)
        connect_and_read(robot, serial, model + "-sh")
        drive(robot, simulation)
        if not serial:  # once is enough: these do not depend on the wire
            watchdog_resumes(robot, simulation)
            see_faults(robot, simulation)
            hit_an_obstacle(robot, simulation)
        robot.send(CLOSE, 1)
        time.sleep(0.05)
        robot.link.close()
        robot = killed_and_back(simulation, device, 9600)
        reset(robot, simulation)
        robot.send(CLOSE, 1)
        robot.link.flush(0.2)
        robot.link.close()


def main(arguments):
    if arguments[0] == "--drive":
        drive_until_killed(json.loads(arguments[1]), int(arguments[2]))
    with tempfile.TemporaryDirectory() as folder:
        session(arguments[0], folder, "p3dx", ["--tcp"], False)
        session(arguments[0], folder, "p3at", ["--pty", folder + "/tty"], True)
    print("ok: an independent ARCOS client connects, drives, dies, comes back and sees the old setpoint resumed")


if __name__ == "__main__":
    main(sys.argv[1:])
