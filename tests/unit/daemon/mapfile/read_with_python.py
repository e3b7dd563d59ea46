# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program given and reads its files with libraries that are not ours: Pillow, numpy, PyYAML's rules of
map_server, shapely (places), and plyfile or meshio (points)."""
import json
import math
import os
import subprocess
import sys
import tempfile

import numpy
import shapely.geometry
import shapely.validation
from PIL import Image

try:
    import plyfile
except ImportError:
    plyfile = None
import meshio


def map_server(folder, name):
    """Occupancy as map_server's image_loader.cpp makes it in trinary mode: 0 free, 100 occupied, -1 unknown, the first
    row the lowest."""
    with open(os.path.join(folder, name)) as file:
        keys = dict(line.split(": ", 1) for line in file.read().splitlines())
    assert set(keys) >= {"image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"}, keys
    image = numpy.array(Image.open(os.path.join(folder, keys["image"])), dtype=float)
    assert image.ndim == 2, "one channel"
    shade = image if int(keys["negate"]) else 255.0 - image
    occupied = shade / 255.0
    grid = numpy.full(image.shape, -1)
    grid[occupied > float(keys["occupied_thresh"])] = 100
    grid[occupied < float(keys["free_thresh"])] = 0
    return grid[::-1], float(keys["resolution"]), [float(v) for v in keys["origin"].strip("[]").split(",")]


def points_of(path):
    found = []
    if plyfile is not None:
        vertex = plyfile.PlyData.read(path)["vertex"]
        found.append(numpy.stack([vertex[axis] for axis in "xyz"], axis=1))
    found.append(numpy.asarray(meshio.read(path).points).reshape(-1, 3))
    for points in found:
        assert points.tolist() == found[0].tolist(), path
    return found[0].tolist()


def check_places(path):
    """Valid polygons that do not overlap, each of its place's area."""
    with open(path) as file:
        collection = json.load(file)
    assert collection["type"] == "FeatureCollection", path
    places = []
    for feature in collection["features"]:
        shape = shapely.geometry.shape(feature["geometry"])
        assert shape.is_valid, (path, shapely.validation.explain_validity(shape))
        assert math.isclose(shape.area, feature["properties"]["area_m2"], abs_tol=1.1e-3), (path, shape.area)
        places.append(shape)
    for i, one in enumerate(places):
        for other in places[:i]:
            assert one.intersection(other).area < 1e-9, path
    return sum(shape.geom_type == "MultiPolygon" for shape in places)


with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[1], folder], check=True)
    names = sorted(os.listdir(folder))
    assert [n for n in names if not n.startswith("places-")] == ["cloud.ply", "empty.ply", "map.pgm", "map.png",
                                                                 "map.yaml"], names

    image = Image.open(os.path.join(folder, "map.pgm"))
    assert image.mode == "L", image.mode
    # The uppermost row of the image is the highest of the map.
    assert numpy.array(image).tolist() == [[205, 205, 254], [254, 0, 205]], numpy.array(image)

    with open(os.path.join(folder, "map.yaml")) as file:
        keys = dict(line.split(": ", 1) for line in file.read().splitlines())
    assert keys["image"] == "map.pgm" and keys["mode"] == "trinary" and keys["negate"] == "0", keys
    assert float(keys["resolution"]) == 0.05, keys
    assert [float(v) for v in keys["origin"].strip("[]").split(",")] == [-1.5, 2.25, 0.0], keys
    assert float(keys["occupied_thresh"]) == 0.65 and float(keys["free_thresh"]) == 0.196, keys

    colours = numpy.array(Image.open(os.path.join(folder, "map.png")))
    assert colours.shape == (2, 3, 3), colours.shape
    assert colours[1].tolist() == [[254, 254, 254], [0, 0, 0], [255, 0, 7]], colours

    with open(os.path.join(folder, "cloud.ply"), "rb") as file:
        head, body = file.read().split(b"end_header\n")
    assert head.startswith(b"ply\nformat binary_little_endian 1.0\n"), head
    assert b"element vertex 2\nproperty float x\nproperty float y\nproperty float z\n" in head, head
    points = numpy.frombuffer(body, dtype="<f4").reshape(-1, 3)
    assert points.tolist() == [[1.0, -2.0, 0.25], [0.5, 0.125, 3.0]], points
    assert points_of(os.path.join(folder, "cloud.ply")) == points.tolist()

    grid, resolution_m, origin = map_server(folder, "map.yaml")
    assert grid.tolist() == [[0, 100, -1], [-1, -1, 0]], grid
    assert (resolution_m, origin) == (0.05, [-1.5, 2.25, 0.0])

    parted = [check_places(os.path.join(folder, name)) for name in names if name.startswith("places-")]
    assert len(parted) == 60 and sum(parted) > 60, "cells that touch over corners were among them"
