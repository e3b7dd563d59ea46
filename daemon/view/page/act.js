// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// What the operator wants done, and what became of it. The token stays in this browser's storage, which pages of
// other origins cannot read, and is sent in a message, never with a request that another page could cause.

const STORED = "topoview-token";
const LATE_MS = 2000;

/** What an act will do, said before it is done; null: it only makes robots stand, and is done at once. */
const WORDS = {
  start: (who) => `start: ${who} explores, and comes home`,
  home: (who) => `home: ${who} drives back to its start`,
  resume: (who) => `resume: ${who} goes on with its mission`,
  clear_estop: (who) => `clear the e-stop of ${who}: it may move again`,
  pause: null,
  stop_all: null,
};

/** Of an order: "" this robot, "all", or a mate's number. */
const whose = (whom) => (whom === "" ? "this robot" : whom === "all" ? "every robot of the team" : `robot ${whom}`);

export function storedToken() { return localStorage.getItem(STORED); }
export function forgetToken() { localStorage.removeItem(STORED); }

/** The token of an address that topoview pair printed; it does not stay in the address. */
export function tokenOfAddress() {
  const found = /^#token=([\w-]+)$/.exec(location.hash);
  if (!found) return null;
  history.replaceState(null, "", location.pathname);
  return found[1];
}

export class Acts {
  /** `tell(words, failed)` shows the operator what became of an act; `authorised(yes)`. */
  constructor(link, tell, authorised) {
    this.link = link;
    this.tell = tell;
    this.authorised = authorised;
    this.next = 1;
    this.waiting = new Map();
    this.order = null;  // of the whole team: {number, what}
  }

  words(act, whom) { return WORDS[act] && WORDS[act](whose(whom)); }

  /** An order of a mission, to this robot, a mate or all. */
  mission(act, whom) {
    if (whom === "") return this.command({ act }, act);
    const message = whom === "all" ? { act: `${act}_all` } : { act, robot: Number(whom) };
    this.ofTeam(message, `${act} for ${whose(whom)}`, whom === "all" ? "this robot obeys" : "");
  }

  send(message, what, done) {
    const id = this.next++;
    if (!this.link.open || !this.link.send({ ...message, id })) {
      this.tell(`${what}: NOT SENT, there is no connection to the robot`, true);
      return;
    }
    const late = setTimeout(() => this.tell(`${what}: no answer yet`, true), LATE_MS);
    this.waiting.set(id, { what, done, late });
  }

  /** An answer of topoview. */
  take(message) {
    const asked = this.waiting.get(message.id);
    if (!asked) return;
    this.waiting.delete(message.id);
    clearTimeout(asked.late);
    asked.done(message);
  }

  /** Nothing that was sent on a lost connection is known to have arrived. */
  lost() {
    for (const { what, late } of this.waiting.values()) {
      clearTimeout(late);
      this.tell(`${what}: the connection was lost before the answer`, true);
    }
    this.waiting.clear();
  }

  estop() {
    this.ofTeam({ act: "estop" }, "E-STOP ALL", "latched on this robot",
      "topometric-estop on the robot, or its own button, stops it without the daemon");
  }

  /** `here`: what has become of it on this robot when it is sent; "": it is not for this robot. */
  ofTeam(message, what, here, cure = "") {
    this.tell(`${what}: sent`, false);
    this.send(message, what, (answer) => {
      if (!answer.ok) return this.tell(`${what}: FAILED: ${answer.why}${cure ? "; " + cure : ""}`, true);
      const refused = answer.v.refused_here;
      const begin = refused ? `this robot REFUSES: ${refused}` : here;
      this.order = { number: answer.v.order, what, begin: begin && `${begin}; `, failed: !!refused };
      this.tell(`${what}: ${begin || "sent to it"}`, !!refused);
    });
  }

  /** Who has acknowledged the order to the team, from the newest word on the team; those not reached are named. */
  follow(team) {
    if (!this.order || !team || !team.present || !team.order || team.order.number !== this.order.number) return;
    const { what, begin, failed } = this.order;
    const { to, acknowledged = [], refused = [] } = team.order;
    const spoke = [...acknowledged, ...refused.map((one) => one.robot)];
    const meant = typeof to === "number" ? [to] : (team.peers || []).map((peer) => peer.robot);
    const missing = meant.filter((robot) => !spoke.includes(robot));
    const list = (robots) => (robots.length ? robots.join(", ") : "none");
    const words = [`acknowledged by: ${list(acknowledged)}`, ...refused.map((one) => `REFUSED by ${one.robot}: ${one.why}`),
      ...(missing.length ? [`NOT REACHED: ${list(missing)}`] : [])];
    this.tell(`${what}: ${begin}${words.join("; ")}`, failed || refused.length + missing.length > 0);
    if (missing.length === 0) this.order = null;
  }

  command(message, what) {
    if (message.act === "stop_all") return this.ofTeam(message, what, "this robot stands");
    this.tell(`${what}: sent`, false);
    this.send(message, what, (answer) =>
      this.tell(answer.ok ? `${what}: done${answer.v && answer.v.place ? `: ${answer.v.place}` : ""}`
        : `${what}: refused: ${answer.why}`, !answer.ok));
  }

  authorise(token, quiet) {
    this.send({ act: "authorise", token }, "token", (answer) => {
      if (answer.ok) localStorage.setItem(STORED, token);
      else forgetToken();
      this.authorised(answer.ok);
      if (!quiet || !answer.ok) this.tell(answer.ok ? "this browser may give orders" : `token: ${answer.why}`, !answer.ok);
    });
  }
}
