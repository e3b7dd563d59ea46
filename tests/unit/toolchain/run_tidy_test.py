#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What makes clang-tidy look at a file again, and what it says of files that it looks at together."""

import json
import pathlib
import shutil
import sys
import tempfile
import unittest
import unittest.mock

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
        return run_tidy.key_of([entry], b"14")

    def test_where_a_line_stands_may_change(self):
        self.assertEqual(self.key(TEXT), self.key(TEXT.replace('"a.hpp"\n', '"a.hpp"\n' + 20 * "\n")))

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


@unittest.skipUnless(shutil.which("clang-tidy"), "clang-tidy is not installed")
class Together(unittest.TestCase):
    """Files of one folder, which has rules of its own."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.cache = self.folder / "cache"
        self.cache.mkdir()
        (self.folder / ".clang-tidy").write_text("Checks: '-*,misc-redundant-expression'\nWarningsAsErrors: '*'\nHeaderFilterRegex: '.*'\n")

    def found(self, **texts):
        """Names of the files in which something is found; in how many batches they were."""
        entries = []
        for name, text in texts.items():
            file = self.folder / (name + ".cpp")
            file.write_text(text)
            entries.append({"file": str(file), "directory": str(self.folder), "command": f"clang++ -c {file} -o {name}.o"})
        database = self.folder / "compile_commands.json"
        database.write_text(json.dumps(entries))
        batches = list(run_tidy.batches(entries))
        results = [run_tidy.check(batch, database, b"14", self.cache) for batch in batches]
        return [pathlib.Path(file).stem for _, _, outputs in results for file in outputs], len(batches)

    def test_clean_files_are_looked_at_in_one_go_and_remembered(self):
        clean = {name: f"int {name}(int n) {{ return n; }}\n" for name in ("a", "b", "c")}
        self.assertEqual(self.found(**clean), ([], 1))
        self.assertEqual(len(list(self.cache.iterdir())), 1)

    def test_a_fault_is_told_of_the_file_that_has_it(self):
        texts = {"a": "int a(int n) { return n; }\n", "b": "int b(int n) { return n - n; }\n", "c": "int c(int n) { return n; }\n"}
        self.assertEqual(self.found(**texts), (["b"], 1))
        self.assertEqual(len(list(self.cache.iterdir())), 0)

    def test_files_that_do_not_go_together_are_looked_at_in_halves(self):
        one = "namespace { int same(int n) { return n; } }\nint %s(int n) { return same(n); }\n"
        looked_at = []

        def note_and_look(batch):
            looked_at.append(len(batch))
            return look(batch)

        look = run_tidy.are_clean_together
        with unittest.mock.patch.object(run_tidy, "are_clean_together", note_and_look):
            self.assertEqual(self.found(a=one % "a", b="int b;\n", c=one % "c", d="int d;\n"), ([], 1))
        self.assertEqual(looked_at, [4, 2, 2])
        self.assertEqual(len(list(self.cache.iterdir())), 1)

    def test_a_batch_has_no_more_files_than_it_may(self):
        many = {f"f{i}": f"int f{i}(int n) {{ return n; }}\n" for i in range(run_tidy.TOGETHER + 1)}
        self.assertEqual(self.found(**many), ([], 2))


if __name__ == "__main__":
    unittest.main()
