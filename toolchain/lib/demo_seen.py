# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a scanner could see of a finished map from a way through it, moment by moment."""

import dataclasses
import math
import pathlib
import re

import numpy
from PIL import Image

FREE = 250  # of a map_server picture: free is 254, unknown 205, occupied 0
COARSE = 2  # cells of the map a side of a cell that is counted
VIEW_RAD, BEAM_RAD = math.radians(270), math.radians(0.5)  # of the front scanner, and dense enough for 0.1 m at 11 m
RANGE_M = 20.0


@dataclasses.dataclass(frozen=True)
class Map:
    """`cells`: top row first, as in the picture; `cell_m`: side of a cell; `origin_m`: the lower left corner."""

    cells: numpy.ndarray
    cell_m: float
    origin_m: tuple

    def pixel(self, x, y):
        return ((x - self.origin_m[0]) / self.cell_m, self.cells.shape[0] - (y - self.origin_m[1]) / self.cell_m)


def read_map(folder):
    folder = pathlib.Path(folder)
    text = (folder / "map.yaml").read_text()
    cell_m = float(re.search(r"resolution: ([\d.]+)", text).group(1))
    x, y = re.search(r"origin: \[([-\d.]+), ([-\d.]+)", text).groups()
    with Image.open(folder / "map.pgm") as image:
        return Map(numpy.array(image.convert("L")), cell_m, (float(x), float(y)))


def free_blocks(grid):
    """Blocks of cells that are free altogether; a map with their size."""
    height, width = (side - side % COARSE for side in grid.cells.shape)
    free = grid.cells[-height:, :width] >= FREE  # the lower left corner stays
    blocks = free.reshape(height // COARSE, COARSE, width // COARSE, COARSE).all(axis=(1, 3))
    return Map(blocks, grid.cell_m * COARSE, grid.origin_m)


def seen_from(free, pose):
    """(rows, columns) of the blocks that beams from a pose pass before they meet one that is not free."""
    x, y, theta = pose
    angles = theta + numpy.arange(-VIEW_RAD / 2, VIEW_RAD / 2, BEAM_RAD)[:, None]
    steps = numpy.arange(0.0, RANGE_M, free.cell_m / 2)[None, :]
    columns, rows = free.pixel(x + steps * numpy.cos(angles), y + steps * numpy.sin(angles))
    columns, rows = numpy.floor(columns).astype(int), numpy.floor(rows).astype(int)
    height, width = free.cells.shape
    inside = (rows >= 0) & (rows < height) & (columns >= 0) & (columns < width)
    rows, columns = numpy.clip(rows, 0, height - 1), numpy.clip(columns, 0, width - 1)
    passed = numpy.logical_and.accumulate(inside & free.cells[rows, columns], axis=1)
    return rows[passed], columns[passed]


def seen_over_time(free, times_s, ways):
    """Shares of the free blocks: of each way, and of all together, at each time. `ways`: poses (x, y, theta) at the times."""
    total = max(1, int(free.cells.sum()))
    each = [numpy.zeros_like(free.cells) for _ in ways]
    shares, joined = [[] for _ in ways], []
    for moment in range(len(times_s)):
        for way, seen, share in zip(ways, each, shares):
            seen[seen_from(free, way[moment])] = True
            share.append(seen.sum() / total)
        joined.append(numpy.logical_or.reduce(each).sum() / total)
    return shares, joined
