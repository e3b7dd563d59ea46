#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""A mission of a real daemon with a simulated robot is shown again: from its session, and from a recording of it.

usage: replay_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]"""
import pathlib
import tempfile

import browser
from robot_processes import main, wait_for
from view_rig import DrivenOnce
from view_test import saved_cells


def is_running(pid):
    """One that ended and waits for whoever takes its status does not run."""
    try:
        return pathlib.Path("/proc/%d/stat" % pid).read_text().rpartition(")")[2].split()[0] != "Z"
    except FileNotFoundError:
        return False


class ReplayTest(DrivenOnce):
    def seek(self, page, position_s):
        answer = page.act("replay", position_s=position_s, playing=False)
        self.assertTrue(answer["ok"], answer)
        page.receive_until(lambda: abs(page.known["replay"]["position_s"] - position_s) < 1e-9)

    def show(self, path):
        self.view = self.start_view("--replay", path)
        return self.page()

    def children(self):
        return [int(pid) for pid in pathlib.Path("/proc/%d/task/%d/children" % (self.view.pid, self.view.pid)).read_text().split()]

    def test_a_session_is_the_mission_again(self):
        page = self.show(self.sessions)
        page.receive_until(lambda: page.known.get("replay") and page.known.get("past"))
        self.assertTrue(page.hello["replay"])
        length_s = page.known["replay"]["length_s"]
        log = self.log()
        states = [line for line in log if line["kind"] == "state"]
        begin_s = min(line["t_s"] for line in log)
        self.assertAlmostEqual(length_s, max(line["t_s"] for line in log) - begin_s, places=6)
        # At its end the map is the one that was saved.
        self.seek(page, length_s)
        wanted = saved_cells(self.folder / "saved")
        self.assertGreater(len(wanted), 1000)
        page.receive_until(lambda: page.cells() == wanted)
        page.receive_until(lambda: page.known["areas"]["areas"])
        self.assertEqual(len(page.known["past"]["events"]), len([line for line in log if line["kind"] == "event"]))
        # In its middle it is the state that was logged, whichever way one comes there.
        middle = states[len(states) // 2]
        middle_s = middle["t_s"] - begin_s
        self.seek(page, middle_s)
        page.receive_until(lambda: page.known["status"]["state"] == middle["state"]
                           and page.known["status"]["map"]["keyframes"] == middle["map"]["keyframes"])
        for name, value in middle["pose"].items():
            self.assertAlmostEqual(page.known["status"]["pose"][name], value, delta=0.001)
        late = self.page()  # who has not been at the end
        late.receive_until(lambda: page.receive() and late.cells() and late.cells() == page.cells())
        late.close()
        there = dict(page.cells())
        self.assertTrue(page.act("replay", position_s=0.0, speed=5, playing=True)["ok"])
        page.receive_until(lambda: page.known["replay"]["position_s"] == length_s and page.cells() == wanted)
        self.seek(page, middle_s)
        page.receive_until(lambda: page.cells() == there)
        # Nothing here reaches a robot.
        for act in ("estop", "start", "stop_all"):
            answer = page.act(act)
            self.assertFalse(answer["ok"])
            self.assertIn("this is a replay", answer["why"])
        self.assertIn("1 to 50", page.act("replay", speed=51)["why"])
        self.look(length_s, states[-1])

    def look(self, length_s, last):
        """The same in a browser, where there is one."""
        if browser.program() is None:
            print("without a browser: there is no Chromium here")
            return
        shown = browser.Browser(tempfile.mkdtemp(dir=self.folder))
        self.addCleanup(shown.close)
        shown.open("http://127.0.0.1:%d/" % self.port)
        shown.until('document.getElementById("link").textContent === "replay, NOT LIVE"', "a page that says what it is")
        for hidden in ("#estop", "#orders"):
            self.assertEqual(shown.value('getComputedStyle(document.querySelector("%s")).display' % hidden), "none")
        shown.until('Number(document.getElementById("position").max) > 0', "a time line")
        shown.value("""(() => { const handle = document.getElementById("position"); handle.value = %r;
            handle.dispatchEvent(new Event("change")); })()""" % length_s)
        # The page gets millimetres, and rounds them to centimetres.
        shown.until("""(([x_m, y_m]) => Math.abs(x_m - %r) < 0.006 && Math.abs(y_m - %r) < 0.006)(
            (document.getElementById("facts").textContent.match(/place(-?[\\d.]+), (-?[\\d.]+)/) || [0, NaN, NaN]).slice(1).map(Number))"""
                    % (last["pose"]["x_m"], last["pose"]["y_m"]), "the robot at its end: %s" % last["pose"])
        shown.until('document.getElementById("log").textContent.includes("area 1 drawn")', "the log until then")
        shown.value('document.getElementById("position").value = 0, document.getElementById("position").dispatchEvent(new Event("change"))')
        shown.until('!document.getElementById("log").textContent.includes("area 1 drawn")', "the log at the beginning")
        shown.click("#play")
        shown.until('document.getElementById("play").textContent === "pause"', "a replay that plays")
        self.assertEqual(shown.complaints, [])

    def test_a_recording_becomes_a_session_meanwhile(self):
        page = self.show(self.folder / "drive.rec")
        page.receive_until(lambda: page.known.get("replay", {}).get("growing"))
        [maker] = self.children()  # now: of a short recording it soon ends
        self.assertEqual(pathlib.Path("/proc/%d/comm" % maker).read_text().strip(), "topometricd")
        page.receive_until(lambda: page.known["replay"]["length_s"] > 1.0)
        page.receive_until(lambda: page.known.get("status", {}).get("map", {}).get("keyframes", 0) > 1 and page.cells())
        self.assertTrue(page.act("replay", speed=50)["ok"])
        # The daemon that makes it does not outlive a page that is killed.
        self.view.kill()
        self.view.wait()
        wait_for(lambda: not is_running(maker), "the end of the daemon that made the session")


if __name__ == "__main__":
    main()
