// Growth rates over the plane of releases: coarse first, then finer, and begun anew whenever a
// message asks for another tree.

import { start } from "./start.js";
import { Pendulum } from "./wasm/branched_pendulum_web.js";

/** Distances of the points of each pass, in those of the last one. */
const STRIDES = [8, 4, 2, 1];

/** Milliseconds of computing between two messages. */
const PART = 60;

const ready = start();
let newest = 0;

/** The points of a pass that none before has had. */
function* points({ columns, rows }, pass) {
  const stride = STRIDES[pass];
  const before = STRIDES[pass - 1];
  for (let row = 0; row < rows; row += stride) {
    for (let column = 0; column < columns; column += stride) {
      const isKnown = before && row % before === 0 && column % before === 0;
      if (!isKnown) yield [column, row];
    }
  }
}

/** The angle in the middle of a point's cell, rad. */
const angle = ([from, to], index, count) => from + ((index + 0.5) / count) * (to - from);

async function compute(task) {
  await ready;
  const { number, plane } = task;
  let map;
  try {
    const pendulum = new Pendulum(task.text, task.names, new Float64Array(task.values));
    map = pendulum.release_map(task.span, task.tolerance);
    pendulum.free();
  } catch (error) {
    postMessage({ number, refused: String(error) });
    return;
  }
  let cells = [];
  let begun = performance.now();
  for (const pass of STRIDES.keys()) {
    for (const [column, row] of points(plane, pass)) {
      const root = angle(plane.root, row, plane.rows);
      const rest = angle(plane.rest, column, plane.columns);
      const [rate, difference] = map.rate(root, rest);
      cells.push({ column, row, stride: STRIDES[pass], rate, difference });
      if (performance.now() - begun > PART) {
        postMessage({ number, cells });
        cells = [];
        // Lets a newer task arrive.
        await new Promise((resolve) => setTimeout(resolve));
        if (newest !== number) return map.free();
        begun = performance.now();
      }
    }
  }
  postMessage({ number, cells, done: true });
  map.free();
}

addEventListener("message", ({ data }) => {
  newest = data.number;
  if (data.text !== undefined) compute(data);
});
