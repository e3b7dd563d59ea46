# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Simulated patrols through drawn buildings: what `topobench slam --simulate` reports of them."""
import json
import pathlib
import subprocess

BUILDINGS = 20
WAY_MIN_M = 30.0  # people or a locked room kept the robot from driving: nothing is counted


def buildings(topobench, seed, folder):
    """The files of the fresh suite of this seed."""
    subprocess.run([topobench, "suite", "--seed", str(seed), "--buildings", str(BUILDINGS), "--out", folder], check=True,
                   stdout=subprocess.DEVNULL)
    return sorted(pathlib.Path(folder).glob("*.yaml"))


def report(topobench, world, minutes, options):
    """The program's report; ends the caller when it fails. `options`: by their names."""
    command = [topobench, "slam", "--simulate", world, "--minutes", minutes, "--json",
               *(word for option in options.items() for word in option)]
    done = subprocess.run([str(word) for word in command], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise SystemExit("%s ended with %d:\n%s" % (" ".join(map(str, command)), done.returncode, done.stderr))
    return json.loads(done.stdout)
