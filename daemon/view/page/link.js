// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The connection to topoview: made again whenever it is lost. Messages are objects; "t" says what one is about.

const AGAIN_MS = 1000;
// topoview says something at least every second, even without a daemon: what is silent for longer is not live.
const SILENT_MS = 3000;

export class Link {
  /** `take` gets each message, `changed` is called when the connection comes or goes. */
  constructor(take, changed) {
    this.take = take;
    this.changed = changed;
    this.heard = 0;      // performance.now() of the newest message
    this.socket = null;
    this.connect();
    setInterval(() => this.watch(), 500);
  }

  connect() {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    const socket = new WebSocket(`${scheme}://${location.host}/ws`);
    this.socket = socket;
    this.begun = performance.now();
    socket.onmessage = (event) => {
      this.heard = performance.now();
      this.take(JSON.parse(event.data));
    };
    socket.onopen = () => this.changed();
    socket.onclose = () => {
      if (this.socket !== socket) return;
      this.socket = null;
      setTimeout(() => this.connect(), AGAIN_MS);
      this.changed();
    };
  }

  /** A connection that a dead network leaves open is given up. */
  watch() {
    const last = Math.max(this.heard, this.begun || 0);
    if (this.socket && performance.now() - last > 2 * SILENT_MS) {
      const dead = this.socket;
      this.socket = null;
      dead.close();
      this.connect();
    }
    this.changed();
  }

  get open() { return this.socket !== null && this.socket.readyState === WebSocket.OPEN; }
  get silent() { return performance.now() - this.heard > SILENT_MS; }

  /** False when it could not be sent. */
  send(message) {
    if (!this.open) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }
}
