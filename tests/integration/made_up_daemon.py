# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""A made-up daemon on a control socket, for what a page shows and no simulated robot can be brought to say at will."""
import json
import os
import socketserver
import threading


class Line(socketserver.StreamRequestHandler):
    def handle(self):
        for line in self.rfile:
            asked = json.loads(line)
            result = self.server.robot.answer(asked["method"], asked.get("params") or {})
            answer = {"error": {"code": -32601, "message": "not here"}} if result is None else {"result": result}
            self.wfile.write(json.dumps({"jsonrpc": "2.0", "id": asked["id"], **answer}).encode() + b"\n")


class Daemon(socketserver.ThreadingMixIn, socketserver.UnixStreamServer):
    """Answers on the socket `path`, as `robot.answer(method, params)` says (None: not here), until it is closed."""

    daemon_threads = True

    def __init__(self, path, robot):
        self.robot = robot
        if os.path.exists(path):
            os.unlink(path)
        super().__init__(str(path), Line)
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def close(self):
        self.shutdown()
        self.server_close()
