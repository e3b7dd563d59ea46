// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The words beside the map. All text goes in as text: nothing that a robot says is read as a page.
import { CURE } from "./doubt.js";
import { MATE_STALE_S, mateAge } from "./draw.js";
import { colourOf } from "./palette.js";
import { clock } from "./replay.js";

const LOG_LINES = 100;
const at = (id) => document.getElementById(id);

function element(tag, words = "", className = "") {
  const made = document.createElement(tag);
  made.textContent = words;
  if (className) made.className = className;
  return made;
}

const number = (value, digits, unit) => (typeof value === "number" ? `${value.toFixed(digits)} ${unit}` : "–");

export function showState(status) {
  const mission = status.mission || {};
  const words = [status.state, mission.state && `mission ${mission.order}: ${mission.state}`, status.reason];
  at("state").textContent = words.filter(Boolean).join(" · ");
  document.title = `${status.robot}: ${status.state}`;
  const latch = status.estop ? `LATCHED${status.estop_latch && status.estop_latch.kept === "no" ? ", not kept over a restart" : ""}` : "clear";
  const rows = [
    ["e-stop", latch, status.estop],
    ["battery", number(status.battery_v, 1, "V")],
    ["does", status.activity || "–"],
    ["why", status.reason || "–"],
    ["mission", mission.state ? `${mission.order}, ${mission.state}, ${number(mission.elapsed_s, 0, "s")}, ${number(mission.distance_m, 1, "m")}` : "–"],
    ["known area", number(status.known_m2, 1, "m²")],
    ["speed", `${number(status.twist && status.twist.v_mps, 2, "m/s")}, ${number(status.twist && status.twist.omega_radps, 2, "rad/s")}`],
    ["free ahead", number(status.free_distance_m, 2, "m")],
    ["place", status.pose ? `${status.pose.x_m.toFixed(2)}, ${status.pose.y_m.toFixed(2)}` : "–"],
    ["keyframes", status.map ? `${status.map.keyframes}` : "–"],
  ];
  at("facts").replaceChildren(...rows.flatMap(([name, value, bad]) => [element("dt", name), element("dd", value, bad ? "bad" : "")]));
}

/** Doubts, faults and what keeps the robot from driving, each with its cure. */
export function showFindings(known) {
  const items = [];
  for (const doubt of ((known.status || {}).plausibility || {}).doubts || []) items.push([doubt.found, doubt.cure]);
  if (known.doubt && known.doubt.why) items.push([known.doubt.why, CURE]);
  for (const fault of (known.health || {}).faults || []) items.push([fault, ""]);
  for (const check of (known.doctor || {}).checks || []) {
    if (!check.ok) items.push([`${check.check}: ${check.found}`, check.cure]);
  }
  const seen = new Set(), rows = [];
  for (const [found, cure] of items) {
    if (seen.has(found)) continue;
    seen.add(found);
    const row = element("li", found, "bad");
    if (cure) row.append(" ", element("small", cure));
    rows.push(row);
  }
  at("findings").replaceChildren(...(rows.length ? rows : [element("li", "none")]));
}

export function showTeam(team, teamAge_s) {
  if (!team.present) return at("team").replaceChildren(element("caption", "this robot has no team"));
  const head = element("tr");
  for (const title of ["robot", "heard", "trip", "loss", "in step", "map", "does"]) head.append(element("th", title));
  const percent = (share) => (typeof share === "number" ? `${(100 * share).toFixed(0)} %` : "–");
  const rows = (team.peers || []).map((peer) => {
    const age = mateAge(peer, teamAge_s), live = peer.alive && age < MATE_STALE_S;
    const row = element("tr", "", live ? "" : "away");
    const claim = peer.status && peer.status.claim;
    const does = peer.by_map ? "no log: known by the map alone" : !peer.alive ? "out of reach" : !peer.status ? "–"
      : peer.status.duty + (claim ? `, cost ${claim.cost_m.toFixed(1)} m` : "");
    const trip = typeof peer.round_trip_s === "number" ? `${(1000 * peer.round_trip_s).toFixed(0)} ms` : "–";
    const lacks = (peer.it_lacks || {}).bytes;  // not in a log
    const behind = peer.by_map ? "–" : peer.in_step ? "yes" : `no${lacks === undefined ? "" : `, ${(lacks / 1000).toFixed(1)} kB`}`;
    for (const cell of [peer.robot, `${age.toFixed(1)} s`, trip, percent(peer.loss_in), behind,
      peer.map_joined || peer.by_map ? "joined" : "apart", does]) row.append(element("td", `${cell}`));
    return row;
  });
  const trouble = team.trouble ? [element("caption", team.trouble, "bad")] : [];
  at("team").replaceChildren(...trouble, head, ...rows);
}

const where = (goal) => `(${goal.x_m.toFixed(1)}, ${goal.y_m.toFixed(1)})`;

export function showGoals(goals) {
  const rows = [];
  const add = (shape, words, more) => {
    const row = element("li", `${shape} ${words}`);
    if (more) row.append(" ", element("small", more));
    rows.push(row);
  };
  const decisions = goals.decisions || [], last = decisions[decisions.length - 1];
  if (goals.goal) add("◎", `now ${where(goals.goal)}`, last ? last.text : "");
  for (const goal of goals.open || [])
    add("◇", `open ${where(goal)}`, `opening ${goal.opening_m.toFixed(1)} m${goal.place ? `, place ${goal.place}` : ""}`);
  for (const goal of goals.given_up || [])
    add("✕", `refused ${where(goal)}`, `${goal.why}; ${goal.back_in_s === null ? "for good" : `back in ${goal.back_in_s.toFixed(0)} s`}`);
  const dropped = (goals.dropped || []).length;
  if (dropped) add("·", `${dropped} candidates left out`, "topoctl goals --why names each");
  at("goals").replaceChildren(...(rows.length ? rows : [element("li", "none")]));
}

function logRow(time, words, bad) {
  const row = element("li", "", bad ? "bad" : "");
  row.append(element("small", time), " ", words);
  return row;
}

/** Of a replay: what was said until its position, the newest first. */
export function showPast(past) {
  at("log").replaceChildren(...past.events.map((event) => logRow(clock(event.t_s), eventWords(event), false)).reverse());
}

export function addToLog(words, bad = false) {
  at("log").prepend(logRow(new Date().toLocaleTimeString(), words, bad));
  while (at("log").childElementCount > LOG_LINES) at("log").lastElementChild.remove();
}

export function eventWords(event) {
  const mission = event.mission;
  if (mission) return `mission ${mission.order}: ${mission.state}${mission.reason ? `, ${mission.reason}` : ""}`;
  if (event.event === "decision") return `goal ${where(event)}: ${event.text}`;
  if (event.event === "team_order") return `${event.order}, ordered by robot ${event.robot}${event.refused ? `: refused: ${event.refused}` : ""}`;
  if (event.event === "mate") return `robot ${event.robot}: ${event.what}${typeof event.x_m === "number" ? ` ${where(event)}` : ""}`;
  if (event.event === "team_word") {
    const refused = event.refused.map((one) => `, REFUSED by ${one.robot}: ${one.why}`).join("");
    return `order ${event.order} to the team: acknowledged by: ${event.acknowledged.join(", ") || "none"}${refused}`;
  }
  if (event.event === "area") return `area ${event.id || ""} ${event.what}`;
  if (event.event === "battery_low") return `battery low: ${number(event.battery_v, 1, "V")}`;
  const rest = Object.entries(event).filter(([name]) => !["event", "t_s", "utc"].includes(name)).map(([name, value]) => `${name} ${JSON.stringify(value)}`);
  return [event.event, ...rest].join(", ");
}

/** The known area since the page was opened, or of a replay. */
export class Coverage {
  constructor() { this.samples = []; }
  add(known_m2) {
    const now = performance.now();
    const last = this.samples[this.samples.length - 1];
    if (typeof known_m2 !== "number" || (last && now - last[0] < 2000)) return;
    this.samples.push([now, known_m2]);
    if (this.samples.length > 1000) this.samples = this.samples.filter((_, i) => i % 2 === 0);
    this.draw();
  }
  /** Of a replay: [seconds, m2], until its position. */
  set(samples) {
    this.samples = samples;
    this.draw();
  }
  draw() {
    const canvas = at("coverage"), context = canvas.getContext("2d");
    canvas.width = canvas.clientWidth || 300;  // which clears it
    if (this.samples.length === 0) return;
    const most = Math.max(1, ...this.samples.map(([, m2]) => m2)), begin = this.samples[0][0];
    const span = Math.max(1, this.samples[this.samples.length - 1][0] - begin);
    context.strokeStyle = colourOf("--own");
    context.lineWidth = 2;
    context.beginPath();
    for (const [t, m2] of this.samples) context.lineTo(((t - begin) / span) * canvas.width, 38 - (m2 / most) * 35);
    context.stroke();
  }
}
