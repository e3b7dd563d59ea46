// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Everything on the map that is not the map. Kinds differ in shape, not in colour alone.
import { drawAreas, drawPen } from "./areas.js";
import { drawDoubt } from "./doubt.js";
import { colourOf } from "./palette.js";

const ROBOT_M = 0.25;          // half the length of what is drawn for a robot
const ROBOT_LEAST_PX = 9;
export const MATE_STALE_S = 1.4;  // heard twice a second; what is drawn is at most half a second older

function colours() {
  return { own: colourOf("--own"), mate: colourOf("--mate"), goal: colourOf("--goal"), open: colourOf("--open"),
    refused: colourOf("--refused"), place: colourOf("--place"), laser: colourOf("--laser"), ink: colourOf("--ink"),
    paper: colourOf("--paper") };
}

function line(context, view, points, colour, width, dash = []) {
  if (!points || points.length < 2) return;
  context.beginPath();
  for (const [x, y] of points) context.lineTo(...view.toPixel(x, y));
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.setLineDash(dash);
  context.stroke();
  context.setLineDash([]);
}

function text(context, c, words, px, py, colour) {
  context.font = "12px system-ui, sans-serif";
  context.lineWidth = 3;
  context.strokeStyle = c.paper;
  context.strokeText(words, px, py);
  context.fillStyle = colour;
  context.fillText(words, px, py);
}

const points = (list) => (list || []).map((p) => [p.x_m, p.y_m]);

/** An arrow head: filled for a robot heard now, hollow for one as it was last known. */
function robot(context, view, c, pose, name, colour, live) {
  const [px, py] = view.toPixel(pose.x_m, pose.y_m);
  const size = Math.max(ROBOT_LEAST_PX, ROBOT_M * view.scale);
  context.save();
  context.translate(px, py);
  context.rotate(-pose.theta_rad);
  context.beginPath();
  context.moveTo(size * 1.3, 0);
  context.lineTo(-size, size * 0.85);
  context.lineTo(-size * 0.6, 0);
  context.lineTo(-size, -size * 0.85);
  context.closePath();
  context.lineWidth = 2;
  context.strokeStyle = live ? c.paper : colour;
  context.fillStyle = colour;
  if (live) context.fill();
  context.stroke();
  context.restore();
  text(context, c, name, px + size + 4, py - size, live ? colour : c.refused);
}

function diamond(context, px, py, size, colour) {
  context.beginPath();
  context.moveTo(px, py - size);
  context.lineTo(px + size, py);
  context.lineTo(px, py + size);
  context.lineTo(px - size, py);
  context.closePath();
  context.lineWidth = 2;
  context.strokeStyle = colour;
  context.stroke();
}

function cross(context, px, py, size, colour) {
  context.beginPath();
  context.moveTo(px - size, py - size);
  context.lineTo(px + size, py + size);
  context.moveTo(px - size, py + size);
  context.lineTo(px + size, py - size);
  context.lineWidth = 2;
  context.strokeStyle = colour;
  context.stroke();
}

function target(context, px, py, colour) {
  context.strokeStyle = colour;
  context.lineWidth = 2.5;
  for (const radius of [4, 9]) {
    context.beginPath();
    context.arc(px, py, radius, 0, 2 * Math.PI);
    context.stroke();
  }
}

/** Where the laser's rays end now: dots, as [x, y, x, y, ...] in centimetres. */
function drawScan(context, view, c, cm) {
  context.fillStyle = c.laser;
  for (let i = 0; i + 1 < cm.length; i += 2) {
    const [px, py] = view.toPixel(cm[i] / 100, cm[i + 1] / 100);
    context.fillRect(px - 1.5, py - 1.5, 3, 3);
  }
}

function drawGoals(context, view, c, goals) {
  for (const goal of goals.dropped || []) {
    const [px, py] = view.toPixel(goal.x_m, goal.y_m);
    context.fillStyle = c.refused;
    context.fillRect(px - 1.5, py - 1.5, 3, 3);
  }
  for (const goal of goals.given_up || []) cross(context, ...view.toPixel(goal.x_m, goal.y_m), 5, c.refused);
  for (const goal of goals.open || []) diamond(context, ...view.toPixel(goal.x_m, goal.y_m), 6, c.open);
  if (goals.goal) target(context, ...view.toPixel(goals.goal.x_m, goals.goal.y_m), c.goal);
}

function drawPlaces(context, view, c, places) {
  context.textAlign = "center";
  for (const place of places.places || []) {
    const [px, py] = view.toPixel(place.x_m, place.y_m);
    text(context, c, `${place.number} · ${place.area_m2.toFixed(0)} m²`, px, py, c.place);
  }
  context.textAlign = "start";
}

/** Seconds since a mate was heard, now. */
export function mateAge(peer, teamAge_s) { return peer.heard_s_ago + teamAge_s; }

/** Of where it is drawn: in a replay the place may be older than the newest word. */
const placeAge = (peer, teamAge_s) => Math.max(mateAge(peer, teamAge_s), peer.here.age_s || 0);

function drawMates(context, view, c, team, teamAge_s) {
  for (const peer of team.peers || []) {
    if (!peer.here) continue;
    const age = placeAge(peer, teamAge_s), live = peer.alive && age < MATE_STALE_S;
    context.globalAlpha = live ? 1 : Math.max(0.35, 0.9 - age / 120);
    const colour = live ? c.mate : c.refused;
    line(context, view, points(peer.here.way), colour, 2, [5, 4]);
    if (peer.here.claim) target(context, ...view.toPixel(peer.here.claim.x_m, peer.here.claim.y_m), colour);
    robot(context, view, c, peer.here.pose, live ? `${peer.robot}` : `${peer.robot}, ${age.toFixed(0)} s ago`, colour, live);
    context.globalAlpha = 1;
  }
}

function drawScale(context, view, c) {
  const wanted_m = 100 / view.scale;
  const steps = [0.2, 0.5, 1, 2, 5, 10, 20, 50];
  const metres = steps.find((step) => step >= wanted_m) || steps[steps.length - 1];
  const right = view.width - 12, y = view.height - 14, left = right - metres * view.scale;
  context.strokeStyle = c.ink;
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(left, y - 5); context.lineTo(left, y); context.lineTo(right, y); context.lineTo(right, y - 5);
  context.stroke();
  text(context, c, `${metres} m`, left + 4, y - 4, c.ink);
}

/** What a frame seldom finds changed. */
function drawGround(context, view, c, tiles, known) {
  tiles.draw(context, view);
  const trails = known.trails || {};
  for (const trail of trails.mates || []) line(context, view, trail, c.mate, 1.2, [2, 3]);
  line(context, view, trails.own, c.own, 1.5, [2, 3]);
  drawDoubt(context, view, known.doubt);
  drawAreas(context, view, (known.areas || {}).areas);
  drawPlaces(context, view, c, known.places || {});
}

/** `ground`: the layer beneath; `known`: the newest value of each topic; `teamAge_s`: how long ago the team's was told; `pin`: where to go or to be (with a heading), or null;
 *  `pen`: an area that is being drawn. */
export function drawAll(context, ground, view, tiles, known, teamAge_s, live, pin, pen) {
  const c = colours();
  context.clearRect(0, 0, view.width, view.height);
  ground.draw(view, [tiles.changes, known.trails, known.doubt, known.areas, known.places],
    (beneath) => drawGround(beneath, view, c, tiles, known));
  if (live) drawScan(context, view, c, (known.scan || {}).cm || []);
  drawGoals(context, view, c, known.goals || {});
  drawMates(context, view, c, known.team || {}, teamAge_s);
  line(context, view, points((known.goals || {}).route), c.own, 3);
  const place = ((known.status || {}).session || {}).place || {};
  if (place.waits && place.proposed) robot(context, view, c, place.proposed, "proposed", c.own, false);
  if (known.status && known.status.pose && !place.waits)
    robot(context, view, c, known.status.pose, known.status.robot || "", live ? c.own : c.refused, live);
  drawPen(context, view, pen);
  if (pin) {
    const [px, py] = view.toPixel(pin.x_m, pin.y_m);
    target(context, px, py, c.goal);
    if (pin.theta_rad === undefined) cross(context, px, py, 12, c.goal);
    else robot(context, view, c, pin, "here", c.goal, true);
  }
  drawScale(context, view, c);
}
