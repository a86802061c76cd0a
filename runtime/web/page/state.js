// The page's state in the address, and the steps back and forth through it.

import { examples } from "./examples.js";

/** Milliseconds without a change after which one counts as made. */
const CALM = 400;

/** Most steps that are remembered. */
const MOST_STEPS = 100;

/** Least and largest speed. */
const SPEEDS = [0.01, 10];

/** What an address leaves out where it is so. */
export const USUAL = { speed: 1, method: "dop853", setting: 1e-6, definition: "momenta", plays: true };

/** The state in which an example begins. */
export const beginningOf = (example) => ({
  ...USUAL,
  text: example.text,
  values: new Map(Object.entries(example.values)),
  release: { ...example.release },
});

const RELEASE = ["root", "others", "apart"];

/** Texts are readable in an address: what is allowed in its last part is not escaped. */
const escaped = (text) =>
  encodeURIComponent(text).replace(/%(2C|3A|40|2F|3B|24)/g, (code) => decodeURIComponent(code));

/** The part of an address behind the `#` for a state. */
export function written(state) {
  const example = examples.find(({ text }) => text === state.text);
  const entries = [example ? ["tree", example.id] : ["text", state.text]];
  state.values.forEach((value, name) => {
    if (example?.values[name] !== value) entries.push([`set.${name}`, value]);
  });
  for (const name of RELEASE) entries.push([name, state.release[name]]);
  for (const name of ["speed", "method", "setting", "definition"]) {
    // What is usual of a setting is so of one method.
    const isUsual = state[name] === USUAL[name] && (name !== "setting" || state.method === USUAL.method);
    if (!isUsual) entries.push([name, state[name]]);
  }
  if (!state.plays) entries.push(["play", 0]);
  return entries.map(([name, value]) => `${name}=${escaped(String(value))}`).join("&");
}

/** A number of an address; without one the other. */
function number(entries, name, other) {
  const value = Number.parseFloat(entries.get(name));
  return Number.isFinite(value) ? value : other;
}

/** The state of the part of an address behind the `#`; of the first example without one. */
export function read(hash) {
  const entries = new URLSearchParams(hash.replace(/^#/, "").replaceAll("+", "%2B"));
  const example = examples.find(({ id }) => id === entries.get("tree")) ?? examples[0];
  const state = beginningOf(example);
  const text = entries.get("text");
  if (text !== null) Object.assign(state, { text, values: new Map() });
  for (const [name, value] of entries) {
    if (name.startsWith("set.") && Number.isFinite(Number(value))) {
      state.values.set(name.slice(4), Number(value));
    }
  }
  for (const name of RELEASE) {
    state.release[name] = number(entries, name, state.release[name]);
  }
  state.speed = Math.min(Math.max(number(entries, "speed", USUAL.speed), SPEEDS[0]), SPEEDS[1]);
  state.method = entries.get("method") ?? USUAL.method;
  // Another method without its setting has the one that it begins with.
  state.setting = number(entries, "setting", state.method === USUAL.method ? USUAL.setting : null);
  state.definition = entries.get("definition") ?? USUAL.definition;
  state.plays = entries.get("play") !== "0";
  return state;
}

/** The address of the page with a state; of the part of it that is embedded. */
export function addressOf(state, isEmbedded = false) {
  const address = new URL(location.href);
  address.search = isEmbedded ? "?embed" : "";
  address.hash = written(state);
  return address.href;
}

/** Remembers states, one a change, and keeps the address that of the present one. */
export class Memory {
  /** `current()` is the page's state, `apply(state)` takes one, `told(undos, redos)` how many there are. */
  constructor(current, apply, told) {
    Object.assign(this, { current, apply, told });
    [this.before, this.after] = [[], []];
  }

  /** Begins with the page's state. */
  begin() {
    this.present = written(this.current());
    [this.before, this.after] = [[], []];
    this.show();
  }

  /** Something has changed; it counts when nothing more does for a moment. */
  changed() {
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => this.settle(), CALM);
  }

  settle() {
    clearTimeout(this.waiting);
    const next = written(this.current());
    if (next === this.present) return;
    this.before.push(this.present);
    this.before.splice(0, this.before.length - MOST_STEPS);
    this.after = [];
    this.present = next;
    this.show();
  }

  undo() {
    this.settle();
    this.move(this.before, this.after);
  }

  redo() {
    this.settle();
    this.move(this.after, this.before);
  }

  move(from, to) {
    const next = from.pop();
    if (next === undefined) return;
    to.push(this.present);
    this.present = next;
    this.apply(read(next));
    this.show();
  }

  show() {
    history.replaceState(null, "", `#${this.present}`);
    this.told(this.before.length, this.after.length);
  }
}
