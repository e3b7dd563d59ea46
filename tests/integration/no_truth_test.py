#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What decides cannot know the simulator's truth: neither is it linked in, nor would the layer check let it be.

usage: no_truth_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

BIN = SOURCE = None


def simulator_symbols(program):
    listing = subprocess.run(["nm", "--demangle", str(BIN / program)], capture_output=True, text=True, check=True).stdout
    return [line for line in listing.splitlines() if "topo::sim" in line or "topo::bench" in line]


def check_layers(root):
    return subprocess.run([sys.executable, str(SOURCE / "toolchain/check-layers"), "--root", str(root)],
                          capture_output=True, text=True, check=False)


class NoTruth(unittest.TestCase):
    def test_the_daemon_has_nothing_of_the_simulator_in_it(self):
        self.assertEqual(simulator_symbols("topometricd"), [])
        self.assertEqual(simulator_symbols("topoctl"), [])

    def test_this_would_be_found(self):
        self.assertGreater(len(simulator_symbols("toposim")), 100)

    def test_an_include_of_the_simulator_is_refused_where_decisions_are_made(self):
        for file in ("core/pipeline/breach.hpp", "core/motion/breach.hpp", "drivers/hokuyo/breach.hpp",
                     "daemon/threads/breach.hpp"):
            for include in ("tests/sim/simulation.hpp", "tests/bench/topobench/explore/plant.hpp"):
                with tempfile.TemporaryDirectory() as folder:
                    breach = pathlib.Path(folder) / file
                    breach.parent.mkdir(parents=True)
                    breach.write_text('#pragma once\n#include "%s"\n' % include)
                    done = check_layers(folder)
                    self.assertNotEqual(done.returncode, 0, (file, include))
                    self.assertIn("breach.hpp", done.stdout + done.stderr)

    def test_the_tree_itself_is_clean(self):
        done = check_layers(SOURCE)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    BIN, SOURCE = pathlib.Path(sys.argv.pop(1)), pathlib.Path(sys.argv.pop(1))
    unittest.main(verbosity=2)
