// Curves over the last seconds.

import { cleared, colour } from "./canvas.js";

/** Seconds that a chart shows. */
export const SPAN = 20;

/** Numbers over time: what is older than a chart shows is left out. */
export class History {
  constructor() {
    this.rows = [];
  }

  push(time, values) {
    if (time < this.rows.at(-1)?.time) this.rows = [];
    if (time === this.rows.at(-1)?.time) this.rows.pop();
    this.rows.push({ time, values });
    while (this.rows[0].time < time - SPAN) this.rows.shift();
  }
}

const LEFT = 52;
const BELOW = 16;

const power = (exponent) => `10${[...String(exponent)].map((c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("")}`;

/** Ticks and the way from values to the part of the height, of positive numbers. */
function logarithmic(values) {
  const positive = values.filter((value) => value > 0);
  const top = Math.ceil(Math.log10(Math.max(...positive, 1e-12)));
  const low = Math.log10(Math.min(...positive, 10 ** top));
  const bottom = Math.max(Math.floor(low), top - 9);
  const [from, to] = [Math.min(bottom, top - 1), top];
  const step = Math.ceil((to - from) / 5);
  const ticks = [];
  for (let exponent = to; exponent >= from; exponent -= step) {
    ticks.push({ value: 10 ** exponent, text: power(exponent) });
  }
  const part = (value) => (Math.max(Math.log10(Math.max(value, 1e-300)), from) - from) / (to - from);
  return { ticks, part };
}

/** Those of numbers of either sign. */
function linear(values) {
  const largest = Math.max(...values.map(Math.abs), 1e-9);
  const size = 10 ** Math.floor(Math.log10(largest));
  const round = [1, 2, 5, 10].map((factor) => factor * size).find((value) => value >= largest);
  const text = (value) => String(Number(value.toPrecision(1))).replaceAll("-", "−");
  const ticks = [-round, 0, round].map((value) => ({ value, text: text(value) }));
  return { ticks, part: (value) => 0.5 + (0.5 * value) / round };
}

/** Draws the rows of a history: `lines` are { colour, dash, of(values) }. */
export function curves(canvas, history, lines, isLogarithmic) {
  const { context, width, height } = cleared(canvas);
  const rows = history.rows;
  if (rows.length < 2) return;
  const all = lines.flatMap((line) => rows.map((row) => line.of(row.values)));
  const known = all.filter(Number.isFinite);
  const { ticks, part } = isLogarithmic ? logarithmic(known) : linear(known);
  const inner = height - BELOW - 6;
  const y = (value) => 6 + inner * (1 - part(value));
  const end = Math.max(rows.at(-1).time, SPAN);
  const x = (time) => LEFT + ((width - LEFT - 4) * (time - end + SPAN)) / SPAN;
  context.font = "11px system-ui, sans-serif";
  context.fillStyle = colour("faint");
  context.strokeStyle = colour("line");
  context.lineWidth = 1;
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const tick of ticks) {
    context.beginPath();
    context.moveTo(LEFT, y(tick.value));
    context.lineTo(width - 4, y(tick.value));
    context.stroke();
    context.fillText(tick.text, LEFT - 5, y(tick.value));
  }
  context.textAlign = "center";
  context.textBaseline = "bottom";
  for (let time = Math.ceil((end - SPAN) / 5) * 5; time <= end - 0.5; time += 5) {
    if (x(time) > LEFT) context.fillText(`${time} s`, x(time), height);
  }
  context.lineWidth = 1.6;
  context.lineJoin = "round";
  for (const line of lines) {
    context.strokeStyle = line.colour;
    context.setLineDash(line.dash ?? []);
    context.beginPath();
    for (const row of rows) context.lineTo(x(row.time), y(line.of(row.values)));
    context.stroke();
  }
  context.setLineDash([]);
}
