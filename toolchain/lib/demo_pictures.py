# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of a demonstration that has ended, from the files in its folder: ways.png (the map with the ways of all robots),
coverage.png (who knew how much when) and goals.png (who had which goal when).

usage: demo_pictures.py FOLDER"""

import bisect
import json
import math
import pathlib
import sys

import demo_chart
import demo_seen
from PIL import Image, ImageDraw

GOAL_APART_M = 1.2  # nearer ones are one goal, seen from elsewhere or on a better map
GOAL_LOST_S = 3.0   # so long it may be away: a robot that waits or recovers has it still
SEEN_PERIOD_S = 1.0
GOAL_SHOWN_S = 4.0  # the map has numbers of goals that somebody had for as long
ROW_HEIGHT, HEADER_HEIGHT = 46, 48
GREYS = {"free": (255, 255, 255), "wall": (50, 50, 50), "unknown": (226, 226, 226)}


def read_way(folder, robot, robots, start, begin_s):
    """[(seconds since the start, (x, y, theta))] in the frame of the map: a robot alone begins its own where it stands."""
    name = "truth.tsv" + (".%d" % robot if robots > 1 else "")
    rows = [list(map(float, line.split("\t"))) for line in (folder / name).read_text().splitlines() if line and line[0] != "#"]
    if robots > 1:
        return [(t - begin_s, (x, y, theta)) for t, x, y, theta in rows]
    x0, y0, turn = start
    c, s = math.cos(turn), math.sin(turn)
    return [(t - begin_s, ((x - x0) * c + (y - y0) * s, (y - y0) * c - (x - x0) * s, theta - turn)) for t, x, y, theta in rows]


def at(way, time_s):
    return way[max(0, bisect.bisect_right([t for t, _ in way], time_s) - 1)][1]


class Goals:
    """Numbers for the places that any robot ever went for, in the order of their first time."""

    def __init__(self):
        self.places = []

    def number(self, goal):
        near = [i for i, place in enumerate(self.places) if math.dist(place, goal) < GOAL_APART_M]
        if not near:
            self.places.append(tuple(goal))
            return len(self.places)
        return 1 + min(near, key=lambda i: math.dist(self.places[i], goal))


def spans(times_s, names):
    """[name, from, to] of what is the same in consecutive moments; None is no name, and short gaps of it are closed."""
    found = []
    for time_s, name in zip(times_s, names):
        if name is None:
            continue
        if found and found[-1][0] == name and time_s - found[-1][2] <= GOAL_LOST_S:
            found[-1][2] = time_s
        else:
            if found and time_s - found[-1][2] <= GOAL_LOST_S:
                found[-1][2] = time_s
            found.append([name, time_s, time_s])
    return found


def named_spans(samples):
    """The goals, and of each robot its spans; names are numbers of goals, and "home"."""
    goals = Goals()
    rows = [[goal if goal in (None, "home") else goals.number(goal) for goal in row] for row in samples["goals"]]
    return goals, [spans(samples["t_s"], column) for column in zip(*rows)]


def draw_ways(grid, ways, goals, visits, title):
    scale = 2 if max(grid.cells.shape) < 1000 else 1
    image = Image.new("RGB", grid.cells.shape[::-1], GREYS["unknown"])
    for grey, colour in ((grid.cells >= demo_seen.FREE, GREYS["free"]), (grid.cells < 100, GREYS["wall"])):
        image.paste(colour, mask=Image.fromarray((grey * 255).astype("uint8")))
    image = image.resize((image.width * scale, image.height * scale), Image.Resampling.NEAREST)
    draw = ImageDraw.Draw(image)

    def pixel(x, y):
        return tuple(scale * value for value in grid.pixel(x, y))

    for robot, way in enumerate(ways):
        colour = demo_chart.COLOURS[robot]
        draw.line([pixel(x, y) for _, (x, y, _) in way], fill=colour, width=2 * scale, joint="curve")
        x, y = pixel(*way[0][1][:2])
        draw.ellipse((x - 5 * scale, y - 5 * scale, x + 5 * scale, y + 5 * scale), fill=colour, outline=(0, 0, 0))
    for number, place in enumerate(goals.places, 1):
        by = [robot for robot, visit in enumerate(visits)
              if any(name == number and end - begin >= GOAL_SHOWN_S for name, begin, end in visit)]
        if not by:
            continue
        x, y = pixel(*place)
        demo_chart.write(image, (x - 6 * scale, y - 6 * scale), str(number), demo_chart.COLOURS[by[0]] if len(by) == 1 else (0, 0, 0),
                         scale=scale, halo=(255, 255, 255))
    width = max(image.width // scale, 640)
    header = Image.new("RGB", (width, HEADER_HEIGHT), (255, 255, 255))
    demo_chart.write(header, (10, 6), title)
    demo_chart.legend(header, (10, 26), [("robot %d" % (robot + 1), demo_chart.COLOURS[robot], 4) for robot in range(len(ways))] +
                      [("numbers: goals, by who went for them (black: several)", (255, 255, 255), 1)])
    framed = Image.new("RGB", (width * scale, image.height + HEADER_HEIGHT * scale), (255, 255, 255))
    framed.paste(header.resize((header.width * scale, header.height * scale), Image.Resampling.NEAREST), (0, 0))
    framed.paste(image, (0, HEADER_HEIGHT * scale))
    return framed.quantize(64)


def draw_coverage(samples, free, ways, title):
    times_s, end_s = samples["t_s"], samples["t_s"][-1]
    moments = [i * SEEN_PERIOD_S for i in range(int(end_s / SEEN_PERIOD_S) + 1)]
    own, joined = demo_seen.seen_over_time(free, moments, [[at(way, t) for t in moments] for way in ways])
    chart = demo_chart.TimeChart(420, end_s, samples["gaps"])
    chart.shares()
    chart.title(title)
    entries = [("seen by all together", (0, 0, 0), 3)]
    judged = samples["covered"][0] or 1.0  # on one scale with what the robots know, which ends at what was judged
    chart.curve(moments, [judged * share for share in joined], (0, 0, 0), 3)
    for robot in range(len(ways)):
        colour, last = demo_chart.COLOURS[robot], samples["known_m2"][-1][robot] or 1.0
        covered = samples["covered"][robot] or 1.0
        chart.curve(moments, [judged * share for share in own[robot]], colour, 1)
        chart.curve(times_s, [known[robot] / last * covered for known in samples["known_m2"]], colour, 2)
        entries += [("robot %d knows" % (robot + 1), colour, 2), ("has seen itself", colour, 1)]
    demo_chart.legend(chart.image, (demo_chart.LEFT, 24), entries)
    return chart.image.quantize(64)


def draw_goals(samples, visits, title):
    chart = demo_chart.TimeChart(demo_chart.TOP + demo_chart.BOTTOM + ROW_HEIGHT * len(visits), samples["t_s"][-1], samples["gaps"])
    chart.title(title)
    demo_chart.write(chart.image, (demo_chart.LEFT, 24), "numbers: goals, as in ways.png; H: on the way home")
    for robot, visit in enumerate(visits):
        top = demo_chart.TOP + ROW_HEIGHT * robot + 8
        demo_chart.write(chart.image, (6, top + 9), "robot %d" % (robot + 1), demo_chart.COLOURS[robot])
        for name, begin, end in visit:
            colour = (170, 170, 170) if name == "home" else demo_chart.COLOURS[robot]
            left, right = chart.x(begin), max(chart.x(end), chart.x(begin) + 2)
            chart.draw.rectangle((left, top, right, top + 30), fill=colour, outline=(255, 255, 255))
            text = "H" if name == "home" else str(name)
            if right - left > 7 * len(text) + 2:
                demo_chart.write(chart.image, (left + (right - left) / 2 - 3 * len(text), top + 9), text, (255, 255, 255))
    return chart.image.quantize(64)


def draw(folder):
    samples = json.loads((folder / "samples.json").read_text())
    robots = len(samples["starts"])
    grid = demo_seen.read_map(folder)
    ways = [read_way(folder, robot, robots, start, samples["begin_steady_s"]) for robot, start in enumerate(samples["starts"])]
    ways = [[row for row in way if row[0] >= 0.0] or way[-1:] for way in ways]
    goals, visits = named_spans(samples)
    said = "%d robot%s, %.0f s" % (robots, "s" if robots > 1 else "", samples["t_s"][-1])
    gaps = "; shaded: not every robot in reach of every other" if samples["gaps"] else ""
    if robots > 1:
        said += ", radio " + samples["radio"]
    return {"ways.png": draw_ways(grid, ways, goals, visits, said),
            "coverage.png": draw_coverage(samples, demo_seen.free_blocks(grid), ways, said + ": share of the area" + gaps),
            "goals.png": draw_goals(samples, visits, said + ": who went for which goal when" + gaps)}


def main():
    folder = pathlib.Path(sys.argv[1])
    for name, image in draw(folder).items():
        image.save(folder / name, optimize=True)


if __name__ == "__main__":
    main()
