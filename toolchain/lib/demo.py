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

import demo_air
import demo_network
import demo_processes
import demo_progress
import demo_radio
import demo_record
import demo_report
import demo_robot
import demo_view

SOURCE = pathlib.Path(__file__).resolve().parents[2]
RESULTS = ("map.pgm", "map.yaml", "cloud.ply", "places.geojson", "overview.png")
PICTURES = ("ways.png", "coverage.png", "goals.png")
ALSO = (*PICTURES, "judge.png", "report.json", "samples.json", "trajectory.txt", "goals.json", "topometricd.log",
        "topoview.log", "truth.tsv")
POLL_PERIOD_S = 0.5
AIR_PERIOD_S = 0.2  # at 0.7 m/s a range is kept to within 0.3 m
SETTLE_LIMIT_S = 60  # after ten minutes apart all is held by all within a minute
DRAW_LIMIT_S = 120
# Mapping runs in real time. A machine that is too slow for it makes the simulated time lag behind.
WALL_TIME_FACTOR = 3


class Demo:
    def __init__(self, options, folder, processes):
        self.options = options
        self.folder = folder
        self.out = pathlib.Path(options.out)
        self.processes = processes
        self.why = []  # it did not pass
        self.record = demo_record.Record()
        self.robots = []
        self.last_truths, self.begin_s = (0.0, []), None

    def truths(self):
        """Robot time, and the robots as they are in the building; the last known when the simulator does not answer."""
        done = self.processes.run("toposim", "ctl", self.sim_control, "truth")
        if done.returncode == 0:
            answer = json.loads(done.stdout)
            self.last_truths = answer["sim_s"], answer["robots"]
        return self.last_truths

    def lay_network(self):
        """Where each robot's link is; one network for all on the loopback where a perfect radio needs no better one."""
        count, radio = self.options.robots, self.options.radio
        self.air, self.places = demo_air.Air(radio, None), [demo_network.LOOPBACK] * count
        if count == 1:
            return
        try:
            network = demo_network.Network(self.processes, count, radio)
        except demo_network.Unavailable as why:
            if not radio.is_perfect():
                raise demo_processes.Failure(demo_network.refusal(self.options.radio_text, why)) from None
            print("links: on the loopback (no network namespaces: %s)" % why)
            return
        print("links: each in a network namespace of its own, radio %s" % self.options.radio_text)
        self.air, self.places = demo_air.Air(radio, network), [network.place(robot) for robot in range(count)]

    def start_simulator(self):
        self.sim_control = self.folder / "sim.sock"
        ready = self.processes.start_and_read_line(
            "toposim", "--world", self.options.world, "--tcp", "--seed", self.options.seed, "--robots", self.options.robots,
            "--control", self.sim_control, "--truth", self.folder / "truth.tsv", "--die-with-parent")
        self.robots = [demo_robot.Robot(number + 1, devices, self.options, self.folder, self.processes, self.places[number])
                       for number, devices in enumerate(json.loads(ready)["robots"])]
        self.follow()
        print("building: %s, seed %s" % (self.options.world, self.options.seed))

    def start_daemons(self):
        if len(self.robots) > 1:
            demo_robot.make_credentials(self.processes, self.folder, len(self.robots))
        for robot in self.robots:
            robot.start()
        for robot in self.robots:
            robot.wait_ready()
            print("daemon: topoctl --socket %s status, in another terminal, tells more" % robot.socket)

    def follow(self):
        """Robot time since the start, 0 before it, with the radio as it is then."""
        sim_s, truths = self.truths()
        self.elapsed_s = sim_s - self.begin_s if self.begin_s is not None else 0.0
        self.air.follow(self.elapsed_s if self.begin_s is not None else demo_air.BEFORE_S,
                        [(truth["x_m"], truth["y_m"]) for truth in truths])

    def pause(self):
        end = time.monotonic() + POLL_PERIOD_S
        while not self.options.radio.is_perfect() and time.monotonic() < end - AIR_PERIOD_S:
            time.sleep(AIR_PERIOD_S)
            self.follow()
        time.sleep(max(0.0, end - time.monotonic()))

    def hold(self):
        """With --view: everything stays as it is for who looks at the page, until Ctrl-C."""
        if not self.options.view:
            return
        print("all is saved; the page stays at %s until Ctrl-C" % self.page, flush=True)
        try:
            while True:
                for robot in self.robots:
                    robot.check_alive()
                self.pause()
        except KeyboardInterrupt:
            print()

    def explore(self):
        self.begin_s, wall_end = self.truths()[0], time.monotonic() + WALL_TIME_FACTOR * self.options.time_limit
        self.begin_steady_s = time.monotonic()
        progress = demo_progress.Progress()
        while not all(robot.has_ended() for robot in self.robots):
            self.follow()
            for robot in self.robots:
                if robot.begin_s is None and self.elapsed_s >= (robot.number - 1) * self.options.entry_delay:
                    robot.begin(self.elapsed_s)
                robot.update(self.elapsed_s)
            self.note()
            progress.show([robot.status for robot in self.robots], self.elapsed_s)
            if not self.goes_on(time.monotonic() < wall_end):
                break
            self.pause()
        progress.end()
        self.ended_s = self.elapsed_s
        for robot in self.robots:
            robot.update(self.elapsed_s)
            trouble = robot.end_mission()
            if trouble and not self.why:
                self.why.append(trouble)
        self.note()

    def note(self):
        if len(self.robots) > 1:
            for robot in self.robots:
                robot.ask_team()
        self.record.note(self.elapsed_s, self.robots)

    def goes_on(self, in_time):
        for robot in self.robots:
            robot.check_alive()
        if self.elapsed_s < self.options.time_limit and in_time:
            return True
        for robot in self.robots:
            if robot.has_ended():
                continue
            self.why.append("%s was not home after %.0f s of robot time, the limit (--time-limit): %s" %
                            (robot.name, self.elapsed_s, demo_progress.reason(robot.status)))
            robot.topoctl("stop")
        return False

    def out_of(self, robot):
        """Of a team, the first robot's results stand in the folder itself, the others' in one each."""
        return self.out if robot.number == 1 else self.out / ("robot%d" % robot.number)

    def settle(self):
        """Until the radio's last cut is over and all robots of the team hold the same: what they found last is on its way
        for a moment, and what they found apart for longer."""
        begin_s = max(self.elapsed_s, self.options.radio.last_cut_end_s())
        if begin_s > self.elapsed_s:
            print("all have ended; waiting for the radio's cut to end at %.0f s" % begin_s, flush=True)
        self.note()
        while self.record.equal_after(begin_s) is None:
            if self.elapsed_s > begin_s + SETTLE_LIMIT_S:
                return self.why.append("the robots did not come to hold the same within %d s" % SETTLE_LIMIT_S)
            self.pause()
            self.follow()
            for robot in self.robots:
                robot.check_alive()
                robot.update(self.elapsed_s)
            self.note()

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
            robot.goals, robot.latency = robot.answer("goals"), robot.answer("latency")
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
        for path in (*self.folder.glob("topometricd*.log"), *self.folder.glob("topolink*.log"), *self.folder.glob("topoview.log"), *self.folder.glob("truth.tsv*")):
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

    def draw(self, judged):
        """The pictures, by the system's Python: PIL and numpy are Debian's packages of it."""
        (self.out / "samples.json").write_text(self.record.text(
            starts=[robot.devices["start"] for robot in self.robots], gaps=self.air.gaps, begin_steady_s=self.begin_steady_s,
            radio=self.options.radio_text, covered=[verdict.get("covered") for verdict in judged]))
        python = "/usr/bin/python3" if os.access("/usr/bin/python3", os.X_OK) else sys.executable
        done = self.processes.run(python, "-B", SOURCE / "toolchain/lib/demo_pictures.py", self.out, patience_s=DRAW_LIMIT_S)
        if done.returncode != 0:
            self.why.append("the pictures were not drawn (they take Debian's python3-numpy and python3-pil): %s" %
                            (done.stderr.strip().splitlines() or ["no reason"])[-1])

    def run(self):
        self.lay_network()
        self.start_simulator()
        self.start_daemons()
        self.page = demo_view.start(self.robots[0], self.processes)
        print("page: %s" % self.page, flush=True)
        self.explore()
        self.save()
        self.hold()
        self.stop()
        judged = [self.judge(robot) for robot in self.robots]
        self.draw(judged)
        report = demo_report.make(self, judged)
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
    parser.add_argument("--speed", type=float, default=0.7)
    parser.add_argument("--time-limit", type=int, required=True)
    parser.add_argument("--radio", dest="radio_text", default="perfect")
    parser.add_argument("--view", action="store_true")
    options = parser.parse_args()
    try:
        options.radio = demo_radio.parse(options.radio_text, options.time_limit)
        if options.robots == 1 and not options.radio.is_perfect():
            raise ValueError("a robot alone has no radio, expected --robots 2 or more")
    except ValueError as error:
        print("demo: --radio '%s': %s" % (options.radio_text, error), file=sys.stderr)
        return 2
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
