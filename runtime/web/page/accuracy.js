// The method by hand, its error and its cost.

import { methods } from "./wasm/branched_pendulum_web.js";

const element = (id) => document.getElementById(id);

/** Tolerances and steps (s) by their logarithms: range and beginning. */
const TOLERANCE = { name: "tolerance", from: -12, to: -2, first: -6 };
const STEP = { name: "step, s", from: -4, to: -1, first: -2 };

const readable = (value) => value.toExponential(1).replace("e-", "e−").replace("e+", "e");

export class AccuracyPanel {
  /** `choose(name, setting)` takes a method. */
  constructor(choose) {
    this.choose = choose;
    this.methods = methods();
    const options = this.methods.map(({ name, title }) => new Option(title, name));
    element("method").replaceChildren(...options);
    element("method").addEventListener("change", () => this.changeMethod());
    element("setting").addEventListener("input", ({ target }) => this.apply(10 ** Number(target.value)));
    element("setting-number").addEventListener("change", ({ target }) => {
      this.apply(target.valueAsNumber > 0 ? target.valueAsNumber : this.setting);
    });
    this.begin();
  }

  /** Takes a method by its name, with the setting that it begins with if none is given; one that there is not changes nothing. */
  show(name, setting) {
    if (!this.methods.some((method) => method.name === name)) return;
    element("method").value = name;
    this.takeKind();
    this.apply(setting ?? 10 ** this.kind.first);
  }

  takeKind() {
    const { adaptive } = this.methods.find(({ name }) => name === element("method").value);
    const kind = adaptive ? TOLERANCE : STEP;
    if (this.kind === kind) return false;
    this.kind = kind;
    [element("setting").min, element("setting").max] = [kind.from, kind.to];
    element("setting-name").textContent = kind.name;
    return true;
  }

  changeMethod() {
    this.apply(this.takeKind() ? 10 ** this.kind.first : this.setting);
  }

  /** Takes the chosen method with a setting. */
  apply(setting) {
    this.setting = setting;
    element("setting").value = Math.log10(setting);
    element("setting-number").value = setting.toExponential(1);
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
