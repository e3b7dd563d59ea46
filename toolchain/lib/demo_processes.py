# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Programs that the demonstration starts: none outlives it, and what a daemon costs is read from /proc."""

import collections
import ctypes
import os
import pathlib
import re
import select
import signal
import subprocess

START_LIMIT_S = 30
STOP_LIMIT_S = 12
LAST_S = 60.0
PR_SET_PDEATHSIG = 1


class Failure(Exception):
    """What the person who runs the demonstration must know, in words."""


def end_with_parent():
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)


class Processes:
    """In the order of their start; ended in the opposite one. A session each: Ctrl-C reaches the script alone, which ends
    them one after the other, the robot before the building."""

    def __init__(self, programs, folder):
        self.programs = programs
        self.folder = folder
        self.running = []

    def command(self, name, words):
        return [str(self.programs / name), *map(str, words)]

    def start(self, name, *words, log=None, enter=(), **options):
        """`enter`: words before the command, which make it run elsewhere. A name with a path is no program of ours."""
        with open(self.folder / ((log or name) + ".log"), "ab") as log_file:
            process = subprocess.Popen([*enter, *self.command(name, words)], stdin=subprocess.DEVNULL, stderr=log_file, text=True,
                                       start_new_session=True, preexec_fn=end_with_parent, **options)
        self.running.append(process)
        return process

    def start_and_read_line(self, name, *words):
        process = self.start(name, *words, stdout=subprocess.PIPE)
        readable = select.select([process.stdout], [], [], START_LIMIT_S)[0]
        line = process.stdout.readline() if readable else ""
        if not line:
            raise Failure("%s did not start:\n%s" % (name, self.end_of_log(name)))
        return line

    def run(self, name, *words, patience_s=60.0):
        """In a session of its own too: Ctrl-C must not end what is asked for in between."""
        try:
            return subprocess.run(self.command(name, words), stdin=subprocess.DEVNULL, capture_output=True, text=True,
                                  start_new_session=True, timeout=patience_s, check=False)
        except subprocess.TimeoutExpired:
            return subprocess.CompletedProcess(words, 1, "", "%s %s: no answer in %.0f s" % (name, words, patience_s))

    def end_of_log(self, name):
        path = self.folder / (name + ".log")
        return path.read_text(errors="replace")[-2000:] if path.exists() else ""

    def end(self, process):
        """Asks, then insists; the exit status, negative for a signal."""
        if process.poll() is None:
            process.terminate()
            try:
                process.wait(STOP_LIMIT_S)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()
        if process in self.running:
            self.running.remove(process)
        if process.stdout:
            process.stdout.close()
        return process.returncode

    def end_all(self):
        # A second Ctrl-C must not leave a program behind.
        before = signal.signal(signal.SIGINT, signal.SIG_IGN)
        for process in reversed(list(self.running)):
            self.end(process)
        signal.signal(signal.SIGINT, before)


class ThreadTimes:
    """Processor time and page faults of every thread of a process, by its name, and the process's memory."""

    def __init__(self, pid):
        self.folder = pathlib.Path("/proc/%d" % pid)
        self.peak_kb = 0
        self.first = self.last = {}
        self.first_s = self.last_s = 0.0
        self.faults = collections.deque()  # (time, faults by thread) of the last minute

    def read(self):
        """Seconds and page faults by thread. schedstat counts nanoseconds; the ticks of stat miss what wakes and sleeps
        within one."""
        seconds, faults = {}, {}
        for task in self.folder.glob("task/*"):
            try:
                name = (task / "comm").read_text().strip()
                fields = (task / "stat").read_text().rpartition(")")[2].split()
                used_s = self.thread_seconds(task, fields)
            except OSError:
                continue  # it has just ended
            seconds[name] = seconds.get(name, 0.0) + used_s
            faults[name] = faults.get(name, 0) + int(fields[7]) + int(fields[9])
        return seconds, faults

    @staticmethod
    def thread_seconds(task, fields):
        if (task / "schedstat").exists():
            return int((task / "schedstat").read_text().split()[0]) * 1e-9
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def begin(self):
        (self.first, faults), self.first_s = self.read(), os.times().elapsed
        self.last, self.last_s = self.first, self.first_s
        self.faults.append((self.first_s, faults))

    def update(self):
        seconds, faults = self.read()
        if seconds:
            self.last, self.last_s = seconds, os.times().elapsed
            self.faults.append((self.last_s, faults))
            while len(self.faults) > 2 and self.faults[1][0] < self.last_s - LAST_S:
                self.faults.popleft()
        self.peak_rss_mb()

    def faults_per_s(self):
        """Of the last minute before the last update."""
        (begin_s, before), (end_s, after) = self.faults[0], self.faults[-1]
        seconds = max(end_s - begin_s, 1e-3)
        return {name: round(max(0, count - before.get(name, 0)) / seconds, 1) for name, count in after.items()}

    def percent(self):
        """Of one core, from begin() to the last update."""
        seconds = max(self.last_s - self.first_s, 1e-3)
        used = {name: 100.0 * (used_s - self.first.get(name, 0.0)) / seconds for name, used_s in self.last.items()}
        return {name: round(value, 2) for name, value in used.items()}

    def peak_rss_mb(self):
        try:
            found = re.search(r"VmHWM:\s*(\d+) kB", (self.folder / "status").read_text())
        except OSError:
            found = None
        self.peak_kb = max(self.peak_kb, int(found.group(1)) if found else 0)
        return round(self.peak_kb / 1024.0, 1)


def configure(text, values):
    """The configuration with other values: {(section, key): text or number}. A key stands in its section, or there behind a #."""
    for (section, key), value in values.items():
        header = re.search(r"(?m)^\[%s\].*$" % re.escape(section), text)
        if header is None:
            text += "\n[%s]\n" % section
            header = re.search(r"(?m)^\[%s\].*$" % re.escape(section), text)
        after = re.search(r"(?m)^\[", text[header.end():])
        end = header.end() + after.start() if after else len(text)
        body, line = text[header.end():end], '%s = %s' % (key, value if isinstance(value, (int, float)) else '"%s"' % value)
        body, found = re.subn(r'(?m)^(?:# *)?%s = (?:"[^"]*"|[\d.]+)' % re.escape(key), lambda _: line, body, count=1)
        text = text[:header.end()] + ("" if found else "\n" + line) + body + text[end:]
    return text
