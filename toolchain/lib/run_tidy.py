# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""clang-tidy over the entries of a compile_commands.json, clean ones remembered.

Most of its time goes into the headers of a file. Files of one folder with the same flags are therefore looked at together
first; where that is not clean, each half of them is, down to the file alone, and that is what is told."""

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
import tempfile
import time

TOP = pathlib.Path(__file__).resolve().parents[2]
ROOMS = ("core", "drivers", "daemon")
TOGETHER = 64  # 30 files together take less than half the time of four batches of them
EMPTY_LINES = re.compile(rb"\n\s*\n")


def flags_of(entry):
    """Of the compiler, without the file and what it writes."""
    words = [word for word in shlex.split(entry["command"])[1:] if word != "-c" and not word.endswith(("ccache", entry["file"]))]
    if words and pathlib.Path(words[0]).name.startswith("clang"):
        del words[0]
    if "-o" in words:
        at = words.index("-o")
        del words[at : at + 2]
    return words


def batches(entries):
    """Neighbours of one folder with equal flags."""
    batch = []
    for entry in entries:
        alike = batch and os.path.dirname(batch[0]["file"]) == os.path.dirname(entry["file"]) and flags_of(batch[0]) == flags_of(entry)
        if batch and (not alike or len(batch) == TOGETHER):
            yield batch
            batch = []
        batch.append(entry)
    if batch:
        yield batch


def together(entries):
    """The text of one file that includes all of them."""
    return "".join('#include "%s"\n' % entry["file"] for entry in entries)


def key_of(entries, version):
    """A hash of everything that clang-tidy's verdict on them depends on, or None when they do not preprocess. They are of
    one folder and have the same flags."""
    # The checks in effect there: a folder may have rules of its own.
    rules = subprocess.run(["clang-tidy", "--dump-config", entries[0]["file"], "--"], capture_output=True, check=True).stdout
    flags = flags_of(entries[0])
    # With macros, include lines and comments, among them what clang-tidy shall not say and names of arguments. Where a line
    # stands is no part of the verdict.
    done = subprocess.run(["clang++", *flags, "-E", "-P", "-C", "-dD", "-dI", "-x", "c++", "-"],
                          input=together(entries).encode(), cwd=entries[0]["directory"], capture_output=True, check=False)
    if done.returncode != 0:
        return None
    # Nor where the tree stands: a fresh clone has the same keys.
    parts = [part.replace(str(TOP).encode(), b"TOP")
             for part in (version, rules, " ".join(flags).encode(), EMPTY_LINES.sub(b"\n", done.stdout))]
    return hashlib.sha256(b"\0".join(parts)).hexdigest()


def are_clean_together(entries):
    """clang-tidy sees the one file in their folder: that folder's rules hold for it."""
    folder = os.path.dirname(entries[0]["file"])
    with tempfile.TemporaryDirectory() as name:
        content, overlay = pathlib.Path(name) / "content", pathlib.Path(name) / "overlay"
        content.write_text(together(entries))
        file = {"name": "together.cpp", "type": "file", "external-contents": str(content)}
        overlay.write_text(json.dumps({
            "version": 0, "use-external-names": False,
            "roots": [{"name": folder, "type": "directory", "contents": [file]}]}))
        # That it includes .cpp files is its purpose.
        done = subprocess.run(
            ["clang-tidy", "--quiet", f"--vfsoverlay={overlay}", "--checks=-bugprone-suspicious-include",
             folder + "/together.cpp", "--", *flags_of(entries[0])],
            cwd=entries[0]["directory"], capture_output=True, check=False)
    return done.returncode == 0


def check_alone(entry, database):
    """Output, or None when clean."""
    done = subprocess.run(
        ["clang-tidy", "--quiet", "-p", str(database.parent), entry["file"]],
        capture_output=True,
        text=True,
        check=False,
    )
    return None if done.returncode == 0 else done.stdout + done.stderr


def findings(batch, database):
    """Output by file of those that are not clean."""
    if len(batch) == 1:
        output = check_alone(batch[0], database)
        return {} if output is None else {batch[0]["file"]: output}
    if are_clean_together(batch):
        return {}
    half = len(batch) // 2
    return findings(batch[:half], database) | findings(batch[half:], database)


def check(batch, database, version, cache):
    """(whether a clean run is remembered, seconds, output by file of those that are not clean)"""
    start = time.monotonic()
    key = key_of(batch, version)
    if key and (cache / key).exists():
        return True, 0.0, {}
    found = findings(batch, database)
    if key and not found:
        (cache / key).touch()
    return False, time.monotonic() - start, found


def chosen(entries, files):
    # A file that a test builds again, with other definitions, is looked at as the product builds it.
    by_file = {entry["file"]: entry for entry in reversed(entries)}
    if not files:
        rooms = tuple(str(TOP / room) + os.sep for room in ROOMS)
        return [entry for entry in entries if entry["file"].startswith(rooms) and entry is by_file[entry["file"]]]
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
        work = list(batches(entries))
        results = pool.map(lambda batch: check(batch, arguments.database, version, cache), work)
        for batch, (known, seconds, found) in zip(work, results):
            remembered += len(batch) if known else 0
            failed += len(found)
            for file, output in found.items():
                print(f"{os.path.relpath(file, TOP)} ({len(batch)} in {seconds:.1f} s)\n{output}", flush=True)
    print(f"check-tidy: {len(entries)} files, {remembered} unchanged since a clean run, {failed} with findings")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
