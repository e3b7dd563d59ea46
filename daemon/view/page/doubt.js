// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Where the map is doubted: walls may stand twice there.

import { colourOf } from "./palette.js";

export const CURE = "dashed on the map; an exploration looks there again before it ends; by hand, drive back to what was mapped before";

/** Regions that another visit contradicts, as dashed squares; turns that odometry alone carries, as dashed rings. */
export function drawDoubt(context, view, doubt) {
  if (!doubt) return;
  const side_px = doubt.side_m * view.scale;
  context.strokeStyle = colourOf("--doubt");
  context.lineWidth = 2;
  context.setLineDash([6, 3]);
  for (const region of doubt.regions) {
    const [px, py] = view.toPixel(region.x_m, region.y_m);
    context.strokeRect(px - side_px / 2, py - side_px / 2, side_px, side_px);
  }
  for (const turn of doubt.loose) {
    context.beginPath();
    context.arc(...view.toPixel(turn.x_m, turn.y_m), Math.max(side_px / 8, 6), 0, 2 * Math.PI);
    context.stroke();
  }
  context.setLineDash([]);
}

/** Whether the point, in metres, lies in a doubted region. */
export function isDoubted(doubt, x, y) {
  if (!doubt) return false;
  return doubt.regions.some((region) => Math.max(Math.abs(x - region.x_m), Math.abs(y - region.y_m)) <= doubt.side_m / 2);
}
