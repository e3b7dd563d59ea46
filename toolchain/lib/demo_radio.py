# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the radio of a demonstration does not carry, as --radio says it, and when it carries nothing.

usage: demo_radio.py SPEC TIME_LIMIT_S: exit status 2, with the reason, when it is none"""

import dataclasses
import itertools
import math
import re
import sys

EXPECTED = ("expected perfect, or items joined by +: loss:P with a share from 0 to below 1, range:M with metres above 0, "
            "cut:FROM:TO with seconds since the start, the later one last")
NUMBER = re.compile(r"[0-9]{1,6}(\.[0-9]{1,6})?")
LOSS_STEPS = 1000  # nft draws whole numbers


@dataclasses.dataclass(frozen=True)
class Radio:
    """`loss`: the share of packets that does not arrive; `cuts`: (from, to) in seconds of robot time since the start."""

    loss: float = 0.0
    range_m: float = math.inf
    cuts: tuple = ()

    def is_perfect(self):
        return self == Radio()

    def has_range(self):
        return math.isfinite(self.range_m)

    def is_cut(self, elapsed_s):
        return any(begin <= elapsed_s < end for begin, end in self.cuts)

    def last_cut_end_s(self):
        return max((end for _, end in self.cuts), default=0.0)

    def far_pairs(self, places):
        """The pairs of robots (0 is the first) that are further apart than the radio reaches; `places`: [(x, y), ...] in m."""
        return frozenset((a, b) for (a, p), (b, q) in itertools.combinations(enumerate(places), 2)
                         if math.dist(p, q) > self.range_m)


def numbers(text):
    parts = text.split(":")
    return [float(part) for part in parts] if all(map(NUMBER.fullmatch, parts)) else []


def cut_of(item, values):
    begin, end = values
    if end <= begin:
        raise ValueError("found '%s', which ends before it begins, %s" % (item, EXPECTED))
    return begin, end


def parse(text, limit_s):
    """A radio; ValueError says what was found and what is expected. A cut must end before `limit_s`: what the robots hold
    is compared after it."""
    loss, range_m, cuts = [], [], []
    for item in text.split("+") if text != "perfect" else []:
        kind, _, rest = item.partition(":")
        values = numbers(rest)
        if kind == "loss" and len(values) == 1 and values[0] < 1.0:
            loss += values
        elif kind == "range" and len(values) == 1 and values[0] > 0.0:
            range_m += values
        elif kind == "cut" and len(values) == 2:
            cuts.append(cut_of(item, values))
        else:
            raise ValueError("found '%s', %s" % (item, EXPECTED))
    for name, found in (("loss", loss), ("range", range_m)):
        if len(found) > 1:
            raise ValueError("found %s %d times, expected it once at most" % (name, len(found)))
    radio = Radio(*loss or [0.0], *range_m or [math.inf], tuple(cuts))
    if radio.last_cut_end_s() >= limit_s:
        raise ValueError("found a cut that ends after %g s, expected an end before the time limit of %g s" %
                         (radio.last_cut_end_s(), limit_s))
    return radio


if __name__ == "__main__":
    try:
        parse(sys.argv[1], float(sys.argv[2]))
    except ValueError as error:
        print("demo: --radio '%s': %s; see --help" % (sys.argv[1], error), file=sys.stderr)
        sys.exit(2)
