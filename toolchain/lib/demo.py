# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""The demonstration: two programs started, a mission given, its end waited for and judged. toolchain/demo builds them and
explains the options. What drives the robot is the daemon alone; the simulator's truth is only read to judge."""

import argparse
import fcntl
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import demo_processes
import demo_report

SOURCE = pathlib.Path(__file__).resolve().parents[2]
RESULTS = ("map.pgm", "map.yaml", "cloud.ply", "places.geojson", "overview.png")
ALSO = ("judge.png", "report.json", "trajectory.txt", "goals.json", "topometricd.log", "truth.tsv")
READY_LIMIT_S = 60
LINE_PERIOD_S = 10.0  # where no terminal is
POLL_PERIOD_S = 0.5
# Mapping runs in real time. A machine that is too slow for it makes the simulated time lag behind.
WALL_TIME_FACTOR = 3


class Progress:
    """One line that is written over on a terminal; elsewhere a line every ten seconds."""

    def __init__(self):
        self.terminal = sys.stdout.isatty()
        self.next_s = 0.0

    def show(self, status, elapsed_s):
        if not self.terminal and time.monotonic() < self.next_s:
            return
        self.next_s = time.monotonic() + LINE_PERIOD_S
        pose, twist = status.get("pose", {}), status.get("twist", {})
        line = "%5.0f s  %6.1f m2  %2d goals  (%6.2f, %6.2f)  %4.2f m/s  %s: %s" % (
            elapsed_s, status.get("known_m2") or 0.0, status.get("open_goals") or 0, pose.get("x_m", 0.0), pose.get("y_m", 0.0),
            twist.get("v_mps", 0.0), status.get("activity", "-"), status.get("reason", "-"))
        if self.terminal:
            print("\r%s\033[K" % line[:shutil.get_terminal_size().columns - 1], end="", flush=True)
        else:
            print(line, flush=True)

    def end(self):
        if self.terminal:
            print(flush=True)


class Demo:
    def __init__(self, options, folder, processes):
        self.options = options
        self.folder = folder
        self.out = pathlib.Path(options.out)
        self.processes = processes
        self.why = []  # it did not pass
        self.samples = []  # robot time since the start, known area
        self.status = {}
        self.last_truth = 0.0, {}

    def topoctl(self, *words, patience_s=150.0):
        return self.processes.run("topoctl", "--socket", self.socket, *words, patience_s=patience_s)

    def answer(self, *words):
        done = self.topoctl("--json", *words)
        return json.loads(done.stdout) if done.returncode == 0 else {}

    def truth(self):
        """Robot time, and the robot as it is in the building; the last known when the simulator does not answer."""
        done = self.processes.run("toposim", "ctl", self.sim_control, "truth")
        if done.returncode == 0:
            answer = json.loads(done.stdout)
            self.last_truth = answer["sim_s"], answer["robots"][0]
        return self.last_truth

    def truth_at_end(self):
        return self.last_truth

    def start_simulator(self):
        self.sim_control = self.folder / "sim.sock"
        ready = self.processes.start_and_read_line(
            "toposim", "--world", self.options.world, "--tcp", "--seed", self.options.seed, "--control", self.sim_control,
            "--truth", self.folder / "truth.tsv", "--die-with-parent")
        self.robot = json.loads(ready)["robots"][0]
        self.truth()
        print("building: %s, seed %s" % (self.options.world, self.options.seed))

    def start_daemon(self):
        self.socket = self.folder / "control.sock"
        values = {("control", "socket"): str(self.socket), ("exploration", "strategy"): self.options.strategy,
                  ("exploration", "finish"): self.options.finish}
        for section, device in (("base", "base"), ("scanner.front", "front"), ("scanner.coronal", "coronal")):
            values[section, "address"] = self.robot[device]["address"]
        config = self.folder / "topometric.toml"
        config.write_text(demo_processes.configure((SOURCE / "config/simulation.toml").read_text(), values))
        self.daemon = self.processes.start("topometricd", "--config", config)
        self.threads = demo_processes.ThreadTimes(self.daemon.pid)
        end = time.monotonic() + READY_LIMIT_S
        while not self.socket.exists() and self.daemon.poll() is None and time.monotonic() < end:
            time.sleep(0.05)
        ready = self.topoctl("wait", "ready", "--timeout", READY_LIMIT_S)
        if ready.returncode != 0:
            raise demo_processes.Failure("the robot did not get ready: %s\n%s" %
                                         (ready.stderr.strip(), self.processes.end_of_log("topometricd")))
        print("daemon: topoctl --socket %s status, in another terminal, tells more" % self.socket)

    def explore(self):
        begun = self.topoctl("start")
        if begun.returncode != 0:
            raise demo_processes.Failure("topoctl start: %s" % begun.stderr.strip())
        waiter = self.processes.start("topoctl", "--socket", self.socket, "wait", "done", stdout=subprocess.DEVNULL)
        begin_s, wall_end = self.truth()[0], time.monotonic() + WALL_TIME_FACTOR * self.options.time_limit
        self.threads.begin()
        progress = Progress()
        self.elapsed_s = 0.0
        while waiter.poll() is None:
            self.status = self.answer("status") or self.status
            self.elapsed_s = self.truth()[0] - begin_s
            self.samples.append((self.elapsed_s, self.status.get("known_m2") or 0.0))
            self.threads.update()
            progress.show(self.status, self.elapsed_s)
            if not self.goes_on(time.monotonic() < wall_end):
                break
            self.wait_a_little(waiter)
        progress.end()
        self.processes.end(waiter)
        self.end_mission()

    def wait_a_little(self, waiter):
        try:
            waiter.wait(POLL_PERIOD_S)
        except subprocess.TimeoutExpired:
            pass

    def goes_on(self, in_time):
        if self.daemon.poll() is not None:
            raise demo_processes.Failure("topometricd ended with status %d:\n%s" %
                                         (self.daemon.returncode, self.processes.end_of_log("topometricd")))
        if self.elapsed_s < self.options.time_limit and in_time:
            return True
        self.why.append("the robot was not home after %.0f s of robot time, the limit (--time-limit): %s" %
                        (self.elapsed_s, self.status.get("reason", "-")))
        self.topoctl("stop")
        return False

    def end_mission(self):
        self.status = self.answer("status") or self.status
        self.samples.append((self.elapsed_s, self.status.get("known_m2") or 0.0))
        mission = self.status.get("mission", {})
        if mission.get("state") != "done" and not self.why:
            self.why.append("the mission ended as '%s': %s" % (mission.get("state", "-"), mission.get("reason", "-")))

    def save(self):
        saved = self.topoctl("map", "save", self.out)
        if saved.returncode != 0:
            self.why.append("the map was not saved: %s" % saved.stderr.strip())
        for name in RESULTS:
            if not (self.out / name).exists():
                self.why.append("%s was not written" % name)
        self.goals, self.latency = self.answer("goals"), self.answer("latency")
        self.lost_s = json.loads(self.processes.run("toposim", "ctl", self.sim_control, "status").stdout or "{}").get("lost_s")

    def stop(self):
        """The robot first, the building last."""
        self.truth()
        self.peak_rss_mb = self.threads.peak_rss_mb()
        status = self.processes.end(self.daemon)
        if status != 0:
            self.why.append("topometricd ended with status %s" % status)
        self.processes.end_all()
        for name in ("topometricd.log", "truth.tsv"):
            shutil.copy(self.folder / name, self.out)

    def judge(self):
        start = ",".join("%r" % value for value in self.robot["start"])
        done = self.processes.run("topobench", "judge", "--world", self.options.world, "--map", self.out / "map.yaml", "--truth",
                                  self.folder / "truth.tsv", "--start=" + start, "--picture", self.out / "judge.png", "--json")
        if done.returncode != 0:
            self.why.append("the map could not be judged: %s" % done.stderr.strip())
            return {}
        return json.loads(done.stdout)

    def run(self):
        self.start_simulator()
        self.start_daemon()
        self.explore()
        self.save()
        self.stop()
        report = demo_report.make(self, self.judge())
        (self.out / "report.json").write_text(demo_report.text(report))
        demo_report.tell(report, self.out)
        return 0 if report["passed"] else 1


def prepare_folder(out):
    """Made, emptied of an earlier run's results, and locked until the returned descriptor is closed."""
    out.mkdir(parents=True, exist_ok=True)
    lock = os.open(out, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(lock)
        raise OSError("%s: another demonstration writes there, name another folder" % out) from None
    for name in RESULTS + ALSO:  # what is there afterwards is of this run
        (out / name).unlink(missing_ok=True)
    return lock


def main():
    parser = argparse.ArgumentParser(description="called by toolchain/demo, which explains the options")
    for name in ("bin", "world", "strategy", "finish", "out"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--time-limit", type=int, required=True)
    options = parser.parse_args()
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, signal.default_int_handler)
    try:
        lock = prepare_folder(pathlib.Path(options.out))
    except OSError as error:
        print("demo: --out: %s" % error, file=sys.stderr)
        return 2
    with tempfile.TemporaryDirectory(prefix="topometric-demo-") as name:
        processes = demo_processes.Processes(SOURCE / options.bin, pathlib.Path(name))
        try:
            return Demo(options, pathlib.Path(name), processes).run()
        except KeyboardInterrupt:
            signal.signal(signal.SIGINT, signal.SIG_IGN)
            processes.end_all()
            print("\ndemo: interrupted; the robot is stopped", file=sys.stderr)
            return 130
        except demo_processes.Failure as failure:
            print("\ndemo: %s" % failure, file=sys.stderr)
            return 1
        finally:
            processes.end_all()
            os.close(lock)


if __name__ == "__main__":
    sys.exit(main())
