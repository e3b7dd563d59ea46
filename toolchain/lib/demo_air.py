# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""The air between the robots of a demonstration: what --radio says, done to a network as time and robots move on."""

BEFORE_S = -1.0  # the time before the start, when no cut has begun


class Air:
    """`network`: has switch_all() and part(), as demo_network.Network; None: nothing can be kept from anybody. `gaps`: [from, to]
    in seconds since the start, while not every robot was in direct reach of every other; `to` is None while it lasts."""

    def __init__(self, radio, network):
        self.radio, self.network = radio, network
        self.cut, self.far, self.gaps = False, frozenset(), []

    def follow(self, elapsed_s, places):
        """Brings the network to what holds at this time, where the robots are there; `places`: [(x, y), ...] in m."""
        cut, far = self.radio.is_cut(elapsed_s), self.radio.far_pairs(places)
        if cut != self.cut:
            self.network.switch_all(not cut)
        if far != self.far:
            self.network.part(far)
        was_apart, is_apart = bool(self.cut or self.far), bool(cut or far)
        self.cut, self.far = cut, far
        if is_apart and not was_apart:
            self.gaps.append([max(0.0, round(elapsed_s, 1)), None])
        elif was_apart and not is_apart:
            self.gaps[-1][1] = max(0.0, round(elapsed_s, 1))
