# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Charts over time for the demonstration's pictures."""

import itertools

from PIL import Image, ImageDraw, ImageFont

INK, LINE, GAP = (60, 60, 60), (222, 222, 222), (238, 232, 214)
# Colours that remain distinct under colour blindness (Okabe and Ito), for a team of eight.
COLOURS = ((213, 94, 0), (0, 114, 178), (0, 158, 115), (204, 121, 167), (120, 94, 240), (160, 120, 0), (86, 180, 233), (90, 90, 90))
LEFT, RIGHT, TOP, BOTTOM = 64, 16, 46, 34
WIDTH = 960


def write(image, place, text, colour=INK, scale=1, halo=None):
    """The font that PIL brings along has one size: enlarged where more is wanted. The place is the upper left corner."""
    if halo:
        for dx, dy in itertools.product((-scale, 0, scale), repeat=2):
            write(image, (place[0] + dx, place[1] + dy), text, halo, scale)
    font = ImageFont.load_default()
    box = font.getbbox(text)
    mask = Image.new("L", (box[2] + 1, box[3] + 1), 0)
    ImageDraw.Draw(mask).text((0, 0), text, fill=255, font=font)
    if scale > 1:
        mask = mask.resize((mask.width * scale, mask.height * scale), Image.Resampling.NEAREST)
    image.paste(Image.new("RGB", mask.size, colour), (int(place[0]), int(place[1])), mask)
    return mask.width


def legend(image, place, entries):
    """Entries (text, colour, width of the line) in one row."""
    x, y = place
    draw = ImageDraw.Draw(image)
    for text, colour, width in entries:
        draw.line((x, y + 6, x + 22, y + 6), fill=colour, width=width)
        x += 28
        x += write(image, (x, y), text) + 18


class TimeChart:
    """An image of the given height whose x axis is time from 0 to `end_s`, with `gaps` (from, to or None) shaded."""

    def __init__(self, height, end_s, gaps):
        self.end_s = max(end_s, 1.0)
        self.image = Image.new("RGB", (WIDTH, height), (255, 255, 255))
        self.draw = ImageDraw.Draw(self.image)
        self.floor = height - BOTTOM
        for begin, end in gaps:
            last = self.end_s if end is None else min(end, self.end_s)
            if begin < self.end_s:
                self.draw.rectangle((self.x(begin), TOP, self.x(last), self.floor), fill=GAP)
        step = next((s for s in (5, 10, 20, 30, 60, 120, 300) if self.end_s / s <= 14), 600)
        for t in range(0, int(self.end_s) + 1, step):
            self.draw.line((self.x(t), TOP, self.x(t), self.floor), fill=LINE)
            write(self.image, (self.x(t) - 3 * len(str(t)), self.floor + 6), str(t))
        write(self.image, (WIDTH - RIGHT - 6, self.floor + 20), "s")

    def x(self, time_s):
        return LEFT + (WIDTH - LEFT - RIGHT) * time_s / self.end_s

    def y(self, share):
        return self.floor - (self.floor - TOP) * share

    def shares(self):
        for percent in (0, 25, 50, 75, 90, 100):
            self.draw.line((LEFT, self.y(percent / 100), WIDTH - RIGHT, self.y(percent / 100)), fill=LINE)
            write(self.image, (LEFT - 36, self.y(percent / 100) - 6), "%3d %%" % percent)

    def curve(self, times_s, shares, colour, width):
        points = [(self.x(t), self.y(share)) for t, share in zip(times_s, shares)]
        if len(points) > 1:
            self.draw.line(points, fill=colour, width=width, joint="curve")

    def title(self, text):
        write(self.image, (LEFT, 6), text)
