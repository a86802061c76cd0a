// Growth rates over the plane of releases: coarse first, then finer, and begun anew whenever a
// message asks for another tree.

import { anglesOf, indexOf, pointsOf } from "./map-plane.js";
import { start } from "./start.js";
import { Pendulum } from "./wasm/branched_pendulum_web.js";

/** Milliseconds of computing between two messages. */
const PART = 80;

const ready = start();
let newest = 0;

function mapOf({ text, names, values, span, tolerance }) {
  const pendulum = new Pendulum(text, names, new Float64Array(values));
  try {
    return pendulum.release_map(span, tolerance);
  } finally {
    pendulum.free();
  }
}

async function compute(task) {
  await ready;
  const { number } = task;
  if (newest !== number) return;
  let map;
  try {
    map = mapOf(task);
  } catch (error) {
    postMessage({ number, refused: String(error) });
    return;
  }
  let cells = [];
  let begun = performance.now();
  const known = new Set(task.known);
  for (const point of pointsOf(task)) {
    if (known.has(indexOf(point))) continue;
    const { root, rest } = anglesOf(point);
    const [rate, difference] = map.rate(root, rest);
    cells.push({ ...point, rate, difference });
    if (performance.now() - begun > PART) {
      postMessage({ number, cells });
      cells = [];
      // Lets a newer task arrive.
      await new Promise((resolve) => setTimeout(resolve));
      if (newest !== number) break;
      begun = performance.now();
    }
  }
  postMessage({ number, cells });
  map.free();
}

addEventListener("message", ({ data }) => {
  newest = data.number;
  if (data.text !== undefined) compute(data);
});
