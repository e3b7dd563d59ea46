# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What systemd and udev read is what they understand. Exit status 77: skipped, no systemd here."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SYSTEMD = pathlib.Path(__file__).resolve().parents[3] / "systemd"
UNIT = SYSTEMD / "topometric.service"
LINK = SYSTEMD / "topometric-link.service"
VIEW = SYSTEMD / "topometric-view.service"
# systemd-analyze's scale: 0 is best, 10 is unconfined; its --threshold takes tenths.
EXPOSURE_MAX_TENTHS = 30
LINK_EXPOSURE_MAX_TENTHS = 20  # it opens no device


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.returncode, done.stdout + done.stderr


class SystemdFiles(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def staged_unit(self):
        """The unit with a program and a document that exist before anything is installed."""
        text = UNIT.read_text()
        text, programs = re.subn(r"^ExecStart=/usr/bin/topometricd\b", "ExecStart=/bin/true", text, flags=re.M)
        self.assertEqual(programs, 1, "the package installs /usr/bin/topometricd")
        text, helpers = re.subn(r"^ExecStopPost=-/usr/bin/topometric-estop\b", "ExecStopPost=-/bin/true", text, flags=re.M)
        self.assertEqual(helpers, 1, "the package installs /usr/bin/topometric-estop")
        unit = self.folder / UNIT.name
        unit.write_text(text)
        return str(unit)

    def staged_link(self):
        text, programs = re.subn(r"^ExecStart=/usr/bin/topolink\b", "ExecStart=/bin/true", LINK.read_text(), flags=re.M)
        self.assertEqual(programs, 1, "the package installs /usr/bin/topolink")
        unit = self.folder / LINK.name
        unit.write_text(text)
        return str(unit)

    def staged_view(self):
        text, programs = re.subn(r"^ExecStart=/usr/bin/topoview\b", "ExecStart=/bin/true", VIEW.read_text(), flags=re.M)
        self.assertEqual(programs, 1, "the package installs /usr/bin/topoview")
        unit = self.folder / VIEW.name
        unit.write_text(text)
        return str(unit)

    def test_systemd_reads_the_units_without_a_word(self):
        # Unknown keys are warnings and leave the exit status at 0, so the output must be empty as well. Words
        # about other units of this machine are not ours.
        for unit in (self.staged_unit(), self.staged_link(), self.staged_view()):
            status, output = run("systemd-analyze", "verify", "--man=no", "--recursive-errors=no", unit)
            ours = [line for line in output.splitlines() if "topometric" in line]
            self.assertEqual((status, ours), (0, []), output)

    def test_verify_would_have_said_a_word(self):
        unit = pathlib.Path(self.staged_unit())
        unit.write_text(unit.read_text().replace("WatchdogSec=2s", "WatchdogSecs=2s"))
        _, output = run("systemd-analyze", "verify", "--man=no", "--recursive-errors=no", str(unit))
        self.assertIn("WatchdogSecs", output)

    def test_the_units_are_confined(self):
        for unit, most_tenths in ((self.staged_unit(), EXPOSURE_MAX_TENTHS), (self.staged_link(), LINK_EXPOSURE_MAX_TENTHS),
                                  (self.staged_view(), LINK_EXPOSURE_MAX_TENTHS)):
            status, output = run("systemd-analyze", "security", "--offline=true", f"--threshold={most_tenths}", unit)
            self.assertEqual(status, 0, output)

    def test_the_unit_keeps_what_the_daemon_needs(self):
        lines = set(UNIT.read_text().splitlines())
        for line in (
            "Type=notify", "WatchdogSec=2s", "Restart=on-failure", "User=topometric", "LimitRTPRIO=50",
            "LimitMEMLOCK=infinity", "RuntimeDirectory=topometric", "SupplementaryGroups=dialout",
            "ExecStopPost=-/usr/bin/topometric-estop --config /etc/topometric/topometric.toml",
            "RestartPreventExitStatus=2", "RestrictRealtime=no", "DeviceAllow=char-ttyACM rw", "DeviceAllow=char-ttyUSB rw",
        ):
            self.assertIn(line, lines)

    def test_the_link_is_the_daemons_user_and_reaches_no_device(self):
        lines = set(LINK.read_text().splitlines())
        for line in ("Type=notify", "User=topometric", "Restart=on-failure", "RestartPreventExitStatus=2", "PrivateDevices=yes",
                     "InaccessiblePaths=-/var/lib/topometric", "RestrictAddressFamilies=AF_UNIX AF_INET AF_NETLINK"):
            self.assertIn(line, lines)

    def test_the_page_is_the_daemons_user_and_reaches_no_device(self):
        lines = set(VIEW.read_text().splitlines())
        for line in ("Type=notify", "User=topometric", "Restart=on-failure", "RestartPreventExitStatus=2", "PrivateDevices=yes",
                     "StateDirectory=topometric/view", "StateDirectoryMode=0700", "MemoryMax=64M",
                     "RestrictAddressFamilies=AF_UNIX AF_INET AF_INET6"):
            self.assertIn(line, lines)

    @unittest.skipUnless(shutil.which("systemd-sysusers"), "no systemd-sysusers here")
    def test_sysusers_makes_the_user_and_the_group(self):
        (self.folder / "etc").mkdir()
        (self.folder / "etc/group").write_text("dialout:x:20:\n")
        status, output = run("systemd-sysusers", f"--root={self.folder}", str(SYSTEMD / "topometric.sysusers.conf"))
        self.assertEqual(status, 0, output)
        self.assertRegex((self.folder / "etc/passwd").read_text(), r"(?m)^topometric:.*:/var/lib/topometric:")
        self.assertRegex((self.folder / "etc/group").read_text(), r"(?m)^dialout:x:20:topometric$")

    @unittest.skipUnless(shutil.which("systemd-tmpfiles"), "no systemd-tmpfiles here")
    @unittest.skipUnless(os.geteuid() == 0, "making folders of another user takes root")
    def test_tmpfiles_makes_the_folders(self):
        (self.folder / "etc").mkdir()
        (self.folder / "etc/passwd").write_text("topometric:x:990:990::/:/bin/false\n")
        (self.folder / "etc/group").write_text("topometric:x:990:\n")
        status, output = run("systemd-tmpfiles", "--create", f"--root={self.folder}",
                             str(SYSTEMD / "topometric.tmpfiles.conf"))
        self.assertEqual((status, output), (0, ""))
        for name in ("maps", "recordings"):
            made = (self.folder / "var/lib/topometric" / name).stat()
            self.assertEqual((made.st_uid, made.st_mode & 0o777), (990, 0o755))

    def test_udev_rules_have_no_dangling_lines(self):
        text = (SYSTEMD / "70-topometric.rules").read_text().replace("\\\n", " ")
        item = re.compile(r'[A-Z_]+(\{[\w/]+\})?(==|!=|\+=|=)"[^"]*"')
        for line in filter(None, text.splitlines()):
            if line.startswith("#"):
                continue
            for part in re.split(r",\s*", line.strip()):
                self.assertRegex(part, f"^{item.pattern}$", line)
        self.assertEqual(set(re.findall(r'GOTO="(\w+)"', text)), set(re.findall(r'LABEL="(\w+)"', text)))


if __name__ == "__main__":
    if not shutil.which("systemd-analyze"):
        print("SKIPPED: systemd-analyze is not installed (package systemd); systemd's files were not checked")
        sys.exit(77)
    unittest.main()
