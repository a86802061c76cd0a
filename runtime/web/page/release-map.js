// The plane of releases, as workers compute it: maps are kept, so that a tree that comes again has
// its own at once, and while a new one is computed the one before is seen through it.

import { anglesOf, indexOf, PLANE } from "./map-plane.js";
import { drawMap, patternOn, placeIn, releaseIn, shade } from "./map-drawing.js";
import { savePicture, saveTable } from "./save.js";

const element = (id) => document.getElementById(id);

const DEGREE = Math.PI / 180;

/** Time that motions are followed, s, and tolerance of the coarser of two runs. */
const SPAN = 15;
const TOLERANCE = 1e-6;

/** Rates that differ by at most that part between two tolerances are determined. */
const DETERMINED = 0.01;

/** Growth up to the end by which a release is chaotic, if the rate is not determined: at both tolerances. */
const CHAOTIC = 1000;

/** Most workers, and most maps that are kept. */
const MOST_WORKERS = 4;
const MOST_MAPS = 12;

const HINT = `How fast does a small difference between two equal branches grow after a release from
  rest? Light is fast; motions are followed for ${SPAN} s. A click releases there.`;

const ALL = PLANE.columns * PLANE.rows;

/** What is known of a map: rate and part that is not determined of each point, and the cells that show them. */
class Plane {
  constructor() {
    this.points = new Map();
    // Of each cell the point that it shows.
    this.cells = new Array(ALL);
  }

  fill(point) {
    this.points.set(indexOf(point), point);
    for (let row = point.row; row < point.row + point.stride; row += 1) {
      for (let column = point.column; column < point.column + point.stride; column += 1) {
        this.cells[row * PLANE.columns + column] = point;
      }
    }
  }

  /** Number of the points of a class. */
  count(own) {
    return [...this.points.values()].filter((point) => classOf(point) === own).length;
  }

  get isDone() {
    return this.points.size === ALL;
  }
}

/**
 * The class of a point: "determined", where two tolerances give the same rate; "chaotic", where they
 * do not, and the difference grows a thousandfold at either of them; "open" everywhere else.
 */
export function classOf({ rate, difference }) {
  if (difference <= DETERMINED) return "determined";
  return rate * (1 - difference) * SPAN >= Math.log(CHAOTIC) ? "chaotic" : "open";
}

/** Classes as tables have them. */
const CLASSES = ["open", "determined", "chaotic"];

export class ReleaseMapPanel {
  /** `release(root, rest)` releases the tree at these angles, rad. */
  constructor(release) {
    this.number = 0;
    const count = Math.min(Math.max((navigator.hardwareConcurrency ?? 2) - 1, 1), MOST_WORKERS);
    this.workers = Array.from({ length: count }, () => {
      const worker = new Worker(new URL("./map-worker.js", import.meta.url), { type: "module" });
      worker.addEventListener("message", ({ data }) => this.take(data));
      return worker;
    });
    this.kept = new Map();
    this.point = { root: 0, rest: 0 };
    [this.plane, this.before, this.state] = [new Plane(), null, ""];
    element("map-hint").textContent = HINT;
    const stops = Array.from({ length: 9 }, (_, index) => shade(index / 8));
    element("scale").style.background = `linear-gradient(to right, ${stops.join(", ")})`;
    for (const own of ["chaotic", "open"]) patternOn(element(`pattern-${own}`), own);
    element("map").addEventListener("click", ({ offsetX, offsetY, target }) => {
      const { root, rest } = releaseIn(target, offsetX, offsetY);
      release(root, rest);
    });
    element("map-csv").addEventListener("click", () => this.save());
    element("map-picture").addEventListener("click", () => {
      savePicture(element("map"), "branched-pendulum-map.png");
    });
    element("map-panel").addEventListener("toggle", () => this.draw());
  }

  /** Begins with another tree, if it has two equal branches. */
  begin(text, values, hasCopies) {
    this.number += 1;
    const key = JSON.stringify([text, ...values]);
    // A tree without a map is none that another's is seen through.
    if (this.plane.points.size > 0 && this.plane.isDone) this.before = this.plane;
    if (!hasCopies) {
      [this.plane, this.before] = [new Plane(), null];
      this.stop();
      this.state = "No two branches of this tree are equal: there is nothing to grow.";
      return this.draw();
    }
    this.plane = this.kept.get(key) ?? new Plane();
    this.kept.delete(key);
    this.kept.set(key, this.plane);
    if (this.kept.size > MOST_MAPS) this.kept.delete(this.kept.keys().next().value);
    if (this.plane.isDone) this.stop();
    else this.compute(text, values);
    this.tell();
    this.draw();
  }

  /** Asks the workers for the points of the map that are not known yet. */
  compute(text, values) {
    const { number, workers: { length: count } } = this;
    const known = [...this.plane.points.keys()];
    const task = { number, text, names: [...values.keys()], values: [...values.values()], known };
    this.workers.forEach((worker, own) => {
      worker.postMessage({ ...task, span: SPAN, tolerance: TOLERANCE, own, count });
    });
  }

  /** Computes no more. */
  stop() {
    this.number += 1;
    this.workers.forEach((worker) => worker.postMessage({ number: this.number }));
  }

  take({ number, cells, refused }) {
    if (number !== this.number) return;
    if (refused) {
      this.state = refused;
    } else {
      cells.forEach((cell) => this.plane.fill(cell));
      this.tell();
    }
    this.draw();
  }

  tell() {
    const { plane } = this;
    const { points, isDone } = plane;
    if (isDone) this.before = null;
    const left = isDone ? "" : ` of ${ALL}`;
    const faint = this.before ? " Faint: the map before the change." : "";
    this.state = `${points.size}${left} points: of ${plane.count("determined")} two tolerances give the same rate;
      ${plane.count("chaotic")} are chaotic, they grow a thousandfold at either tolerance; ${plane.count("open")} are not determined.${faint}`;
  }

  /** Marks a release, rad. */
  mark(root, rest) {
    // Both signs turned give the same motion in a mirror.
    this.point = root < 0 ? { root: -root, rest: -rest } : { root, rest };
    this.draw();
  }

  /** Where a release is on the canvas, CSS pixels. */
  placeOf(root, rest) {
    return placeIn(element("map"), root, rest);
  }

  save() {
    const rows = [...this.plane.points.values()].map((point) => {
      const { root, rest } = anglesOf(point);
      return [root / DEGREE, rest / DEGREE, point.rate, point.difference, CLASSES.indexOf(classOf(point))];
    });
    const columns = ["root (deg)", "others (deg)", "growth rate (1/s)", "relative change with tolerance",
      "class (0 open; 1 determined; 2 chaotic)"];
    saveTable(columns, rows, "branched-pendulum-map.csv");
  }

  draw() {
    if (!element("map-panel").open) return;
    drawMap(element("map"), this, classOf);
    element("map-state").textContent = this.state;
  }
}
