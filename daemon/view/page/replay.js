// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The time line of a replay. topoview keeps it: all pages of a replay see the same.

const at = (id) => document.getElementById(id);

/** 3:07, or 1:02:03. */
export function clock(seconds) {
  const all = Math.floor(seconds), pad = (value) => `${value}`.padStart(2, "0");
  const hours = Math.floor(all / 3600), minutes = Math.floor(all / 60) % 60;
  return hours ? `${hours}:${pad(minutes)}:${pad(all % 60)}` : `${minutes}:${pad(all % 60)}`;
}

const AGAIN_MS = 150;  // between two places of a handle that is being moved: topoview takes ten wishes a second

/** What the button does next: at the end it begins anew, unless there will be more. */
const plays = (line) => line.playing && (line.position_s < line.length_s || line.growing);

export class TimeLine {
  /** `wish(object)` sends what is wanted of the time line. */
  constructor(wish) {
    this.line = { playing: false, position_s: 0, length_s: 0, speed: 1 };
    this.held = false;  // the operator has the handle: it does not run away
    at("play").addEventListener("click", () => wish({ playing: !plays(this.line) }));
    at("speed").addEventListener("change", () => wish({ speed: Number(at("speed").value) }));
    const handle = at("position");
    handle.addEventListener("pointerdown", () => { this.held = true; });
    for (const name of ["pointerup", "pointercancel", "change"])
      handle.addEventListener(name, () => { this.held = false; });
    handle.addEventListener("change", () => wish({ position_s: Number(handle.value) }));
    handle.addEventListener("input", () => this.go(wish));
    this.waits = false;
  }

  /** To where the handle is; while it moves, now and then. */
  go(wish) {
    if (this.waits) return;
    const asked = at("position").value;
    wish({ position_s: Number(asked) });
    this.waits = true;
    setTimeout(() => {
      this.waits = false;
      if (this.held && at("position").value !== asked) this.go(wish);
    }, AGAIN_MS);
  }

  show(line) {
    this.line = line;
    at("time-line").hidden = false;
    at("play").textContent = plays(line) ? "pause" : "play";
    at("position").max = line.length_s;
    if (!this.held) at("position").value = line.position_s;
    at("position").setAttribute("aria-valuetext", clock(line.position_s));
    if (document.activeElement !== at("speed")) at("speed").value = `${line.speed}`;
    at("time").textContent = `${clock(line.position_s)} of ${clock(line.length_s)}` +
      `${line.growing ? ", growing" : ""}${line.utc ? ` · ${line.utc}` : ""}`;
    at("replay-note").textContent = `${line.session}${line.log ? "" : " · no mission log: map and way alone"}`;
  }
}
