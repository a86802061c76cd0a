// A pendulum's shape, as it is drawn.

const outlines = new WeakMap();

/** What a pendulum has whatever its angles: until a parameter changes. */
function lasting(pendulum) {
  let own = outlines.get(pendulum);
  if (!own) {
    own = { outlines: pendulum.widths_and_radii(), reach: pendulum.reach() };
    outlines.set(pendulum, own);
  }
  return own;
}

/** Forgets the widths of a pendulum whose parameters have changed. */
export const reshaped = (pendulum) => outlines.delete(pendulum);

/** Pivots, ends and centres (m) of a pendulum now, its bodies' outlines and its reach. */
export const shapeOf = (pendulum) => ({
  pivots: pendulum.pivots(),
  ends: pendulum.ends(),
  centres: pendulum.centres(),
  ...lasting(pendulum),
});
