#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""topometricd and topoctl as processes, with toposim's devices: what an operator does, and what he does wrong.

usage: daemon_process_test.py TOPOMETRICD TOPOCTL TOPOSIM TOPOMETRIC_ESTOP
"""
import fcntl
import json
import os
import pty
import signal
import socket
import subprocess
import sys
import tempfile
import time

from sim_client_tools import Simulation

DAEMON, CTL, SIM, ESTOP = sys.argv[1:5]
PATIENCE_S = 60
STARTED = []  # daemons, so that none outlives a test that failed


def configuration(folder, robot, more=""):
    path = os.path.join(folder, "topometric.toml")
    devices = robot["devices"] if "devices" in robot else robot
    address = {name: "tcp:%s:%d" % (devices[name]["host"], devices[name]["port"]) for name in ("base", "front", "coronal")}
    with open(path, "w") as file:
        file.write("""[robot]
model = "p3dx"
[base]
address = "%s"
[scanner.front]
address = "%s"
x_m = 0.021
[scanner.coronal]
address = "%s"
[control]
socket = "%s/ctl.sock"
[realtime]
policy = "off"
%s""" % (address["base"], address["front"], address["coronal"], folder, more))
    return path


class Daemon:
    def __init__(self, folder, config, *options, stderr=None):
        self.folder = folder
        self.log = open(os.path.join(folder, "log"), "ab")
        self.process = subprocess.Popen([DAEMON, "--config", config, *options], stderr=self.log if stderr is None else stderr)
        STARTED.append(self.process)
        self.until(lambda: self.ctl("version").returncode == 0, "the daemon does not answer")

    def ctl(self, *words):
        return subprocess.run([CTL, "--socket", self.folder + "/ctl.sock", *words], capture_output=True, text=True, timeout=120)

    def status(self):
        done = self.ctl("--json", "status")
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    def until(self, pleases, complaint):
        limit = time.monotonic() + PATIENCE_S
        while not pleases():
            assert self.process.poll() is None, "the daemon ended: %s" % self.logged()
            assert time.monotonic() < limit, "%s: %s" % (complaint, self.logged())
            time.sleep(0.05)

    def logged(self):
        with open(os.path.join(self.folder, "log")) as file:
            return file.read()[-3000:]

    def stop(self, number=signal.SIGTERM):
        begin = time.monotonic()
        self.process.send_signal(number)
        status = self.process.wait(10)
        seconds = time.monotonic() - begin
        self.log.close()
        assert status == 0, "exit status %d: %s" % (status, self.logged())
        assert not os.path.exists(self.folder + "/ctl.sock"), "the socket is left behind"
        return seconds


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, timeout=60)


def test_wrong_configuration(folder):
    path = os.path.join(folder, "wrong.toml")
    with open(path, "w") as file:
        file.write('[robot]\nmodle = "p3dx"\n[base]\naddress = 7\n')
    for option in ("--check-config", "--config"):
        done = run(DAEMON, option, path)
        assert done.returncode == 2, done
        assert "%s:2:1: \"robot.modle\": unknown key, did you mean robot.model?" % path in done.stderr, done.stderr
        assert "%s:4:11: base.address: found 7" % path in done.stderr, done.stderr
        assert "scanner.front.address is missing" in done.stderr, done.stderr
    assert run(DAEMON, "--config", folder + "/nothing.toml").returncode == 2
    assert run(DAEMON, "--no-such-option").returncode == 2
    assert run(DAEMON).returncode == 2
    assert run(DAEMON, "--version").stdout.startswith("topometricd ")
    assert os.listdir(folder) == ["wrong.toml"], os.listdir(folder)


def test_ctl_without_daemon(folder):
    done = run(CTL, "--socket", folder + "/none.sock", "status")
    assert done.returncode == 3 and "none.sock" in done.stderr, done
    assert run(CTL, "no-such-command").returncode == 2
    assert run(CTL).returncode == 2
    done = run(CTL, "--socket", folder + "/none.sock", "doctor")
    assert done.returncode == 3 and "BAD  daemon" in done.stdout and "systemctl start" in done.stdout, done
    assert run(CTL, "--socket", folder + "/none.sock", "wait", "done").returncode == 3
    assert run(CTL, "--help").returncode == 0


def test_wait_ready_waits_for_the_daemon(folder):
    begin = time.monotonic()
    done = run(CTL, "--socket", folder + "/ctl.sock", "wait", "ready", "--timeout", "0.5")
    assert done.returncode == 4 and "nobody answers" in done.stderr, done
    assert time.monotonic() - begin >= 0.5
    with Simulation(SIM, folder) as sim:
        waiting = subprocess.Popen([CTL, "--socket", folder + "/ctl.sock", "wait", "ready", "--timeout", "60"])
        STARTED.append(waiting)
        daemon = Daemon(folder, configuration(folder, sim.robot))
        assert waiting.wait(PATIENCE_S) == 0
        assert daemon.ctl("start").returncode == 0
        assert daemon.stop() < 3


def test_a_daemon_that_hangs(folder):
    with Simulation(SIM, folder) as sim:
        config = configuration(folder, sim.robot)
        daemon = Daemon(folder, config)
        assert daemon.ctl("wait", "ready", "--timeout", "60").returncode == 0
        done = run(ESTOP, "--config", config)
        assert done.returncode == 3 and "topoctl estop" in done.stderr, done
        daemon.process.send_signal(signal.SIGSTOP)
        begin = time.monotonic()
        done = daemon.ctl("estop")
        assert done.returncode == 3 and "does not answer" in done.stderr and "topometric-estop" in done.stderr, done
        done = daemon.ctl("wait", "ready", "--timeout", "0.5")
        assert done.returncode == 4 and "does not answer" in done.stderr, done
        assert time.monotonic() - begin < 4, "it waits longer than it was told to"
        done = daemon.ctl("doctor")
        assert done.returncode == 3 and "--force" in done.stdout, done
        # The simulated port takes one client, as many a bridge does.
        done = run(ESTOP, "--config", config)
        assert done.returncode == 1 and "does not answer" in done.stderr and "--force" in done.stderr, done
        done = run(ESTOP, "--config", config, "--force")
        assert done.returncode == 0 and "E_STOP, VEL 0, RVEL 0, CLOSE written" in done.stdout, done
        assert daemon.process.wait(PATIENCE_S) == -signal.SIGKILL


def test_operator(folder):
    with Simulation(SIM, folder) as sim:
        config = configuration(folder, sim.robot)
        assert run(DAEMON, "--check-config", config).returncode == 0
        shown = run(DAEMON, "--config", config, "--print-config")
        assert "v_max_mps = 0.7  # default" in shown.stdout, shown.stdout
        daemon = Daemon(folder, config, "--record", folder + "/run.rec")
        ready = lambda: all(d["working"] for d in daemon.status()["devices"].values())
        daemon.until(ready, "devices do not come up")
        daemon.until(lambda: daemon.status()["map"]["keyframes"] > 0, "no map")

        second = run(DAEMON, "--config", config)
        assert second.returncode == 1 and "another process serves it" in second.stderr, second
        assert daemon.ctl("version").returncode == 0

        before = sim.truth()
        assert daemon.ctl("drive", "0.3", "0", "--for", "3").returncode == 0
        assert daemon.ctl("drive", "9", "0").returncode == 1
        assert daemon.ctl("drive", "0", "-0.5", "--for", "0.5").returncode == 0
        after = sim.truth()
        moved = sum((a - b) ** 2 for a, b in zip(position(after), position(before))) ** 0.5
        assert 0.3 < moved < 1.2, (before, after)

        assert daemon.ctl("estop").returncode == 0
        done = daemon.ctl("drive", "0.1", "0")
        assert done.returncode == 1 and "clear-estop" in done.stderr, done
        assert daemon.ctl("clear-estop").returncode == 0

        os.mkdir(folder + "/map")
        done = daemon.ctl("map", "save", folder + "/map")
        assert done.returncode == 0, done
        saved = os.listdir(folder + "/map")
        assert {"cloud.ply", "map.pgm", "map.yaml", "trajectory.txt"} <= set(saved), saved
        assert daemon.ctl("map", "save", folder + "/nowhere/map").returncode == 1
        assert daemon.ctl("log-level", "debug").returncode == 0
        assert daemon.ctl("log-level", "loud").returncode == 1
        for words in (["status"], ["latency"], ["health"], ["config"], ["goals"], ["goals", "--why"], ["places"], ["doctor"]):
            done = daemon.ctl(*words)
            assert done.returncode == 0 and done.stdout, done
        latency = json.loads(daemon.ctl("--json", "latency").stdout)
        print("latency", json.dumps(latency))
        check_slow_client(daemon)
        seconds = daemon.stop()
        print("stopped in %.2f s" % seconds)
        assert seconds < 3, seconds
    check_replay(folder, config)


def test_missions(folder):
    """What scripts do: wait, send, look, stop; and what is refused."""
    with Simulation(SIM, folder) as sim:
        daemon = Daemon(folder, configuration(folder, sim.robot, "[exploration]\nsave_folder = \"%s/kept\"\n" % folder))
        assert daemon.ctl("wait", "done").returncode == 1, "there is no mission to wait for"
        assert daemon.ctl("wait", "ready", "--timeout", "60").returncode == 0
        assert daemon.status()["mission"]["state"] == "none"
        done = daemon.ctl("goto", "500", "0")
        assert done.returncode == 1 and done.stderr, done
        assert daemon.ctl("pause").returncode == 1 and daemon.ctl("resume").returncode == 1

        assert daemon.ctl("start").returncode == 0
        assert daemon.ctl("start").returncode == 1, "one is under way"
        assert daemon.ctl("wait", "done", "--timeout", "0.3").returncode == 4
        assert daemon.ctl("estop").returncode == 0
        status = daemon.status()
        assert status["mission"]["state"] == "paused" and status["estop"], status
        for words in (["resume"], ["home"], ["start"]):
            done = daemon.ctl(*words)
            assert done.returncode == 1 and "clear-estop" in done.stderr, done
        done = daemon.ctl("doctor")
        assert done.returncode == 1 and "clear-estop" in done.stdout, done
        still = standing(daemon, sim)
        assert daemon.ctl("clear-estop").returncode == 0
        daemon.until(lambda: not daemon.status()["estop"], "the e-stop is not cleared")
        time.sleep(1.5)  # longer than a plan lives: nothing may set it going but an order
        assert position(sim.truth()) == position(still), "it moves without an order: %s, %s, %s" % (still, sim.truth(), daemon.logged())
        assert daemon.ctl("resume").returncode == 0
        watch = subprocess.Popen([CTL, "--socket", folder + "/ctl.sock", "--json", "watch", "--every", "0.1"],
                                 stdout=subprocess.PIPE, text=True)
        STARTED.append(watch)
        assert json.loads(watch.stdout.readline())["mission"]["state"] == "under way"
        assert daemon.ctl("stop").returncode == 0
        last = watch.communicate(timeout=60)[0].splitlines()[-1]
        assert watch.returncode == 0 and json.loads(last)["mission"]["state"] == "stopped", last
        assert daemon.ctl("wait", "done").returncode == 5, "a mission that was stopped is no success"

        assert daemon.ctl("home").returncode == 0
        done = daemon.ctl("--json", "wait", "done", "--timeout", "60")
        assert done.returncode == 0 and json.loads(done.stdout)["order"] == "home", done
        # The last file to be written; those before it are whole.
        daemon.until(lambda: os.path.exists(folder + "/kept/overview.png"), "the map was not kept")
        assert sorted(os.listdir(folder + "/kept")) == ["cloud.ply", "doubt.json", "goals.json", "map.pgm", "map.yaml", "overview.png",
                                                        "places.geojson", "trajectory.txt"]
        assert daemon.stop() < 3


def standing(daemon, sim):
    """Where the robot stands, when it does."""
    seen = [None]

    def stands():
        before, seen[0] = seen[0], position(sim.truth())
        time.sleep(0.3)
        return before == seen[0]
    daemon.until(stands, "it does not stand")
    return sim.truth()


def test_keys(folder):
    """Driving by keys on a terminal, which then dies: the robot stops by itself."""
    with Simulation(SIM, folder) as sim:
        daemon = Daemon(folder, configuration(folder, sim.robot))
        assert daemon.ctl("wait", "ready", "--timeout", "60").returncode == 0
        assert daemon.ctl("drive").returncode == 1, "no terminal"
        master, slave = pty.openpty()
        driver = subprocess.Popen([CTL, "--socket", folder + "/ctl.sock", "drive"], stdin=slave, stdout=subprocess.DEVNULL)
        STARTED.append(driver)
        os.close(slave)
        moving = lambda: os.write(master, b"w") and daemon.status()["twist"]["v_mps"] > 0.1
        daemon.until(moving, "it does not drive")
        os.write(master, b" ")
        daemon.until(lambda: daemon.status()["commanded"]["v_mps"] == 0.0, "space does not stop it")
        daemon.until(moving, "it does not drive again")
        driver.kill()
        driver.wait()
        daemon.until(lambda: daemon.status()["twist"]["v_mps"] == 0.0, "it drives on without anybody")
        os.close(master)
        assert daemon.stop() < 3


def position(truth):
    pose = truth.get("pose", truth)
    return pose["x_m"], pose["y_m"]


def check_slow_client(daemon):
    """A client that asks and never reads does not keep the others waiting."""
    slow = socket.socket(socket.AF_UNIX)
    slow.connect(daemon.folder + "/ctl.sock")
    slow.settimeout(1)
    try:
        for _ in range(5000):
            slow.sendall(b'{"jsonrpc": "2.0", "method": "config", "id": 1}\n')
    except OSError:
        pass
    assert daemon.ctl("status").returncode == 0
    slow.close()


def check_replay(folder, config):
    with open(folder + "/run.rec", "rb") as file:
        assert any(file.read(24)[16:]), "the recording does not say which configuration it was made with"
    summary = run(DAEMON, "--summary", folder + "/run.rec")
    assert summary.returncode == 0 and "ended in order" in summary.stdout, summary
    assert all("  %s: " % channel in summary.stdout for channel in ("base", "front", "coronal")), summary
    assert run(DAEMON, "--summary", folder + "/nothing.rec").returncode == 2
    # The robot's own sessions: the only journal that may stay is one that a new one would push out.
    kept = os.path.join(folder, "kept")
    scratch = os.path.join(folder, "scratch")
    os.mkdir(kept)
    os.mkdir(scratch)
    journal = os.path.join(kept, "journal-20260102T030405Z.session")
    with open(journal, "wb") as file:
        file.write(b"of a daemon that was killed")
    with open(config, "a") as file:
        file.write('[session]\nfolder = "%s"\nkeep = 1\njournal_period_s = 0.2\n' % kept)
    daemon = Daemon(folder, config, "--replay", folder + "/run.rec", "--sessions", scratch)
    daemon.until(lambda: daemon.status()["map"]["keyframes"] >= 2, "the recording gives no map")
    daemon.until(lambda: daemon.status()["session"]["journal"]["keyframes"] >= 2, "the replay keeps no session")
    assert daemon.process.wait(PATIENCE_S) == 0, "the replay does not end with the recording: %s" % daemon.logged()
    assert not os.path.exists(folder + "/ctl.sock"), "the socket is left behind"
    assert os.listdir(kept) == [os.path.basename(journal)], os.listdir(kept)
    with open(journal, "rb") as file:
        assert file.read() == b"of a daemon that was killed"
    assert sorted(name.split("-")[0] for name in os.listdir(scratch)) == ["journal", "log"], os.listdir(scratch)
    with open(folder + "/run.rec", "rb") as whole, open(folder + "/cut.rec", "wb") as cut:
        cut.write(whole.read()[:os.path.getsize(folder + "/run.rec") // 3])
    done = run(DAEMON, "--config", config, "--replay", folder + "/cut.rec")
    assert done.returncode == 0 and "cut.rec: at byte " in done.stderr and "cut after" in done.stderr, done
    assert run(DAEMON, "--config", config, "--sessions", scratch).returncode == 2, "sessions of a replay, without one"
    assert run(DAEMON, "--config", config, "--replay", folder + "/nothing.rec").returncode == 2


def nowhere():
    """Devices that are not there."""
    return {name: {"host": "127.0.0.1", "port": 9 + at} for at, name in enumerate(("base", "front", "coronal"))}


def test_a_log_that_nobody_reads(folder):
    """A terminal that is held, a pager that is not scrolled: an e-stop is answered all the same."""
    reader, writer = os.pipe()
    fcntl.fcntl(writer, fcntl.F_SETPIPE_SZ, 4096)
    daemon = Daemon(folder, configuration(folder, nowhere()), stderr=writer)
    os.close(writer)
    client = socket.socket(socket.AF_UNIX)
    client.connect(folder + "/ctl.sock")
    client.settimeout(20)
    answers = client.makefile()
    for number in range(3000):  # a line of the log each, more than the pipe and the queue take
        client.sendall(b'{"jsonrpc": "2.0", "method": "estop", "id": %d}\n' % number)
        assert json.loads(answers.readline())["id"] == number
    assert daemon.status()["estop"]
    client.close()
    os.close(reader)
    assert daemon.stop() < 3


def test_ctrl_c_ends_a_slow_watch(folder):
    daemon = Daemon(folder, configuration(folder, nowhere()))
    watch = subprocess.Popen([CTL, "--socket", folder + "/ctl.sock", "--json", "watch", "--every", "3600"],
                             stdout=subprocess.PIPE, text=True)
    STARTED.append(watch)
    assert "state" in json.loads(watch.stdout.readline())
    watch.send_signal(signal.SIGINT)
    assert watch.wait(20) == 0
    assert daemon.stop(signal.SIGHUP) < 3, "as when the terminal is gone"


def test_devices_that_are_not_there(folder):
    daemon = Daemon(folder, configuration(folder, nowhere()))
    daemon.until(lambda: "127.0.0.1:10" in daemon.status()["devices"]["front"]["message"], "the device is not named")
    assert daemon.ctl("map", "save", folder).returncode == 1
    for words in (["start"], ["home"], ["goto", "1", "0"]):
        done = daemon.ctl(*words)
        assert done.returncode == 1 and "base is not ready" in done.stderr, done
    assert daemon.ctl("wait", "ready", "--timeout", "0.2").returncode == 4
    done = daemon.ctl("doctor")
    assert done.returncode == 1 and "BAD  base" in done.stdout and "cure:" in done.stdout, done
    assert daemon.stop() < 3


def main():
    for name, test in sorted(globals().items()):
        if name.startswith("test_") and (len(sys.argv) < 6 or name in sys.argv[5:]):
            with tempfile.TemporaryDirectory() as folder:
                begin = time.monotonic()
                try:
                    test(folder)
                finally:
                    for process in STARTED:
                        process.kill()
                    STARTED.clear()
                print("%s: %.1f s" % (name, time.monotonic() - begin), flush=True)


if __name__ == "__main__":
    main()
