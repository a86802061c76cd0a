// The tree: examples, sliders with numbers for its parameters, its description.

import { parameters } from "./wasm/branched_pendulum_web.js";
import { examples } from "./examples.js";
import { showMessage } from "./message.js";

const element = (id) => document.getElementById(id);

/** Value with which a parameter begins that nothing else names, by its unit: it is seen to act. */
const FIRST = {
  kg: 0.1, m: 0.3, "kg m²": 1e-3, "m/s²": 9.81, "": 1,
  "N m/rad": 0.05, "N/m": 5, "N m s": 1e-4, "N s/m": 1e-3, "N m": 1e-4, "N m s²": 1e-6, "rad/s": 0.05,
};

/** Range of a slider about the value with which it begins. */
function range(unit, value) {
  switch (unit) {
    case "kg": return [value / 10, value * 6];
    case "m": return [value / 3, value * 3];
    case "m/s²": return [Math.min(0, 2.5 * value), Math.max(0, 2.5 * value)];
    case "N m s": return [0, Math.max(4 * value, 0.004)];
    default: return value === 0 ? [0, 1] : [Math.min(0, 3 * value), Math.max(0, 3 * value)];
  }
}

/** The words about a parameter without the unit that they may have, and the unit. */
function wordsAndUnit(meaning) {
  const words = meaning.replaceAll("`", "");
  const place = words.lastIndexOf(", ");
  if (place < 0) return [words, ""];
  const unit = words.slice(place + 2);
  return [words.replaceAll(`, ${unit}`, ""), unit];
}

const readable = (value) => Number(value.toPrecision(4)).toString();

export class TreePanel {
  /**
   * `replace(text, values)` takes a tree and throws its mistakes, `change(name, value)` a value,
   * `begin(example)` an example; `typed()` follows a tree that was typed.
   */
  constructor({ replace, change, begin, typed }) {
    Object.assign(this, { replace, change });
    this.values = new Map();
    // Values of names that a text has had, for when they come again.
    this.remembered = new Map();
    const options = examples.map(({ title }, index) => new Option(title, index));
    const own = new Option("one of your own", "own");
    own.hidden = true;
    element("example").replaceChildren(...options, own);
    element("example").addEventListener("change", (event) => begin(examples[event.target.value]));
    let waiting;
    element("description").addEventListener("input", (event) => {
      clearTimeout(waiting);
      waiting = setTimeout(() => this.describe(event.target.value) && typed(), 300);
    });
  }

  get text() {
    return this.shown;
  }

  /** Takes a text that the page has made, with values of its parameters (those that it had before). */
  write(text, values = new Map()) {
    values.forEach((value, name) => this.remembered.set(name, value));
    if (!this.describe(text)) return false;
    element("description").value = text;
    return true;
  }

  /** Reads a description; a mistake is told, and the tree before goes on. */
  describe(text) {
    try {
      const known = parameters(text).map(({ name, meaning }) => ({ name, meaning }));
      const values = new Map(known.map(({ name, meaning }) => {
        const value = this.remembered.get(name) ?? FIRST[wordsAndUnit(meaning)[1]] ?? 0;
        return [name, value];
      }));
      this.replace(text, values);
      this.shown = text;
      this.values = values;
      values.forEach((value, name) => this.remembered.set(name, value));
      this.sliders(known);
      const index = examples.findIndex((example) => example.text === text);
      element("example").value = index < 0 ? "own" : index;
      this.tell("");
      return true;
    } catch (error) {
      this.tell(String(error));
      return false;
    }
  }

  /** Says what is wrong with the description; nothing, if the text is empty. */
  tell(text) {
    this.told = text;
    showMessage(element("message"), text);
  }

  sliders(known) {
    element("parameters").replaceChildren(...known.map((parameter) => this.row(parameter)));
  }

  /** A slider and a field for the number, which may lie beyond the slider's range. */
  row({ name, meaning }) {
    const row = document.createElement("div");
    row.className = "parameter";
    row.innerHTML = `<label><span></span> <code></code></label>
      <input type="range" step="any"><input type="number" step="any"><span class="unit"></span>`;
    const [label, slider, field, units] = row.children;
    const value = this.values.get(name);
    const [words, unit] = wordsAndUnit(meaning);
    slider.id = `parameter-${name}`;
    label.htmlFor = slider.id;
    [label.children[0].textContent, label.children[1].textContent] = [words, name];
    field.setAttribute("aria-label", `${words} ${name}, number`);
    units.textContent = unit;
    [slider.min, slider.max] = range(unit, value);
    slider.value = value;
    field.value = readable(value);
    slider.addEventListener("input", () => {
      field.value = readable(Number(slider.value));
      this.set(name, Number(slider.value));
    });
    field.addEventListener("change", () => {
      const typed = field.valueAsNumber;
      if (Number.isFinite(typed) && this.set(name, typed)) slider.value = typed;
      else field.value = readable(this.values.get(name));
    });
    return row;
  }

  set(name, value) {
    try {
      this.change(name, value);
      this.values.set(name, value);
      this.remembered.set(name, value);
      this.tell("");
      return true;
    } catch (error) {
      this.tell(String(error));
      return false;
    }
  }
}
