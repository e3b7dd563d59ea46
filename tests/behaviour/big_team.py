# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""A made-up daemon: it answers on a control socket as topometricd would in a building of 5,000 m2 with a team of 20 robots
that drive about in it and find something new every second. For measures of the page, which no 20 real daemons disturb."""
import itertools
import math
import random
import threading
import time

DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
CELL_M, SIDE = 0.05, 64
WIDTH_M, HEIGHT_M = 100.0, 50.0
ROOM_M, DOOR_M, CORRIDOR_M = 5.0, 1.0, 2.0
UNKNOWN, FREE, WALL = 0, 1, 2
ANSWER_BYTES = 128_000    # as of map.tiles
TRAIL_POINTS = 300        # as of map.trails
STEP_M = 0.5              # between two of them
NEW_TILES_A_SECOND = 20   # one of each robot
SPEED_MPS = 0.5


def encode_cells(cells):
    """As encode_cells() in daemon/app/tile_book.hpp."""
    text = []
    for state, run in itertools.groupby(cells):
        left = len(list(run))
        while left > 0:
            length = min(left, 272)
            if length > 16:
                text.append(DIGITS[48 + (length - 1) // 16 - 1])
            text.append(DIGITS[state * 16 + (length - 1) % 16])
            left -= length
    return "".join(text)


class Building:
    """Rooms of 5 x 5 m on both sides of corridors, with doors, and with cupboards that the laser has seen from one side."""

    def __init__(self, seed=1):
        self.chance = random.Random(seed)
        self.columns, self.rows = round(WIDTH_M / CELL_M), round(HEIGHT_M / CELL_M)
        self.cells = [bytearray([FREE]) * self.columns for _ in range(self.rows)]
        # Two rows of rooms, a corridor, two rows of rooms, ...: robots drive in the corridors.
        self.corridors_m, y = [], 0.0
        while y + 2 * ROOM_M + CORRIDOR_M <= HEIGHT_M:
            self.row_of_rooms(y, door_above=True)
            self.corridors_m.append(y + ROOM_M + CORRIDOR_M / 2)
            self.row_of_rooms(y + ROOM_M + CORRIDOR_M, door_above=False)
            y += 2 * ROOM_M + CORRIDOR_M
        self.box(0, 0, WIDTH_M, HEIGHT_M)
        self.roughen()
        self.states = {}
        for x in range(math.ceil(self.columns / SIDE)):
            for y in range(math.ceil(self.rows / SIDE)):
                self.states[x, y] = self.tile(x, y)

    def fill(self, x0, y0, x1, y1, state):
        left, right = (min(self.columns, max(0, round(v / CELL_M))) for v in (x0, x1))
        low, high = (min(self.rows, max(0, round(v / CELL_M))) for v in (y0, y1))
        for row in self.cells[low:high]:
            row[left:right] = bytes([state]) * (right - left)

    def box(self, x0, y0, x1, y1, inside=None):
        thick = 2 * CELL_M
        if inside is not None:
            self.fill(x0, y0, x1, y1, inside)
        for ax, ay, bx, by in ((x0, y0, x1, y0 + thick), (x0, y1 - thick, x1, y1), (x0, y0, x0 + thick, y1), (x1 - thick, y0, x1, y1)):
            self.fill(ax, ay, bx, by, WALL)

    def row_of_rooms(self, y, door_above):
        for i in range(round(WIDTH_M / ROOM_M)):
            x = i * ROOM_M
            self.box(x, y, x + ROOM_M, y + ROOM_M)
            for _ in range(3):
                cx, cy = x + self.chance.uniform(0.3, ROOM_M - 1.0), y + self.chance.uniform(0.3, ROOM_M - 1.0)
                self.box(cx, cy, cx + self.chance.uniform(0.2, 0.9), cy + self.chance.uniform(0.2, 0.9), UNKNOWN)
            door = x + self.chance.uniform(0.5, ROOM_M - 0.5 - DOOR_M)
            wall = y + ROOM_M if door_above else y
            self.fill(door, wall - 0.15, door + DOOR_M, wall + 0.15, FREE)

    def roughen(self):
        """A laser's walls are not of one thickness, and here and there a cell was never seen."""
        for row in self.cells:
            for at in [i for i, state in enumerate(row) if state == WALL]:
                beside = at + self.chance.choice((-1, 1))
                if self.chance.random() < 0.3 and 0 <= beside < len(row):
                    row[beside] = self.chance.choice((WALL, UNKNOWN))
            for _ in range(4):
                row[self.chance.randrange(len(row))] = UNKNOWN

    def tile(self, x, y):
        cells = bytearray()
        for row in range(y * SIDE, (y + 1) * SIDE):
            part = self.cells[row][x * SIDE:(x + 1) * SIDE] if row < self.rows else b""
            cells += bytes(part) + bytes(SIDE - len(part))
        return cells

    def known_m2(self):
        return sum(row.count(FREE) + row.count(WALL) for row in self.cells) * CELL_M ** 2


class Loop:
    """The way of one robot: along a corridor, back along the next one."""

    def __init__(self, building, number, robots):
        lanes = building.corridors_m
        low = lanes[number % (len(lanes) - 1)]
        high = lanes[number % (len(lanes) - 1) + 1]
        x0 = 2.0 + 40.0 * number / robots
        x1 = x0 + 45.0
        self.corners = [(x0, low), (x1, low), (x1, high), (x0, high)]
        self.lengths = [math.dist(a, b) for a, b in zip(self.corners, self.corners[1:] + self.corners[:1])]
        self.lap = [[round(v, 2) for v in self.at(STEP_M * i)[:2]] for i in range(int(sum(self.lengths) / STEP_M))]

    def part(self, way_m, first, last):
        """Places of the way, counted from there."""
        here = int(way_m / STEP_M)
        return [self.lap[i % len(self.lap)] for i in range(here + first, here + last)]

    def at(self, way_m):
        way_m %= sum(self.lengths)
        for corner, (a, b) in enumerate(zip(self.corners, self.corners[1:] + self.corners[:1])):
            if way_m <= self.lengths[corner]:
                share = way_m / self.lengths[corner]
                x, y = (p + share * (q - p) for p, q in zip(a, b))
                return x + 0.2 * math.sin(way_m), y + 0.2 * math.cos(0.7 * way_m), math.atan2(b[1] - a[1], b[0] - a[0])
            way_m -= self.lengths[corner]
        return (*self.corners[0], 0.0)


def point(x, y):
    return {"x_m": x, "y_m": y}


class BigTeam:
    """What the daemon of robot 1 answers, as a function of the time."""

    def __init__(self, robots=20):
        self.robots, self.building = robots, Building()
        self.loops = [Loop(self.building, number, robots) for number in range(robots)]
        self.begun, self.lock, self.chance = time.monotonic(), threading.Lock(), random.Random(2)
        self.known_m2 = self.building.known_m2()
        self.tiles = {place: encode_cells(cells) for place, cells in self.building.states.items()}
        self.numbers = {place: number + 1 for number, place in enumerate(self.tiles)}
        self.number, self.renewed_s = len(self.tiles), 0.0

    def now_s(self):
        return time.monotonic() - self.begun

    def way_m(self):
        return 170.0 + SPEED_MPS * self.now_s()

    def pose(self, robot):
        return self.loops[robot].at(self.way_m())

    def pose_json(self, robot):
        x, y, theta = self.pose(robot)
        return {**point(x, y), "theta_rad": theta}

    def way(self, robot, points=12):
        return [point(*place) for place in self.loops[robot].part(self.way_m(), 1, 1 + points)]

    def status(self):
        return {"robot": "big", "state": "driving", "reason": "gap of 2.1 m in place 12", "activity": "to a goal",
                "mission": {"order": "explore", "state": "under way", "reason": "", "elapsed_s": self.now_s(), "distance_m": 170.0},
                "goal": self.way(0)[-1], "estop": False, "battery_v": 12.6, "known_m2": self.known_m2, "pose": self.pose_json(0),
                "twist": {"v_mps": SPEED_MPS, "omega_radps": 0.1}, "plausibility": {"doubts": []}, "open_goals": 24,
                "free_distance_m": 3.2, "map": {"revision": self.number, "keyframes": 12_000, "closures": 900}}

    def team(self):
        peers = []
        for robot in range(1, self.robots):
            goal = self.way(robot, 20)[-1]
            peers.append({"robot": robot + 1, "alive": True, "hears_us": True, "heard_s_ago": (0.11 * robot + self.now_s()) % 0.5,
                          "round_trip_s": 0.02, "loss_in": 0.01, "loss_out": 0.01, "in_step": True, "it_lacks": {"items": 0, "bytes": 0},
                          "map_joined": True, "status": {"duty": "able", "claim": {**goal, "cost_m": 10.0}},
                          "here": {"pose": self.pose_json(robot), "claim": goal, "way": self.way(robot)}})
        return {"present": True, "name": "big", "robot": 1, "peers": peers, "order": {"number": 0}, "trouble": ""}

    def goals(self):
        chance = random.Random(3)

        def some(count, **more):
            return [{**point(chance.uniform(1, WIDTH_M - 1), chance.uniform(1, HEIGHT_M - 1)), **more} for _ in range(count)]
        return {"goal": self.way(0)[-1], "open": some(24, opening_m=1.5, place=3), "dropped": some(80),
                "given_up": some(12, why="no way leads there", back_in_s=20.0), "route": self.way(0, 60),
                "decisions": [{**point(1, 1), "text": "nearest of 24 by route"}]}

    def places(self):
        return {"places": [{"number": i, **point(5.0 * (i % 20) + 2.5, 6.0 * (i // 20) + 2.5), "area_m2": 25.0} for i in range(160)]}

    def scan(self):
        x, y, theta = self.pose(0)
        ends = ((x + r * math.cos(a), y + r * math.sin(a)) for i in range(90)
                for a, r in [(theta + math.radians(2.6 * i - 120), 2.0 + 1.5 * math.sin(i / 7.0))])
        return {"cm": [round(100 * v) for end in ends for v in end]}

    def renew(self):
        """Tiles that robots look at now; called with the lock held."""
        due = int((self.now_s() - self.renewed_s) * NEW_TILES_A_SECOND)
        if due < 1:
            return
        self.renewed_s = self.now_s()
        for place in self.chance.sample(sorted(self.tiles), min(due, len(self.tiles))):
            cells = self.building.states[place]
            cells[self.chance.randrange(len(cells))] = self.chance.choice((FREE, WALL))
            self.tiles[place] = encode_cells(cells)
            self.number += 1
            self.numbers[place] = self.number

    def map_tiles(self, since):
        with self.lock:
            if since > 0:
                self.renew()
            later = sorted((number, place) for place, number in self.numbers.items() if number > since)
            told, bytes_told, upto = [], 0, since
            for number, place in later:
                if bytes_told >= ANSWER_BYTES:
                    break
                told.append([*place, self.tiles[place]])
                bytes_told += len(self.tiles[place])
                upto = number
            return {"revision": upto, "more": len(told) < len(later), "resolution_m": CELL_M, "side": SIDE, "tiles": told}

    def answer(self, method, params):
        """None: a daemon knows the method, and this one does not."""
        if method == "map.tiles":
            return self.map_tiles(params.get("since", 0))
        if method == "map.trails":
            own, *mates = [loop.part(self.way_m(), -TRAIL_POINTS, 1) for loop in self.loops]
            return {"own": own, "mates": mates}
        if method == "areas":
            return {"areas": [{"id": "%d" % i, "kind": "keep_out", "robot": 1, "corners_m": [[x, 20], [x + 4, 20], [x + 4, 24], [x, 24]]}
                              for i, x in enumerate((20, 60))], "trouble": ""}
        if method == "map.doubt":
            return {"why": "the map is doubted", "side_m": 5.0, "regions": [point(42.5, 12.5), point(47.5, 12.5)], "loose": [point(70, 30)]}
        simple = {"status": self.status, "team": self.team, "goals": self.goals, "places": self.places, "scan": self.scan,
                  "health": lambda: {"faults": []}, "doctor": lambda: {"checks": []}, "events.subscribe": dict}
        return simple[method]() if method in simple else None
