// The method by hand, its error and its cost.

import { methods } from "./wasm/branched_pendulum_web.js";

const element = (id) => document.getElementById(id);

/** Tolerances and steps (s) by their logarithms: range and beginning. */
const TOLERANCE = { name: "tolerance", from: -12, to: -2, first: -6 };
const STEP = { name: "step", from: -4, to: -1, first: -2 };

const readable = (value) => value.toExponential(1).replace("e-", "e−").replace("e+", "e");

export class AccuracyPanel {
  /** `choose(name, setting)` takes a method. */
  constructor(choose) {
    this.choose = choose;
    this.methods = methods();
    const options = this.methods.map(({ name, title }) => new Option(title, name));
    element("method").replaceChildren(...options);
    element("method").value = "dop853";
    element("method").addEventListener("change", () => this.changeMethod());
    element("setting").addEventListener("input", () => this.apply());
    this.begin();
    this.changeMethod();
  }

  changeMethod() {
    const { adaptive } = this.methods.find(({ name }) => name === element("method").value);
    const kind = adaptive ? TOLERANCE : STEP;
    const setting = element("setting");
    if (this.kind !== kind) {
      this.kind = kind;
      [setting.min, setting.max, setting.value] = [kind.from, kind.to, kind.first];
      element("setting-name").textContent = kind.name;
    }
    this.apply();
  }

  /** Takes the chosen method with its setting. */
  apply() {
    const setting = 10 ** Number(element("setting").value);
    const unit = this.kind === STEP ? " s" : "";
    element("setting-value").textContent = readable(setting) + unit;
    this.begin();
    this.choose(element("method").value, setting);
  }

  /** Begins to count. */
  begin() {
    this.sums = { motion: 0, computing: 0, evaluations: 0 };
  }

  /** Adds a frame: seconds of motion, milliseconds of computing, evaluations. */
  count(motion, computing, evaluations) {
    this.sums.motion += motion;
    this.sums.computing += computing;
    this.sums.evaluations += evaluations;
  }

  draw(error) {
    const { motion, computing, evaluations } = this.sums;
    element("error").textContent = readable(Math.abs(error));
    if (motion < 0.5) return;
    element("evaluations").textContent = Math.round(evaluations / motion).toString();
    element("cost").textContent = `${(computing / motion).toFixed(2)} ms`;
    if (motion > 4) this.begin();
  }
}
