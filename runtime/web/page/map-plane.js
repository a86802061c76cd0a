// The plane of releases, and what is known of it: shared by the page and its workers.

const DEGREE = Math.PI / 180;

/** The plane: half of it, which the other mirrors. Angles of all others and of the root, rad. */
export const PLANE = { columns: 96, rows: 48, rest: [-135 * DEGREE, 135 * DEGREE], root: [0, 135 * DEGREE] };

/** Distances of the points of each pass, in those of the last one. */
export const STRIDES = [8, 4, 2, 1];

/** The angle in the middle of a point's cell, rad. */
const angle = ([from, to], index, count) => from + ((index + 0.5) / count) * (to - from);

/** Angles of root and all others (rad) at a point. */
export const anglesOf = ({ column, row }) => ({
  root: angle(PLANE.root, row, PLANE.rows),
  rest: angle(PLANE.rest, column, PLANE.columns),
});

/** The number of a point. */
export const indexOf = ({ column, row }) => row * PLANE.columns + column;

/** The points, coarse ones first, that worker `own` of `count` has to compute. */
export function* pointsOf({ own, count }) {
  let number = 0;
  for (const [pass, stride] of STRIDES.entries()) {
    const before = STRIDES[pass - 1];
    for (let row = 0; row < PLANE.rows; row += stride) {
      for (let column = 0; column < PLANE.columns; column += stride) {
        const isKnown = before && row % before === 0 && column % before === 0;
        if (isKnown) continue;
        if (number % count === own) yield { column, row, stride };
        number += 1;
      }
    }
  }
}
