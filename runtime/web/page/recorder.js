// The motion since its release, for a table.

import { saveTable } from "./save.js";

/** Most numbers that are kept; the oldest rows go. */
const MOST_NUMBERS = 2_000_000;

/** How energies are formed, in words, by the name of the definition. */
const FORMED = { momenta: "from momenta", parseval: "by Parseval" };

/** Names of the columns of a tree with these links and so many scales. */
const columnsOf = ({ names, definition, scales }) => [
  "time (s)",
  ...names.map((name) => `theta ${name} (rad)`),
  ...names.map((name) => `omega ${name} (rad/s)`),
  "energy (J)",
  ...[["energy", "J"], ["W", "W"], ["work", "W"]].flatMap(([what, unit]) =>
    Array.from({ length: scales }, (_, scale) => `${what} of scale ${scale} ${FORMED[definition]} (${unit})`)),
];

export class Recorder {
  /** Begins with the names of a tree's links, and the definition of its energies. */
  begin(names, definition) {
    Object.assign(this, { names, definition, rows: [] });
  }

  /** Adds what is known of the motion now. */
  add({ time, angles, rates, energy, budget }) {
    const { energies = [], received = [], powers = [] } = budget ?? {};
    const row = [time, ...angles, ...rates, energy, ...energies, ...received, ...powers];
    const last = this.rows.at(-1);
    if (time < last?.[0] || row.length !== last?.length) this.rows = [];
    if (time === last?.[0]) this.rows.pop();
    this.scales = energies.length;
    this.rows.push(row);
    if (this.rows.length * row.length > MOST_NUMBERS) this.rows.shift();
  }

  save() {
    saveTable(columnsOf(this), this.rows, "branched-pendulum-motion.csv");
  }
}
