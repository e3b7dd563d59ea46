#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""topoview with a real daemon and a simulated robot: what a page gets, may do, and may not.

usage: view_test.py BIN_FOLDER SOURCE_FOLDER [unittest options]"""
import math
import re
import signal
import threading
import time

from page_client import Page, Refused, request
from robot_processes import PATIENCE_S, main, wait_for
from view_rig import START_M, ViewProcesses

FREE, OCCUPIED = 254, 0  # of a saved map's pixels


def saved_cells(folder):
    """(x, y): state, of the cells of map.pgm that are not unknown."""
    picture = (folder / "map.pgm").read_bytes()
    head = re.match(rb"P5\s+(?:#[^\n]*\n\s*)*(\d+)\s+(\d+)\s+255\s", picture)
    width, height = int(head.group(1)), int(head.group(2))
    pixels = picture[head.end():]
    yaml = (folder / "map.yaml").read_text()
    resolution = float(re.search(r"resolution: (\S+)", yaml).group(1))
    left, low = (round(float(word) / resolution) for word in re.search(r"origin: \[([^,]+), ([^,]+),", yaml).groups())
    states = {FREE: 1, OCCUPIED: 2}
    return {(left + i % width, low + height - 1 - i // width): states[pixel]
            for i, pixel in enumerate(pixels[:width * height]) if pixel in states}


def resident_kb(pid):
    with open("/proc/%d/status" % pid, encoding="ascii") as status:
        return int(re.search(r"VmRSS:\s+(\d+)", status.read()).group(1))


def is_sanitized(program):
    """A sanitizer's shadow is no memory of the product."""
    return any(mark in program.read_bytes() for mark in (b"__asan_init", b"__tsan_init"))


class ViewTest(ViewProcesses):
    def test_the_page_shows_the_map_and_the_robot(self):
        self.start_view()
        page = self.page()
        token = self.make_token("desk")
        self.assertTrue(page.act("authorise", token=token)["ok"])
        page.receive_until(lambda: page.known.get("status", {}).get("state"))
        self.assertEqual(self.ctl("wait", "ready", "--timeout", "30").returncode, 0)
        answer = page.act("start")
        self.assertTrue(answer["ok"], answer)
        page.receive_until(lambda: page.known.get("goals", {}).get("route") and page.known["status"]["map"]["keyframes"] > 3)
        self.assertTrue(page.known["goals"]["goal"])
        page.receive_until(lambda: len(page.known.get("trails", {}).get("own", [])) > 1)
        self.assertTrue(page.act("stop_all")["ok"])
        page.receive_until(lambda: page.known["status"]["twist"] == {"v_mps": 0.0, "omega_radps": 0.0})
        self.assertIn("decision", {event["event"] for event in page.events})
        # The robot stands, so the map is the one that is saved.
        saved = self.folder / "saved"
        self.assertEqual(self.ctl("map", "save", saved).returncode, 0)
        wanted = saved_cells(saved)
        self.assertGreater(len(wanted), 1000)
        page.receive_until(lambda: page.cells() == wanted)
        late = self.page()  # who comes later gets the same
        late.receive_until(lambda: late.cells() == wanted)

    def test_whoever_looks_may_stop_and_nothing_else(self):
        self.start_view()
        page = self.page()
        for act in ("start", "home", "clear_estop", "stop_all"):
            answer = page.act(act)
            self.assertFalse(answer["ok"], act)
            self.assertIn("topoview pair", answer["why"])
        before = self.e_stops()
        answer = page.act("estop")
        self.assertEqual((answer["ok"], answer["v"]), (True, {"order": 0}))
        wait_for(lambda: self.e_stops() > before, "an emergency stop on the wire")
        page.receive_until(lambda: page.known.get("status", {}).get("estop"))
        token = self.make_token("desk")
        self.assertTrue(page.act("authorise", token=token)["ok"])
        self.assertTrue(page.act("clear_estop")["ok"])
        page.receive_until(lambda: not page.known["status"]["estop"])
        self.assertIn("desk", self.view_command("tokens"))
        self.view_command("revoke", "desk")
        self.assertFalse(page.act("clear_estop")["ok"], "a revoked token ends where it is in use")
        self.assertTrue(page.act("estop")["ok"])

    def test_topoctl_pairs_with_a_picture_of_the_address(self):
        self.start_view()
        done = self.ctl("view", "pair", "--config", self.config, "--name", "phone")
        self.assertEqual(done.returncode, 0, done.stderr)
        token, address = re.search(r"token +(\S+)\naddress +(\S+)\n", done.stdout).groups()
        self.assertEqual(address, "http://127.0.0.1:%d/#token=%s" % (self.port, token))
        picture = [line for line in done.stdout.splitlines() if set(line) & set("▀▄█")]
        self.assertGreater(len(picture), 12)
        self.assertEqual(len({len(line) for line in picture}), 1)
        self.assertTrue(self.page().act("authorise", token=token)["ok"])
        again = self.ctl("view", "pair", "--config", self.config, "--name", "phone")
        self.assertNotEqual(again.returncode, 0)
        self.assertIn("topoview revoke phone", again.stderr)

    def test_other_sites_get_nothing_not_even_the_stop(self):
        self.start_view()
        before = self.e_stops()
        own = "http://127.0.0.1:%d" % self.port
        self.page(origin=own).receive()
        for origin in ("http://evil.example", "null", "http://127.0.0.1:%d" % (self.port + 1)):
            with self.assertRaises(Refused) as refused:
                Page(self.port, origin=origin)
            self.assertEqual(refused.exception.args[0], 403)
        rebound = "evil.example:%d" % self.port
        with self.assertRaises(Refused):
            Page(self.port, host=rebound, origin="http://" + rebound)
        self.assertEqual(request(self.port, host=rebound)[0], 403)
        status, headers, body = request(self.port)
        self.assertEqual(status, 200)
        self.assertIn(b"E-STOP ALL", body)
        self.assertIn("script-src 'self'", headers["content-security-policy"])
        self.assertEqual(self.e_stops(), before)

    def test_where_looking_needs_a_token_so_does_the_stop(self):
        self.configure('look = "token"\n')
        self.start_view()
        page = self.page()
        answer = page.act("estop")
        self.assertFalse(answer["ok"])
        self.assertEqual((page.known, page.tiles), ({}, {}))
        for wrong in ("aaaa-bbbb", ""):
            self.assertFalse(page.act("authorise", token=wrong)["ok"])
        self.assertTrue(page.act("authorise", token=self.make_token("desk"))["ok"])
        page.receive_until(lambda: page.known.get("status") and page.tiles)
        self.assertTrue(page.act("estop")["ok"])

    def test_pages_outlive_their_daemon(self):
        self.start_view()
        page = self.page()
        page.receive_until(lambda: page.known.get("status") and page.tiles)
        self.daemon.send_signal(signal.SIGKILL)
        self.daemon.wait()
        page.receive_until(lambda: not page.known["link"]["joined"])
        answer = page.act("estop")
        self.assertFalse(answer["ok"])
        self.assertIn("no daemon", answer["why"])
        former = page.map
        self.daemon = self.start_daemon()
        page.receive_until(lambda: page.known["link"]["joined"] and page.map != former and page.tiles)

    def drive_to(self, page, x_m, y_m):
        end = time.monotonic() + PATIENCE_S
        while not (answer := page.act("goto", x_m=x_m, y_m=y_m))["ok"] and time.monotonic() < end:
            self.assertIn("not analysed with it yet", answer["why"])  # an area changed: planning has a period
            told_s = time.monotonic()
            page.receive_until(lambda: time.monotonic() > told_s + 0.5)  # a page may give so many orders a second
        self.assertTrue(answer["ok"], answer)
        page.receive_until(lambda: page.known["status"]["mission"]["state"] == "under way")

    def wheels_in_map(self):
        """Where the simulator has the corners of the body between the wheels: a P3-DX is 0.38 m wide over them."""
        truth = self.simulator_says("truth")["robots"][0]
        x, y, theta = truth["x_m"] - START_M[0], truth["y_m"] - START_M[1], truth["theta_rad"]
        return [(x + ax * math.cos(theta) - ay * math.sin(theta), y + ax * math.sin(theta) + ay * math.cos(theta))
                for ax in (-0.1, 0.1) for ay in (-0.19, 0.19)]

    def test_no_wheel_enters_an_area_drawn_over_a_route(self):
        self.start_view()
        page = self.page()
        self.assertTrue(page.act("authorise", token=self.make_token("desk"))["ok"])
        self.assertEqual(self.ctl("wait", "ready", "--timeout", "30").returncode, 0)
        page.receive_until(lambda: page.known.get("status", {}).get("pose") and page.known.get("places", {}).get("places"))
        self.drive_to(page, 4.5, 0.0)
        page.receive_until(lambda: page.known["status"]["pose"]["x_m"] > 0.5)
        left, low, right, high = 2.0, -1.2, 2.8, 1.2
        answer = page.act("area_draw", corners_m=[left, low, right, low, right, high, left, high])
        self.assertTrue(answer["ok"], answer)
        drawn_at = time.monotonic()
        page.receive_until(lambda: page.known.get("areas", {}).get("areas"))
        self.assertLess(time.monotonic() - drawn_at, 1.0, "seconds until the page shows it")
        inside, seen = [], 0
        while page.known["status"]["mission"]["state"] == "under way":
            wheels = self.wheels_in_map()
            inside += [p for p in wheels if left < p[0] < right and low < p[1] < high]
            seen += left < wheels[0][0] < right
            page.receive()
        self.assertEqual(inside, [])
        self.assertEqual(page.known["status"]["mission"]["state"], "done", page.known["status"]["mission"])
        self.assertGreater(seen, 0, "it drove by, on the other side of the edge")
        self.assertIn("area", {event["event"] for event in page.events})
        self.assertIn("(2.00, -1.20)", self.ctl("area", "list").stdout)
        # Into the area nobody is sent.
        self.assertIn("kept out of", page.act("goto", x_m=2.4, y_m=0.0)["why"])
        self.assertTrue(page.act("area_withdraw", area=answer["v"]["id"])["ok"])
        page.receive_until(lambda: not page.known["areas"]["areas"])
        self.drive_to(page, 2.4, 0.0)

    def test_goals_in_an_area_drawn_for_it_come_first(self):
        self.start_view()
        page = self.page()
        self.assertTrue(page.act("authorise", token=self.make_token("desk"))["ok"])
        self.assertEqual(self.ctl("wait", "ready", "--timeout", "30").returncode, 0)
        self.assertTrue(page.act("start")["ok"])
        page.receive_until(lambda: page.known.get("goals", {}).get("goal") and page.known.get("scan", {}).get("cm"))
        # Around all that there is: whatever is open lies in it.
        answer = page.act("area_draw", kind="here_first", corners_m=[-9, -9, 19, -9, 19, 19, -9, 19])
        self.assertTrue(answer["ok"], answer)
        page.receive_until(lambda: "in an area that comes first" in page.known["status"]["reason"])
        self.assertIn("here_first", self.ctl("area", "list").stdout)
        page.receive_until(lambda: page.known["areas"]["areas"])
        self.assertTrue(page.act("area_withdraw", area=answer["v"]["id"])["ok"])
        page.receive_until(lambda: not page.known["areas"]["areas"])

    def test_twelve_pages_one_slow_and_one_deaf(self):
        """Those that read have the state when it is made: five times a second, and 0.3 s late at most."""
        view = self.start_view()
        self.page(receive_buffer=4096)  # which never reads
        slow = self.page(receive_buffer=4096)
        pages = [self.page() for _ in range(10)]
        token = self.make_token("desk")
        self.assertTrue(pages[0].act("authorise", token=token)["ok"])
        self.assertEqual(self.ctl("wait", "ready", "--timeout", "30").returncode, 0)
        self.assertTrue(pages[0].act("start")["ok"])
        end, gaps, memory_kb = time.monotonic() + 8.0, [0.0] * len(pages), []

        def read(index):
            last = None
            while (now := time.monotonic()) < end:
                if pages[index].receive()["t"] != "status":
                    continue
                now = time.monotonic()
                gaps[index] = max(gaps[index], now - (last or now))
                last = now

        def trickle():
            while time.monotonic() < end:  # 20 kB/s
                slow.line.recv(1000)
                time.sleep(0.05)

        threads = [threading.Thread(target=read, args=(index,)) for index in range(len(pages))]
        threads.append(threading.Thread(target=trickle))
        for thread in threads:
            thread.start()
        while time.monotonic() < end:
            memory_kb.append(resident_kb(view.pid))
            time.sleep(0.5)
        for thread in threads:
            thread.join()
        print("longest time between two states: %.3f s; topoview: %d to %d kB" % (max(gaps), memory_kb[0], memory_kb[-1]))
        self.assertLess(max(gaps), 0.2 + 0.3)
        if not is_sanitized(self.programs / "topoview"):
            self.assertLess(max(memory_kb), 32 * 1024)
            self.assertLess(memory_kb[-1] - memory_kb[len(memory_kb) // 2], 1024, "flat once all have their buffers")
        self.assertTrue(pages[0].act("estop")["ok"])


if __name__ == "__main__":
    main()
