// Energies by scale: curves, and the budget as bars.

import { ofScale } from "./canvas.js";
import { curves, History } from "./charts.js";

const element = (id) => document.getElementById(id);

const HINTS = {
  scales: `H_d is the energy of what equal branches do against each other, one for each generation
    that they hang in (scale 1, 2, …); scale 0 is what they do together. All are energies by
    Parseval: their sum is the whole energy. W is what a scale receives from the others, the rate of
    H_d but for friction, drive and hand.`,
  none: `Links of one generation differ here, or there is one of each: such a tree has no energies by
    scale. The curve is the whole energy.`,
};

const milli = (value) => (1000 * value).toFixed(Math.abs(value) < 1e-2 ? 3 : 1).replace("-", "−");

const name = (scale) => (scale === 0 ? "0: all" : `${scale}: H_d`);

export class EnergyPanel {
  constructor() {
    this.begin(0);
  }

  /** Takes a tree with so many scales, 0 where it has none; curves of as many go on. */
  take(scales) {
    if (scales !== this.scales) this.begin(scales);
  }

  /** Begins the curves of a tree anew. */
  begin(scales = this.scales) {
    this.history = new History();
    this.scales = scales;
    element("energy-hint").textContent = HINTS[scales > 1 ? "scales" : "none"];
    const rows = Array.from({ length: scales }, (_, scale) => {
      const row = document.createElement("tr");
      row.innerHTML = `<td>${name(scale)}</td><td class="bar"><div></div></td><td></td><td></td><td></td>`;
      row.querySelector("div").style.background = ofScale(scale);
      return row;
    });
    element("budget").replaceChildren(...rows);
    element("budget").closest("table").hidden = scales === 0;
    element("transfers").parentElement.hidden = scales < 2;
  }

  record(time, energy, budget) {
    this.budget = budget;
    this.history.push(time, { energy, ...budget });
  }

  draw() {
    const differences = Array.from({ length: Math.max(this.scales - 1, 0) }, (_, index) => index + 1);
    const whole = { colour: ofScale(0), dash: [5, 4], of: (values) => values.energy };
    const energies = differences.map((scale) => ({
      colour: ofScale(scale),
      of: (values) => values.energies[scale],
    }));
    curves(element("energies"), this.history, [whole, ...energies], true);
    if (this.scales > 1) {
      const received = differences.map((scale) => ({
        colour: ofScale(scale),
        of: (values) => values.received[scale],
      }));
      curves(element("transfers"), this.history, received, false);
    }
    const { budget } = this;
    if (!budget) return;
    const largest = budget.energies.reduce((sum, energy) => sum + Math.abs(energy), 1e-300);
    [...element("budget").children].forEach((row, scale) => {
      const [, bar, energy, received, power] = row.children;
      const { energies } = budget;
      bar.firstChild.style.width = `${(100 * Math.max(energies[scale], 0)) / largest}%`;
      energy.textContent = milli(energies[scale]);
      received.textContent = milli(budget.received[scale]);
      power.textContent = milli(budget.powers[scale]);
    });
  }
}
