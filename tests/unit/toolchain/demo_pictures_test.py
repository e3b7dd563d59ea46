# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the demonstration's pictures are made of, and that they are made. Needs the system's numpy and PIL."""

import json
import math
import pathlib
import sys
import tempfile
import unittest

TOP = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(TOP / "toolchain/lib"))

import demo_pictures  # noqa: E402
import demo_seen  # noqa: E402
import numpy  # noqa: E402
from PIL import Image  # noqa: E402

FREE, WALL, UNKNOWN = 254, 0, 205


def two_rooms():
    """8 x 4 m at 0.05 m: a wall at x = 4 with a door at its lower end, 1 m wide; the lower left corner is (-1, -2)."""
    cells = numpy.full((80, 160), FREE, dtype=numpy.uint8)
    cells[:60, 79:81] = WALL
    cells[:, [0, -1]] = cells[[0, -1], :] = WALL
    return demo_seen.Map(cells, 0.05, (-1.0, -2.0))


class Seen(unittest.TestCase):
    def setUp(self):
        self.free = demo_seen.free_blocks(two_rooms())

    def seen(self, *pose):
        found = numpy.zeros_like(self.free.cells)
        found[demo_seen.seen_from(self.free, pose)] = True
        return found

    def test_a_wall_hides_what_is_behind_it(self):
        left, right = self.seen(1.0, 1.0, 0.0)[:, :39], self.seen(1.0, 1.0, 0.0)[:, 41:]
        self.assertGreater(left.mean(), 0.7)
        self.assertLess(right.mean(), 0.05)

    def test_nothing_is_seen_behind_the_scanner(self):
        found = self.seen(1.0, 0.0, 0.0)
        self.assertFalse(found[20, :18].any(), "straight back along the row of the scanner")
        self.assertTrue(found[20, 20:38].all(), "straight ahead")

    def test_a_block_is_free_when_all_its_cells_are(self):
        self.assertEqual(self.free.cells.shape, (40, 80))
        self.assertFalse(self.free.cells[:30, 39:41].any())
        self.assertTrue(self.free.cells[30:39, 39:41].all())

    def test_all_together_have_seen_what_any_has(self):
        ways = [[(0.0, 0.0, 0.0)] * 2, [(0.0, 0.0, 0.0), (5.0, 0.0, math.pi)]]
        (one, two), joined = demo_seen.seen_over_time(self.free, [0.0, 1.0], ways)
        self.assertEqual((one[0], one[0]), (two[0], joined[0]))
        self.assertGreater(two[1], two[0] + 0.2)
        self.assertEqual((one[1], joined[1]), (one[0], two[1]))


class Spans(unittest.TestCase):
    def test_what_lasts_is_one_and_short_pauses_are_closed(self):
        times_s, names = [0, 1, 2, 3, 4, 9, 10, 11], [1, 1, None, 1, 2, 2, "home", "home"]
        self.assertEqual(demo_pictures.spans(times_s, names), [[1, 0, 4], [2, 4, 4], [2, 9, 10], ["home", 10, 11]])

    def test_near_places_are_one_goal_for_all_robots(self):
        goals = demo_pictures.Goals()
        self.assertEqual([goals.number(goal) for goal in ([0, 0], [5, 0], [0.5, 0.5], [5.5, 0], [2.5, 0])], [1, 2, 1, 2, 3])


class Drawn(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)
        grid = two_rooms()
        Image.fromarray(grid.cells).save(self.folder / "map.pgm")
        (self.folder / "map.yaml").write_text("image: map.pgm\nresolution: 0.05\norigin: [-1.0, -2.0, 0.0]\n")

    def write(self, starts):
        for robot, (x, y, theta) in enumerate(starts):
            rows = ["%f\t%f\t%f\t%f" % (100.0 + 0.1 * i, x + 0.02 * i * math.cos(theta), y + 0.02 * i * math.sin(theta), theta)
                    for i in range(51)]
            name = "truth.tsv" + (".%d" % robot if len(starts) > 1 else "")
            (self.folder / name).write_text("\n".join(["# t x y theta", *rows]) + "\n")
        count = len(starts)
        (self.folder / "samples.json").write_text(json.dumps({
            "t_s": [0.0, 2.0, 4.0], "known_m2": [[5.0] * count, [10.0] * count, [20.0] * count],
            "goals": [[[1.0, 1.0]] * count, [None] * count, ["home"] * count], "starts": starts, "gaps": [[1.0, None]],
            "begin_steady_s": 100.0, "radio": "cut:1:2", "covered": [0.97] * count}))

    def colours_at(self, image, place, radius=3):
        """Around a place in metres of the map: the picture has two pixels a cell, and a frame above."""
        x, y = 2 * (place[0] + 1.0) / 0.05, 2 * demo_pictures.HEADER_HEIGHT + 2 * (80 - (place[1] + 2.0) / 0.05)
        return {image.getpixel((int(x) + dx, int(y) + dy)) for dx in range(-radius, radius + 1) for dy in range(-radius, radius + 1)}

    def test_a_teams_ways_are_where_they_were_driven(self):
        self.write([(-0.5, -1.0, 0.0), (5.0, 1.0, math.pi)])
        drawn = {name: image.convert("RGB") for name, image in demo_pictures.draw(self.folder).items()}
        self.assertEqual(sorted(drawn), ["coverage.png", "goals.png", "ways.png"])
        orange, blue = demo_pictures.demo_chart.COLOURS[:2]
        self.assertIn(orange, self.colours_at(drawn["ways.png"], (0.4, -1.0)))
        self.assertIn(blue, self.colours_at(drawn["ways.png"], (4.1, 1.0)))
        self.assertNotIn(orange, self.colours_at(drawn["ways.png"], (4.1, 1.0)))
        for name in ("coverage.png", "goals.png"):
            used = {colour for _, colour in drawn[name].getcolors(1 << 20)}
            self.assertLessEqual({orange, blue, demo_pictures.demo_chart.GAP}, used, name)

    def test_a_robot_alone_begins_its_map_where_it_stands(self):
        self.write([(7.0, 3.0, math.pi / 2)])
        ways = demo_pictures.draw(self.folder)["ways.png"].convert("RGB")
        self.assertIn(demo_pictures.demo_chart.COLOURS[0], self.colours_at(ways, (0.9, 0.0)))


if __name__ == "__main__":
    unittest.main()
