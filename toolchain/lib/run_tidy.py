# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""clang-tidy over the entries of a compile_commands.json, a file at a time, clean ones remembered."""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import time

TOP = pathlib.Path(__file__).resolve().parents[2]
ROOMS = ("core", "drivers", "daemon")


# What clang-tidy reads in comments: what it shall not say, and names of arguments.
MARKS = re.compile(rb"NOLINT\w*(?:\([^)\n]*\))?|/\*[^\n]*?\*/")
# Where a line stands is no part of the verdict: a comment above it may have grown.
LINE_NUMBER = re.compile(rb"^# \d+ ", re.M)
EMPTY_LINES = re.compile(rb"\n\s*\n")


def key_of(entry, version):
    """A hash of everything that clang-tidy's verdict depends on, or None when the file does not preprocess."""
    # The checks in effect for this file: a folder may have rules of its own.
    rules = subprocess.run(["clang-tidy", "--dump-config", entry["file"], "--"], capture_output=True, check=True).stdout
    command = [word for word in shlex.split(entry["command"]) if not word.endswith("ccache")]
    if "-o" in command:
        at = command.index("-o")
        del command[at : at + 2]
    command = [word for word in command if word != "-c"]
    texts = []
    for more in (["-dD", "-dI"], ["-C"]):
        done = subprocess.run([*command, "-E", *more], cwd=entry["directory"], capture_output=True, check=False)
        if done.returncode != 0:
            return None
        texts.append(done.stdout)
    code = EMPTY_LINES.sub(b"\n", LINE_NUMBER.sub(b"# ", texts[0]))
    marks = b"\n".join(MARKS.findall(texts[1]))
    # Where the tree stands is no part of the verdict: a fresh clone has the same keys.
    here = str(TOP).encode()
    parts = [version, rules, " ".join(command).encode(), code, marks]
    return hashlib.sha256(b"\0".join(part.replace(here, b"TOP") for part in parts)).hexdigest()


def check(entry, database, version, cache):
    """(file, seconds, output or None when clean)."""
    start = time.monotonic()
    key = key_of(entry, version)
    if key and (cache / key).exists():
        return entry["file"], 0.0, None
    done = subprocess.run(
        ["clang-tidy", "--quiet", "-p", str(database.parent), entry["file"]],
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode == 0:
        if key:
            (cache / key).touch()
        return entry["file"], time.monotonic() - start, None
    return entry["file"], time.monotonic() - start, done.stdout + done.stderr


def chosen(entries, files):
    if not files:
        rooms = tuple(str(TOP / room) + os.sep for room in ROOMS)
        return [entry for entry in entries if entry["file"].startswith(rooms)]
    by_file = {entry["file"]: entry for entry in entries}
    wanted = [str(pathlib.Path(file).resolve()) for file in files]
    missing = [file for file in wanted if file not in by_file]
    if missing:
        raise SystemExit(f"check-tidy: not in the compilation database: {', '.join(missing)}")
    return [by_file[file] for file in wanted]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--database", type=pathlib.Path, required=True)
    parser.add_argument("files", nargs="*")
    arguments = parser.parse_args()
    cache = pathlib.Path(os.environ["TOPOMETRIC_TIDY_CACHE"])
    version = subprocess.run(["clang-tidy", "--version"], capture_output=True, check=True).stdout
    entries = chosen(json.loads(arguments.database.read_text()), arguments.files)
    if not entries:
        raise SystemExit("check-tidy: nothing to check")
    failed = remembered = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        for file, seconds, output in pool.map(
            lambda entry: check(entry, arguments.database, version, cache), entries
        ):
            name = os.path.relpath(file, TOP)
            remembered += seconds == 0.0
            failed += output is not None
            if output is not None:
                print(f"{name}: {seconds:.1f} s\n{output}", flush=True)
    print(f"check-tidy: {len(entries)} files, {remembered} unchanged since a clean run, {failed} with findings")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
