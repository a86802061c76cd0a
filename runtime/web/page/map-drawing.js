// The plane of releases as it is drawn: rates in colours, chaotic points dotted, open ones hatched.

import { cleared, colour } from "./canvas.js";
import { PLANE } from "./map-plane.js";

const DEGREE = Math.PI / 180;

/** Space for axes beside the plane, CSS pixels. */
const SPACE = { left: 52, right: 10, above: 8, below: 40 };

/** Growth rates between which colours change, 1/s. */
const [LOW, HIGH] = [0.01, 5].map(Math.log);

/** Colours from slow to fast growth: red, green, blue. */
const COLOURS = [[24, 18, 74], [92, 24, 120], [183, 55, 121], [246, 120, 84], [252, 236, 160]];

/** The colour at a part of the scale. */
export function shade(part) {
  const place = Math.min(Math.max(part, 0), 1) * (COLOURS.length - 1);
  const index = Math.min(Math.floor(place), COLOURS.length - 2);
  const mixed = COLOURS[index].map((low, i) => low + (place - index) * (COLOURS[index + 1][i] - low));
  return `rgb(${mixed.map(Math.round).join(" ")})`;
}

const shadeOf = (rate) => shade((Math.log(Math.max(rate, 1e-300)) - LOW) / (HIGH - LOW));

/** The rectangle of the plane on a canvas. */
function inner({ clientWidth, clientHeight }) {
  const { left, right, above, below } = SPACE;
  return { left, above, width: clientWidth - left - right, height: clientHeight - above - below };
}

const part = ([from, to], value) => (value - from) / (to - from);
const value = ([from, to], own) => from + Math.min(Math.max(own, 0), 1) * (to - from);

/** Where a release (rad) is on a canvas, CSS pixels. */
export function placeIn(canvas, root, rest) {
  const { left, above, width, height } = inner(canvas);
  return [left + width * part(PLANE.rest, rest), above + height * (1 - part(PLANE.root, root))];
}

/** The release (rad) at a place of a canvas. */
export function releaseIn(canvas, x, y) {
  const { left, above, width, height } = inner(canvas);
  return { rest: value(PLANE.rest, (x - left) / width), root: value(PLANE.root, 1 - (y - above) / height) };
}

/** A tile of eight pixels, in black with white inside, so that it is seen on every shade. */
function tile(paint) {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [8, 8];
  const context = canvas.getContext("2d");
  paint(context, "#000000", 1);
  paint(context, "#ffffff", 0.45);
  return canvas;
}

function stripes(context, style, size) {
  context.strokeStyle = style;
  context.lineWidth = 3.2 * size;
  context.beginPath();
  for (const shift of [-8, 0, 8]) {
    context.moveTo(shift - 1, 9);
    context.lineTo(shift + 9, -1);
  }
  context.stroke();
}

function dots(context, style, size) {
  context.fillStyle = style;
  for (const middle of [2, 6]) {
    context.beginPath();
    context.arc(middle, middle, 1.1 * size, 0, 7);
    context.fill();
  }
}

/** Patterns over points whose rate is not determined, with their strength. */
const PATTERNS = {
  chaotic: { tile: tile(dots), alpha: 0.4 },
  open: { tile: tile(stripes), alpha: 0.5 },
};

/** Shows the pattern of a class on an element. */
export function patternOn(element, own) {
  const image = `url(${PATTERNS[own].tile.toDataURL()})`;
  element.style.background = `${image}, ${shade(0.75)}`;
}

const cellsCanvas = document.createElement("canvas");
[cellsCanvas.width, cellsCanvas.height] = [PLANE.columns, PLANE.rows];

function drawCells(context, { cells }, alpha, classOf) {
  const { left, above, width, height } = inner(context.canvas);
  const own = cellsCanvas.getContext("2d");
  own.clearRect(0, 0, PLANE.columns, PLANE.rows);
  const [across, down] = [width / PLANE.columns, height / PLANE.rows];
  const covered = { chaotic: new Path2D(), open: new Path2D() };
  cells.forEach((point, index) => {
    const [column, row] = [index % PLANE.columns, PLANE.rows - 1 - Math.floor(index / PLANE.columns)];
    own.fillStyle = Number.isFinite(point.rate) ? shadeOf(point.rate) : "gray";
    own.fillRect(column, row, 1, 1);
    covered[classOf(point)]?.rect(left + column * across, above + row * down, across, down);
  });
  context.globalAlpha = alpha;
  context.imageSmoothingEnabled = false;
  context.drawImage(cellsCanvas, left, above, width, height);
  for (const [own, { tile, alpha: strength }] of Object.entries(PATTERNS)) {
    context.globalAlpha = strength * alpha;
    context.fillStyle = context.createPattern(tile, "repeat");
    context.fill(covered[own]);
  }
  context.globalAlpha = 1;
}

function axes(context, canvas) {
  const { left, above, width, height } = inner(canvas);
  const degrees = (number) => `${number}°`.replace("-", "−");
  context.strokeStyle = colour("line");
  context.lineWidth = 1;
  context.strokeRect(left - 0.5, above - 0.5, width + 1, height + 1);
  context.fillStyle = colour("text");
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "top";
  for (const own of [-90, 0, 90]) {
    context.fillText(degrees(own), placeIn(canvas, 0, own * DEGREE)[0], above + height + 5);
  }
  context.fillText("angle of all others", left + width / 2, above + height + 21);
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const own of [0, 45, 90, 135]) {
    const y = placeIn(canvas, own * DEGREE, 0)[1];
    context.fillText(degrees(own), left - 5, Math.min(Math.max(y, above + 6), above + height - 4));
  }
  context.save();
  context.translate(8, above + height / 2);
  context.rotate(-Math.PI / 2);
  context.textAlign = "center";
  context.fillText("angle of the root", 0, 0);
  context.restore();
}

function mark(context, [x, y]) {
  for (const [style, width] of [["#000000", 5], ["#ffffff", 2]]) {
    context.strokeStyle = style;
    context.lineWidth = width;
    context.beginPath();
    context.arc(x, y, 7, 0, 7);
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      context.moveTo(x + 4 * dx, y + 4 * dy);
      context.lineTo(x + 12 * dx, y + 12 * dy);
    }
    context.stroke();
  }
}

/** Draws a map: its `plane` over the faint one `before` it, points by their class, and the release `point`. */
export function drawMap(canvas, { plane, before, point }, classOf) {
  const { context } = cleared(canvas);
  if (before) drawCells(context, before, 0.45, classOf);
  drawCells(context, plane, 1, classOf);
  axes(context, canvas);
  const { left, above, width, height } = inner(canvas);
  context.save();
  context.beginPath();
  context.rect(left, above, width, height);
  context.clip();
  mark(context, placeIn(canvas, point.root, point.rest));
  context.restore();
}
