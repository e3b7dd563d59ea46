# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a demonstration saw of its robots over time, for its report and its pictures."""

import json

LACK_MAX_BYTES = 15e3  # three keyframes and a bit: 1.6 a second of some 4.3 kB each, while a robot drives


def goal_of(status):
    """(x, y) in m of what the robot drives to for the exploration's sake, "home" on the way back, or None."""
    if status.get("activity") == "returning":
        return "home"
    goal = status.get("goal")
    return [round(goal["x_m"], 2), round(goal["y_m"], 2)] if goal else None


def lack_of(robot):
    """Bytes that the robot knows to lack of what mates hold; None while not every mate is in reach."""
    peers = robot.team.get("peers", [])
    if not peers or not all(peer["alive"] for peer in peers):
        return None
    return max(peer["lacks_here"]["bytes"] for peer in peers)


class Record:
    """A row a moment: seconds since the start, of each robot the known area in m2, its goal, the hash of what it holds (None:
    it does not say), and what it lacks."""

    def __init__(self):
        self.rows = []

    def note(self, elapsed_s, robots):
        self.rows.append((elapsed_s, [robot.status.get("known_m2") or 0.0 for robot in robots],
                          [goal_of(robot.status) for robot in robots],
                          [robot.team.get("held", {}).get("hash") for robot in robots],
                          [lack_of(robot) for robot in robots]))

    def best_known(self):
        """The team knows what its best informed robot knows."""
        return [(elapsed_s, max(known)) for elapsed_s, known, *_ in self.rows]

    def equal_after(self, time_s):
        """Seconds from that time to the first row in which all robots hold the same; None: there is none."""
        return next((round(elapsed_s - time_s, 1) for elapsed_s, _, _, held, _ in self.rows
                     if elapsed_s >= time_s and None not in held and len(set(held)) == 1), None)

    def caught_up_after(self, time_s):
        """Seconds from that time until, after all were in reach of all again and what they lacked was greatest, none lacked
        more than what it drives past in two seconds; None: that did not come."""
        rows = [(elapsed_s, max(lack)) for elapsed_s, *_, lack in self.rows if elapsed_s >= time_s and None not in lack]
        peak = max(range(len(rows)), key=lambda i: rows[i][1], default=0)
        return next((round(elapsed_s - time_s, 1) for elapsed_s, lack in rows[peak:] if lack <= LACK_MAX_BYTES), None)

    def text(self, **more):
        columns = [list(column) for column in zip(*self.rows)] or [[], [], [], [], []]
        return json.dumps({"t_s": [round(t, 2) for t in columns[0]], "known_m2": columns[1], "goals": columns[2],
                           "lacks_bytes": columns[4], **more}) + "\n"
