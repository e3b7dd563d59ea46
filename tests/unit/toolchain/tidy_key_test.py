#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What makes clang-tidy look at a file again, and what does not."""

import pathlib
import shutil
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
TOP = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(TOP / "toolchain/lib"))
import run_tidy  # noqa: E402

TEXT = "#include \"a.hpp\"\n// why\nint twice(int n) { return two * n; }\n"


@unittest.skipUnless(shutil.which("clang-tidy"), "clang-tidy is not installed")
class TidyKey(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "a.hpp").write_text("constexpr int two = 2;\n")

    def key(self, text):
        file = self.folder / "a.cpp"
        file.write_text(text)
        entry = {"file": str(file), "directory": str(self.folder), "command": f"c++ -c {file} -o a.o"}
        return run_tidy.key_of(entry, b"14")

    def test_a_comment_may_change(self):
        self.assertEqual(self.key(TEXT), self.key(TEXT.replace("// why\n", "// another reason\n// in two lines\n")))

    def test_code_may_not(self):
        self.assertNotEqual(self.key(TEXT), self.key(TEXT.replace("two * n", "n * two")))

    def test_nor_a_header(self):
        before = self.key(TEXT)
        (self.folder / "a.hpp").write_text("constexpr int two = 3;\n")
        self.assertNotEqual(before, self.key(TEXT))

    def test_nor_what_clang_tidy_reads_in_comments(self):
        self.assertNotEqual(self.key(TEXT), self.key(TEXT.replace("// why", "// NOLINT(misc-x)")))
        self.assertNotEqual(self.key(TEXT), self.key(TEXT.replace("(int n)", "(int /*n*/)")))

    def test_a_file_that_does_not_preprocess_has_none(self):
        self.assertIsNone(self.key('#include "gone.hpp"\n'))


if __name__ == "__main__":
    unittest.main()
