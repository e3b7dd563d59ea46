#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the parts of a GoogleTest program that mostly wait side by side: side_by_side.py PROGRAM FILTER..."""

import subprocess
import sys
import tempfile


def main():
    program, filters = sys.argv[1], sys.argv[2:]
    parts = []
    for text in filters:
        output = tempfile.TemporaryFile(mode="w+")
        parts.append((text, output, subprocess.Popen([program, "--gtest_filter=" + text], stdout=output, stderr=subprocess.STDOUT)))
    failed = []
    for text, output, process in parts:
        status = process.wait()
        output.seek(0)
        said = output.read()
        # A filter that names no test would pass without having tested anything.
        if status != 0 or "[  PASSED  ] 0 tests" in said:
            failed.append(text)
        print("==", text, "failed" if text in failed else "passed")
        print(said, flush=True)
    if failed:
        sys.exit("failed: " + ", ".join(failed))


if __name__ == "__main__":
    main()
