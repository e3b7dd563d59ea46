# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program given and reads its files with libraries that are not ours."""
import os
import subprocess
import sys
import tempfile

import numpy
from PIL import Image

with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.argv[1], folder], check=True)
    assert sorted(os.listdir(folder)) == ["cloud.ply", "map.pgm", "map.png", "map.yaml"], os.listdir(folder)

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
