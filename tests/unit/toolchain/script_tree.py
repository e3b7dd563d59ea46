# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""A small source tree in a temporary folder, and a script of toolchain/ run over it."""

import pathlib
import subprocess
import tempfile
import unittest

TOP = pathlib.Path(__file__).resolve().parents[3]
HEAD = "// SPDX-FileCopyrightText: 2026 The Topometric authors\n// SPDX-License-Identifier: BSD-3-Clause\n"
HASH_HEAD = HEAD.replace("//", "#")


class TreeTest(unittest.TestCase):
    script = ""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.root = pathlib.Path(holder.name)

    def write(self, path, text):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")

    def run_script(self, *arguments):
        return subprocess.run(
            [TOP / "toolchain" / self.script, "--root", self.root, *arguments],
            capture_output=True,
            text=True,
            check=False,
        )

    def assert_clean(self):
        done = self.run_script()
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.returncode, 0, done.stderr)

    def assert_reports(self, *expected):
        """Exactly these breaches: each (`file:line`, a part of the message)."""
        done = self.run_script()
        lines = done.stdout.splitlines()
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual(len(lines), len(expected), done.stdout)
        for line, (place, part) in zip(lines, expected):
            self.assertTrue(line.startswith(place + ": "), line)
            self.assertIn(part, line)
