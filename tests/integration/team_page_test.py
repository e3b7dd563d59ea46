#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""The page of a team of two: an area reaches the mate, and the stop for all says who was not reached.

usage: team_page_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]; exit status 77: skipped, no network namespaces or no
Chromium here"""
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import unittest

import browser
from link_rig import WHY_NOT
from page_client import Page
from robot_processes import wait_for
from team_rig import Rig, in_contact
from view_rig import free_port

PROGRAMS = SOURCES = None
CONTACT_S = 60.0  # a handshake of DDS Security that is left half done is begun anew after 15 to 25 s
TOLD = 'document.getElementById("told").textContent'


class TeamPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        holder = tempfile.TemporaryDirectory(prefix="topo-team-page-")
        cls.addClassCleanup(holder.cleanup)
        cls.folder = pathlib.Path(holder.name)
        cls.rig = Rig(PROGRAMS, SOURCES, cls.folder, robots=2, domain=67)
        cls.addClassCleanup(cls.rig.close)
        cls.robots = [cls.rig.robot(number).start() for number in (1, 2)]
        cls.one, cls.two = cls.robots
        for robot in cls.robots:
            robot.ready()
        in_contact(cls.robots)
        cls.port = free_port()
        config = cls.folder / "view.toml"
        text = cls.one.config.read_text()
        view = '\n[view]\nport = %d\nstate_folder = "%s"\n' % (cls.port, cls.folder / "view")
        config.write_text(text[:text.index("\n[view]")] + view + text[text.index("\n[team]"):])
        cls.view = cls.one.spawn(cls.folder / "topoview.log", PROGRAMS / "topoview", "--config", config)
        cls.addClassCleanup(cls.one.kill, cls.view)
        paired = subprocess.run([PROGRAMS / "topoview", "--config", config, "pair"], capture_output=True, text=True, check=True)
        cls.token = re.search(r"token +(\S+)", paired.stdout).group(1)
        wait_for(lambda: (cls.folder / "topoview.log").read_text().count("the page is at"), "a page")

    def ids(self, robot):
        return [area["id"] for area in robot.look("areas").get("areas", [])]

    def test_an_area_holds_for_the_mate_which_may_withdraw_it(self):
        page = Page(self.port)
        self.addCleanup(page.close)
        self.assertTrue(page.act("authorise", token=self.token)["ok"])
        corners = [5.0, 5.0, 6.0, 5.0, 6.0, 6.0]
        drawn = page.act("area_draw", corners_m=corners)
        self.assertTrue(drawn["ok"], drawn)
        begin = time.monotonic()
        wait_for(lambda: self.ids(self.two), "the area at the mate")
        print("known to the mate after %.2f s" % (time.monotonic() - begin))
        area = self.two.look("areas")["areas"][0]
        self.assertEqual(area["robot"], 1)
        # Both begin in one frame; what they saw since bends their maps a little.
        for (x, y), (wanted_x, wanted_y) in zip(area["corners_m"], zip(corners[::2], corners[1::2])):
            self.assertLess(max(abs(x - wanted_x), abs(y - wanted_y)), 0.15)
        self.two.obeys("area", "withdraw", area["id"])
        self.assertEqual(self.ids(self.two), [])
        wait_for(lambda: self.ids(self.one) == [], "no area at the robot that drew it")
        page.receive_until(lambda: page.known.get("areas", {}).get("areas") == [])

    def missions(self):
        return [robot.look("status")["mission"]["state"] for robot in self.robots]

    def test_one_mate_is_sent_off_and_paused(self):
        shown = browser.Browser(self.folder / "profile-mate")
        self.addCleanup(shown.close)
        shown.open("http://127.0.0.1:%d/#token=%s" % (self.port, self.token))
        shown.until('!document.getElementById("whom").disabled && document.getElementById("whom").options.length === 3',
                    "the choice of robots")
        shown.value('document.getElementById("whom").value = "2"')
        before = self.missions()
        shown.click('[data-act="start"]')
        shown.until('document.getElementById("question-text").textContent === "start: robot 2 explores, and comes home"',
                    "what it will do")
        shown.click("#do-it")
        shown.until(TOLD + '.includes("start for robot 2: acknowledged by: 2")', "the mate's word")
        wait_for(lambda: self.missions()[1] == "under way", "the mate's mission")
        shown.click('[data-act="pause"]')
        shown.until(TOLD + '.includes("pause for robot 2: acknowledged by: 2")', "the mate's word")
        wait_for(lambda: self.missions()[1] == "paused", "the mate's pause")
        self.assertEqual(self.missions()[0], before[0], "it was not for this robot")
        self.two.obeys("estop")
        shown.click('[data-act="resume"]')
        shown.click("#do-it")
        shown.until(TOLD + '.includes("REFUSED by 2: ")', "the mate's reason")
        self.two.obeys("clear-estop")
        self.two.obeys("stop")

    def test_the_stop_for_all_names_who_was_not_reached(self):
        shown = browser.Browser(self.folder / "profile")
        self.addCleanup(shown.close)
        shown.open("http://127.0.0.1:%d/" % self.port)
        shown.until('document.querySelectorAll("#team tr").length === 2', "the mate")
        before = self.rig.building.e_stops()
        shown.click("#estop")
        wait_for(lambda: all(now > then for now, then in zip(self.rig.building.e_stops(), before)), "E_STOP on both wires")
        shown.until(TOLD + '.includes("acknowledged by: 2")', "the mate's acknowledgement")
        self.assertNotIn("NOT REACHED", shown.value(TOLD))
        for robot in self.robots:
            robot.obeys("clear-estop")
        self.two.kill(self.two.link)
        before = self.rig.building.e_stops()[0]
        shown.click("#estop")
        wait_for(lambda: self.rig.building.e_stops()[0] > before, "E_STOP on this robot's wire")
        shown.until(TOLD + '.includes("NOT REACHED: 2")', "who was not reached")
        self.assertTrue(shown.value('document.getElementById("told").classList.contains("failed")'))
        self.two.start_link()
        shown.until(TOLD + '.includes("acknowledged by: 2")', "the mate, which is in reach again", CONTACT_S)


if __name__ == "__main__":
    PROGRAMS, SOURCES = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
    if WHY_NOT or browser.program() is None:
        print("skipped: %s" % (WHY_NOT or "there is no Chromium here: Debian's chromium-headless-shell"))
        sys.exit(77)
    unittest.main(verbosity=2)
