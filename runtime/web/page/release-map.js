// The plane of releases, as it is computed by the worker.

import { cleared, colour } from "./canvas.js";

const element = (id) => document.getElementById(id);

const DEGREE = Math.PI / 180;

/** The plane: half of it, which the other mirrors. Angles of all others and of the root, rad. */
const PLANE = { columns: 96, rows: 48, rest: [-135 * DEGREE, 135 * DEGREE], root: [0, 135 * DEGREE] };

/** Time that motions are followed, s, and tolerance of the coarser of two runs. */
const SPAN = 15;
const TOLERANCE = 1e-6;

/** Growth rates between which colours change, 1/s. */
const RATES = [0.01, 5];

/** Values that differ by more than that part between two tolerances are not determined. */
const DETERMINED = 0.01;

/** Colours from slow to fast growth: red, green, blue. */
const COLOURS = [[24, 18, 74], [92, 24, 120], [183, 55, 121], [246, 120, 84], [252, 236, 160]];

function shade(part) {
  const place = Math.min(Math.max(part, 0), 1) * (COLOURS.length - 1);
  const index = Math.min(Math.floor(place), COLOURS.length - 2);
  const mixed = COLOURS[index].map((low, i) => low + (place - index) * (COLOURS[index + 1][i] - low));
  return `rgb(${mixed.map(Math.round).join(" ")})`;
}

const [LOW, HIGH] = RATES.map(Math.log);
const shadeOf = (rate) => shade((Math.log(Math.max(rate, 1e-300)) - LOW) / (HIGH - LOW));

const HINT = `How fast does a small difference between two equal branches grow after a release from
  rest? Light is fast; motions are followed for ${SPAN} s.`;

export class ReleaseMapPanel {
  /** `release(root, rest)` releases the tree at these angles, rad. */
  constructor(release) {
    this.number = 0;
    this.worker = new Worker(new URL("./map-worker.js", import.meta.url), { type: "module" });
    this.worker.addEventListener("message", ({ data }) => this.take(data));
    this.cells = document.createElement("canvas");
    [this.cells.width, this.cells.height] = [PLANE.columns, PLANE.rows];
    this.point = { root: 0, rest: 0 };
    this.clear();
    element("map-hint").textContent = HINT;
    const stops = Array.from({ length: 9 }, (_, index) => shade(index / 8));
    element("scale").style.background = `linear-gradient(to right, ${stops.join(", ")})`;
    element("map").addEventListener("click", ({ offsetX, offsetY, target }) => {
      const part = (range, place) => range[0] + place * (range[1] - range[0]);
      const rest = part(PLANE.rest, offsetX / target.clientWidth);
      const root = part(PLANE.root, 1 - offsetY / target.clientHeight);
      release(root, rest);
    });
  }

  clear() {
    this.cells.getContext("2d").clearRect(0, 0, PLANE.columns, PLANE.rows);
    this.counts = { known: 0, undetermined: 0 };
    this.rates = new Map();
    this.state = "";
  }

  /** Begins with another tree, if it has two equal branches. */
  begin(text, values, hasCopies) {
    this.number += 1;
    this.clear();
    const task = { number: this.number, plane: PLANE, span: SPAN, tolerance: TOLERANCE };
    if (hasCopies) {
      this.worker.postMessage({ ...task, text, names: [...values.keys()], values: [...values.values()] });
    } else {
      this.worker.postMessage({ number: this.number });
      this.state = "No two branches of this tree are equal: there is nothing to grow.";
    }
    this.draw();
  }

  take({ number, cells, refused, done }) {
    if (number !== this.number) return;
    if (refused) {
      this.state = refused;
    } else {
      cells.forEach((cell) => this.fill(cell));
      const { known, undetermined } = this.counts;
      const all = PLANE.columns * PLANE.rows;
      const left = done ? "" : ` of ${all}`;
      this.state = `${known}${left} points, ${undetermined} of them not determined: they change with the tolerance.`;
    }
    this.draw();
  }

  fill({ column, row, stride, rate, difference }) {
    this.counts.known += 1;
    if (!(difference <= DETERMINED)) this.counts.undetermined += 1;
    this.rates.set(row * PLANE.columns + column, rate);
    const context = this.cells.getContext("2d");
    context.fillStyle = Number.isFinite(rate) ? shadeOf(rate) : "gray";
    // The root's angle grows upwards.
    context.fillRect(column, PLANE.rows - row - stride, stride, stride);
  }

  /** Marks a release, rad. */
  mark(root, rest) {
    // Both signs turned give the same motion in a mirror.
    this.point = root < 0 ? { root: -root, rest: -rest } : { root, rest };
    this.draw();
  }

  draw() {
    const { context, width, height } = cleared(element("map"));
    context.imageSmoothingEnabled = false;
    context.drawImage(this.cells, 0, 0, width, height);
    const x = (rest) => ((rest - PLANE.rest[0]) / (PLANE.rest[1] - PLANE.rest[0])) * width;
    const y = (root) => (1 - (root - PLANE.root[0]) / (PLANE.root[1] - PLANE.root[0])) * height;
    context.strokeStyle = context.fillStyle = "#ffffffcc";
    context.shadowColor = "black";
    context.shadowBlur = 3;
    context.font = "11px system-ui, sans-serif";
    context.lineWidth = 1;
    context.textAlign = "center";
    for (const degrees of [-90, 0, 90]) {
      context.fillText(`${degrees}°`.replace("-", "−"), x(degrees * DEGREE), height - 4);
    }
    context.textAlign = "left";
    for (const degrees of [45, 90]) context.fillText(`${degrees}°`, 4, y(degrees * DEGREE) + 4);
    const [px, py] = [x(this.point.rest), y(this.point.root)];
    context.lineWidth = 2;
    context.beginPath();
    context.arc(px, py, 7, 0, 7);
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      context.moveTo(px + 4 * dx, py + 4 * dy);
      context.lineTo(px + 12 * dx, py + 12 * dy);
    }
    context.stroke();
    context.shadowBlur = 0;
    context.strokeStyle = colour("line");
    context.lineWidth = 1;
    context.strokeRect(0.5, 0.5, width - 1, height - 1);
    element("map-state").textContent = this.state;
  }
}
