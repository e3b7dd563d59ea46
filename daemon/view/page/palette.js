// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The colours of style.css, read once: to ask for one makes the browser lay out all that has changed.

let style = null;
const read = new Map();

/** As it stands there, for "--own" and so on. */
export function colourOf(name) {
  style = style || getComputedStyle(document.documentElement);
  if (!read.has(name)) read.set(name, style.getPropertyValue(name).trim());
  return read.get(name);
}

/** To be called when the page turns dark or light. */
export function forgetColours() { read.clear(); }
