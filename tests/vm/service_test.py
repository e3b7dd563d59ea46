#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""The package on a system of its own: makes the .deb, boots systemd in a container (systemd-nspawn, a throw-away overlay
over a minimal Debian that is made once), and runs service_inside.py in it.

usage: service_test.py BUILD_FOLDER [--prepare]     (--prepare: only make the minimal Debian)

Needs root, mmdebstrap and systemd-container (toolchain/install-dependencies ci). Exit status 77: not run, because one of
them is missing; with TOPOMETRIC_VM=required that is a failure, with TOPOMETRIC_VM=off nothing is tried.
The minimal Debian (about 300 MB) is kept in $XDG_CACHE_HOME/topometric, by default ~/.cache/topometric."""
import fcntl
import hashlib
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parents[1]
SUITE = "bookworm"
SYSTEM = ["systemd", "systemd-sysv", "udev", "dbus", "kmod", "iproute2", "procps", "python3"]
MAKE_LIMIT_S = 600
RUN_LIMIT_S = 300
CONTAINER_UNIT = """[Unit]
After=basic.target dbus.service
SuccessAction=exit-force
FailureAction=exit-force
[Service]
Type=oneshot
TimeoutStartSec=%d
ExecStart=/usr/bin/python3 -B /ci/service_inside.py
StandardOutput=file:/ci/out
StandardError=inherit
""" % (RUN_LIMIT_S - 20)


def cannot(why):
    required = os.environ.get("TOPOMETRIC_VM") == "required"
    print("%s: %s; the service was not tested in a container" % ("FAILED" if required else "SKIPPED", why))
    sys.exit(1 if required else 77)


def check_machine():
    if os.environ.get("TOPOMETRIC_VM") == "off":
        print("SKIPPED: TOPOMETRIC_VM=off; the service is not tested in a container here")
        sys.exit(77)
    for program, package in (("systemd-nspawn", "systemd-container"), ("mmdebstrap", "mmdebstrap"), ("cpack", "cmake")):
        if not shutil.which(program):
            cannot("%s is missing (package %s)" % (program, package))
    if os.geteuid() != 0:
        cannot("not root")


def run_packages():
    listed = subprocess.run([SOURCE / "toolchain/install-dependencies", "run", "--list"], check=True, capture_output=True,
                            text=True)
    return listed.stdout.split()


def apt_sources():
    found = [pathlib.Path("/etc/apt/sources.list"), pathlib.Path("/etc/apt/sources.list.d/debian.sources")]
    return [str(path) for path in found if path.is_file() and path.stat().st_size > 0]


def minimal_debian(cache):
    """Made under another name and moved: what stands there is whole."""
    packages = SYSTEM + run_packages()
    root = cache / ("root-" + hashlib.sha256(" ".join([SUITE, *packages]).encode()).hexdigest()[:12])
    if root.is_dir():
        return root
    print("making a minimal Debian in %s" % root, flush=True)
    fresh = pathlib.Path(tempfile.mkdtemp(prefix="making-", dir=cache))
    command = ["mmdebstrap", "--quiet", "--variant=minbase", "--include=" + ",".join(packages),
               '--aptopt=Apt::Install-Recommends "false"']
    command += ["--dpkgopt=path-exclude=/usr/share/%s/*" % name for name in ("man", "doc", "locale")]
    try:
        made = subprocess.run([*command, SUITE, str(fresh / "root"), *apt_sources()], timeout=MAKE_LIMIT_S,
                              stdin=subprocess.DEVNULL, check=False)
        if made.returncode != 0:
            cannot("mmdebstrap ended with status %d (is there a Debian mirror?)" % made.returncode)
        (fresh / "root/etc/hostname").write_text("robot\n")
        for old in cache.glob("root-*"):
            shutil.rmtree(old)
        (fresh / "root").rename(root)
    finally:
        shutil.rmtree(fresh, ignore_errors=True)
    return root


def make_package(build, folder):
    done = subprocess.run(["cpack", "-G", "DEB", "--config", str(build / "CPackConfig.cmake"), "-B", str(folder / "cpack")],
                          capture_output=True, text=True, check=False)
    packages = list((folder / "cpack").glob("topometric_*.deb"))
    if done.returncode != 0 or len(packages) != 1:
        sys.exit("cpack: status %d, packages %s\n%s%s" % (done.returncode, packages, done.stdout[-3000:], done.stderr[-3000:]))
    shutil.move(packages[0], folder / "topometric.deb")
    shutil.rmtree(folder / "cpack")


def boot(root, folder):
    command = ["systemd-nspawn", "--quiet", "--directory=%s" % root, "--volatile=overlay", "--register=no", "--keep-unit",
               "--private-network", "--machine=topometric-%d" % os.getpid(), "--bind=%s:/ci" % folder,
               "--bind-ro=%s:/etc/systemd/system/ci.service" % (folder / "ci.service"), "--boot", "--console=pipe",
               "systemd.wants=ci.service"]
    ended = subprocess.run(["timeout", "-k", "5", str(RUN_LIMIT_S), *command], stdin=subprocess.DEVNULL,
                           capture_output=True, text=True, check=False)
    out = folder / "out"
    print(out.read_text() if out.exists() else "the container did not run the test: " + ended.stderr[-2000:], end="")
    return ended.returncode


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    check_machine()
    cache = pathlib.Path(os.environ.get("XDG_CACHE_HOME", pathlib.Path.home() / ".cache")) / "topometric"
    cache.mkdir(parents=True, exist_ok=True)
    with open(cache / "lock", "w") as lock, tempfile.TemporaryDirectory(prefix="topometric-vm-") as holder:
        fcntl.flock(lock, fcntl.LOCK_EX)  # one container on one root
        begin = time.monotonic()
        root = minimal_debian(cache)
        prepared = time.monotonic()
        if "--prepare" in sys.argv:
            return 0
        folder = pathlib.Path(holder)
        folder.chmod(0o755)
        make_package(build, folder)
        for path in (build / "bin/toposim", HERE / "service_inside.py", SOURCE / "config/simulation.toml"):
            shutil.copy(path, folder)
        (folder / "ci.service").write_text(CONTAINER_UNIT)
        packed = time.monotonic()
        status = boot(root, folder)
        print("root %.1f s, package %.1f s, container %.1f s: %s" %
              (prepared - begin, packed - prepared, time.monotonic() - packed, "ok" if status == 0 else "FAILED (%d)" % status))
    return 0 if status == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
