#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""The page in a headless Chromium, with a real daemon and a simulated robot: what an operator sees and clicks.

usage: browser_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]; exit status 77: skipped, there is no Chromium here"""
import json
import math
import signal
import sys
import tempfile
import time

import browser
from made_up_daemon import Daemon
from robot_processes import main, wait_for
from view_rig import START_M, DrivenOnce, ViewProcesses, free_port

LIVE = 'document.getElementById("link").textContent === "live"'
STALE = 'document.body.classList.contains("stale")'
TOLD = 'document.getElementById("told").textContent'


class Shown:
    """A page in a browser."""

    def open(self, token=None, **look):
        shown = browser.Browser(tempfile.mkdtemp(dir=self.folder), **look)
        self.addCleanup(shown.close)
        shown.open("http://127.0.0.1:%d/%s" % (self.port, "#token=" + token if token else ""))
        shown.until(LIVE, "a page that is live")
        return shown

    def at(self, shown, x_m, y_m):
        """Pixels of the window where the page shows a point of the map."""
        shown.until("window.topoview !== undefined", "the page's own measure")
        return shown.value("window.topoview.pixelOf(%r, %r)" % (x_m, y_m))


class BrowserTest(Shown, ViewProcesses):
    def setUp(self):
        super().setUp()
        self.view = self.start_view()

    def test_the_stop_is_in_sight_and_works_at_one_click(self):
        for look in ({}, {"width": 390, "height": 844, "phone": True}):
            with self.subTest(**look):
                shown = self.open(**look)
                on_top = shown.value("""(() => { const b = document.getElementById("estop").getBoundingClientRect();
                    const e = document.elementFromPoint(b.x + b.width / 2, b.y + b.height / 2);
                    return e.id === "estop" && b.top >= 0 && b.bottom <= innerHeight && b.height >= 44; })()""")
                self.assertTrue(on_top, look)
                before = self.e_stops()
                shown.click("#estop")
                wait_for(lambda: self.e_stops() > before, "E_STOP on the robot's wire")
                shown.until(TOLD + '.includes("latched on this robot")', "the outcome")
                shown.until('document.getElementById("facts").textContent.includes("LATCHED")', "the latch")
                self.assertEqual(shown.complaints, [])
                self.ctl("clear-estop")

    def test_what_is_out_of_date_is_grey_within_two_seconds(self):
        shown = self.open()
        shown.value("window.sameDocument = true")
        for process, words in ((self.view, "NO "), (self.daemon, "NO NEWS")):
            process.send_signal(signal.SIGSTOP)
            stopped = time.monotonic()
            shown.until(STALE, "a grey page")
            self.assertLess(time.monotonic() - stopped, 2.0)
            shown.until('document.getElementById("link").textContent.startsWith("%s")' % words, "why")
            process.send_signal(signal.SIGCONT)
            shown.until(LIVE, "the page, live again")
            self.assertFalse(shown.value(STALE))
        self.daemon.kill()
        self.daemon.wait()
        shown.until('document.getElementById("link").textContent.startsWith("NO DAEMON")', "why")
        self.daemon = self.start_daemon()
        shown.until(LIVE, "the page, live again")
        self.assertTrue(shown.value("window.sameDocument"), "without a reload")

    def test_an_area_is_drawn_by_mouse_and_withdrawn(self):
        shown = self.open(self.make_token("desk"))
        shown.until('!document.getElementById("drawing").disabled', "the right to draw")
        shown.click("#drawing")
        corners = [(1.0, 1.0), (2.0, 1.0), (2.0, 2.0)]
        for corner in (*corners, (1.5, 2.5)):
            shown.click_at(*self.at(shown, *corner))
        shown.until('document.getElementById("pen-text").textContent.startsWith("4 corners")', "four corners")
        shown.click("#pen-undo")
        shown.click_at(*self.at(shown, *corners[0]))  # which closes it
        shown.until('document.getElementById("question-text").textContent.includes("no robot of the team")', "the question")
        self.assertIn("none", shown.value('document.getElementById("areas").textContent'))
        shown.click("#do-it")
        asked = time.monotonic()
        shown.until('document.querySelectorAll("#areas button").length === 1', "the area")
        self.assertLess(time.monotonic() - asked, 1.0)
        listed = self.ctl("area", "list").stdout
        for x, y in corners:
            self.assertRegex(listed, r"\(%s\d*, %s\d*\)" % (("%.1f" % x)[:3], ("%.1f" % y)[:3]))
        shown.click("#areas button")
        shown.click("#do-it")
        shown.until('document.querySelectorAll("#areas button").length === 0', "no area")
        self.assertEqual(shown.complaints, [])


class Doubting:
    """A robot that has 4 x 4 m of free floor, and doubts 2 x 2 m of it."""

    def __init__(self):
        # 64 x 64 cells that are free (decode_cells in page_client.py).
        self.answers = {
            "status": {"robot": "one", "state": "standing", "pose": {"x_m": 0.3, "y_m": 0.3, "theta_rad": 0.0}},
            "map.tiles": {"revision": 1, "more": False, "resolution_m": 0.0625, "side": 64, "tiles": [[0, 0, "_f" * 15 + "f"]]},
            "map.doubt": {"why": "walls may stand twice", "side_m": 2.0, "figure": 2.0, "loose": [],
                          "regions": [{"x_m": 2.0, "y_m": 2.0, "points": 9, "contradicted": 0.8}]},
            "events.subscribe": {}}

    def answer(self, method, params):
        return self.answers.get(method)


class DoubtTest(Shown, ViewProcesses):
    """The page of a daemon that says what is wanted."""

    def setUp(self):
        super(ViewProcesses, self).setUp()
        self.write_config({device: {"address": "tcp:127.0.0.1:%d" % port} for port, device in enumerate(("base", "front", "coronal"), 1)})
        self.robot, self.port = Doubting(), free_port()
        self.addCleanup(Daemon(self.socket, self.robot).close)
        self.configure("")
        self.start_view()

    def test_a_doubted_region_is_framed_and_named(self):
        shown = self.open()
        shown.until('document.getElementById("findings").textContent.includes("walls may stand twice")', "the doubt")
        # Points of the frame's upper edge and, for comparison, below it.
        edge, inside = ([self.at(shown, 1.2 + 0.05 * i, y) for i in range(33)] for y in (3.0, 2.5))
        colours = """(points => { const c = document.getElementById("ground"), box = c.getBoundingClientRect();
            return points.map(([x, y]) => c.getContext("2d").getImageData(x - box.x, y - box.y, 1, 1).data.join()); })(%s)"""
        self.assertGreater(len(set(shown.value(colours % json.dumps(edge)))), 1, "dashes")
        self.assertEqual(len(set(shown.value(colours % json.dumps(inside)))), 1, "floor")
        for place, words in (((2.0, 2.5), "free, doubtful"), ((3.5, 3.5), "free")):
            x, y = self.at(shown, *place)
            shown.call("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)
            shown.until('document.getElementById("under").textContent.endsWith(" m · %s")' % words, words)
        self.robot.answers["map.doubt"] = {**self.robot.answers["map.doubt"], "why": "", "regions": []}
        shown.until('!document.getElementById("findings").textContent.includes("twice")', "no doubt any more")
        shown.until("new Set(%s).size === 1" % (colours % json.dumps(edge)), "no frame any more")
        self.assertEqual(shown.complaints, [])


class PlaceTest(Shown, DrivenOnce):
    def place(self):
        return self.status().get("session", {}).get("place", {})

    def test_the_place_in_a_session_is_set_by_a_press_and_a_drag(self):
        self.daemon = super(DrivenOnce, self).start_daemon()
        session, = self.sessions.glob("journal-*.session")
        self.assertEqual(self.ctl("session", "load", session.stem).returncode, 0)
        wait_for(lambda: self.place().get("waits"), "a proposal: the map is small")
        self.start_view()
        shown = self.open(self.make_token("desk"))
        shown.until('!document.getElementById("posing").disabled', "the right to set the pose")
        self.assertIn(session.stem, shown.value('document.getElementById("place").textContent'))
        truth = self.simulator_says("truth")["robots"][0]
        x, y, theta = truth["x_m"] - START_M[0], truth["y_m"] - START_M[1], truth["theta_rad"]
        shown.click("#posing")
        press, to = self.at(shown, x + 0.1, y), self.at(shown, x + 0.1 + math.cos(theta), y + math.sin(theta))
        for kind, (px, py) in (("mousePressed", press), ("mouseMoved", to), ("mouseReleased", to)):
            shown.call("Input.dispatchMouseEvent", type=kind, x=px, y=py, button="left", buttons=1, clickCount=1)
        shown.until('document.getElementById("question-text").textContent.startsWith("set pose: this robot looks for itself")', "the question")
        self.assertTrue(self.place()["waits"], "nothing before the operator agrees")
        shown.click("#do-it")
        shown.until(TOLD + '.includes(": done")', "the outcome")
        wait_for(lambda: self.place()["standing"] == "known", "a place that is known")
        shown.until('document.getElementById("posing").disabled && !document.getElementById("place").textContent', "no question any more")
        pose = self.status()["pose"]
        self.assertLess(math.hypot(pose["x_m"] - x, pose["y_m"] - y), 0.12)
        self.assertEqual(shown.complaints, [])


if __name__ == "__main__":
    if browser.program() is None:
        print("skipped: there is no Chromium here: Debian's chromium-headless-shell")
        sys.exit(77)
    main()
