// Canvases as large as their boxes, and the colours of the page.

const styles = getComputedStyle(document.documentElement);

/** The value of a colour of style.css, which knows light and dark. */
export const colour = (name) => styles.getPropertyValue(`--${name}`).trim();

/** The colour of a scale: 0 is what all copies do together. */
export const ofScale = (scale) => colour(scale === 0 ? "curve-0" : `curve-${1 + (scale - 1) % 4}`);

/** Clears a canvas, as many pixels as the screen has, and gives its context in CSS pixels. */
export function cleared(canvas) {
  const { clientWidth: width, clientHeight: height } = canvas;
  const ratio = window.devicePixelRatio || 1;
  const [columns, rows] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== columns || canvas.height !== rows) {
    canvas.width = columns;
    canvas.height = rows;
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}
