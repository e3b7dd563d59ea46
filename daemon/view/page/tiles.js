// SPDX-FileCopyrightText: 2026 The Topometric authors
// SPDX-License-Identifier: BSD-3-Clause
// The map: square tiles of cells, each put once into a sheet of them, and again when it changes. A map of a building is then
// a dozen pictures to be drawn, not hundreds.

import { colourOf } from "./palette.js";

const DIGITS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
const VALUE = new Uint8Array(128);
[...DIGITS].forEach((digit, value) => { VALUE[digit.charCodeAt(0)] = value; });

const SHEET = 8;  // tiles along the side of a sheet

/** The cells of a tile, row by row from the lowest y, as runs of one state (0 unknown, 1 free, 2 occupied): encode_cells()
 *  backwards. `each(state, begin, end)`. */
function eachRun(text, each) {
  let at = 0, longer = 0;
  for (let i = 0; i < text.length; ++i) {
    const value = VALUE[text.charCodeAt(i)];
    if (value >= 48) {
      longer = (value - 47) * 16;
      continue;
    }
    const end = at + longer + (value & 15) + 1;
    each(value >> 4, at, end);
    at = end;
    longer = 0;
  }
}

/** A colour as four bytes of a picture: red, green, blue, opaque. */
function pixelOf(name) {
  const hex = colourOf(name);
  const full = hex.length === 4 ? "#" + [...hex.slice(1)].map((c) => c + c).join("") : hex;
  const bytes = [1, 3, 5].map((i) => parseInt(full.slice(i, i + 2), 16));
  return new Uint32Array(new Uint8Array([...bytes, 255]).buffer)[0];
}

export class Tiles {
  constructor() {
    this.tiles = new Map();
    this.sheets = new Map();
    this.map = 0;
    this.side = 64;
    this.image = new ImageData(this.side, this.side);  // of one tile at a time
    this.resolution = 0.05;
    this.changes = 0;  // counts them
    this.readColours();
  }

  /** To be called again when the page turns dark or light. */
  readColours() {
    this.pixels = [0, pixelOf("--free"), pixelOf("--wall")];  // unknown is transparent
    for (const tile of this.tiles.values()) this.paint(tile);
    ++this.changes;
  }

  take(message) {
    if (message.map !== this.map || (message.side > 0 && message.side !== this.side)) {
      this.tiles.clear();
      this.sheets.clear();
    }
    this.map = message.map;
    if (message.side > 0) this.side = message.side;
    if (this.image.width !== this.side) this.image = new ImageData(this.side, this.side);
    if (message.resolution_m > 0) this.resolution = message.resolution_m;
    for (const [x, y, text] of message.tiles) {
      const key = `${x} ${y}`;
      const tile = this.tiles.get(key) || { x, y, cells: new Uint8Array(this.side * this.side) };
      tile.text = text;
      this.paint(tile);
      this.tiles.set(key, tile);
    }
    ++this.changes;
  }

  /** Also finds the box of what is known in the tile, in cells from its corner. A sheet's rows begin at the lowest y. */
  paint(tile) {
    const side = this.side, image = this.image, pixels = new Uint32Array(image.data.buffer);
    let x0 = side, y0 = side, x1 = 0, y1 = 0;
    tile.cells.fill(0);  // what is not told is unknown
    pixels.fill(0);
    eachRun(tile.text, (state, begin, end) => {
      tile.cells.fill(state, begin, end);
      pixels.fill(this.pixels[state], begin, end);
      if (state === 0) return;
      const low = Math.floor(begin / side), high = Math.floor((end - 1) / side), whole = low !== high;
      x0 = Math.min(x0, whole ? 0 : begin % side);
      x1 = Math.max(x1, whole ? side : (end - 1) % side + 1);
      y0 = Math.min(y0, low);
      y1 = Math.max(y1, high + 1);
    });
    tile.known = x1 > 0 ? { x0, y0, x1, y1 } : null;
    const sheet = this.sheetOf(tile);
    sheet.context.putImageData(image, (tile.x - sheet.x * SHEET) * side, (tile.y - sheet.y * SHEET) * side);
  }

  sheetOf(tile) {
    const x = Math.floor(tile.x / SHEET), y = Math.floor(tile.y / SHEET), key = `${x} ${y}`;
    if (!this.sheets.has(key)) {
      const picture = new OffscreenCanvas(SHEET * this.side, SHEET * this.side);
      this.sheets.set(key, { x, y, picture, context: picture.getContext("2d") });
    }
    return this.sheets.get(key);
  }

  /** The box of all that is known, in metres, or null when nothing is. */
  box() {
    let box = null;
    for (const { x, y, known } of this.tiles.values()) {
      if (!known) continue;
      const left = x * this.side, low = y * this.side, cell = this.resolution;
      box = box || { x0: Infinity, y0: Infinity, x1: -Infinity, y1: -Infinity };
      box.x0 = Math.min(box.x0, (left + known.x0) * cell); box.x1 = Math.max(box.x1, (left + known.x1) * cell);
      box.y0 = Math.min(box.y0, (low + known.y0) * cell); box.y1 = Math.max(box.y1, (low + known.y1) * cell);
    }
    return box;
  }

  stateAt(x_m, y_m) {
    const cx = Math.floor(x_m / this.resolution), cy = Math.floor(y_m / this.resolution);
    const tx = Math.floor(cx / this.side), ty = Math.floor(cy / this.side);
    const tile = this.tiles.get(`${tx} ${ty}`);
    return tile ? tile.cells[(cy - ty * this.side) * this.side + cx - tx * this.side] : 0;
  }

  draw(context, view) {
    const edge = SHEET * this.side * this.resolution;
    context.imageSmoothingEnabled = view.scale * this.resolution < 1;
    context.save();
    context.scale(1, -1);  // y goes up in the map, and down in a picture
    for (const { x, y, picture } of this.sheets.values()) {
      // Corners on whole pixels, or seams would show between neighbours.
      const [left, bottom] = view.toPixel(x * edge, y * edge).map(Math.round);
      const [right, top] = view.toPixel((x + 1) * edge, (y + 1) * edge).map(Math.round);
      if (right < 0 || bottom < 0 || left > view.width || top > view.height) continue;
      context.drawImage(picture, left, -bottom, right - left, bottom - top);
    }
    context.restore();
  }
}
