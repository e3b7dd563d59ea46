#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""The Debian packages and the man pages, read by Debian's own programs: lintian, dpkg-deb and mandoc.

usage: package_test.py BUILD SOURCE [unittest options]; exit status 77: skipped, a program is not here."""
import gzip
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD = SOURCE = pathlib.Path()
# What a package that is not for Debian's archive cannot have: a bug of the archive that it closes, and a maintainer's
# address in the network.
NOT_OURS = ("initial-upload-closes-no-bugs", "bogus-mail-host", "bogus-mail-host-in-debian-changelog")

MAN_PAGES = {
    "topometric": ["topoctl.1.gz", "topolink.8.gz", "topometric-estop.8.gz", "topometric-team.8.gz", "topometricd.8.gz"],
    "topometric-view": ["topoview.8.gz"],
}


def run(*command, **options):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False, **options)


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        made = run("cpack", "-G", "DEB", "--config", BUILD / "CPackConfig.cmake", "-B", cls.folder)
        cls.debs = sorted(cls.folder.glob("*.deb"))
        if made.returncode != 0 or {deb.name.split("_")[0] for deb in cls.debs} != set(MAN_PAGES):
            raise AssertionError("cpack: status %d, %s\n%s%s" % (made.returncode, cls.debs, made.stdout, made.stderr))
        for deb in cls.debs:
            run("dpkg-deb", "-R", deb, cls.folder / deb.name.split("_")[0])

    def test_lintian_finds_no_error_and_no_warning(self):
        # As root it would refuse; what it then tests is the same.
        done = run("lintian", "--allow-root", "--no-cfg", "--fail-on", "error,warning", "--suppress-tags",
                   ",".join(NOT_OURS), *self.debs)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)

    def test_they_have_what_a_package_has(self):
        for name, man_pages in MAN_PAGES.items():
            with self.subTest(package=name):
                self.look_at(self.folder / name, name, man_pages)

    def look_at(self, files, name, man_pages):
        control = (files / "DEBIAN" / "control").read_text()
        extended = control.split("Description: ", 1)[1].splitlines()[1:]
        self.assertGreater(len(extended), 5, control)
        with gzip.open(files / "usr" / "share" / "doc" / name / "changelog.gz", "rt") as log:
            self.assertTrue(log.readline().startswith("topometric ("))
        pages = sorted(path.name for path in (files / "usr" / "share" / "man").glob("*/*"))
        self.assertEqual(pages, man_pages)
        scripts = list((files / "DEBIAN").glob("p*"))
        self.assertEqual(len(scripts), 3)
        for script in scripts:
            self.assertEqual(run("sh", "-n", script).returncode, 0, script)
            for line in script.read_text().splitlines():
                if line.strip().startswith("systemctl"):
                    self.assertIn("systemctl daemon-reload", line, script)

    def test_a_summary_of_its_own(self):
        summaries = {(self.folder / name / "DEBIAN" / "control").read_text().split("Description: ", 1)[1].splitlines()[0]
                     for name in MAN_PAGES}
        self.assertEqual(len(summaries), len(MAN_PAGES), summaries)


class ManPages(unittest.TestCase):
    def test_mandoc_has_nothing_to_say(self):
        pages = sorted((SOURCE / "doc").glob("*.[18]"))
        self.assertGreaterEqual(len(pages), 5)
        for page in pages:
            words = run("mandoc", "-T", "lint", page).stdout.splitlines()
            # The width of the source's lines is the house's, not the page's.
            self.assertEqual([w for w in words if "input text line longer than 80 bytes" not in w], [], page)

    def test_mandoc_would_have_said_it(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "bad.8"
            page.write_text('.TH BAD 8 "2026"\n.SH NAME\nbad\n.XX none\n')
            self.assertIn("WARNING", run("mandoc", "-T", "lint", page).stdout)


if __name__ == "__main__":
    BUILD, SOURCE = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
    missing = [name for name in ("cpack", "lintian", "mandoc", "dpkg-deb") if shutil.which(name) is None]
    if missing:
        print("skipped: not here: " + ", ".join(missing))
        sys.exit(77)
    unittest.main()
