// Curves over the last seconds.

import { cleared, colour } from "./canvas.js";

/** Seconds that a chart shows. */
export const SPAN = 20;

/** Most powers of ten that a logarithmic axis shows. */
const DECADES = 10;

/** Numbers over time: what is older than a chart shows is left out. */
export class History {
  constructor(span = SPAN) {
    this.span = span;
    this.rows = [];
  }

  push(time, values) {
    if (time < this.rows.at(-1)?.time) this.rows = [];
    if (time === this.rows.at(-1)?.time) this.rows.pop();
    this.rows.push({ time, values });
    while (this.rows[0].time < time - this.span) this.rows.shift();
  }
}

/** Width (pixels) of the labels at the left. */
export const LEFT = 60;
const BELOW = 16;
const ABOVE = 6;

/** Height of the band in which zero stands below a logarithmic axis. */
const ZERO = 14;

/** Least and largest size of a number that is written without a power of ten: others are too wide. */
const PLAIN = [1e-3, 1e4];

const power = (exponent) => `10${[...String(exponent)].map((c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]).join("")}`;

/**
 * Ticks and the way from values to pixels of a logarithmic axis. Zero has a place of its own below;
 * what is smaller than the axis shows, or negative, has none.
 */
function logarithmic(values, height) {
  const positive = values.filter((value) => value > 0);
  const hasZero = values.includes(0);
  const inner = height - BELOW - ABOVE - (hasZero ? ZERO : 0);
  const top = Math.ceil(Math.log10(Math.max(...positive, 1e-12)));
  const low = Math.log10(Math.min(...positive, 10 ** top));
  const from = Math.min(Math.max(Math.floor(low), top - DECADES), top - 1);
  const step = Math.ceil((top - from) / 5);
  const at = (exponent) => ABOVE + (inner * (top - exponent)) / (top - from);
  const ticks = [];
  for (let exponent = top; exponent >= from; exponent -= step) {
    ticks.push({ y: at(exponent), text: power(exponent) });
  }
  const zero = height - BELOW - 2;
  if (hasZero) ticks.push({ y: zero, text: "0" });
  const y = (value) => {
    if (value === 0) return zero;
    const exponent = Math.log10(value);
    return exponent >= from ? at(exponent) : Number.NaN;
  };
  return { ticks, y };
}

/** A number of one digit for a tick: 0.002, −2·10⁻⁶. */
export function tickOf(value) {
  const size = Math.abs(value);
  if (size === 0 || (size > 0.99 * PLAIN[0] && size < PLAIN[1])) {
    return String(Number(value.toPrecision(1))).replace("-", "−");
  }
  const [digit, exponent] = value.toExponential(0).split("e");
  return `${digit.replace("-", "−")}·${power(Number(exponent))}`;
}

/** Ticks and the way from values to pixels of an axis of numbers of either sign. */
function linear(values, height) {
  const largest = Math.max(...values.map(Math.abs));
  const size = 10 ** Math.floor(Math.log10(largest || 1));
  const round = [1, 2, 5, 10].map((factor) => factor * size).find((value) => value >= largest);
  const inner = height - BELOW - ABOVE;
  const y = (value) => ABOVE + inner * (0.5 - (0.5 * value) / round);
  return { ticks: [-round, 0, round].map((value) => ({ y: y(value), text: tickOf(value) })), y };
}

/** Draws the rows of a history: `lines` are { colour, dash, of(values) }. */
export function curves(canvas, history, lines, isLogarithmic) {
  const { context, width, height } = cleared(canvas);
  const { rows, span } = history;
  if (rows.length < 2) return;
  const all = lines.flatMap((line) => rows.map((row) => line.of(row.values)));
  const { ticks, y } = (isLogarithmic ? logarithmic : linear)(all.filter(Number.isFinite), height);
  const end = Math.max(rows.at(-1).time, span);
  const x = (time) => LEFT + ((width - LEFT - 4) * (time - end + span)) / span;
  axes({ context, width, height }, ticks, x, end, span);
  context.lineWidth = 1.5;
  context.lineJoin = "bevel";
  for (const line of lines) {
    context.strokeStyle = line.colour;
    context.setLineDash(line.dash ?? []);
    context.beginPath();
    let isDrawn = false;
    for (const row of rows) {
      const value = line.of(row.values);
      const height = y(value);
      // From zero to a positive number there is no way on a logarithmic axis.
      const goesOn = isDrawn && !(isLogarithmic && (value === 0) !== isDrawn.isZero);
      if (Number.isFinite(height)) context[goesOn ? "lineTo" : "moveTo"](x(row.time), height);
      isDrawn = Number.isFinite(height) && { isZero: value === 0 };
    }
    context.stroke();
  }
  context.setLineDash([]);
}

function axes({ context, width, height }, ticks, x, end, span) {
  context.font = "11px system-ui, sans-serif";
  context.fillStyle = colour("faint");
  context.strokeStyle = colour("line");
  context.lineWidth = 1;
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (const { y, text } of ticks) {
    context.beginPath();
    context.moveTo(LEFT, y);
    context.lineTo(width - 4, y);
    context.stroke();
    context.fillText(text, LEFT - 5, y);
  }
  context.textAlign = "center";
  context.textBaseline = "bottom";
  for (let time = Math.ceil((end - span) / 5) * 5; time <= end - 0.5; time += 5) {
    if (x(time) > LEFT) context.fillText(`${time} s`, x(time), height);
  }
}
