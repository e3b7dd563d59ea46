# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""The operator's page of the demonstration's first robot."""

import re
import socket
import time

import demo_processes

USUAL_PORT = 8080
START_LIMIT_S = 10


def free_port():
    """The usual one when nothing has it, else any."""
    for port in (USUAL_PORT, 0):
        with socket.socket() as probe:
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind(("127.0.0.1", port))
                return probe.getsockname()[1]
            except OSError:
                continue
    raise demo_processes.Failure("no TCP port is free on this machine for the page")


def address_of(text):
    """The address with its token, of what topoview pair prints."""
    found = re.search(r"(?m)^address +(http://\S+)$", text)
    if found is None:
        raise demo_processes.Failure("topoview pair printed no address: %s" % text)
    return found.group(1)


def start(robot, processes):
    """Starts the page; the address that opens it with the right to command."""
    view = processes.start("topoview", "--config", robot.config)
    end = time.monotonic() + START_LIMIT_S
    while view.poll() is None and time.monotonic() < end:
        with socket.socket() as probe:
            if probe.connect_ex(("127.0.0.1", robot.view_port)) == 0:
                return address_of(processes.run("topoview", "--config", robot.config, "pair", "--name", "demo").stdout)
        time.sleep(0.05)
    raise demo_processes.Failure("topoview did not start:\n%s" % processes.end_of_log("topoview"))
