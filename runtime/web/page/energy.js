// Energies of differences: curves, and the budget as bars.

import { ofScale } from "./canvas.js";
import { curves, History } from "./charts.js";

const element = (id) => document.getElementById(id);

const H_D = "H<sub>d</sub>";

const HINTS = {
  momenta: `${H_D} is the energy of what copies do against each other, W the power that it receives from
    all else. Here it is formed from momenta, as the paper's: these energies do not sum to the whole.`,
  parseval: `By Parseval the energies sum to the whole: what all copies do together, and for each
    generation what its copies do against each other. W is what a row receives from the others.`,
  none: `Nothing is a copy in this tree: there is no difference that could have an energy. The curve
    is the whole energy.`,
};

const milli = (value) => (1000 * value).toFixed(Math.abs(value) < 1e-2 ? 3 : 1).replace("-", "−");

const ORDINALS = ["1st", "2nd", "3rd"];

/** Words for a scale of so many, as HTML. */
function name(scale, scales) {
  if (scale === 0) return "all together";
  if (scales === 2) return `${H_D}: copies apart`;
  return `${H_D}, ${ORDINALS[scale - 1] ?? `${scale}th`} branching`;
}

export class EnergyPanel {
  /** `changed()` follows another choice of the definition. */
  constructor(changed) {
    this.scales = 0;
    this.begin(0);
    element("definition").addEventListener("change", () => {
      this.begin();
      changed();
    });
  }

  /** By which definition energies are formed, as addresses have it. */
  get definition() {
    return element("definition").value;
  }

  set definition(name) {
    if (HINTS[name]) element("definition").value = name;
  }

  /**
   * Takes a tree with so many scales, 0 where it has none, and why it has none though there are
   * copies; curves of as many go on.
   */
  take(scales, refused) {
    if (scales === this.scales && refused === this.refused) return;
    this.refused = refused;
    this.begin(scales);
  }

  /** Copies that differ have no energies by Parseval. */
  offer(hasParseval) {
    element("definition").options[1].disabled = !hasParseval;
    if (!hasParseval) this.definition = "momenta";
  }

  /** Begins the curves of a tree anew. */
  begin(scales = this.scales) {
    this.history = new History();
    this.budget = undefined;
    this.scales = scales;
    const hasDifferences = scales > 1;
    element("energy-hint").innerHTML = HINTS[hasDifferences ? this.definition : "none"];
    // Names in the reason are the description's: text, no HTML.
    if (this.refused) element("energy-hint").textContent = `No H_d and no W: ${this.refused}.`;
    element("definition").parentElement.hidden = !hasDifferences;
    const rows = Array.from({ length: scales }, (_, scale) => {
      const row = document.createElement("tr");
      row.innerHTML = "<th scope=row></th><td class=bar><div></div></td><td></td><td></td><td></td>";
      row.firstChild.innerHTML = name(scale, scales);
      row.querySelector("div").style.background = ofScale(scale);
      return row;
    });
    element("budget").replaceChildren(...rows);
    element("budget").closest("table").hidden = scales === 0;
    element("transfers").parentElement.hidden = !hasDifferences;
  }

  record(time, energy, budget) {
    this.budget = budget;
    this.history.push(time, { energy, ...budget });
  }

  /** The scales of the differences. */
  get differences() {
    return Array.from({ length: Math.max(this.scales - 1, 0) }, (_, index) => index + 1);
  }

  /** Draws energies and budget. */
  draw() {
    const whole = { colour: ofScale(0), dash: [5, 4], of: (values) => values.energy };
    const energies = this.differences.map((scale) => ({
      colour: ofScale(scale),
      of: (values) => values.energies[scale],
    }));
    curves(element("energies"), this.history, [whole, ...energies], true);
    if (this.budget) this.drawBudget(this.budget);
  }

  /** Draws the transfers. */
  drawTransfers() {
    if (this.scales < 2) return;
    const received = this.differences.map((scale) => ({
      colour: ofScale(scale),
      of: (values) => 1000 * values.received[scale],
    }));
    curves(element("transfers"), this.history, received, false);
  }

  drawBudget({ energies, received, powers }) {
    const largest = energies.reduce((sum, energy) => sum + Math.abs(energy), 1e-300);
    [...element("budget").children].forEach((row, scale) => {
      const [, bar, ...cells] = row.children;
      bar.firstChild.style.width = `${(100 * Math.max(energies[scale], 0)) / largest}%`;
      [energies, received, powers].forEach((values, index) => {
        cells[index].textContent = milli(values[scale]);
      });
    });
  }
}
