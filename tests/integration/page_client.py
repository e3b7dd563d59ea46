# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""A page of topoview without a browser: HTTP, and WebSocket (RFC 6455) with permessage-deflate (RFC 7692)."""
import base64
import json
import os
import socket
import struct
import zlib

DIGITS = {digit: value for value, digit in
          enumerate("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_")}
TEXT, CLOSE, PING, PONG = 1, 8, 9, 10


def request(port, target="/", host=None, **headers):
    """Status, headers (small letters) and body of a GET."""
    with socket.create_connection(("127.0.0.1", port), timeout=20) as line:
        send_head(line, target, host or "127.0.0.1:%d" % port, dict(headers, Connection="close"))
        answer = b""
        while piece := line.recv(65536):
            answer += piece
    head, _, body = answer.partition(b"\r\n\r\n")
    first, *rest = head.decode().split("\r\n")
    return int(first.split()[1]), {k.lower(): v for k, v in (field.split(": ", 1) for field in rest)}, body


def send_head(line, target, host, headers):
    fields = "".join("%s: %s\r\n" % (name.replace("_", "-"), value) for name, value in headers.items())
    line.sendall(("GET %s HTTP/1.1\r\nHost: %s\r\n%s\r\n" % (target, host, fields)).encode())


def decode_cells(text):
    """0 unknown, 1 free, 2 occupied, row by row from the lowest y."""
    cells, longer = bytearray(), 0
    for digit in text:
        value = DIGITS[digit]
        if value >= 48:
            longer = 16 * (value - 47)
            continue
        cells += bytes([value >> 4]) * (longer + value % 16 + 1)
        longer = 0
    return cells


class Refused(Exception):
    """The status of a request for a WebSocket that was not taken."""


class Page:
    def __init__(self, port, host=None, origin=None, receive_buffer=None):
        self.line = socket.socket()
        if receive_buffer:
            self.line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self.line.settimeout(30)
        self.line.connect(("127.0.0.1", port))
        headers = {"Upgrade": "websocket", "Connection": "Upgrade", "Sec-WebSocket-Version": "13",
                   "Sec-WebSocket-Key": base64.b64encode(os.urandom(16)).decode(),
                   "Sec-WebSocket-Extensions": "permessage-deflate"}
        if origin:
            headers["Origin"] = origin
        send_head(self.line, "/ws", host or "127.0.0.1:%d" % port, headers)
        self.read = self.line.makefile("rb")
        status = int(self.read.readline().split()[1])
        while self.read.readline() not in (b"\r\n", b""):
            pass
        if status != 101:
            self.close()
            raise Refused(status)
        self.inflater = zlib.decompressobj(-15)
        self.known, self.events, self.hello, self.answers = {}, [], None, {}
        self.map, self.tiles, self.resolution_m = None, {}, None
        self.bytes, self.last_id = 0, 0

    def close(self):
        self.read.close()
        self.line.close()

    def frame(self):
        first, second = self.read.read(2)
        length = second & 127
        if length > 125:
            length = struct.unpack(">H" if length == 126 else ">Q", self.read.read(2 if length == 126 else 8))[0]
        payload = self.read.read(length)
        self.bytes += length + 2
        return first, payload

    def receive(self):
        """The next message, which is taken in."""
        content, packed = b"", False
        while True:
            first, payload = self.frame()
            kind = first & 15
            if kind == PING:
                self.send_frame(PONG, payload)
            elif kind == CLOSE:
                raise EOFError("closed by topoview")
            else:
                packed = packed or bool(first & 64)
                content += payload
                if first & 128:
                    break
        if packed:
            content = self.inflater.decompress(content + b"\x00\x00\xff\xff")
        message = json.loads(content)
        self.take(message)
        return message

    def skip(self):
        """Reads on without a look at what comes, which costs little; False at the end. Nothing can be received after it."""
        try:
            kind, payload = self.frame()
        except (OSError, ValueError, struct.error):
            return False
        if kind & 15 == PING:
            self.send_frame(PONG, payload)
        return kind & 15 != CLOSE

    def take(self, message):
        kind = message["t"]
        if kind == "hello":
            self.hello = message
        elif kind == "answer":
            self.answers[message["id"]] = message
        elif kind == "event":
            self.events.append(message["v"])
        elif kind == "map":
            if message["map"] != self.map:
                self.map, self.tiles = message["map"], {}
            self.resolution_m = message["resolution_m"]
            for x, y, cells in message["tiles"]:
                self.tiles[x, y] = decode_cells(cells)
        else:
            self.known[kind] = message["v"]

    def receive_until(self, condition, messages=3000):
        """Takes messages until the condition holds; state comes five times a second, so that they never end."""
        for _ in range(messages):
            if condition():
                return
            self.receive()
        raise AssertionError("did not come in %d messages; known: %s" % (messages, json.dumps(self.known)[:2000]))

    def send_frame(self, kind, payload):
        mask = os.urandom(4)
        head = struct.pack(">BB", 128 | kind, 128 | len(payload)) if len(payload) < 126 else \
            struct.pack(">BBH", 128 | kind, 254, len(payload))
        self.line.sendall(head + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(payload)))

    def act(self, name, **more):
        """The answer to an act."""
        self.last_id += 1
        self.send_frame(TEXT, json.dumps({"act": name, "id": self.last_id, **more}).encode())
        self.receive_until(lambda: self.last_id in self.answers)
        return self.answers[self.last_id]

    def cells(self):
        """(x, y): state, of all cells that are not unknown."""
        return {(64 * tx + i % 64, 64 * ty + i // 64): state
                for (tx, ty), cells in self.tiles.items() for i, state in enumerate(cells) if state}
