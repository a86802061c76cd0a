// Two releases side by side: one from which the difference between the arms stays small, and one
// from which it grows.

import { Pendulum } from "./wasm/branched_pendulum_web.js";
import { colour, ofScale } from "./canvas.js";
import { curves, History } from "./charts.js";
import { drawPendulum } from "./drawing.js";
import { examples } from "./examples.js";
import { coloursOf } from "./palette.js";
import { shapeOf } from "./shape.js";
import { Traces } from "./traces.js";

const element = (id) => document.getElementById(id);

const DEGREE = Math.PI / 180;

/** Releases of the root, degrees; how far each arm is turned, degrees; how long they are followed, s. */
const RELEASES = [39.5, 47.8];
const APART = 0.6;
const SPAN = 12;

/** Height of the pivot over that of a picture, from above: no arm has the energy to come over it. */
const HIGH = 0.2;

/** Frames between two drawings of the curves. */
const FRAMES_A_DRAWING = 4;

const differenceEnergy = (pendulum) => {
  const budget = pendulum.budget(false);
  const [, energy] = budget.energies;
  budget.free();
  return energy;
};

const readable = (value) => Number(value.toPrecision(2)).toLocaleString("en", { maximumSignificantDigits: 2 });
const times = (value) => `${readable(value)} times`;
const milli = (value) => `${readable(1000 * value)} mJ`;

class Side {
  constructor(number) {
    const [{ text, values }] = examples;
    this.number = number;
    this.degrees = RELEASES[number];
    this.pendulum = new Pendulum(text, Object.keys(values), new Float64Array(Object.values(values)));
    this.pendulum.set_method("dop853", 1e-9);
    this.pendulum.release(this.degrees * DEGREE, 0, APART * DEGREE);
    this.parents = [...this.pendulum.parents()];
    this.colours = coloursOf(this.parents);
    this.traces = new Traces();
    this.traces.begin(this.parents);
    this.first = this.now = this.most = differenceEnergy(this.pendulum);
  }

  advance(duration) {
    this.pendulum.advance(duration);
    this.now = differenceEnergy(this.pendulum);
    this.most = Math.max(this.most, this.now);
  }

  draw() {
    const { pendulum, colours, traces, number } = this;
    const shape = shapeOf(pendulum);
    traces.add(pendulum.time(), shape.ends);
    drawPendulum(element(`compare-${number}`), { shape, colours, traces, high: HIGH });
    element(`compare-told-${number}`).textContent =
      `from ${this.degrees}°: the difference has ${times(this.now / this.first)} the energy that it began with`;
  }
}

export class Comparison {
  constructor() {
    this.sides = [];
    element("compare").addEventListener("click", () => this.begin());
  }

  begin() {
    this.sides.forEach(({ pendulum }) => pendulum.free());
    element("comparison").hidden = false;
    element("compare-end").textContent = "";
    this.history = new History(SPAN);
    this.sides = RELEASES.map((_, number) => new Side(number));
    this.frames = 0;
    this.isRunning = true;
    this.draw();
  }

  /** Moves both on by a frame (s). */
  frame(duration) {
    if (!this.isRunning) return;
    const left = SPAN - this.sides[0].pendulum.time();
    this.sides.forEach((side) => side.advance(Math.min(duration, left)));
    this.history.push(this.sides[0].pendulum.time(), this.sides.map(({ now }) => now));
    this.frames += 1;
    if (left <= duration) this.end();
    this.draw();
  }

  end() {
    this.isRunning = false;
    const [low, high] = this.sides;
    const rise = ({ most, first }) => `${times(most / first)} that (${milli(most)})`;
    element("compare-end").innerHTML =
      `Both began with ${milli(high.first)}. In ${SPAN} s H<sub>d</sub> came to at most ${rise(low)} from
       ${low.degrees}°, and to ${rise(high)} from ${high.degrees}°: what grows at ${high.degrees}° is the swing of one arm against the other.`;
    element("compare").textContent = "Show it again";
  }

  draw() {
    if (this.sides.length === 0) return;
    this.sides.forEach((side) => side.draw());
    if (this.isRunning && this.frames % FRAMES_A_DRAWING !== 0) return;
    const lines = [
      { colour: colour("text"), dash: [5, 4], of: ([low]) => low },
      { colour: ofScale(1), of: ([, high]) => high },
    ];
    curves(element("compare-chart"), this.history, lines, true);
  }
}
