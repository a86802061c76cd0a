// The face of the pendulum: support, plumb line, scale bar, ghost, traces, bodies.

import { cleared, colour } from "./canvas.js";

/** Height of the pivot over that of the picture, from above: of a pendulum that stays below, and of any. */
const HIGH = 0.2;
const MIDDLE = 0.5;

/** Space about the tree, over the picture. */
const SPACE = 0.05;

/** A rod without a body is as thin, CSS pixels. */
const THIN = 2.5;

/** Pixels from the corner of a picture of a place in metres, and back, the pivot at `high`. */
export function frameOf({ width, height, reach, high }) {
  const scale = Math.min((0.5 - SPACE) * width, (1 - high - SPACE) * height) / reach;
  const middle = [width / 2, high * height];
  return {
    scale,
    toPixels: (x, y) => [middle[0] + scale * x, middle[1] - scale * y],
    toMetres: (x, y) => [(x - middle[0]) / scale, (middle[1] - y) / scale],
  };
}

/** Where the pivot stands: high until an end rises above what the picture has room for. */
export class Height {
  constructor() {
    this.settle();
  }

  settle() {
    [this.high, this.target] = [HIGH, HIGH];
  }

  /** Sees the ends (m) of a tree of that reach; it takes half a second to the other place. */
  see(ends, reach, isCalm) {
    const room = (HIGH / (1 - HIGH - SPACE)) * reach;
    for (let index = 1; index < ends.length; index += 2) {
      if (ends[index] > 0.85 * room) this.target = MIDDLE;
    }
    this.high = isCalm ? this.target : this.high + 0.1 * (this.target - this.high);
  }
}

function line(context, from, to) {
  context.beginPath();
  context.moveTo(...from);
  context.lineTo(...to);
  context.stroke();
}

function support(context, [x, y], size) {
  context.strokeStyle = colour("faint");
  context.lineWidth = 2;
  const above = y - 0.35 * size;
  line(context, [x - size, above], [x + size, above]);
  line(context, [x, y], [x, above]);
  context.lineWidth = 1;
  for (let step = -4; step < 4; step += 1) {
    const left = x + (step * size) / 4;
    line(context, [left, above], [left + 0.28 * size, above - 0.28 * size]);
  }
}

function plumbLine(context, toPixels, reach) {
  context.strokeStyle = colour("line");
  context.lineWidth = 1;
  context.setLineDash([2, 5]);
  line(context, toPixels(0, 0), toPixels(0, -reach));
  context.setLineDash([]);
}

/** A bar of a round length that is about a fifth of the picture. */
function scaleBar(context, { width, height, scale }) {
  const most = (0.22 * width) / scale;
  const size = 10 ** Math.floor(Math.log10(most));
  const length = [5, 2, 1].map((factor) => factor * size).find((round) => round <= most);
  const [left, below] = [12, height - 12];
  context.strokeStyle = context.fillStyle = colour("faint");
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(left, below - 5);
  context.lineTo(left, below);
  context.lineTo(left + scale * length, below);
  context.lineTo(left + scale * length, below - 5);
  context.stroke();
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "left";
  context.textBaseline = "bottom";
  const text = length >= 1 ? `${length} m` : `${Number((100 * length).toPrecision(2))} cm`;
  context.fillText(text, left + 4, below - 4);
}

function ghost(context, toPixels, places) {
  context.strokeStyle = colour("faint");
  context.globalAlpha = 0.8;
  context.lineWidth = 1.5;
  context.setLineDash([6, 4]);
  context.beginPath();
  for (let index = 0; index < places.length; index += 4) {
    context.moveTo(...toPixels(places[index], places[index + 1]));
    context.lineTo(...toPixels(places[index + 2], places[index + 3]));
  }
  context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
}

function body(context, from, to, width, radius, fill, edge) {
  context.lineCap = "round";
  const wide = Math.max(width, THIN);
  context.strokeStyle = edge;
  context.lineWidth = wide;
  line(context, from, to);
  if (wide > 5) {
    context.strokeStyle = fill;
    context.lineWidth = wide - 2.5;
    line(context, from, to);
  }
  if (radius > 0) {
    context.fillStyle = fill;
    context.lineWidth = 1.5;
    context.beginPath();
    context.arc(...to, Math.max(radius, 3), 0, 7);
    context.fill();
    context.stroke();
  }
}

function bodies(context, { toPixels, scale }, picture) {
  const { shape, chosen, colours } = picture;
  const { pivots, ends, centres, outlines } = shape;
  const links = ends.length / 2;
  for (let link = 0; link < links; link += 1) {
    const [width, radius] = [outlines[2 * link], outlines[2 * link + 1]].map((own) => own * scale);
    const tip = radius > 0 ? centres : ends;
    const from = toPixels(pivots[2 * link], pivots[2 * link + 1]);
    const to = toPixels(tip[2 * link], tip[2 * link + 1]);
    const edge = link === chosen ? colour("text") : colours(link, 0.95);
    body(context, from, to, width, radius, colours(link, link === chosen ? 0.95 : 0.72), edge);
  }
  for (let link = 0; link < links; link += 1) {
    context.fillStyle = colour("panel");
    context.strokeStyle = colour("text");
    context.lineWidth = 1;
    context.beginPath();
    context.arc(...toPixels(pivots[2 * link], pivots[2 * link + 1]), link === 0 ? 4 : 2.2, 0, 7);
    context.fill();
    context.stroke();
  }
}

function hand(context, toPixels, [px, py, hx, hy]) {
  context.strokeStyle = colour("warn");
  context.lineWidth = 2;
  context.setLineDash([5, 4]);
  line(context, toPixels(px, py), toPixels(hx, hy));
  context.setLineDash([]);
  context.beginPath();
  context.arc(...toPixels(hx, hy), 6, 0, 7);
  context.stroke();
}

/**
 * Draws a pendulum: `picture` has `shape` (pivots, ends, centres, outlines, reach, m), `colours`,
 * `high`, and where there are such `chosen`, `hand`, `ghost`, `traces`.
 */
export function drawPendulum(canvas, picture) {
  const { context, width, height } = cleared(canvas);
  const { reach } = picture.shape;
  const frame = frameOf({ width, height, reach, high: picture.high });
  plumbLine(context, frame.toPixels, reach);
  support(context, frame.toPixels(0, 0), Math.max(18, 0.12 * frame.scale * reach));
  picture.traces?.draw(context, frame.toPixels, picture.colours);
  bodies(context, frame, picture);
  if (picture.ghost?.length) ghost(context, frame.toPixels, picture.ghost);
  if (picture.hand?.length === 4) hand(context, frame.toPixels, picture.hand);
  scaleBar(context, { width, height, scale: frame.scale });
}
