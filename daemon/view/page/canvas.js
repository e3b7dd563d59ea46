// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Which part of the map is seen: moved and zoomed by mouse, touch, wheel and keys.

const NEAREST = 400, FARTHEST = 2;  // pixels a metre
const CLICK_PX = 6;                 // a pointer that moved less was a click

export class View {
  /** `redraw` when something moved; `clicked(x_m, y_m)`; `hovered(x_m, y_m)`. */
  constructor(canvas, redraw, clicked, hovered) {
    this.canvas = canvas;
    this.redraw = redraw;
    this.centre = { x: 0, y: 0 };
    this.scale = 30;
    this.moved = false;     // by the operator: the view is no longer fitted to the map
    this.pointers = new Map();
    this.path = 0;
    this.aim = null;        // {press(x_m, y_m), turn(x_m, y_m), release()}: a press and its drag are not the map's
    this.aiming = null;     // the pointer that does so now
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => {
      this.move(event);
      hovered(...this.toMap(event.offsetX, event.offsetY));
    });
    canvas.addEventListener("pointerup", (event) => {
      if (this.released(event)) return this.aim && this.aim.release();
      const click = this.pointers.size === 1 && this.path < CLICK_PX;
      this.pointers.delete(event.pointerId);
      if (click) clicked(...this.toMap(event.offsetX, event.offsetY));
    });
    canvas.addEventListener("pointercancel", (event) => this.released(event) || this.pointers.delete(event.pointerId));
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY * 0.0015), event.offsetX, event.offsetY);
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => this.key(event));
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  resize() {
    const ratio = window.devicePixelRatio || 1;
    this.width = this.canvas.clientWidth;
    this.height = this.canvas.clientHeight;
    this.canvas.width = Math.round(this.width * ratio);
    this.canvas.height = Math.round(this.height * ratio);
    this.canvas.getContext("2d").setTransform(ratio, 0, 0, ratio, 0, 0);
    this.redraw();
  }

  toPixel(x, y) {
    return [this.width / 2 + (x - this.centre.x) * this.scale, this.height / 2 - (y - this.centre.y) * this.scale];
  }
  toMap(px, py) {
    return [this.centre.x + (px - this.width / 2) / this.scale, this.centre.y - (py - this.height / 2) / this.scale];
  }

  down(event) {
    this.canvas.setPointerCapture(event.pointerId);
    if (this.aim && this.aiming === null && this.pointers.size === 0) {
      this.aiming = event.pointerId;
      return this.aim.press(...this.toMap(event.offsetX, event.offsetY));
    }
    if (this.pointers.size === 0) this.path = 0;
    this.pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
  }

  /** True when the pointer had aimed. */
  released(event) {
    const aimed = this.aiming === event.pointerId;
    if (aimed) this.aiming = null;
    return aimed;
  }

  /** One pointer moves the map; two zoom it about their middle. */
  move(event) {
    if (this.aiming === event.pointerId && this.aim) this.aim.turn(...this.toMap(event.offsetX, event.offsetY));
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    const here = { x: event.offsetX, y: event.offsetY };
    this.path += Math.hypot(here.x - last.x, here.y - last.y);
    if (this.pointers.size === 2) {
      const other = [...this.pointers].find(([id]) => id !== event.pointerId)[1];
      const before = Math.hypot(last.x - other.x, last.y - other.y);
      const after = Math.hypot(here.x - other.x, here.y - other.y);
      if (before > 0 && after > 0) this.zoom(after / before, (here.x + other.x) / 2, (here.y + other.y) / 2);
    }
    if (this.path >= CLICK_PX) this.shift((here.x - last.x) / this.pointers.size, (here.y - last.y) / this.pointers.size);
    this.pointers.set(event.pointerId, here);
  }

  shift(dx, dy) {
    this.moved = true;
    this.centre.x -= dx / this.scale;
    this.centre.y += dy / this.scale;
    this.redraw();
  }

  zoom(factor, px = this.width / 2, py = this.height / 2) {
    this.moved = true;
    const [x, y] = this.toMap(px, py);
    this.scale = Math.min(NEAREST, Math.max(FARTHEST, this.scale * factor));
    const [nx, ny] = this.toMap(px, py);
    this.centre.x += x - nx;
    this.centre.y += y - ny;
    this.redraw();
  }

  key(event) {
    const step = 60;
    const moves = { ArrowLeft: [step, 0], ArrowRight: [-step, 0], ArrowUp: [0, step], ArrowDown: [0, -step] };
    if (moves[event.key]) this.shift(...moves[event.key]);
    else if (event.key === "+") this.zoom(1.25);
    else if (event.key === "-") this.zoom(0.8);
    else return;
    event.preventDefault();
  }

  fit(box) {
    if (!box) return;
    const margin_px = 30;
    this.centre = { x: (box.x0 + box.x1) / 2, y: (box.y0 + box.y1) / 2 };
    this.scale = Math.min(NEAREST, Math.max(FARTHEST, Math.min(
      (this.width - 2 * margin_px) / (box.x1 - box.x0), (this.height - 2 * margin_px) / (box.y1 - box.y0))));
    this.redraw();
  }
}
