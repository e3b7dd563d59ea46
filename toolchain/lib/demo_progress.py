# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What a demonstration says while its robots explore."""

import shutil
import sys
import time

LINE_PERIOD_S = 10.0  # where no terminal is


def reason(status):
    """Why a robot does what it does; that it stands because its data disagree goes first."""
    doubts = [doubt.get("found", "-") for doubt in status.get("plausibility", {}).get("doubts", [])]
    return "stands, because " + doubts[0] if doubts else status.get("reason", "-")


class Progress:
    """One line that is written over on a terminal; elsewhere a line every ten seconds."""

    def __init__(self):
        self.terminal = sys.stdout.isatty()
        self.next_s = 0.0

    def show(self, statuses, elapsed_s):
        if not self.terminal and time.monotonic() < self.next_s:
            return
        self.next_s = time.monotonic() + LINE_PERIOD_S
        known = max(status.get("known_m2") or 0.0 for status in statuses)
        line = "%5.0f s  %6.1f m2" % (elapsed_s, known) + "".join(self.of_robot(status) for status in statuses)
        if self.terminal:
            print("\r%s\033[K" % line[:shutil.get_terminal_size().columns - 1], end="", flush=True)
        else:
            print(line, flush=True)

    @staticmethod
    def of_robot(status):
        pose, twist = status.get("pose", {}), status.get("twist", {})
        return "  %2d goals  (%6.2f, %6.2f)  %4.2f m/s  %s: %s" % (
            status.get("open_goals") or 0, pose.get("x_m", 0.0), pose.get("y_m", 0.0), twist.get("v_mps", 0.0),
            status.get("activity", "-"), reason(status))

    def end(self):
        if self.terminal:
            print(flush=True)
