# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""The network of a demonstration: namespaces of its robots (team_network), and what their radio does not carry.

usage: demo_network.py SPEC: exit status 2, with the reason, when what a radio does cannot be done on this machine"""

import dataclasses
import math
import sys

import demo_radio
import team_network
from team_network import Unavailable

# What comes in at a robot's radio: nothing from robots out of range, and of the rest a share is lost by chance.
RULES = """table netdev air {
  set far { type ether_addr; }
  chain in {
    type filter hook ingress device radio priority 0;
    ether saddr @far drop
    numgen random mod %d < %d drop
  }
}
"""


@dataclasses.dataclass(frozen=True)
class Place:
    """Where a link runs. `enter`: the words before its command."""

    interface: str
    peers: tuple
    enter: tuple


LOOPBACK = Place("lo", ("127.0.0.1",), ())


class Network(team_network.Network):
    """`robots`: how many; here they are counted from 0, as the simulator does."""

    def __init__(self, processes, robots, radio):
        super().__init__(processes, range(1, robots + 1))
        for number in self.rooms:
            self.plug(number)
            if radio.loss > 0.0 or radio.has_range():
                self.filter(number, RULES % (demo_radio.LOSS_STEPS, round(demo_radio.LOSS_STEPS * radio.loss)))

    def place(self, robot):
        return Place("radio", (), self.rooms[robot + 1])

    def switch_all(self, on):
        for number in self.rooms:
            self.switch(number, on)

    def part(self, pairs):
        """The robots of these pairs hear nothing of each other; all others do."""
        for number in self.rooms:
            far = [team_network.mac(a + b + 2 - number) for a, b in sorted(pairs) if number - 1 in (a, b)]
            rules = "flush set netdev air far\n"
            if far:
                rules += "add element netdev air far { %s }\n" % ", ".join(far)
            self.filter(number, rules)


def refusal(text, why):
    return ("--radio '%s' needs network namespaces, and there are none here: %s. Run it as root or where users may make "
            "namespaces; without --radio the links run on the loopback" % (text, why))


def trouble(text):
    """Why what the radio does cannot be done here; empty: it can."""
    return team_network.trouble(lambda processes: Network(processes, 1, demo_radio.parse(text, math.inf)))


def main():
    why = trouble(sys.argv[1])
    if why:
        print("demo: %s" % refusal(sys.argv[1], why), file=sys.stderr)
    return 2 if why else 0


if __name__ == "__main__":
    sys.exit(main())
