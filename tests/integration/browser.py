# SPDX-FileCopyrightText: 2026 The Topometric authors
# SPDX-License-Identifier: BSD-3-Clause
"""A headless Chromium that a test steers over a pipe (the DevTools protocol: JSON, each message ended by a NUL)."""
import base64
import json
import os
import pathlib
import select
import shutil
import signal
import subprocess
import time

NAMES = ("chromium-headless-shell", "chromium")
PATIENCE_S = 30.0


def program():
    """Debian's chromium-headless-shell or chromium; None when neither is here."""
    return next((path for path in map(shutil.which, NAMES) if path), None)


class Browser:
    """One tab. `folder`: for its profile."""

    def __init__(self, folder, width=1280, height=760, phone=False, dark=False):
        to_browser, self.write_end = os.pipe()
        self.read_end, from_browser = os.pipe()
        command = [program(), "--headless", "--remote-debugging-pipe", "--no-first-run", "--disable-gpu", "--no-sandbox",
                   "--disable-dev-shm-usage", "--disable-background-networking", "--user-data-dir=%s" % folder]
        # DevTools reads descriptor 3 and writes 4; sh knows no descriptor of two digits.
        self.process = subprocess.Popen(["bash", "-c", 'exec "$@" 3<&%d 4>&%d' % (to_browser, from_browser), "bash", *command],
                                        pass_fds=(to_browser, from_browser), stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL, start_new_session=True)
        os.close(to_browser)
        os.close(from_browser)
        self.bytes, self.last, self.session, self.loaded, self.complaints = b"", 0, None, False, []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        self.call("Page.enable")
        self.call("Runtime.enable")
        self.call("Log.enable")
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=2 if phone else 1,
                  mobile=phone)
        self.call("Emulation.setTouchEmulationEnabled", enabled=phone)
        self.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])

    def close(self):
        os.close(self.write_end)  # the browser ends, and with it the processes that write into its profile
        try:
            self.process.wait(PATIENCE_S)
        except subprocess.TimeoutExpired:
            os.killpg(self.process.pid, signal.SIGKILL)
            self.process.wait()
        os.close(self.read_end)

    def message(self, end):
        while b"\0" not in self.bytes:
            if not select.select([self.read_end], [], [], max(0.0, end - time.monotonic()))[0]:
                raise TimeoutError("the browser says nothing")
            piece = os.read(self.read_end, 1 << 16)
            if not piece:
                raise EOFError("the browser is gone")
            self.bytes += piece
        text, _, self.bytes = self.bytes.partition(b"\0")
        return json.loads(text)

    def call(self, method, **params):
        self.last += 1
        session = {"sessionId": self.session} if self.session else {}
        os.write(self.write_end, json.dumps({"id": self.last, "method": method, "params": params, **session}).encode() + b"\0")
        end = time.monotonic() + PATIENCE_S
        while (answer := self.message(end)).get("id") != self.last:
            self.note(answer)
        if "error" in answer:
            raise RuntimeError("%s: %s" % (method, answer["error"]))
        return answer["result"]

    def note(self, event):
        """Keeps what a page complains of: exceptions, refusals of the Content-Security-Policy, files that are not there."""
        self.loaded = self.loaded or event.get("method") == "Page.loadEventFired"
        if event.get("method") == "Runtime.exceptionThrown":
            details = event["params"]["exceptionDetails"]
            self.complaints.append("%s %s" % (details.get("text"), (details.get("exception") or {}).get("description")))
        if event.get("method") == "Log.entryAdded" and event["params"]["entry"]["level"] == "error":
            self.complaints.append(event["params"]["entry"]["text"])

    def open(self, address):
        """Returns when the page and its files are loaded."""
        self.loaded = False
        self.call("Page.navigate", url=address)
        end = time.monotonic() + PATIENCE_S
        while not self.loaded:
            self.note(self.message(end))

    def value(self, script):
        """What an expression of the page is worth; it must be JSON."""
        done = self.call("Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True)
        if "exceptionDetails" in done:
            raise RuntimeError("%s: %s" % (script, done["exceptionDetails"]))
        return done["result"].get("value")

    def until(self, script, what, patience_s=PATIENCE_S):
        """Waits until an expression is true; its value."""
        end = time.monotonic() + patience_s
        while not (value := self.value(script)):
            if time.monotonic() > end:
                raise AssertionError("not within %.0f s: %s; the page says: %s" % (
                    patience_s, what, self.value("document.body.innerText")[:2000]))
            time.sleep(0.02)
        return value

    def click(self, selector):
        """Presses the middle of an element, as a mouse would; it must be in sight."""
        x, y = self.value("""(() => { const e = document.querySelector(%s); e.scrollIntoView({block: "nearest"});
            const b = e.getBoundingClientRect(); return [b.x + b.width / 2, b.y + b.height / 2]; })()""" % json.dumps(selector))
        self.click_at(x, y)

    def click_at(self, x, y):
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def tap_at(self, x, y):
        self.call("Input.dispatchTouchEvent", type="touchStart", touchPoints=[{"x": x, "y": y}])
        self.call("Input.dispatchTouchEvent", type="touchEnd", touchPoints=[])

    def picture(self, path):
        shot = self.call("Page.captureScreenshot", format="png")
        pathlib.Path(path).write_bytes(base64.b64decode(shot["data"]))
