# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""What the independent clients share: a running toposim, and a byte link over TCP or a terminal with deadlines."""
import json
import os
import select
import socket
import subprocess
import termios
import time
import tty

ROOM = """
[[start]]
x_m = 4.0
y_m = 3.0
[[wall]]
points_m = [[-0.1, -0.1], [8.1, -0.1], [8.1, 6.1], [-0.1, 6.1]]
closed = true
thickness_m = 0.2
"""
SPEEDS = {9600: termios.B9600, 19200: termios.B19200, 38400: termios.B38400, 57600: termios.B57600,
          115200: termios.B115200}


class Simulation:
    """toposim in a process of its own; `with` ends it."""

    def __init__(self, program, folder, *options):
        self.program = program
        world = os.path.join(folder, "room.toml")
        with open(world, "w") as file:
            file.write(ROOM)
        self.control = os.path.join(folder, "control.sock")
        command = [program, "--world", world, "--control", self.control, "--die-with-parent", *options]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        line = self.process.stdout.readline()
        assert line, "toposim did not start: exit status %s" % self.process.wait()
        self.ready = json.loads(line)
        self.robot = self.ready["robots"][0]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        status = self.process.wait(10)
        self.process.stdout.close()
        assert status == 0, "toposim ended with status %d" % status

    def ctl(self, command, **arguments):
        words = ["%s=%s" % (key, json.dumps(value).strip('"')) for key, value in arguments.items()]
        out = subprocess.run([self.program, "ctl", self.control, command, *words], check=True, capture_output=True)
        return json.loads(out.stdout)

    def truth(self):
        return self.ctl("truth")["robots"][0]


class Link:
    """Bytes to and from a device; every read has a deadline."""

    def __init__(self, device, speed=9600):
        self.socket = None
        if device["transport"] == "tcp":
            self.socket = socket.create_connection((device["host"], device["port"]), 5)
            self.socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self.fd = self.socket.fileno()
        else:
            self.fd = os.open(device["path"], os.O_RDWR | os.O_NOCTTY)
            tty.setraw(self.fd)
            self.set_speed(speed)
        self.buffer = b""

    def set_speed(self, speed):
        settings = termios.tcgetattr(self.fd)
        settings[4] = settings[5] = SPEEDS[speed]
        termios.tcsetattr(self.fd, termios.TCSANOW, settings)

    def write(self, data):
        os.write(self.fd, data)

    def fill(self, deadline):
        """More bytes, or TimeoutError; ConnectionError when the link is gone."""
        wait = deadline - time.monotonic()
        if wait <= 0 or not select.select([self.fd], [], [], wait)[0]:
            raise TimeoutError("nothing came in time; so far %r" % self.buffer[-80:])
        data = os.read(self.fd, 65536)
        if not data:
            raise ConnectionError("the device closed the link")
        self.buffer += data

    def flush(self, seconds):
        """Reads and forgets for a while."""
        deadline = time.monotonic() + seconds
        try:
            while True:
                self.fill(deadline)
                self.buffer = b""
        except TimeoutError:
            self.buffer = b""

    def close(self):
        if self.socket:
            self.socket.close()
        else:
            os.close(self.fd)
