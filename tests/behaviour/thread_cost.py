# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What something costs a daemon's threads that must not feel it: processor time (/proc/PID/task/TID/schedstat) and system
calls (counted by perf) of base and mapping, in pairs with it and without."""
import pathlib
import re
import shutil
import statistics
import subprocess
import time

THREADS = ("base", "mapping")
RATIO_MAX = 1.05
TURN_RADPS = 0.4
WARM_UP_S = 150.0  # the first turns make keyframes, and idle robots search their past


def need(*programs):
    """Of the packages linux-perf and strace."""
    for name in programs:
        if not shutil.which(name):
            raise SystemExit("%s is missing (packages linux-perf and strace)" % name)


def thread_ids(pid):
    tasks = pathlib.Path("/proc/%d/task" % pid).iterdir()
    return {name: int(task.name) for task in tasks for name in [(task / "comm").read_text().strip()] if name in THREADS}


def cpu_s(pid, thread):
    return int(pathlib.Path("/proc/%d/task/%d/schedstat" % (pid, thread)).read_text().split()[0]) * 1e-9


def calls_counter(thread, seconds):
    return subprocess.Popen(["perf", "stat", "-x", ";", "-e", "raw_syscalls:sys_enter", "-t", str(thread), "--", "sleep",
                             str(seconds)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def measured(pid, seconds):
    """Milliseconds of processor time and system calls a second, by thread."""
    threads = thread_ids(pid)
    counters = {name: calls_counter(thread, seconds) for name, thread in threads.items()}
    before, begin = {name: cpu_s(pid, thread) for name, thread in threads.items()}, time.monotonic()
    said = {name: counter.communicate()[1] for name, counter in counters.items()}
    passed_s = time.monotonic() - begin
    found = {}
    for name, thread in threads.items():
        counted = re.match(r"(\d+);", said[name].strip())
        if not counted:
            raise SystemExit("perf counted no system calls: %s" % said[name].strip())
        found[name, "ms/s"] = 1e3 * (cpu_s(pid, thread) - before[name]) / passed_s
        found[name, "calls/s"] = int(counted.group(1)) / seconds
    return found


def in_pairs(count, with_it, without_it):
    """(with, without), `count` times; which of the two comes first alternates. Each is a function that measures."""
    pairs = []
    for number in range(count):
        order = (with_it, without_it) if number % 2 == 0 else (without_it, with_it)
        found = {how: how() for how in order}
        pairs.append((found[with_it], found[without_it]))
        print("pair %d: %s" % (number + 1, {"%s %s" % key: tuple(round(side[key], 2) for side in pairs[-1])
                                           for key in pairs[-1][0]}), flush=True)
    return pairs


def report(pairs):
    """Prints the ratios of the medians; False when one is above RATIO_MAX."""
    passed = True
    for key in pairs[0][0]:
        on, off = (statistics.median(pair[side][key] for pair in pairs) for side in (0, 1))
        ratio = on / off
        passed = passed and ratio <= RATIO_MAX
        print("%-8s %-8s with %s, without %s: medians %.2f and %.2f, ratio %.3f" % (
            *key, " ".join("%.2f" % pair[0][key] for pair in pairs), " ".join("%.2f" % pair[1][key] for pair in pairs), on, off,
            ratio))
    return passed


class Turning:
    """Robots that turn on the spot meanwhile, so that every scan is matched anew; it begins when turning adds nothing to
    their maps any more. `sockets`: of their daemons; `seconds`: how long it may take from then on."""

    def __init__(self, programs, sockets, seconds):
        self.commands = [[str(word) for word in (programs / "topoctl", "--socket", socket, "drive", 0, TURN_RADPS, "--for",
                                                 WARM_UP_S + seconds)] for socket in sockets]

    def __enter__(self):
        self.processes = [subprocess.Popen(command) for command in self.commands]
        time.sleep(WARM_UP_S)

    def __exit__(self, *_):
        for process in self.processes:
            process.terminate()
            process.wait()
