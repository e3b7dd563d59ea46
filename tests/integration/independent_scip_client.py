#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""A SCIP 2 client that is not ours: written from the published protocol, it identifies and streams from toposim's
lasers over TCP and terminals and checks every checksum.

usage: independent_scip_client.py TOPOSIM
"""
import math
import statistics
import sys
import tempfile
import time

from sim_client_tools import Link, Simulation


def check_sum(line):
    return (sum(line) & 0x3F) + 0x30


def decode(text, digits):
    values = []
    for at in range(0, len(text), digits):
        value = 0
        for char in text[at:at + digits]:
            assert 0x30 <= char <= 0x6F, "character %r is no data" % char
            value = value << 6 | (char - 0x30)
        values.append(value)
    return values


class Scip:
    def __init__(self, device):
        self.link = Link(device)

    def reply(self, seconds=2.0):
        """Next message: echo, status, data lines with their checksums checked and cut off."""
        deadline = time.monotonic() + seconds
        while b"\n\n" not in self.link.buffer:
            self.link.fill(deadline)
        raw, self.link.buffer = self.link.buffer.split(b"\n\n", 1)
        lines = raw.split(b"\n")
        for line in lines[1:]:
            body = line[:-1]
            if lines[0][:2] in (b"VV", b"PP", b"II") and b":" in line:  # KEY:value;c - the semicolon is not summed
                body = line[:-2]
                if b"<-" in body and check_sum(body) != line[-1]:
                    body = body.split(b"<-")[0]  # UTM-30LX on USB
            assert check_sum(body) == line[-1], "checksum of %r" % line
        return lines[0].decode(), lines[1][:2].decode(), [line[:-1] for line in lines[2:]]

    def ask(self, request):
        """Sends a request and returns its reply, past scans that were under way."""
        self.link.write(request.encode() + b"\n")
        while True:
            echo, status, data = self.reply()
            if echo == request:
                return status, data

    def keys(self, request):
        status, data = self.ask(request)
        assert status == "00", (request, status)
        return dict(line.decode().rstrip(";").split(":", 1) for line in data)

    def scan(self, digits):
        echo, status, data = self.reply()
        assert status == "99", (echo, status)
        return echo, decode(data[0], 4)[0], decode(b"".join(data[1:]), digits)


def identify(scip, device):
    version = scip.keys("VV")
    assert version["SERI"] == device["serial_number"], version
    assert device["model"] in version["PROD"], version
    parameters = {key: value for key, value in scip.keys("PP").items()}
    info = scip.keys("II;who")
    assert info["LASR"] == "OFF", info
    return {key: int(value) for key, value in parameters.items() if key != "MODL"}


def clock_offset_ms(scip):
    """Sensor clock minus ours by the smallest round trip."""
    assert scip.ask("TM0")[0] == "00"
    best = None
    for _ in range(10):
        before = time.monotonic()
        status, data = scip.ask("TM1")
        after = time.monotonic()
        assert status == "00"
        sample = (after - before, decode(data[0], 4)[0] - (before + after) / 2 * 1e3)
        best = min(best, sample) if best else sample
    assert scip.ask("MD0000108001000")[0] == "10", "measuring is refused in adjust mode"
    assert scip.ask("TM2")[0] == "00"
    return best[1]


def check_room(ranges, pp, walls_m):
    """The start stands in the middle of a room of 8 x 6 m: straight ahead 4 m less the mount, left 3 m."""
    for angle, expected in walls_m.items():
        step = pp["AFRT"] + round(math.radians(angle) * pp["ARES"] / (2 * math.pi))
        near = [r for r in ranges[step - 10:step + 11] if pp["DMIN"] <= r <= pp["DMAX"]]
        assert abs(statistics.median(near) - expected) < 60, (angle, statistics.median(near), expected)


def stream(scip, pp, walls_m):
    offset = clock_offset_ms(scip)
    request = "MD%04d%04d01000" % (pp["AMIN"], pp["AMAX"])
    assert scip.ask(request)[0] == "00"
    stamps, lags = [], []
    for _ in range(20):
        echo, stamp, ranges = scip.scan(3)
        assert echo == request and len(ranges) == pp["AMAX"] - pp["AMIN"] + 1
        check_room(ranges, pp, walls_m)
        stamps.append(stamp)
        lags.append(time.monotonic() * 1e3 + offset - stamp)
    period = 60000 / pp["SCAN"]
    steps = [b - a for a, b in zip(stamps, stamps[1:])]
    assert all(abs(step - period) <= 1.5 for step in steps), steps
    # Data leave after the scan has ended, 18.75 ms behind step 0, never before.
    assert min(lags) > period * pp["AMAX"] / pp["ARES"] - 1.5, lags
    assert scip.ask("QT")[0] == "00"


def count_down(scip, pp):
    """Intensities, the remaining count, the interval and the string in the echo."""
    base = "ME%04d%04d0020" % (pp["AMIN"], pp["AMAX"])
    assert scip.ask(base + "3;c")[0] == "00"
    # Interval 2 is the third-last digit of the request above, 03 the count.
    for remaining in (2, 1, 0):
        echo, _, values = scip.scan(3)
        assert echo == base[:-1] + "%02d;c" % remaining, echo
        assert len(values) == 2 * (pp["AMAX"] - pp["AMIN"] + 1)
    try:
        scip.reply(0.3)
        raise AssertionError("a scan after the last one")
    except TimeoutError:
        pass


def single_scan(scip):
    assert scip.ask("GD0500050801")[0] == "10", "the laser is off"
    assert scip.ask("BM")[0] == "00"
    assert scip.ask("BM")[0] == "02"
    status, data = scip.ask("GD0500050801")
    assert status == "00" and len(decode(b"".join(data[1:]), 3)) == 9
    assert scip.ask("QT")[0] == "00"


def survive_faults(simulation, name, device):
    """Garbage costs a scan at most; a cut link comes back idle at the same address."""
    scip = Scip(device)
    request = "MD0000108001000"
    assert scip.ask(request)[0] == "00"
    simulation.ctl("garbage", device=name, bytes=500)
    good = bad = 0
    while good < 20:
        try:
            scip.scan(3)
            good += 1
        except (AssertionError, UnicodeDecodeError, IndexError, ValueError):
            bad += 1
    assert bad > 0, "the garbage was not seen"
    simulation.ctl("cut", device=name, seconds=0.5)
    try:
        for _ in range(1000):
            scip.reply()
        raise AssertionError("the link was not cut")
    except (ConnectionError, OSError):
        scip.link.close()
    deadline = time.monotonic() + 10
    while True:
        try:
            scip = Scip(device)
            break
        except OSError:
            assert time.monotonic() < deadline, "the link does not come back"
            time.sleep(0.05)
    scip.link.flush(0.2)
    if device["transport"] == "tcp":
        assert scip.keys("II")["LASR"] == "OFF", "a lost client leaves the sensor idle"
    else:
        assert scip.ask("QT")[0] == "00"
    scip.link.close()


def urg(simulation):
    """The URG-04LX wakes up in SCIP 1.1 and knows no intensities."""
    scip = Scip(simulation.robot["front"])
    scip.link.write(b"VV\n")
    deadline = time.monotonic() + 2
    while b"\n\n" not in scip.link.buffer:
        scip.link.fill(deadline)
    assert scip.link.buffer == b"VV\nE\n\n", scip.link.buffer
    scip.link.buffer = b""
    scip.link.write(b"SCIP2.0\n")
    while b"\n\n" not in scip.link.buffer:
        scip.link.fill(deadline)
    assert scip.link.buffer == b"SCIP2.0\n0\n\n", scip.link.buffer
    scip.link.buffer = b""
    pp = identify(scip, simulation.robot["front"])
    assert scip.ask("MS%04d%04d01000" % (pp["AMIN"], pp["AMAX"]))[0] == "00"
    for _ in range(3):
        assert len(scip.scan(2)[2]) == 682
    scip.link.close()


def main(program):
    walls_front = {0: 4000 - 21, 90: 3000, -90: 3000}
    with tempfile.TemporaryDirectory() as folder:
        for options in (["--tcp"], ["--pty", folder + "/tty"]):
            with Simulation(program, folder, *options) as simulation:
                for name in ("front", "coronal"):
                    device = simulation.robot[name]
                    scip = Scip(device)
                    pp = identify(scip, device)
                    # The coronal scanner looks up, left and right; the room is 2.5 m high where nothing else is said.
                    stream(scip, pp, walls_front if name == "front" else {90: 3000, -90: 3000})
                    count_down(scip, pp)
                    single_scan(scip)
                    scip.link.close()
                survive_faults(simulation, "front", simulation.robot["front"])
        with Simulation(program, folder, "--laser", "URG-04LX", "--pty", folder + "/tty") as simulation:
            urg(simulation)
    print("ok: an independent SCIP client identifies and streams over TCP and terminals")


if __name__ == "__main__":
    main(sys.argv[1])
