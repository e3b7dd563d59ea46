// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Areas that no wheel enters, and those whose goals come first: the pen with which one is drawn, and those that are in force.

import { colourOf } from "./palette.js";

const SNAP_PX = 12;      // to the first corner, which closes the area, and to a level or upright edge
const GRID_M = 0.05;     // a cell of the map
const MOST_CORNERS = 60;

/** What an area of a kind does, and how it is drawn: stripes rise or fall, so that not the colour alone tells. */
export const KINDS = {
  keep_out: { name: "keep out", shape: "▨", colour: "--keep-out", rises: true,
    does: "no robot of the team enters this area", ends: "all robots of the team may enter it again" },
  here_first: { name: "here first", shape: "▧", colour: "--here-first", rises: false,
    does: "goals in this area come before all others, for the whole team", ends: "its goals are like all others again" },
};
const kindOf = (area) => KINDS[area.kind] || KINDS.keep_out;

const snapped = (value) => Math.round(value / GRID_M) * GRID_M;

/** An area that is being drawn: corners in metres, in order. */
export class Pen {
  constructor() { this.lift(); }

  lift() {
    this.active = false;
    this.kind = "keep_out";
    this.corners = [];
    this.length_m = 0;  // of the next edge; 0: as far as the click is
  }

  begin(kind) {
    this.lift();
    this.active = true;
    this.kind = kind;
  }

  /** Where a click at (x, y) sets a corner; `pixel_m`: metres that a pixel shows. */
  place(x, y, pixel_m) {
    const last = this.corners[this.corners.length - 1];
    if (!last) return [snapped(x), snapped(y)];
    let dx = x - last[0], dy = y - last[1];
    if (Math.abs(dx) < SNAP_PX * pixel_m) dx = 0;
    else if (Math.abs(dy) < SNAP_PX * pixel_m) dy = 0;
    const length = Math.hypot(dx, dy);
    if (this.length_m > 0 && length > 0)
      return [last[0] + (dx / length) * this.length_m, last[1] + (dy / length) * this.length_m];
    return [snapped(last[0] + dx), snapped(last[1] + dy)];
  }

  /** True when the click closed the area. */
  click(x, y, pixel_m) {
    const first = this.corners[0];
    if (this.corners.length >= 3 && Math.hypot(x - first[0], y - first[1]) < SNAP_PX * pixel_m) return true;
    if (this.corners.length < MOST_CORNERS) this.corners.push(this.place(x, y, pixel_m));
    this.length_m = 0;
    return false;
  }

  undo() { this.corners.pop(); }

  get complete() { return this.corners.length >= 3; }
  /** As the act of topoview takes it. */
  get flat() { return this.corners.flat().map((value) => Math.round(value * 1000) / 1000); }
  get words() {
    const edges = this.corners.slice(1).map(([x, y], i) =>
      Math.hypot(x - this.corners[i][0], y - this.corners[i][1]).toFixed(2));
    return `${this.corners.length} corners${edges.length ? `, edges ${edges.join(", ")} m` : ""}`;
  }
}

function outline(context, view, corners, close) {
  context.beginPath();
  for (const [x, y] of corners) context.lineTo(...view.toPixel(x, y));
  if (close) context.closePath();
}

/** Stripes as well as a colour. */
function hatch(context, view, colour, rises) {
  context.save();
  context.clip();
  context.strokeStyle = colour;
  context.lineWidth = 1.5;
  context.globalAlpha = 0.6;
  context.beginPath();
  for (let x = -view.height; x < view.width; x += 9) {
    context.moveTo(x, rises ? view.height : 0);
    context.lineTo(x + view.height, rises ? 0 : view.height);
  }
  context.stroke();
  context.restore();
}

export function drawAreas(context, view, areas) {
  for (const area of areas || []) {
    const kind = kindOf(area);
    outline(context, view, area.corners_m, true);
    hatch(context, view, colourOf(kind.colour), kind.rises);
    context.strokeStyle = colourOf(kind.colour);
    context.lineWidth = 2;
    outline(context, view, area.corners_m, true);
    context.stroke();
  }
}

/** An area that is being drawn. */
export function drawPen(context, view, pen) {
  if (!pen.active) return;
  const colour = context.strokeStyle = colourOf(KINDS[pen.kind].colour);
  context.lineWidth = 2;
  outline(context, view, pen.corners, pen.complete);
  context.setLineDash([6, 4]);
  context.stroke();
  context.setLineDash([]);
  context.fillStyle = colour;
  for (const [x, y] of pen.corners) {
    const [px, py] = view.toPixel(x, y);
    context.fillRect(px - 4, py - 4, 8, 8);
  }
}

/** The list beside the map; `withdraw(id, kind)` is called for the area that is to end. */
export function showAreas(list, value, mayAct, withdraw) {
  const rows = (value.areas || []).map((area) => {
    const row = document.createElement("li"), button = document.createElement("button");
    row.textContent = `${kindOf(area).shape} ${area.id}, ${kindOf(area).name}: ${area.corners_m.length} corners${area.robot === null ? "" : `, drawn at robot ${area.robot}`} `;
    button.type = "button";
    button.textContent = "withdraw";
    button.disabled = !mayAct;
    button.addEventListener("click", () => withdraw(area.id, kindOf(area)));
    row.append(button);
    return row;
  });
  if (value.trouble) {
    const row = document.createElement("li");
    row.className = "bad";
    row.textContent = value.trouble;
    rows.push(row);
  }
  if (rows.length === 0) {
    rows.push(document.createElement("li"));
    rows[0].textContent = "none";
  }
  list.replaceChildren(...rows);
}
