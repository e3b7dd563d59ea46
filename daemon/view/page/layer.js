// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// What changes seldom has a canvas of its own, beneath: a frame leaves it as it is.

export class Layer {
  constructor(canvas) {
    this.canvas = canvas;
    this.of = [];
  }

  /** `of`: what the picture depends on beside the view; `paint(context)` is called when any of it is another one. */
  draw(view, of, paint) {
    const ratio = window.devicePixelRatio || 1;
    const now = [view.width, view.height, ratio, view.scale, view.centre.x, view.centre.y, ...of];
    if (now.every((value, i) => value === this.of[i])) return;
    const context = this.canvas.getContext("2d");
    if (now.slice(0, 3).some((value, i) => value !== this.of[i])) {
      this.canvas.width = Math.round(view.width * ratio);
      this.canvas.height = Math.round(view.height * ratio);
      context.setTransform(ratio, 0, 0, ratio, 0, 0);
    }
    this.of = now;
    context.clearRect(0, 0, view.width, view.height);
    paint(context);
  }
}
