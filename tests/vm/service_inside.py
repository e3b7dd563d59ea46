# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""Runs inside the container of service_test.py, as root, under its systemd. Prints a line a finding; exit status 1 when
one is a FAIL."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import time

UNIT = "topometric.service"
LINK = "topometric-link.service"
CONFIG = pathlib.Path("/etc/topometric/topometric.toml")
SIM_CONTROL = "/run/toposim.sock"
PATIENCE_S = 60
failures = 0


def run(*command):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=PATIENCE_S, check=False)


def check(name, good, found=""):
    global failures
    failures += 0 if good else 1
    print("%7.2f s  %s  %s%s" % (time.monotonic() - BEGIN, "ok  " if good else "FAIL", name, ": %s" % (found,) if found != "" else ""),
          flush=True)
    if not good:
        print(run("journalctl", "--unit", UNIT, "--no-pager", "--output=cat", "--lines=30").stdout)


def wait(condition, seconds=PATIENCE_S):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.05)
    return None


def show(*names):
    lines = run("systemctl", "show", UNIT, *["--property=" + name for name in names]).stdout.splitlines()
    values = dict(line.split("=", 1) for line in lines)
    return [values[name] for name in names]


def main_pid():
    return int(show("MainPID")[0])


def journal():
    run("journalctl", "--sync")
    return run("journalctl", "--unit", UNIT, "--no-pager", "--output=cat").stdout


def topoctl(*words):
    return run("topoctl", *words)


def status():
    done = topoctl("--json", "status")
    return json.loads(done.stdout) if done.returncode == 0 else {}


def sim(command):
    return json.loads(run("/ci/toposim", "ctl", SIM_CONTROL, command).stdout)["robots"][0]


def base_works():
    return status().get("devices", {}).get("base", {}).get("working")


def install():
    done = run("dpkg", "--install", "/ci/topometric.deb")
    check("the package installs", done.returncode == 0, done.stderr.strip())
    active, enabled = show("ActiveState", "UnitFileState")
    check("installing starts nothing", (active, enabled) == ("inactive", "disabled"), (active, enabled))
    verify = run("systemd-analyze", "verify", "--man=no", "--recursive-errors=no", "/lib/systemd/system/" + UNIT)
    words = [line for line in (verify.stdout + verify.stderr).splitlines() if "topometric" in line]
    check("systemd-analyze verify is silent", verify.returncode == 0 and not words, "; ".join(words))


def wrong_configuration():
    CONFIG.parent.mkdir(exist_ok=True)
    CONFIG.write_text('[robot]\nmodle = "p3dx"\n')
    started = run("systemctl", "start", UNIT)
    time.sleep(2.5)  # RestartSec is 1 s
    active, code, restarts = show("ActiveState", "ExecMainStatus", "NRestarts")
    check("a wrong configuration: exit status 2, no restart",
          started.returncode != 0 and (active, code, restarts) == ("failed", "2", "0"), (active, code, restarts))
    check("and the journal says what is wrong", "did you mean robot.model?" in journal())
    run("systemctl", "reset-failed", UNIT)


def start():
    text = pathlib.Path("/ci/simulation.toml").read_text()
    text = text.replace('socket = "/tmp/topometric.sock"', 'socket = "/run/topometric/control.sock"')
    CONFIG.write_text(text.replace('policy = "off"', 'policy = "try"'))
    room = "[[start]]\nx_m = 2\ny_m = 5\n[[wall]]\npoints_m = [[0, 0], [30, 0], [30, 10], [0, 10]]\nclosed = true\n"
    pathlib.Path("/run/room.toml").write_text(room)
    run("systemd-run", "--unit=toposim", "/ci/toposim", "--world", "/run/room.toml", "--ports", "standard", "--control",
        SIM_CONTROL)
    check("toposim answers", wait(lambda: pathlib.Path(SIM_CONTROL).exists() and run("/ci/toposim", "ctl", SIM_CONTROL,
                                                                                     "truth").returncode == 0))
    started = run("systemctl", "start", UNIT)
    check("start waits for READY", started.returncode == 0 and show("ActiveState") == ["active"], started.stderr.strip())
    check("the devices come up", wait(base_works), status().get("devices", {}).get("base", {}).get("message", ""))
    text = wait(lambda: "standing" in show("StatusText")[0] and show("StatusText")[0])
    check("STATUS is readable", text, text)


def confinement():
    lines = pathlib.Path("/proc/%d/status" % main_pid()).read_text().splitlines()
    found = {line.split(":")[0]: line.split(":")[1].split() for line in lines}
    check("its own user", found["Uid"][0] != "0", found["Uid"][0])
    check("no capability, no new privileges, a system call filter",
          int(found["CapBnd"][0], 16) == 0 and found["NoNewPrivs"] == ["1"] and found["Seccomp"] == ["2"])
    check("the limits of the unit", show("LimitRTPRIO", "LimitMEMLOCK") == ["50", "infinity"])


def doctor_finds():
    """Names of the checks that are bad."""
    done = topoctl("--json", "doctor")
    return {c["check"] for c in json.loads(done.stdout)["checks"] if not c["ok"]} if done.stdout else {done.stderr}


def operator():
    done = topoctl("status")
    check("topoctl status", done.returncode == 0 and done.stdout, done.stderr.strip())
    # A container grants no real-time rights where its host has none; everything else must be well.
    bad = wait(lambda: doctor_finds() <= {"real time"} and ["nothing else"]) or sorted(doctor_finds())
    check("topoctl doctor", bad == ["nothing else"], ", ".join(bad))
    check("and says what it looked at", "firmware watchdog" in topoctl("doctor").stdout)


def stands_for(seconds):
    before = sim("truth")
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if sim("truth") != before:
            return False
        time.sleep(0.1)
    return True


def dies_driving(name, number, journal_word):
    """A robot at speed whose daemon gets a signal: started again, E_STOP written, and then it stands."""
    run("systemctl", "reset-failed", UNIT)  # five starts a minute are the limit, and these are more
    driver = subprocess.Popen(["topoctl", "drive", "0.5", "0", "--for", "60"], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL)
    before_m = sim("truth")["path_m"]
    check("%s: the robot drives" % name, wait(lambda: sim("truth")["path_m"] > before_m + 0.3))
    old, stops, at_m, begin = main_pid(), sim("status")["base"]["e_stops"], sim("truth")["path_m"], time.monotonic()
    os.kill(old, number)
    back = wait(lambda: main_pid() not in (0, old) and show("ActiveState", "SubState") == ["active", "running"])
    seconds = time.monotonic() - begin
    driver.kill()
    driver.wait()
    check("%s: started again" % name, back and show("NRestarts") == ["1"], "after %.1f s" % seconds)
    check("%s: %s" % (name, journal_word), journal_word in journal())
    # One E_STOP is the helper's, one the new daemon's.
    check("%s: E_STOP reached the robot" % name, wait(lambda: sim("status")["base"]["e_stops"] >= stops + 2))
    check("%s: the new daemon has the robot" % name, wait(base_works))
    check("%s: and the robot stands until told to move" % name, stands_for(3.0),
          "it stopped %.2f m on" % (sim("truth")["path_m"] - at_m))


def drives_when_told():
    before_m = sim("truth")["path_m"]
    topoctl("drive", "0.2", "0", "--for", "1")
    check("it drives when told", sim("truth")["path_m"] > before_m + 0.02)


def link_show(*names):
    lines = run("systemctl", "show", LINK, *["--property=" + name for name in names]).stdout.splitlines()
    return dict(line.split("=", 1) for line in lines)


def link():
    """The link of a robot without a team ends well; with one it serves the daemon's user, and is started again."""
    started = run("systemctl", "start", LINK)
    found = link_show("ActiveState", "Result")
    check("the link without a team ends well", started.returncode == 0 and wait(
        lambda: link_show("ActiveState", "Result") == {"ActiveState": "inactive", "Result": "success"}, 5), found)
    made = run("topometric-team", "new", "/run/office", "--name", "office"), run("topometric-team", "add", "1", "/run/office")
    run("cp", "-r", "/run/office/robot-1", "/etc/topometric/team")
    run("chown", "-R", "topometric:", "/etc/topometric/team")
    run("ip", "link", "set", "lo", "up")
    CONFIG.write_text(CONFIG.read_text() + """
[team]
name = "office"
id = 1
interface = "lo"
peers = ["127.0.0.1"]
security = "/etc/topometric/team"
""")
    started = run("systemctl", "start", LINK)
    check("the link starts with credentials", started.returncode == 0 and made[1].returncode == 0,
          started.stderr + made[0].stderr + made[1].stderr)
    up = wait(lambda: "radio up" in link_show("StatusText")["StatusText"], 10)
    check("its radio is up", up, run("journalctl", "--unit", LINK, "--no-pager", "--output=cat", "--lines=20").stdout if not up
          else link_show("StatusText")["StatusText"])
    old = link_show("MainPID")["MainPID"]
    os.kill(int(old), signal.SIGKILL)
    check("kill -9: the link is started again", wait(lambda: link_show("MainPID")["MainPID"] not in ("0", old) and
                                                     link_show("ActiveState")["ActiveState"] == "active"))
    run("systemctl", "stop", LINK)
    check("stopping the link is a success", link_show("Result")["Result"] == "success")
    os.chmod("/etc/topometric/team/identity-key.pem", 0o644)
    run("systemctl", "start", LINK)
    check("a key that others may read: exit status 2, no restart", wait(
        lambda: link_show("ActiveState", "ExecMainStatus") == {"ActiveState": "failed", "ExecMainStatus": "2"}, 5),
        link_show("ActiveState", "ExecMainStatus"))
    run("systemctl", "reset-failed", LINK)


def stop():
    stops = sim("status")["base"]["e_stops"]
    run("systemctl", "stop", UNIT)
    result, active = show("Result", "ActiveState")
    check("stop is a success", (result, active) == ("success", "inactive"), (result, active))
    base = sim("status")["base"]
    check("stop: E_STOP and CLOSE reached the robot", base["e_stops"] >= stops + 2 and base["state"] == "wait" and
          not base["motors_on"], base)
    check("stop: the socket is gone", not pathlib.Path("/run/topometric/control.sock").exists())
    check("the helper said so", "E_STOP, VEL 0, RVEL 0, CLOSE written" in journal())


def remove():
    run("systemctl", "reset-failed", UNIT)
    run("systemctl", "start", UNIT)
    check("started once more", wait(base_works))
    old = main_pid()
    done = run("dpkg", "--remove", "topometric")
    check("dpkg --remove stops it", done.returncode == 0 and not pathlib.Path("/proc/%d" % old).exists() and
          run("systemctl", "is-active", UNIT).stdout.strip() != "active", done.stderr.strip())
    check("removed: the session is closed", sim("status")["base"]["state"] == "wait")
    check("removed: maps stay", pathlib.Path("/var/lib/topometric/maps").is_dir())


BEGIN = time.monotonic()
install()
wrong_configuration()
start()
confinement()
operator()
dies_driving("crash", signal.SIGABRT, "status=6/ABRT")
dies_driving("kill -9", signal.SIGKILL, "code=killed, status=9/KILL")
dies_driving("hang", signal.SIGSTOP, "Watchdog timeout")
drives_when_told()
link()
stop()
remove()
print("%d failures" % failures)
sys.exit(1 if failures else 0)
