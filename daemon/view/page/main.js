// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// Ties the parts together: messages in, pictures and words out, clicks to acts.
import { Acts, forgetToken, storedToken, tokenOfAddress } from "./act.js";
import { KINDS, Pen, showAreas } from "./areas.js";
import { View } from "./canvas.js";
import { isDoubted } from "./doubt.js";
import { drawAll } from "./draw.js";
import { Layer } from "./layer.js";
import { Link } from "./link.js";
import { forgetColours } from "./palette.js";
import { addToLog, Coverage, eventWords, showFindings, showGoals, showPast, showState, showTeam } from "./panels.js";
import { TimeLine } from "./replay.js";
import { Tiles } from "./tiles.js";

const STALE_MS = 1200;  // state comes five times a second; what is shown is at most half a second older
const at = (id) => document.getElementById(id);

const tiles = new Tiles();
const ground = new Layer(at("ground"));
const coverage = new Coverage();
const pen = new Pen();
const known = {};     // topic: its newest value
const toldAt = {};    // topic: when, in performance.now()
let drawn = { tiles: 0, mates: 0 };  // by the newest frame
let dirty = false, following = false, going = false;
let pin = null, pending = null, mayAct = false, replayed = false;

const isLive = () => performance.now() - (toldAt.status || -Infinity) < STALE_MS && known.link && known.link.joined;
// In a replay the time of the page is not that of the mission.
const teamAge_s = () => (replayed ? 0 : (performance.now() - (toldAt.team || 0)) / 1000);

function tell(words, failed) {
  at("told").textContent = words;
  at("told").hidden = false;
  at("told").classList.toggle("failed", failed);
  if (tell.last !== words) addToLog(words, failed);
  tell.last = words;
}

const placeAsked = () => ((known.status || {}).session || {}).place || {};

function redraw() {
  if (dirty) return;
  dirty = true;
  requestAnimationFrame(() => {
    dirty = false;
    const pose = (known.status || {}).pose;
    if (following && pose) view.centre = { x: pose.x_m, y: pose.y_m };
    // While a session waits for the robot's place its map is shown, in which goals and ways of the present one have none.
    const shown = placeAsked().waits ? { status: known.status } : known;
    drawAll(at("canvas").getContext("2d"), ground, view, tiles, shown, teamAge_s(), isLive(), pin, pen);
    drawn = { tiles: tiles.tiles.size, mates: ((known.team || {}).peers || []).filter((peer) => peer.here).length };
  });
}

const CELLS = ["unknown", "free", "wall"];
const view = new View(at("canvas"), redraw, clicked, (x, y) => {
  at("under").textContent = `${x.toFixed(2)}, ${y.toFixed(2)} m · ${CELLS[tiles.stateAt(x, y)]}${isDoubted(known.doubt, x, y) ? ", doubtful" : ""}`;
});

// For tests, and for who looks with the browser's own tools: where the window shows a point of the map.
window.topoview = {
  pixelOf: (x_m, y_m) => {
    const box = at("canvas").getBoundingClientRect(), [px, py] = view.toPixel(x_m, y_m);
    return [box.x + px, box.y + py];
  },
  drawn: () => drawn,
  redraw,
  shift: (dx, dy) => view.shift(dx, dy),
};

function showLink() {
  const live = isLive(), link = known.link;
  document.body.classList.toggle("stale", !live);
  const silent_s = Math.round((performance.now() - (toldAt.status || performance.now())) / 1000);
  const words = !connection.open || connection.silent ? replayed ? "NO CONNECTION to the replay" : "NO CONNECTION to the robot"
    : link && !link.joined ? `NO DAEMON: ${link.why}`
    : live && replayed ? "replay, NOT LIVE"
    : live ? "live" : known.status ? `NO NEWS for ${silent_s} s` : "waiting for the first news";
  at("link").textContent = words;
  redraw();
}

function greeted(hello) {
  at("robot").textContent = hello.robot;
  mayAct = hello.may;
  if (greeted.before !== undefined && greeted.before !== hello.replay) location.reload();  // another program is here now
  greeted.before = replayed = hello.replay;
  document.body.classList.toggle("replay", replayed);
  for (const button of document.querySelectorAll("#orders [data-act], #whom, #going, #drawing, #first")) button.disabled = !mayAct;
  if (known.areas) shows.areas(known.areas);
  showPlace();
  at("token-form").hidden = mayAct;
  at("token-held").hidden = !mayAct;
  if (!hello.look) tell("looking needs a token here", true);
  const token = tokenOfAddress() || storedToken();
  if (!mayAct && token) acts.authorise(token, true);
}

/** Whom start, pause, resume and home are for. A list that is drawn anew while it is open would close. */
function showWhom(team) {
  const robots = team.present ? (team.peers || []).map((peer) => peer.robot) : [], names = robots.join();
  at("for-whom").hidden = robots.length === 0;
  if (names === showWhom.names) return;
  showWhom.names = names;
  const chosen = at("whom").value;
  at("whom").replaceChildren(new Option("this robot", ""), ...robots.map((robot) => new Option(`robot ${robot}`, robot)),
    new Option("the whole team", "all"));
  at("whom").value = [...at("whom").options].some((option) => option.value === chosen) ? chosen : "";
}

const shows = {
  status: (value) => {
    showState(value);
    showFindings(known);
    showPlace();
    if (!replayed) coverage.add(value.known_m2);
  },
  team: (value) => {
    showTeam(value, 0);
    showWhom(value);
    acts.follow(value);
  },
  goals: showGoals,
  areas: (value) => showAreas(at("areas"), value, mayAct, (id, kind) =>
    ask(`withdraw area ${id}: ${kind.ends}`,
      () => acts.command({ act: "area_withdraw", area: id }, `withdraw area ${id}`))),
  replay: (value) => timeLine.show(value),
  past: (value) => {
    showPast(value);
    coverage.set(value.known_m2);
  },
  health: () => showFindings(known),
  doctor: () => showFindings(known),
  doubt: () => showFindings(known),
};

function take(message) {
  if (message.t === "hello") return greeted(message);
  if (message.t === "answer") return acts.take(message);
  if (message.t === "event") return addToLog(eventWords(message.v));
  if (message.t === "map") {
    tiles.take(message);
    if (!view.moved) view.fit(tiles.box());
  } else {
    known[message.t] = message.v;
    toldAt[message.t] = performance.now();
    if (shows[message.t]) shows[message.t](message.v);
    if (message.t === "link") showLink();
  }
  redraw();
}

let wasOpen = false;
const connection = new Link(take, () => {
  if (wasOpen && !connection.open) acts.lost();
  wasOpen = connection !== undefined && connection.open;
  showLink();
  if (known.team) showTeam(known.team, teamAge_s());
});
const acts = new Acts(connection, tell, () => {});
const timeLine = new TimeLine((wish) => acts.send({ act: "replay", ...wish }, "time line", (answer) => {
  if (!answer.ok) tell(`time line: ${answer.why}`, true);
}));

/** Says what an act will do, and does it when the operator agrees. */
function ask(words, act) {
  pending = act;
  at("question-text").textContent = words;
  at("question").hidden = false;
  at("do-it").focus();
}

function leave() {
  pending = null;
  pin = null;
  at("question").hidden = true;
  setGoing(false);
  setPosing(false);
  draw(null);
  redraw();
}

function showPen() {
  at("pen").hidden = !pen.active;
  at("drawing").setAttribute("aria-pressed", `${pen.active && pen.kind === "keep_out"}`);
  at("first").setAttribute("aria-pressed", `${pen.active && pen.kind === "here_first"}`);
  at("pen-text").textContent = pen.corners.length ? pen.words : "click the corners on the map, the first one again to close";
  at("pen-close").disabled = !pen.complete;
  at("pen-undo").disabled = pen.corners.length === 0;
  redraw();
}

/** `kind`: of an area that is to be drawn; null: none. */
function draw(kind) {
  if (kind) pen.begin(kind);
  else pen.lift();
  at("pen-length").value = "";
  showPen();
}

function closeArea() {
  const corners_m = pen.flat, kind = pen.kind, { name, does } = KINDS[kind];
  ask(`${name}: ${does}, of ${corners_m.length / 2} corners, from now on`,
    () => acts.command({ act: "area_draw", kind, corners_m }, name));
}

function setCorner(x, y) {
  pen.length_m = Number(at("pen-length").value) || 0;
  at("pen-length").value = "";
  const closed = pen.click(x, y, 1 / view.scale);
  showPen();
  if (closed) closeArea();
}

function showPlace() {
  const place = placeAsked();
  at("posing").disabled = !mayAct || !place.waits;
  at("place").textContent = !place.waits ? ""
    : `this is the map of session ${place.session}, which waits: where is the robot? (set pose…)`;
  if (!place.waits && view.aim) leave();
}

/** Press where the robot is, drag to where it looks. */
function setPosing(on) {
  at("posing").setAttribute("aria-pressed", `${on}`);
  view.aim = !on ? null : {
    press: (x, y) => {
      pin = { x_m: Math.round(x * 100) / 100, y_m: Math.round(y * 100) / 100, theta_rad: 0 };
      redraw();
    },
    turn: (x, y) => {
      pin.theta_rad = Math.round(Math.atan2(y - pin.y_m, x - pin.x_m) * 1000) / 1000;
      redraw();
    },
    release: askForPose,
  };
}

function askForPose() {
  const { x_m, y_m, theta_rad } = pin, session = placeAsked().session;
  const where = `(${x_m}, ${y_m}) looking to ${Math.round((theta_rad * 180) / Math.PI)}°`;
  ask(`set pose: this robot looks for itself near ${where} in session ${session}, and goes on with that map`,
    () => acts.command({ act: "set_pose", x_m, y_m, theta_rad }, `set pose ${where}`));
}

function setGoing(on) {
  going = on;
  at("going").setAttribute("aria-pressed", `${on}`);
}

function clicked(x, y) {
  if (pen.active) return setCorner(x, y);
  if (!going) return;
  pin = { x_m: Math.round(x * 100) / 100, y_m: Math.round(y * 100) / 100 };
  const { x_m, y_m } = pin;
  ask(`go to: this robot drives to (${x_m}, ${y_m})`, () => acts.command({ act: "goto", x_m, y_m }, `go to (${x_m}, ${y_m})`));
  redraw();
}

at("estop").addEventListener("click", () => acts.estop());
for (const button of document.querySelectorAll("#orders [data-act]")) {
  button.addEventListener("click", () => {
    const act = button.dataset.act, whom = "mate" in button.dataset ? at("whom").value : "";
    const words = acts.words(act, whom);
    const go = () => ("mate" in button.dataset ? acts.mission(act, whom) : acts.command({ act }, button.textContent));
    if (words === null) go();
    else ask(words, go);
  });
}
at("going").addEventListener("click", () => {
  if (going) return leave();
  setGoing(true);
  at("under").textContent = "click on the map: where to?";
});
at("posing").addEventListener("click", () => {
  const begins = !view.aim;
  leave();
  setPosing(begins);
  at("under").textContent = begins ? "press where the robot is, drag to where it looks" : "";
});
for (const [id, kind] of [["drawing", "keep_out"], ["first", "here_first"]]) {
  at(id).addEventListener("click", () => {
    const begins = !pen.active || pen.kind !== kind;
    leave();
    draw(begins ? kind : null);
  });
}
at("pen-undo").addEventListener("click", () => {
  pen.undo();
  showPen();
});
at("pen-close").addEventListener("click", closeArea);
at("pen-leave").addEventListener("click", leave);
at("do-it").addEventListener("click", () => {
  const act = pending;
  leave();
  if (act) act();
});
at("leave-it").addEventListener("click", leave);
document.addEventListener("keydown", (event) => { if (event.key === "Escape") leave(); });
at("token-form").addEventListener("submit", (event) => {
  event.preventDefault();
  acts.authorise(at("token").value.trim(), false);
  at("token").value = "";
});
at("forget").addEventListener("click", () => {
  forgetToken();
  location.reload();
});
at("nearer").addEventListener("click", () => view.zoom(1.4));
at("farther").addEventListener("click", () => view.zoom(1 / 1.4));
at("whole").addEventListener("click", () => {
  view.moved = false;
  view.fit(tiles.box());
});
at("follow").addEventListener("click", () => {
  following = !following;
  at("follow").setAttribute("aria-pressed", `${following}`);
  redraw();
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
  forgetColours();
  tiles.readColours();
  redraw();
});
