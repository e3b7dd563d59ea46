# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""The demonstration: programs started, a mission given, its end waited for and judged. toolchain/demo builds them and
explains the options. What drives the robot is the daemon alone; the simulator's truth is only read to judge."""

import argparse
import fcntl
import json
import math
import os
import pathlib
import shutil
import signal
import sys
import tempfile
import time

import demo_processes
import demo_report
import demo_robot

SOURCE = pathlib.Path(__file__).resolve().parents[2]
RESULTS = ("map.pgm", "map.yaml", "cloud.ply", "places.geojson", "overview.png")
ALSO = ("judge.png", "report.json", "trajectory.txt", "goals.json", "topometricd.log", "truth.tsv")
LINE_PERIOD_S = 10.0  # where no terminal is
POLL_PERIOD_S = 0.5
SETTLE_LIMIT_S = 20
# Mapping runs in real time. A machine that is too slow for it makes the simulated time lag behind.
WALL_TIME_FACTOR = 3


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
            status.get("activity", "-"), status.get("reason", "-"))

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
        self.robots = []
        self.last_truths = 0.0, []

    def truths(self):
        """Robot time, and the robots as they are in the building; the last known when the simulator does not answer."""
        done = self.processes.run("toposim", "ctl", self.sim_control, "truth")
        if done.returncode == 0:
            answer = json.loads(done.stdout)
            self.last_truths = answer["sim_s"], answer["robots"]
        return self.last_truths

    def start_simulator(self):
        self.sim_control = self.folder / "sim.sock"
        ready = self.processes.start_and_read_line(
            "toposim", "--world", self.options.world, "--tcp", "--seed", self.options.seed, "--robots", self.options.robots,
            "--control", self.sim_control, "--truth", self.folder / "truth.tsv", "--die-with-parent")
        self.robots = [demo_robot.Robot(number + 1, devices, self.options, self.folder, self.processes)
                       for number, devices in enumerate(json.loads(ready)["robots"])]
        self.truths()
        print("building: %s, seed %s" % (self.options.world, self.options.seed))

    def start_daemons(self):
        for robot in self.robots:
            robot.start()
        for robot in self.robots:
            robot.wait_ready()
            print("daemon: topoctl --socket %s status, in another terminal, tells more" % robot.socket)

    def explore(self):
        begin_s, wall_end = self.truths()[0], time.monotonic() + WALL_TIME_FACTOR * self.options.time_limit
        progress = Progress()
        self.elapsed_s = 0.0
        while not all(robot.has_ended() for robot in self.robots):
            self.elapsed_s = self.truths()[0] - begin_s
            for robot in self.robots:
                if robot.begin_s is None and self.elapsed_s >= (robot.number - 1) * self.options.entry_delay:
                    robot.begin(self.elapsed_s)
                robot.update(self.elapsed_s)
            self.note()
            progress.show([robot.status for robot in self.robots], self.elapsed_s)
            if not self.goes_on(time.monotonic() < wall_end):
                break
            time.sleep(POLL_PERIOD_S)
        progress.end()
        for robot in self.robots:
            robot.update(self.elapsed_s)
            trouble = robot.end_mission()
            if trouble and not self.why:
                self.why.append(trouble)
        self.note()

    def note(self):
        """The team knows what its best informed robot knows."""
        known = max(robot.status.get("known_m2") or 0.0 for robot in self.robots)
        self.samples.append((self.elapsed_s, known))

    def goes_on(self, in_time):
        for robot in self.robots:
            robot.check_alive()
        if self.elapsed_s < self.options.time_limit and in_time:
            return True
        for robot in self.robots:
            if robot.has_ended():
                continue
            self.why.append("%s was not home after %.0f s of robot time, the limit (--time-limit): %s" %
                            (robot.name, self.elapsed_s, robot.status.get("reason", "-")))
            robot.topoctl("stop")
        return False

    def out_of(self, robot):
        """Of a team, the first robot's results stand in the folder itself, the others' in one each."""
        return self.out if robot.number == 1 else self.out / ("robot%d" % robot.number)

    def settle(self):
        """Until all robots of the team hold the same: what they found last is on its way for a moment."""
        end = time.monotonic() + SETTLE_LIMIT_S
        while len({robot.answer("team").get("held", {}).get("hash") for robot in self.robots}) > 1:
            if time.monotonic() > end:
                return self.why.append("the robots did not come to hold the same within %d s" % SETTLE_LIMIT_S)
            time.sleep(POLL_PERIOD_S)

    def save(self):
        if len(self.robots) > 1:
            self.settle()
        for robot in self.robots:
            folder = self.out_of(robot)
            folder.mkdir(exist_ok=True)
            saved = robot.topoctl("map", "save", folder)
            if saved.returncode != 0:
                self.why.append("the map of %s was not saved: %s" % (robot.name, saved.stderr.strip()))
            for name in RESULTS:
                if not (folder / name).exists():
                    self.why.append("%s was not written" % (folder / name))
            robot.goals, robot.latency, robot.team = robot.answer("goals"), robot.answer("latency"), robot.answer("team")
        self.lost_s = json.loads(self.processes.run("toposim", "ctl", self.sim_control, "status").stdout or "{}").get("lost_s")

    def stop(self):
        """The robots first, the building last."""
        self.truths()
        for robot in self.robots:
            robot.peak_rss_mb = robot.threads.peak_rss_mb()
            status = self.processes.end(robot.daemon)
            if status != 0:
                self.why.append("topometricd of %s ended with status %s" % (robot.name, status))
        self.processes.end_all()
        for path in (*self.folder.glob("topometricd*.log"), *self.folder.glob("topolink*.log"), *self.folder.glob("truth.tsv*")):
            shutil.copy(path, self.out)

    def judge(self, robot):
        # A team's maps are in its common frame, which is the building's; a robot alone begins its map where it stands.
        start = ",".join("%r" % value for value in (robot.devices["start"] if len(self.robots) == 1 else (0.0, 0.0, 0.0)))
        truth = self.folder / ("truth.tsv" + (".%d" % (robot.number - 1) if len(self.robots) > 1 else ""))
        folder = self.out_of(robot)
        done = self.processes.run("topobench", "judge", "--world", self.options.world, "--map", folder / "map.yaml", "--truth",
                                  truth, "--start=" + start, "--picture", folder / "judge.png", "--json")
        if done.returncode != 0:
            self.why.append("the map of %s could not be judged: %s" % (robot.name, done.stderr.strip()))
            return {}
        verdict = json.loads(done.stdout)
        if len(self.robots) > 1:
            verdict["home_distance_m"] = self.from_a_start_m(robot)
        return verdict

    def from_a_start_m(self, robot):
        """The robots of a team share their starts: each comes home to the one that suits the team."""
        truth = self.last_truths[1][robot.number - 1]
        return min(math.hypot(truth["x_m"] - other.devices["start"][0], truth["y_m"] - other.devices["start"][1])
                   for other in self.robots)

    def run(self):
        self.start_simulator()
        self.start_daemons()
        self.explore()
        self.save()
        self.stop()
        report = demo_report.make(self, [self.judge(robot) for robot in self.robots])
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
    for folder in (out, *out.glob("robot[0-9]*")):
        for name in RESULTS + ALSO:  # what is there afterwards is of this run
            (folder / name).unlink(missing_ok=True)
    return lock


def main():
    parser = argparse.ArgumentParser(description="called by toolchain/demo, which explains the options")
    for name in ("bin", "world", "strategy", "finish", "out"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--robots", type=int, default=1)
    parser.add_argument("--entry-delay", type=float, default=0.0)
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
            print("\ndemo: interrupted; every robot is stopped", file=sys.stderr)
            return 130
        except demo_processes.Failure as failure:
            print("\ndemo: %s" % failure, file=sys.stderr)
            return 1
        finally:
            processes.end_all()
            os.close(lock)


if __name__ == "__main__":
    sys.exit(main())
