#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Maps and logs as other tools, systems and accidents leave them, small ones made here, and the folder of cases that
users reported where it stands beside the data. Graphs: topobench_posegraph_test.py.

usage: foreign_files_test.py TOPOBENCH [unittest options]
The cases are found through TOPOMETRIC_DATA (../cases of it); without it their tests say that they were skipped."""
import gzip
import io
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

from PIL import Image

TOPOBENCH = ""
CASES = pathlib.Path(os.environ["TOPOMETRIC_DATA"]) / ".." / "cases" if os.environ.get("TOPOMETRIC_DATA") else None
FREE, UNKNOWN, OCCUPIED = 254, 205, 0
WIDTH, HEIGHT = 60, 40


def room():
    """Rows of grey values: free within a wall, one pillar, nothing known around."""
    rows = [[UNKNOWN] * WIDTH for _ in range(HEIGHT)]
    for y in range(5, 35):
        for x in range(5, 55):
            wall = x in (5, 54) or y in (5, 34) or (20 <= x < 24 and 15 <= y < 19)
            rows[y][x] = OCCUPIED if wall else FREE
    return rows


def flat(rows):
    return bytes(value for row in rows for value in row)


def chunk(name, data):
    return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))


def png(rows, bits=8, extra=()):
    """Grey values times 257 in 16 bits; `extra`: chunks between head and pixels."""
    def line(row):
        return b"\0" + (bytes(row) if bits == 8 else b"".join(struct.pack(">H", 257 * v) for v in row))
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), bits, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + b"".join(chunk(*e) for e in extra) +
            chunk(b"IDAT", zlib.compress(b"".join(map(line, rows)))) + chunk(b"IEND", b""))


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = pathlib.Path(folder.name)

    def run_tool(self, *arguments):
        return subprocess.run([TOPOBENCH, *map(str, arguments)], capture_output=True, text=True, check=False)

    def read(self, *arguments):
        """The report and what was said beside it."""
        done = self.run_tool(*arguments, "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout), done.stderr

    def refused(self, arguments, *parts):
        done = self.run_tool(*arguments, "--json")
        self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)


class Maps(Files):
    def write(self, picture, name="m.pgm", keys="negate: 0\n", image=None, origin="[0.0, 0.0, 0.0]"):
        (self.path / name).write_bytes(picture)
        file = self.path / "m.yaml"
        file.write_text("image: %s\nresolution: 0.05\norigin: %s\noccupied_thresh: 0.65\nfree_thresh: 0.196\n%s" %
                        (image or name, origin, keys))
        return file

    def cells(self, *arguments, **keys):
        """What the analysis knows of the map: all of it, where each cell was read as the one that it is."""
        report, said = self.read("analyse", "--map", self.write(*arguments, **keys))
        return (report["known_cells"], report["places"], report["walls"]), said

    def test_numbers_are_numbers_in_every_form(self):
        rows = room()
        pgm = b"P5\n%d %d\n255\n" % (WIDTH, HEIGHT) + flat(rows)
        expected, said = self.cells(pgm)
        self.assertEqual((expected[0], said), (50 * 30, ""))
        wide = b"P5\n%d %d\n65535\n" % (WIDTH, HEIGHT) + b"".join(struct.pack(">H", 257 * v) for v in flat(rows))
        profile = chunk(b"iCCP", b"x\0\0" + zlib.compress(b"no profile"))[8:-4]
        inverted = b"P5\n%d %d\n255\n" % (WIDTH, HEIGHT) + bytes(255 - v for v in flat(rows))
        coloured, palette = io.BytesIO(), io.BytesIO()
        Image.frombytes("L", (WIDTH, HEIGHT), flat(rows)).convert("RGB").save(coloured, "PNG")
        Image.frombytes("L", (WIDTH, HEIGHT), flat(rows)).convert("P").save(palette, "PNG")
        for name, picture, keys in (
                ("m.pgm", wide, {}),
                ("m.pgm", pgm.replace(b"\n", b"\r\n", 3), {}),
                ("m.pgm", b"P2\r\n%d %d\r\n255\r\n" % (WIDTH, HEIGHT) + " ".join(map(str, flat(rows))).encode(), {}),
                ("m.png", png(rows), {}),
                ("m.png", png(rows, extra=[(b"gAMA", struct.pack(">I", 100000))]), {}),
                ("m.png", png(rows, extra=[(b"gAMA", struct.pack(">I", 22727))]), {}),
                ("m.png", png(rows, extra=[(b"iCCP", profile)]), {}),
                ("m.png", png(rows, extra=[(b"sRGB", b"\0"), (b"tEXt", b"a\0b")]), {}),
                ("m.png", png(rows, 16), {}),
                ("m.png", png(rows, 16, extra=[(b"gAMA", struct.pack(">I", 45455))]), {}),
                ("m.png", coloured.getvalue(), {}),
                ("m.png", palette.getvalue(), {}),
                ("m.pgm", inverted, {"keys": "negate: yes\n"}),
                ("m.pgm", inverted, {"keys": "negate: True\n"}),
                ("m.pgm", pgm, {"keys": "negate: No\n"}),
                ("m.pgm", pgm, {"keys": "negate: off\n"})):
            with self.subTest(name, keys=keys, head=picture[:60]):
                self.assertEqual(self.cells(picture, name=name, **keys), (expected, ""))

    def test_pictures_and_yaws_of_other_computers_are_taken_with_a_warning(self):
        pgm = b"P5\n%d %d\n255\n" % (WIDTH, HEIGHT) + flat(room())
        expected, _ = self.cells(pgm)
        for image in ("/nowhere/maps/m.pgm", "'D:\\maps\\m.pgm'", "old/m.pgm"):
            cells, said = self.cells(pgm, image=image)
            self.assertEqual(cells, expected)
            self.assertIn("is not there, took", said)
        for yaw in ("-nan", "nan", ".nan", "-nan(ind)"):
            cells, said = self.cells(pgm, origin="[0.000000, 0.000000, %s]" % yaw)
            self.assertEqual(cells, expected)
            self.assertIn("took the yaw", said)

    def test_a_picture_that_may_be_shifted_is_refused(self):
        pgm = b"P5\r\n%d %d\r\n255\r\n" % (WIDTH, HEIGHT) + flat(room())
        self.refused(("analyse", "--map", self.write(pgm + b"\r\n")), "m.pgm", "a text converter?")

    def test_the_simulator_reads_them_too(self):
        rows = room()
        pgm = b"P5\n%d %d\n255\n" % (WIDTH, HEIGHT) + flat(rows)
        def area(*arguments, **keys):
            return self.read("bound", "--world", self.write(*arguments, **keys), "--robots", 1)[0]["reachable_m2"]
        expected = area(pgm)
        self.assertGreater(expected, 3.0)
        wide = b"P5\n%d %d\n65535\n" % (WIDTH, HEIGHT) + b"".join(struct.pack(">H", 257 * v) for v in flat(rows))
        for name, picture, keys in (("m.pgm", pgm.replace(b"\n", b"\r\n", 3), {}), ("m.pgm", wide, {}),
                                    ("m.png", png(rows, 16), {}),
                                    ("m.png", png(rows, extra=[(b"gAMA", struct.pack(">I", 100000))]), {}),
                                    ("m.pgm", pgm, {"keys": "negate: False\n"}),
                                    ("m.pgm", pgm, {"image": "/nowhere/m.pgm"}),
                                    ("m.pgm", pgm, {"origin": "[0, 0, -nan]"})):
            with self.subTest(name, keys=keys):
                self.assertEqual(area(picture, name=name, **keys), expected)


def ranges(x, y, theta, first_deg, step_deg, count):
    """Of beams in a room from (-3, -2) to (7, 4)."""
    out = []
    for k in range(count):
        angle = theta + math.radians(first_deg + k * step_deg)
        c, s = math.cos(angle), math.sin(angle)
        ways = [(7 - x) / c if c > 1e-9 else (-3 - x) / c if c < -1e-9 else 1e9,
                (4 - y) / s if s > 1e-9 else (-2 - y) / s if s < -1e-9 else 1e9]
        out.append("%.3f" % min(ways))
    return " ".join(out)


class Logs(Files):
    SCANS = 40

    def drive(self):
        for i in range(self.SCANS):
            yield 0.05 * i, 0.01 * i, 0.01 * i, 100.0 + 0.2 * i

    def flaser(self, name="FLASER", first_deg=-90.0, step_deg=1.0, count=181):
        return ["%s %d %s %f %f %f %f %f %f %f nohost %f" %
                (name, count, ranges(x, y, t, first_deg, step_deg, count), x, y, t, x, y, t, s, s - 100)
                for x, y, t, s in self.drive()]

    def sweep(self, name, tail):
        """ROBOTLASER and RAWLASER; `tail` of the pose."""
        return ["%s 0 -1.570796 3.141593 0.017453 30.0 0.01 0 181 %s 0 %s%f nohost %f" %
                (name, ranges(x, y, t, -90, 1, 181), tail(x, y, t), s, s - 100) for x, y, t, s in self.drive()]

    def odometry(self):
        return ["ODOM %f %f %f 0.25 0 0 %f nohost %f" % (x, y, t, s, s - 100) for x, y, t, s in self.drive()]

    def write(self, lines, begin=b"", end="\n", name="a.log"):
        file = self.path / name
        content = begin + ("\n".join(lines) + end).encode()
        file.write_bytes(gzip.compress(content) if name.endswith(".gz") else content)
        return file

    def mapped(self, file, *options):
        report, said = self.read("slam", "--log", file, *options, "--out", self.path / "out")
        last = (self.path / "out" / "trajectory.txt").read_text().splitlines()[-1].split()
        self.assertEqual(report["lost"], 0)
        self.assertLess(math.dist((float(last[1]), float(last[2])), (0.05 * (report["scans"] - 1),
                                                                    0.01 * (report["scans"] - 1))), 0.03, last)
        return report["scans"], said

    def test_messages_of_all_layouts(self):
        poses = lambda x, y, t: "%f %f %f %f %f %f 0 0 0 0 0 " % (x, y, t, x, y, t)
        for lines in (self.flaser(), self.flaser("RLASER"), self.sweep("ROBOTLASER1", poses),
                      self.sweep("ROBOTLASER2", poses), self.flaser(step_deg=0.25, first_deg=-135, count=1081)):
            self.assertEqual(self.mapped(self.write(lines)), (self.SCANS, ""))
        raw = [line for pair in zip(self.odometry(), self.sweep("RAWLASER1", lambda *_: "")) for line in pair]
        scans, said = self.mapped(self.write(raw))
        self.assertEqual(scans, self.SCANS)
        self.assertIn("took the poses of RAWLASER1 from ODOM", said)
        self.refused(("slam", "--log", self.write(self.sweep("RAWLASER1", lambda *_: ""))), "40 of RAWLASER1",
                     "0 of ODOM")
        self.refused(("slam", "--log", self.write(["LASER3 1 2 3", "ODOM 0 0 0 0 0 0 1 h 1"])), "1 of ODOM",
                     "1 of LASER3")

    def test_foreign_lines_are_passed_over_and_said_once(self):
        lines = self.flaser()
        for at, line in ((5, "$GPGGA,123519,4807.038,N,01131.000,E,1,08"), (9, "imu 0.1 0.2"), (20, "imu 0.1 0.2"),
                         (21, "\x00\x01\x02")):
            lines.insert(at, line)
        report, said = self.read("slam", "--log", self.write(lines, begin=b"\xef\xbb\xbf", name="a.log.gz"))
        self.assertEqual((report["scans"], report["foreign_lines"]), (self.SCANS, 4))
        self.assertEqual(said.count("\n"), 1, said)
        self.assertIn("2 of imu (the first in line 10)", said)

    def test_a_cut_last_line_costs_that_line(self):
        lines = self.flaser()
        for cut in (lines[-1][:500], lines[-1][:-30], "FLA"):
            scans, said = self.mapped(self.write(lines[:-1] + [cut], end=""))
            self.assertEqual(scans, self.SCANS - 1)
            self.assertEqual("passed over the last line" in said, cut != "FLA", said)
        self.assertEqual(self.mapped(self.write(lines, end="")), (self.SCANS, ""))
        self.refused(("slam", "--log", self.write(lines[:3] + [lines[3][:500]] + lines[4:])), ":4: found")

    def test_beams_of_no_known_scanner_are_refused_until_said(self):
        lines = self.flaser(first_deg=-60, step_deg=0.75, count=161)
        self.refused(("slam", "--log", self.write(lines)), ":1: found 161 ranges in FLASER", "--beams START,STEP")
        self.assertEqual(self.mapped(self.write(lines), "--beams=-60,0.75"), (self.SCANS, ""))
        scans, said = self.mapped(self.write(["PARAM laser_front_laser_resolution 0.75 1 h 1"] + lines))
        self.assertEqual(scans, self.SCANS)
        self.assertIn("161 beams of 0.75 degrees from -60", said)
        # A known number of beams, and a log that says otherwise: the log holds.
        narrow = self.flaser(first_deg=-45, step_deg=0.5, count=181)
        _, said = self.mapped(self.write(["PARAM laser_front_laser_resolution 0.5 1 h 1"] + narrow))
        self.assertIn("181 beams of 0.5 degrees from -45", said)


@unittest.skipUnless(CASES and CASES.is_dir(), "TOPOMETRIC_DATA is not set or has no ../cases: none was tried")
class Cases(Files):
    def test_maps(self):
        expected = self.read("analyse", "--map", CASES / "maps" / "base.yaml")[0]["known_cells"]
        for file in sorted((CASES / "maps").glob("*.yaml")):
            with self.subTest(file.name):
                if not any(file.parent.joinpath(line.split()[1].rsplit("/", 1)[-1]).exists()
                           for line in file.read_text().splitlines() if line.startswith("image:")):
                    self.refused(("analyse", "--map", file), "No such file")  # its picture is not in the folder
                    continue
                report, said = self.read("analyse", "--map", file)
                self.assertEqual(report["known_cells"], expected)
                self.assertEqual(bool(said), file.stem in ("abs", "nan_yaw"), said)

    def test_graphs(self):
        refused = {"comma", "noinfo", "se3", "space", "toro_order", "isam", "isam_odometry", "prior", "landmark", "switch"}
        said_once = {"equiv", "params", "robotlaser"}
        for file in sorted((CASES / "graphs").iterdir()):
            with self.subTest(file.name):
                if file.stem in refused:
                    self.refused(("posegraph", file), file.name + ":", "expected")
                    continue
                said = self.read("posegraph", file)[1]
                self.assertEqual(said.count("\n"), 1 if file.stem in said_once else 0, said)

    def test_logs(self):
        for file in sorted((CASES / "logs").glob("*.log.gz")):
            with self.subTest(file.name):
                report, said = self.read("slam", "--log", file)
                self.assertGreaterEqual(report["scans"], 90)
                self.assertEqual(report["lost"], 0)
                self.assertEqual(bool(said), file.name.split(".")[0] in ("nmea", "lower", "raw1"), said)


if __name__ == "__main__":
    TOPOBENCH = sys.argv.pop(1)
    unittest.main()
