#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""A daemon that is killed recovers its map; sessions are saved, listed and gone on with; a full disk is survived.

usage: session_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]
Where the robot is, is held against the simulator's truth; the daemon sees its wires only."""
import json
import math
import resource
import subprocess
import sys
import time

from robot_processes import PATIENCE_S, RobotProcesses, main, wait_for

# No two corners alike, so that one scan tells where it was taken.
WORLD = """
[[start]]
x_m = 2.0
y_m = 2.0
[[wall]]
points_m = [[-0.1, -0.1], [12.1, -0.1], [12.1, 8.1], [-0.1, 8.1]]
closed = true
thickness_m = 0.2
[[wall]]
points_m = [[7.0, 8.0], [7.0, 4.5]]
thickness_m = 0.1
[[wall]]
points_m = [[3.0, 5.5], [4.2, 5.5], [4.2, 6.3], [3.0, 6.3]]
closed = true
thickness_m = 0.1
[[wall]]
points_m = [[10.0, 0.0], [10.0, 1.0], [11.0, 1.6]]
thickness_m = 0.1
"""
START = (2.0, 2.0)


def xxh64(data):
    """XXH64 with seed 0 of fewer than 32 bytes (the algorithm's specification, doc/xxhash_spec.md, steps 1, 5 to 7)."""
    mask, p1, p2, p3, p4, p5 = (1 << 64) - 1, 0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, \
        0x85EBCA77C2B2AE63, 0x27D4EB2F165667C5

    def turned(x, n):
        return ((x << n) | (x >> (64 - n))) & mask

    acc = (p5 + len(data)) & mask
    while len(data) >= 8:
        lane = turned(int.from_bytes(data[:8], "little") * p2 & mask, 31) * p1 & mask
        acc, data = (turned(acc ^ lane, 27) * p1 + p4) & mask, data[8:]
    if len(data) >= 4:
        acc = (turned(acc ^ (int.from_bytes(data[:4], "little") * p1 & mask), 23) * p2 + p3) & mask
        data = data[4:]
    for byte in data:
        acc = turned(acc ^ (byte * p5 & mask), 11) * p1 & mask
    acc = (acc ^ acc >> 33) * p2 & mask
    acc = (acc ^ acc >> 29) * p3 & mask
    return acc ^ acc >> 32


class Sessions(RobotProcesses):
    def setUp(self):
        super().setUp()
        self.sessions = self.folder / "sessions"
        self.sessions.mkdir()
        world = self.folder / "world.toml"
        world.write_text(WORLD)
        _, devices = self.start_simulator(world)
        self.write_config(devices, '[session]\nfolder = "%s"\njournal_period_s = 0.2\n' % self.sessions)

    def start_daemon(self, **options):
        daemon = self.start("topometricd", "--config", self.config, **options)
        wait_for(lambda: self.status().get("map", {}).get("keyframes", 0) > 0, "a daemon with a map")
        return daemon

    def ready(self):
        done = self.ctl("wait", "ready", "--timeout", PATIENCE_S)
        self.assertEqual(done.returncode, 0, done)

    def place(self):
        return self.status().get("session", {}).get("place", {})

    def ready_again(self):
        """After a restart. A map of few keyframes shows too little to be sure of the place: the operator confirms."""
        wait_for(lambda: self.place().get("standing") in ("proposed", "known"), "a place, or a proposal")
        if self.place()["standing"] == "proposed":
            self.confirm()
        self.ready()

    def confirm(self, *pose):
        before = self.truth()
        for refused in (self.ctl("start"), self.ctl("drive", 0.3, 0)):
            self.assertEqual(refused.returncode, 1)
            self.assertIn("is a proposal", refused.stderr)
        self.assertEqual(self.truth(), before)
        done = self.ctl("session", "confirm", *pose)
        self.assertEqual(done.returncode, 0, done)
        wait_for(lambda: self.place()["standing"] == "known", "a place that is known")

    def pass_the_trial(self):
        """Circles until the first metres match the older map; turns away from what is in the way."""
        for _ in range(16):
            place = self.place()
            if not place["on_trial"]:
                break
            way_m = place["trial"]["way_m"]
            self.drive((0.4, 0.4, 4))
            if self.place()["on_trial"] and self.place()["trial"]["way_m"] < way_m + 0.2:
                self.drive((0, 0.8, 2))
        self.assertEqual(self.place()["trial"]["verdict"], "passed", (self.place(), self.status()))

    def truth(self):
        return self.simulator_says("truth")["robots"][0]

    def drive(self, *way):
        """Legs of (speed, turning speed, seconds) by hand."""
        for v, w, seconds in way:
            done = self.ctl("drive", v, w, "--for", seconds)
            self.assertEqual(done.returncode, 0, done)

    def make_a_map(self):
        self.ready()
        self.drive((0.5, 0, 6), (0, 0.8, 2), (0.4, 0, 3))
        status = wait_for(lambda: (lambda s: s if s["state"] == "standing" and s["twist"]["v_mps"] == 0 else None)(
            self.status()), "a robot that stands")
        self.assertGreater(status["map"]["keyframes"], 6, status)
        return status

    def journalled(self):
        """The journal has every keyframe of the map."""
        def all_there():
            status = self.status()
            journal = status["session"]["journal"]
            return journal if journal["keyframes"] == status["map"]["keyframes"] else None
        return wait_for(all_there, "a journal with all keyframes")

    def assert_at_the_truth(self, status):
        """The map's origin is where the first daemon's robot stood."""
        truth, pose = self.truth(), status["pose"]
        off_m = math.hypot(pose["x_m"] - (truth["x_m"] - START[0]), pose["y_m"] - (truth["y_m"] - START[1]))
        print("pose off by %.3f m" % off_m, file=sys.stderr)
        self.assertLess(off_m, 0.12)

    def assert_logged(self):
        """The mission log of a killed daemon is whole lines, of what it did a second apart."""
        log, = self.sessions.glob("log-*.jsonl")
        lines = [json.loads(line) for line in log.read_text().splitlines()]
        states = [line for line in lines if line["kind"] == "state"]
        self.assertGreater(len(states), 5)
        for before, after in zip(states, states[1:]):
            self.assertGreaterEqual(after["t_s"] - before["t_s"], 0.999)
        self.assertIn("driving", {state["state"] for state in states})
        self.assertIn("ready", {line.get("event") for line in lines})
        self.assertGreater(states[-1]["map"]["keyframes"], 6)

    def test_a_killed_daemon_recovers_its_map_and_stands(self):
        daemon = self.start_daemon()
        self.make_a_map()
        kept = self.journalled()["keyframes"]
        daemon.kill()
        daemon.wait()
        self.assert_logged()
        before = self.truth()
        self.start_daemon()
        self.ready_again()
        status = self.status()
        self.assertGreater(status["map"]["keyframes"], kept)
        self.assertEqual(status["session"]["obstacle"], "")
        self.assert_at_the_truth(status)
        self.assertEqual(self.truth(), before, "the wheels turned by themselves")
        self.assertEqual(status["mission"]["state"], "none")
        # Told to move, it goes on mapping in the same frame; and that is kept in a journal of its own.
        self.drive((0, -0.8, 3), (0.4, 0, 4))
        self.assertGreater(self.status()["map"]["keyframes"], status["map"]["keyframes"])
        self.assert_at_the_truth(self.status())
        self.assertEqual(len(list(self.sessions.glob("journal-*.session"))), 1, "kept before it is certain")
        self.pass_the_trial()
        self.assert_at_the_truth(self.status())
        self.assertGreater(self.journalled()["keyframes"], kept)
        self.assertEqual(len(list(self.sessions.glob("journal-*.session"))), 2)

    def test_killed_at_any_moment_of_its_way(self):
        """Three times in a row, while it drives."""
        keyframes = 0
        for turn in (0.5, -0.6, 0.7):
            daemon = self.start_daemon()
            self.ready_again()
            if keyframes > 0:
                self.pass_the_trial()  # nothing is kept before it
            driver = self.start("topoctl", "--socket", self.socket, "drive", 0.35, turn, "--for", 30,
                                stdout=subprocess.DEVNULL)
            wait_for(lambda: self.status()["session"]["journal"]["keyframes"] >= keyframes + 4, "a growing journal")
            keyframes = self.status()["session"]["journal"]["keyframes"]
            daemon.kill()
            daemon.wait()
            driver.wait()
            wait_for(lambda: (lambda a, b: a == b)(self.truth(), (time.sleep(0.2), self.truth())[1]), "standing")
        self.start_daemon()
        self.ready_again()
        self.assertGreaterEqual(self.status()["map"]["keyframes"], keyframes)
        self.assert_at_the_truth(self.status())

    def test_sessions_are_saved_and_gone_on_with(self):
        daemon = self.start_daemon()
        self.make_a_map()
        saved = self.ctl("session", "save", "office")
        self.assertEqual(saved.returncode, 0, saved)
        self.assertIn("office.session", saved.stdout)
        kept = self.status()["map"]["keyframes"]
        self.assertEqual(self.ctl("session", "save", "../office").returncode, 1)
        daemon.terminate()
        self.assertEqual(daemon.wait(), 0)
        # Stopped in order: the next one begins a map of its own, and has nothing in its way.
        self.start_daemon()
        self.ready()
        self.assertLess(self.status()["map"]["keyframes"], kept)
        listed = self.ctl("session", "list")
        self.assertIn("office", listed.stdout)
        self.assertIn("journal-", listed.stdout)
        self.assertEqual(self.ctl("session", "load", "nowhere").returncode, 1)
        pose = self.truth()
        loaded = self.ctl("session", "load", "office", "--pose", pose["x_m"] - START[0] + 0.5,
                          pose["y_m"] - START[1] - 0.4, pose["theta_rad"] + 0.2)
        self.assertEqual(loaded.returncode, 0, loaded)
        wait_for(lambda: self.status()["map"]["keyframes"] == kept + 1, "the session's map")
        self.assert_at_the_truth(self.status())
        # Told a wrong place it stays as it was.
        wrong = self.ctl("session", "load", "office", "--pose", 60, 60, 0)
        self.assertEqual(wrong.returncode, 1, wrong)
        self.assertIn("fits nowhere", wrong.stderr)
        self.assertEqual(self.status()["map"]["keyframes"], kept + 1)
        found = self.ctl("--json", "session", "load", "office", "--search")
        self.assertEqual(found.returncode, 0, found)
        self.assertEqual(json.loads(found.stdout)["keyframes"], kept)
        self.assertTrue(json.loads(found.stdout)["proposal"], "the map is small")
        self.confirm()
        self.ready()
        self.assert_at_the_truth(self.status())

    def resume(self, name):
        self.config.write_text(self.config.read_text() + 'resume = "%s"\n' % name)

    def assert_stands_for_want_of_a_session(self, *words):
        """The reason is in what start says, in the doctor's words and in the log."""
        refused = wait_for(lambda: (lambda r: r if words[0] in r.stderr else None)(self.ctl("start")), "a refusal")
        self.assertEqual(refused.returncode, 1)
        doctor = self.ctl("doctor").stdout
        log = (self.folder / "topometricd.log").read_text()
        for word in words:
            self.assertIn(word, refused.stderr)
            self.assertIn(word, doctor)
            self.assertIn(word, log)
        self.assertIn("BAD  session", doctor)
        self.assertEqual(list(self.sessions.glob("journal-*.session")), [], "a new map is begun")

    def test_a_saved_session_that_lost_its_end_is_not_replaced_by_a_new_map(self):
        daemon = self.start_daemon()
        self.make_a_map()
        self.assertEqual(self.ctl("session", "save", "office").returncode, 0)
        daemon.terminate()
        self.assertEqual(daemon.wait(), 0)
        office = self.sessions / "office.session"
        whole = office.read_bytes()
        for journal in self.sessions.glob("journal-*.session"):
            journal.unlink()
        office.write_bytes(whole[:-300])
        self.resume("office")
        self.start_daemon()
        self.assert_stands_for_want_of_a_session("office.session: no keyframe", "cut at byte %d" % (len(whole) - 300))
        refused = self.ctl("session", "load", "office")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("office.session: no keyframe with a pose is in it: cut at byte", refused.stderr)
        # Mended, it is gone on with.
        office.write_bytes(whole)
        loaded = self.ctl("session", "load", "office")
        self.assertEqual(loaded.returncode, 0, loaded)
        self.assertIn("session confirm", loaded.stdout)
        self.confirm()
        self.ready()
        self.assertEqual(self.ctl("doctor").returncode, 0)

    def test_a_session_that_is_not_there_is_not_replaced_by_a_new_map(self):
        self.resume("office")
        self.start_daemon()
        self.assert_stands_for_want_of_a_session("office.session: there is no such session")
        self.assertEqual(self.ctl("session", "new").returncode, 0)
        self.ready()

    def test_a_killed_journal_of_another_version_is_not_replaced_by_a_new_map(self):
        daemon = self.start_daemon()
        self.make_a_map()
        self.journalled()
        daemon.kill()
        daemon.wait()
        (journal,) = self.sessions.glob("journal-*.session")
        newer = bytearray(journal.read_bytes())
        newer[8] = 99
        newer[20:28] = xxh64(bytes(newer[:20])).to_bytes(8, "little")  # a whole header, of another version
        journal.unlink()
        (self.sessions / "journal-20260102T030405Z.session").write_bytes(newer)
        (self.sessions / "empty.session").touch()
        self.start_daemon()
        wait_for(lambda: "found version 99" in self.ctl("start").stderr, "a refusal")
        self.assertIn("found version 99, expected 3", self.ctl("doctor").stdout)
        listed = self.ctl("session", "list").stdout
        self.assertRegex(listed, "journal-20260102T030405Z .* no session: found version 99, expected 3")
        self.assertRegex(listed, "empty .* no session: the file is empty")

    def test_a_full_disk_is_told_and_mapping_goes_on(self):
        limit = 12000
        self.start_daemon(preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
        self.make_a_map()
        wait_for(lambda: self.status()["session"]["journal"]["failures"] > 1, "failures that are counted")
        journal = self.status()["session"]["journal"]
        self.assertTrue(journal["failing"])
        self.assertIn("cannot write", journal["message"])
        before = self.status()["map"]["keyframes"]
        self.drive((0, 0.8, 3))
        self.assertGreater(self.status()["map"]["keyframes"], before)
        log = (self.folder / "topometricd.log").read_text()
        self.assertIn("the session is not being kept, 1 times since the start: File too large", log)
        self.assertIn("NOT being kept", self.ctl("status").stdout)
        self.assertIn("session: it is not being kept: journal-", self.ctl("health").stdout)
        doctor = self.ctl("doctor")
        self.assertEqual(doctor.returncode, 1)
        self.assertIn("BAD  session", doctor.stdout)
        for path in self.sessions.glob("*.session"):
            self.assertLessEqual(path.stat().st_size, limit)


if __name__ == "__main__":
    main()
