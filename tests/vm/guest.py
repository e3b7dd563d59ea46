# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""A guest with Debian's kernel, whose root is this machine's root: programs of the build tree run in it unchanged.
QEMU emulates the processor (TCG). KVM is never tried: on nested hosts its device opens and then guests hang.

The kernel package is fetched with apt-get and unpacked, not installed; what is used of it (about 10 MB) is kept in a
folder of the caller's choice."""
import ctypes
import hashlib
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import threading

KERNEL = "linux-image-amd64"  # the "cloud" flavour is built without CAN
MODULES = ["virtio_pci", "9pnet_virtio", "9p", "can", "can-raw", "vcan", "can-dev", "kvaser_pci", "sch_tbf", "sch_prio"]
PROGRAMS = {"qemu-system-x86_64": "qemu-system-x86", "busybox": "busybox-static", "cpio": "cpio", "modprobe": "kmod",
            "depmod": "kmod", "dpkg-deb": "dpkg", "ip": "iproute2", "tc": "iproute2"}
DONE = re.compile(r"^\[guest\] status (\d+)", re.MULTILINE)
# Two processors, each as fast as this machine can emulate it at the moment, and this machine's time.
FAST = ["-smp", "2", "-m", "1024"]
# A guest that keeps time however busy this machine is: its clock advances by 2 ns an instruction while it computes, and by
# this machine's clock while it waits. QEMU 7.2 counts instructions of several processors only very slowly. The clock
# that goes on while the guest is suspended is this machine's.
PUNCTUAL = ["-smp", "1", "-m", "512", "-icount", "shift=1,sleep=on", "-rtc", "clock=host"]
# /tmp, /run and the like are the guest's own; `shared` is this machine's, to be written to.
INIT = """#!/bin/busybox sh
b=/bin/busybox
$b mount -t proc proc /proc; $b mount -t sysfs sysfs /sys; $b mount -t devtmpfs dev /dev
while read -r m; do $b insmod /m/$m || echo "[guest] no module $m"; done </m/list
O=trans=virtio,version=9p2000.L,msize=512000
$b mount -t 9p -o $O,ro,cache=loose root /newroot || echo "[guest] no root"
N=/newroot
$b mount -t proc proc $N/proc; $b mount -t sysfs sysfs $N/sys; $b mount -t devtmpfs dev $N/dev
$b mkdir -p $N/dev/shm $N/dev/pts; $b mount -t tmpfs shm $N/dev/shm; $b mount -t devpts devpts $N/dev/pts
for d in tmp run root var/tmp var/log; do $b mount -t tmpfs t $N/$d; done
$b sh /show
$b ip link set lo up
$b chroot $N /bin/bash -c "export PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root; exec /bin/bash @SHARED@/run" </dev/null
echo "[guest] status $?, up $($b cut -d' ' -f1 /proc/uptime) s"
$b sync; $b poweroff -f
"""


class CannotRun(Exception):
    """This machine cannot run a guest: why."""


def check_programs():
    for program, package in PROGRAMS.items():
        if not shutil.which(program, path="/usr/sbin:/usr/bin:/sbin:/bin"):
            raise CannotRun("%s is missing (package %s)" % (program, package))


def kernel_package():
    """The package behind the one that always names the newest."""
    listed = subprocess.run(["apt-cache", "depends", KERNEL], capture_output=True, text=True, check=False).stdout
    found = re.search(r"Depends: (linux-image-\S+)", listed)
    if not found:
        raise CannotRun("apt knows no %s (is there a Debian mirror? apt-get update)" % KERNEL)
    return found.group(1)


def kernel(cache):
    """(image, modules in the order in which they are loaded); what stands in the cache is whole."""
    package = kernel_package()
    home = cache / ("kernel-%s-%s" % (package, hashlib.sha256(" ".join(MODULES).encode()).hexdigest()[:8]))
    if not home.is_dir():
        print("unpacking %s into %s" % (package, home), flush=True)
        with tempfile.TemporaryDirectory(prefix="making-", dir=cache) as fresh:
            unpack(package, pathlib.Path(fresh))
            for old in cache.glob("kernel-*"):
                shutil.rmtree(old)
            (pathlib.Path(fresh) / "kernel").rename(home)
    return home / "vmlinuz", [home / name for name in (home / "list").read_text().split()]


def unpack(package, fresh):
    fetched = subprocess.run(["apt-get", "-q", "download", package], cwd=fresh, capture_output=True, text=True, check=False)
    packages = list(fresh.glob("*.deb"))
    if fetched.returncode != 0 or not packages:
        raise CannotRun("%s cannot be fetched: %s" % (package, fetched.stderr.strip()[-300:]))
    tree = fresh / "tree"
    subprocess.run(["dpkg-deb", "-x", packages[0], tree], check=True)
    version = next((tree / "lib/modules").iterdir()).name
    subprocess.run(["/sbin/depmod", "-b", tree, version], check=True)
    kept = fresh / "kernel"
    kept.mkdir()
    shutil.copy(tree / ("boot/vmlinuz-" + version), kept / "vmlinuz")
    names = []
    for module in MODULES:
        shown = subprocess.run(["/sbin/modprobe", "-d", tree, "-S", version, "--show-depends", module],
                               capture_output=True, text=True, check=True).stdout
        for path in re.findall(r"^insmod (\S+)", shown, re.MULTILINE):
            name = pathlib.Path(path).name
            if name not in names:
                names.append(name)
                shutil.copy(path, kept)
    (kept / "list").write_text("\n".join(names) + "\n")


def show(path, tag, read_only):
    """Lines of init: a folder of this machine under the same path, although the guest's own hides its parents."""
    mode = "ro,cache=loose" if read_only else "cache=none"
    return ("/bin/busybox mkdir -p /newroot%s\n/bin/busybox mount -t 9p -o trans=virtio,version=9p2000.L,msize=512000,%s "
            "%s /newroot%s\n" % (path, mode, tag, path))


def initrd(folder, modules, shared, visible):
    tree = folder / "initrd"
    for name in ("bin", "m", "proc", "sys", "dev", "newroot"):
        (tree / name).mkdir(parents=True)
    shutil.copy(shutil.which("busybox"), tree / "bin/busybox")
    for module in modules:
        shutil.copy(module, tree / "m")
    (tree / "m/list").write_text("".join(module.name + "\n" for module in modules))
    (tree / "init").write_text(INIT.replace("@SHARED@", str(shared)))
    (tree / "init").chmod(0o755)
    (tree / "show").write_text(show(shared, "shared", False) +
                               "".join(show(path, "seen%d" % i, True) for i, path in enumerate(visible)))
    names = "\n".join(str(path.relative_to(tree)) for path in [tree, *sorted(tree.rglob("*"))])
    packed = subprocess.run(["cpio", "-o", "-H", "newc", "--quiet"], cwd=tree, input=names.encode(), capture_output=True,
                            check=True)
    (folder / "initrd.img").write_bytes(packed.stdout)
    return folder / "initrd.img"


def share(tag, path, read_only):
    options = "local,id=%s,path=%s,security_model=none,multidevs=remap%s" % (tag, path, ",readonly=on" if read_only else "")
    return ["-fsdev", options, "-device", "virtio-9p-pci,fsdev=%s,mount_tag=%s" % (tag, tag)]


def run(cache, script, shared, visible, limit_s, processors=FAST):
    """Runs a bash script in the guest, which it powers off afterwards, and prints what it says. `shared`: a folder that
    the guest may write to; `visible`: folders under /tmp or /root that it must see; `processors`: FAST or PUNCTUAL. Returns
    the script's status (124 when the time was up, 125 when the guest did not come to an end) and all that was said."""
    check_programs()
    image, modules = kernel(cache)
    (shared / "run").write_text(script)
    with tempfile.TemporaryDirectory(prefix="topometric-guest-") as holder:
        command = ["qemu-system-x86_64", "-nodefaults", "-no-user-config", "-no-reboot", "-display", "none",
                   "-machine", "q35,accel=tcg", "-cpu", "max", *processors, "-kernel", image,
                   "-initrd", initrd(pathlib.Path(holder), modules, shared, visible), "-append",
                   "console=ttyS0 quiet panic=-1 mitigations=off random.trust_cpu=on", "-serial", "stdio",
                   # two controllers on one bus, as hardware has them
                   "-object", "can-bus,id=bus", "-device", "kvaser_pci,canbus=bus", "-device", "kvaser_pci,canbus=bus",
                   *share("root", "/", True), *share("shared", shared, False)]
        for i, path in enumerate(visible):
            command += share("seen%d" % i, path, True)
        return watch([str(word) for word in command], limit_s)


def end_with_parent():
    """In the child before it becomes QEMU: nothing is left behind when this program is killed."""
    set_parent_death_signal = 1  # prctl(2)
    ctypes.CDLL(None).prctl(set_parent_death_signal, signal.SIGKILL)


def watch(command, limit_s):
    text = ""
    out_of_time = threading.Event()
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", preexec_fn=end_with_parent) as guest:

        def kill():
            out_of_time.set()
            guest.kill()

        timer = threading.Timer(limit_s, kill)
        timer.start()
        try:
            for line in guest.stdout:
                text += line
                print(line.rstrip(), flush=True)
                if DONE.match(line):
                    guest.kill()  # one that was suspended does not always power off
        finally:
            timer.cancel()
    if out_of_time.is_set():
        return 124, text
    done = DONE.search(text)
    return (int(done.group(1)) if done else 125), text
