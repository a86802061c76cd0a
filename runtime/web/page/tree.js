// The tree: examples, sliders for its parameters, its description.

import { parameters } from "./wasm/branched_pendulum_web.js";
import { examples } from "./examples.js";

const element = (id) => document.getElementById(id);

/** Value with which a parameter begins that no example names, by its unit. */
const FIRST = { kg: 0.1, m: 0.3, "m/s²": 9.81 };

/** Range of a slider about the value with which it begins. */
function range(unit, value) {
  switch (unit) {
    case "kg": return [value / 10, value * 6];
    case "m": return [value / 3, value * 3];
    case "m/s²": return [0, 2.5 * value];
    case "N m s": return [0, Math.max(4 * value, 0.004)];
    default: return value === 0 ? [0, 1] : [Math.min(0, 3 * value), Math.max(0, 3 * value)];
  }
}

/** The unit, if the words about a parameter end with one. */
const unit = (meaning) => meaning.split(", ").at(-1);

const readable = (value) => Number(value.toPrecision(4)).toString();

export class TreePanel {
  /** `replace(text, values)` takes a tree and throws its mistakes, `change(name, value)` a value. */
  constructor(replace, change) {
    this.replace = replace;
    this.change = change;
    this.values = new Map();
    // Values of names that a text has had, for when they come again.
    this.remembered = new Map();
    const options = examples.map(({ title }, index) => new Option(title, index));
    element("example").replaceChildren(...options);
    element("example").addEventListener("change", (event) => this.show(examples[event.target.value]));
    let waiting;
    element("description").addEventListener("input", (event) => {
      clearTimeout(waiting);
      waiting = setTimeout(() => this.describe(event.target.value), 300);
    });
  }

  get text() {
    return this.shown;
  }

  /** Takes an example. */
  show({ text, values }) {
    this.remembered = new Map(Object.entries(values));
    element("description").value = text;
    this.describe(text);
  }

  /** Takes a text that the page has made. */
  write(text) {
    if (!this.describe(text)) return;
    element("description").value = text;
  }

  /** Reads a description; a mistake is told, and the tree before goes on. */
  describe(text) {
    try {
      const known = parameters(text).map(({ name, meaning }) => ({ name, meaning }));
      const values = new Map(known.map(({ name, meaning }) => {
        const value = this.remembered.get(name) ?? FIRST[unit(meaning)] ?? 0;
        return [name, value];
      }));
      this.replace(text, values);
      this.shown = text;
      this.values = values;
      values.forEach((value, name) => this.remembered.set(name, value));
      this.sliders(known);
      element("message").textContent = "";
      return true;
    } catch (error) {
      element("message").textContent = String(error);
      return false;
    }
  }

  sliders(known) {
    const rows = known.map(({ name, meaning }) => {
      const row = document.createElement("div");
      row.className = "parameter";
      row.innerHTML = `<label></label><input type="range" step="any"><output></output><small></small>`;
      const [label, slider, output, words] = row.children;
      const value = this.values.get(name);
      slider.id = `parameter-${name}`;
      label.htmlFor = slider.id;
      label.textContent = name;
      [slider.min, slider.max] = range(unit(meaning), value);
      slider.value = value;
      const shown = () => `${readable(Number(slider.value))} ${unit(meaning)}`;
      output.textContent = shown();
      words.textContent = meaning.replaceAll("`", "");
      slider.addEventListener("input", () => {
        output.textContent = shown();
        this.set(name, Number(slider.value));
      });
      return row;
    });
    element("parameters").replaceChildren(...rows);
  }

  set(name, value) {
    try {
      this.change(name, value);
      this.values.set(name, value);
      this.remembered.set(name, value);
      element("message").textContent = "";
    } catch (error) {
      element("message").textContent = String(error);
    }
  }
}
