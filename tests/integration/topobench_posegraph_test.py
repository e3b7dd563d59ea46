#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""topobench posegraph as a user runs it: small graphs reckoned by hand, bad files, and the benchmarks' graphs when
they are here.

usage: topobench_posegraph_test.py TOPOBENCH [unittest options]
The benchmarks are found through TOPOMETRIC_DATA; without it their tests say that they were skipped."""
import bz2
import gzip
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOPOBENCH = ""
DATA = os.environ.get("TOPOMETRIC_DATA", "")
EYE = "1 0 0 1 0 1"
G2O = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\n"
# Known optima: see the table of the data's MANIFEST.
OPTIMA = {"manhattanOlson3500.g2o.bz2": (2566431.7, 146.0766),
          "manhattanOlson3500_badinit.g2o.bz2": (2566434.0, 146.0767),
          "intel943.g2o.bz2": (205887.3, 546.4611),
          "fr079.toro.graph.bz2": (77834.6, 32.0248)}


def run(*arguments):
    return subprocess.run([TOPOBENCH, "posegraph", *map(str, arguments)], capture_output=True, text=True,
                          check=False)


class Graphs(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def write(self, text, name="graph.g2o"):
        file = self.path / name
        file.write_text(text)
        return file

    def solved(self, file, *options):
        done = run(file, "--json", *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return json.loads(done.stdout)

    def refused(self, text, *parts):
        done = run(self.write(text), "--json")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stdout, "")
        for part in parts:
            self.assertIn(part, done.stderr)

    def test_two_ways_that_disagree_meet_in_the_middle(self):
        text = G2O + "EDGE_SE2 0 1 1 0 0 100 0 0 100 0 100\nEDGE_SE2 0 1 1.2 0 0 100 0 0 100 0 100\n"
        report = self.solved(self.write(text))
        self.assertEqual((report["nodes"], report["edges"]), (2, 2))
        self.assertAlmostEqual(report["chi2_start"], 4.0, places=9)
        self.assertAlmostEqual(report["chi2_end"], 2.0, places=9)
        self.assertGreaterEqual(report["iterations"], 1)

    def test_packed_files_say_the_same(self):
        text = (G2O + "FIX 1\n" + "EDGE_SE2 0 1 1 0 0 %s\nEDGE_SE2 1 0 -0.9 0.1 0 %s\n" % (EYE, EYE)).encode()
        chi2 = []
        for name, packed in (("a.g2o", text), ("a.g2o.bz2", bz2.compress(text)), ("a.g2o.gz", gzip.compress(text))):
            (self.path / name).write_bytes(packed)
            chi2.append(self.solved(self.path / name)["chi2_end"])
        self.assertEqual(chi2[0], chi2[1])
        self.assertEqual(chi2[0], chi2[2])

    def test_the_two_formats_order_the_information_differently(self):
        # An error in y and in theta alone: what is left tells which entries were taken for which.
        node = "%s 0 0 0 0\n%s 1 1 0 0\n"
        edges = "%s 0 1 1 0 0 %s\n%s 0 1 1 0.2 0.1 %s\n"
        g2o, toro = "4 0 0 9 0 25", "4 0 9 25 0 0"
        a = self.solved(self.write(node % (("VERTEX_SE2",) * 2) + edges % ("EDGE_SE2", g2o, "EDGE_SE2", g2o)))
        b = self.solved(self.write(node % (("VERTEX2",) * 2) + edges % ("EDGE2", toro, "EDGE2", toro), "b.toro"))
        self.assertAlmostEqual(a["chi2_start"], b["chi2_start"], places=12)
        self.assertAlmostEqual(a["chi2_end"], b["chi2_end"], places=12)
        self.assertGreater(a["chi2_start"], 0.5)

    def test_a_robust_loss_leaves_a_false_closure_alone(self):
        steps = "".join("EDGE_SE2 %d %d 1 0 0 1e4 0 0 1e4 0 1e4\n" % (i, i + 1) for i in range(20))
        file = self.write(steps + "EDGE_SE2 0 20 10 3 1 1e4 0 0 1e4 0 1e4\n")
        plain, robust = self.solved(file), self.solved(file, "--robust")
        self.assertLess(plain["chi2_end"], 0.5 * plain["chi2_start"])
        self.assertGreater(robust["chi2_end"], 0.8 * robust["chi2_start"])

    def test_bad_files_are_refused_with_place_and_remedy(self):
        edge = "EDGE_SE2 0 1 1 0 0 %s\n" % EYE
        self.refused("", "expected lines EDGE_SE2")
        self.refused(G2O, ":2:", "found no edge")
        self.refused(G2O + "EDGE_SE3 0 1\n", ":3:", "\"EDGE_SE3\"", "in space", "VERTEX_SE2, EDGE_SE2 and FIX")
        self.refused(G2O + "EDGE2 0 1 1 0 0 1 0 1 1 0 0\n", ":3:", "tags of g2o")
        self.refused(G2O + "VERTEX_SE2 1 0 0 0\n" + edge, ":3:", "a node that no line before has given")
        self.refused(G2O + "EDGE_SE2 0 1 1 0 0 1 0 0 1 0\n", ":3:", "found 11 words", "expected 12")
        self.refused(G2O + "EDGE_SE2 0 1 1 nan 0 %s\n" % EYE, ":3:", "\"nan\" in word 5")
        self.refused(G2O + "EDGE_SE2 0 1 1 0 0 1 0 0 -1 0 1\n", ":3:", "eigenvalues -1 to 1", "semidefinite")
        self.refused(G2O + "EDGE_SE2 0 1 1 0 0 0 0 0 0 0 0\n", ":3:", "semidefinite")
        self.refused(G2O + "EDGE_SE2 0 0 1 0 0 %s\n" % EYE, ":3:", "another node")
        self.refused(G2O + edge + "EDGE_SE2 0 5 1 0 0 %s\n" % EYE, ":4:", "an edge to node 5", "vertex line")
        self.refused(G2O + "FIX 9\n" + edge, ":3:", "FIX of node 9")
        self.refused("FIX 0\nFIX 1\n" + edge, ":1:", "2 fixed nodes", "a vertex line for each")
        self.refused(G2O + "FIX\n" + edge, ":3:", "FIX id")
        self.refused(G2O + "VERTEX_SE2 2 0 0 0\n" + edge, "a graph in one piece")
        self.refused(G2O + "EDGE_SE2 -1 1 1 0 0 %s\n" % EYE, ":3:", "a whole number or a name")
        self.refused(G2O + "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 0\n", "singular")

    def test_constraints_of_other_kinds_are_named(self):
        edge = "EDGE_SE2 0 1 1 0 0 %s\n" % EYE
        for line, what in (("EDGE_PRIOR_SE2 0 0 0 0 %s" % EYE, "a prior on a pose"),
                           ("EDGE_SE2_XY 0 9 1 1 1 0 1", "a landmark seen from a pose"),
                           ("EDGE_BEARING_SE2_XY 0 9 0.5 1", "a landmark's bearing"),
                           ("EDGE_SE2_SWITCHABLE 0 1 7 1 0 0 %s" % EYE, "a closure with a switch"),
                           ("EDGE_SE2_MAXMIX 0 1 1 0 0 %s" % EYE, "a closure of several modes"),
                           ("EDGE3 0 1 1 0 0 0 0 0", "in space"),
                           ("VERTEX_SE3:QUAT 4 0 0 0 0 0 0 1", "in space"),
                           ("ODOMETRY 0 1 1 0 0 %s" % EYE, "iSAM"),
                           ("EDGE_OF_TOMORROW 0 1", "a constraint of another kind")):
            with self.subTest(line):
                self.refused(G2O + edge + line + "\n", ":4:", line.split()[0], what)

    def test_lines_without_relative_poses_are_passed_over_and_said_once(self):
        edges = "EDGE_SE2 0 1 1 0 0 100 0 0 100 0 100\nEDGE_SE2 0 1 1.2 0 0 100 0 0 100 0 100\n"
        foreign = "PARAMS_SE2OFFSET 0 0 0 0\nVERTEX_XY 7 1 1\nEQUIV 0 1\nROBOTLASER1 0 -1.5 3 1 8 0 0 1 2 0\nEQUIV 1 0\n"
        done = run(self.write(foreign + G2O + edges), "--json")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["chi2_end"], self.solved(self.write(G2O + edges))["chi2_end"])
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertIn("passed over 5 lines", done.stderr)
        self.assertIn("2 of EQUIV (the first in line 3)", done.stderr)
        self.assertIn("1 of PARAMS_SE2OFFSET (line 1)", done.stderr)

    def test_all_fixed_nodes_are_held(self):
        # Ends held 2 apart, two steps that measure 2.2: the middle gives way, not the ends.
        nodes = "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_SE2 2 2 0 0\n"
        steps = "EDGE_SE2 0 1 1 0 0 100 0 0 100 0 100\nEDGE_SE2 1 2 1.2 0 0 100 0 0 100 0 100\n"
        self.assertAlmostEqual(self.solved(self.write(nodes + steps))["chi2_end"], 0.0, places=12)
        for fix in ("FIX 0\nFIX 2\n", "FIX 0 2\n", "FIX 2 0 2\n"):
            report = self.solved(self.write(nodes + fix + steps))
            self.assertEqual(report["fixed"], 2)
            self.assertAlmostEqual(report["chi2_end"], 2.0, places=9)
        everything = self.solved(self.write(nodes + "FIX 0 1 2\n" + steps))
        self.assertAlmostEqual(everything["chi2_end"], 4.0, places=9)

    def test_pieces_that_hold_a_fixed_node_each_are_one_graph(self):
        nodes = "".join("VERTEX_SE2 %d %d 0 0\n" % (i, i) for i in range(4))
        edges = "EDGE_SE2 0 1 1 0 0 %s\nEDGE_SE2 2 3 1 0 0 %s\n" % (EYE, EYE)
        self.refused(nodes + edges, "a graph in one piece")
        self.assertAlmostEqual(self.solved(self.write(nodes + "FIX 0 3\n" + edges))["chi2_end"], 0.0, places=12)

    def test_ids_are_names(self):
        # The letters a and b in the upper byte, as tools for several robots write them; and names outright.
        a, b = (ord(letter) << 56 for letter in "ab")
        for one in ([a, a + 1, b, b + 1], ["a0", "a1", "b0", "b1"], [0, 1, 70, 71]):
            nodes = "".join("VERTEX_SE2 %s %d %d 0\n" % (name, k % 2, k // 2) for k, name in enumerate(one))
            def edge(i, j, x, y):
                return "EDGE_SE2 %s %s %g %g 0 100 0 0 100 0 100\n" % (one[i], one[j], x, y)
            report = self.solved(self.write(nodes + edge(0, 1, 1, 0) + edge(2, 3, 1, 0) + edge(0, 2, 0, 1) +
                                            edge(1, 2, -1, 1.3)), "--robust")
            self.assertEqual(report["nodes"], 4)
            # a1 and b0 follow each other in the order of names but not on a path: a closure, with the loss for such.
            alone = [0, 1, 70, 71]
            self.assertGreater(report["chi2_end"], 1.0 if one != alone else 0.0)
        self.refused("VERTEX_SE2 1.5 0 0 0\n", ":1:", "a whole number or a name")
        self.refused("VERTEX_SE2 7 0 0 0\nVERTEX_SE2 007 0 0 0\n", ":2:", "no line before")

    def test_marks_and_commas_of_other_systems(self):
        edge = "EDGE_SE2 0 1 1 0 0 %s\n" % EYE
        plain = self.solved(self.write(G2O + edge))["chi2_end"]
        (self.path / "bom.g2o").write_bytes(b"\xef\xbb\xbf" + (G2O + edge).replace("\n", "\r\n").encode())
        self.assertEqual(self.solved(self.path / "bom.g2o")["chi2_end"], plain)
        self.refused((G2O + edge).replace("1 0 0\n", "1,5 0 0\n", 1), ":2:", "a point instead of the comma")
        (self.path / "wide.g2o").write_bytes((G2O + edge).encode("utf-16"))
        self.assertIn("UTF-16", run(self.path / "wide.g2o").stderr)

    def test_numbers_in_the_other_formats_order_are_suspected(self):
        self.refused(G2O + "EDGE_SE2 0 1 1 0 0 50 0 50 100 0 0\n", ":3:", "TORO's order", "EDGE2")
        self.refused("EDGE2 0 1 1 0 0 50 0 0 50 0 100\n", ":1:", "g2o's order", "EDGE_SE2")
        self.refused(G2O + "EDGE_SE2 0 1 1 0 0\n", ":3:", "without its information matrix")

    def test_a_missing_file_is_said(self):
        done = run(self.path / "none.g2o")
        self.assertEqual(done.returncode, 2)
        self.assertIn("none.g2o", done.stderr)


@unittest.skipUnless(DATA, "TOPOMETRIC_DATA is not set: the benchmarks' graphs were not solved")
class Benchmarks(unittest.TestCase):
    def test_known_optima_from_the_odometry_start(self):
        for name, (start, optimum) in OPTIMA.items():
            with self.subTest(name):
                done = run(pathlib.Path(DATA) / "pose_graphs" / name, "--json")
                self.assertEqual(done.returncode, 0, done.stderr)
                report = json.loads(done.stdout)
                self.assertLess(abs(report["chi2_start"] - start), 1e-3 * start)
                self.assertLess(abs(report["chi2_end"] - optimum), 1e-3 * optimum)


if __name__ == "__main__":
    TOPOBENCH = sys.argv.pop(1)
    unittest.main()
