// The pendulum on the page: pointer and keys on it.

import { drawPendulum, frameOf, Height } from "./drawing.js";

/** Distance (CSS pixels) from which a pointer takes hold of a link. */
const NEAR = 28;

/** How far a key pulls, over the reach of the tree; with Shift. */
const PULL = 0.06;
const SMALL_PULL = 0.015;

const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

const isCalm = matchMedia("(prefers-reduced-motion: reduce)");

export class View {
  /**
   * `on` has `grab(link, x, y)`, `pull(x, y)`, `letGo()` with places in metres, `choose(by)`,
   * `chosen()` and `pause()`.
   */
  constructor(canvas, on) {
    Object.assign(this, { canvas, on, height: new Height() });
    this.shape = { pivots: [], ends: [], reach: 1 };
    // What holds a link: the number of a pointer, "keys" or null; and the place of the keys' hand.
    this.held = null;
    this.place = null;
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(end, (event) => this.up(event));
    }
    canvas.addEventListener("keydown", (event) => this.key(event));
    canvas.addEventListener("blur", () => this.letKeysGo());
  }

  /** Pixels from the corner of the canvas of a place in metres, and back. */
  frame() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    return frameOf({ width, height, reach: this.shape.reach, high: this.height.high });
  }

  /** The link nearest to a point in pixels, if one is near. */
  nearest(x, y) {
    const { toPixels } = this.frame();
    const { pivots, ends } = this.shape;
    let best = { link: null, distance: NEAR };
    for (let link = 0; 2 * link < pivots.length; link += 1) {
      const [ax, ay] = toPixels(pivots[2 * link], pivots[2 * link + 1]);
      const [bx, by] = toPixels(ends[2 * link], ends[2 * link + 1]);
      const [dx, dy] = [bx - ax, by - ay];
      const along = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1);
      const part = Math.min(1, Math.max(0, along));
      const distance = Math.hypot(x - ax - part * dx, y - ay - part * dy);
      if (distance < best.distance) best = { link, distance };
    }
    return best.link;
  }

  at(event) {
    const box = this.canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  down(event) {
    const [x, y] = this.at(event);
    const link = this.nearest(x, y);
    if (link === null) return;
    this.canvas.setPointerCapture(event.pointerId);
    this.held = event.pointerId;
    this.canvas.classList.add("held");
    this.on.grab(link, ...this.frame().toMetres(x, y));
  }

  move(event) {
    if (event.pointerId !== this.held) return;
    this.on.pull(...this.frame().toMetres(...this.at(event)));
  }

  up(event) {
    if (event.pointerId !== this.held) return;
    this.canvas.classList.remove("held");
    this.letGo();
  }

  letGo() {
    this.held = null;
    this.on.letGo();
  }

  letKeysGo() {
    if (this.held === "keys") this.letGo();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const arrow = ARROWS[event.key];
    if (arrow) this.pullBy(arrow, event.shiftKey ? SMALL_PULL : PULL);
    else if (event.key === "PageUp" || event.key === "PageDown") {
      this.letKeysGo();
      this.on.choose(event.key === "PageUp" ? -1 : 1);
    } else if (event.key === "Enter" || event.key === "Escape") this.letKeysGo();
    else if (event.key === " ") this.on.pause();
    else return;
    event.preventDefault();
  }

  /** Pulls the chosen link by its end in a direction. */
  pullBy([x, y], part) {
    if (typeof this.held === "number") return;
    if (this.held === null) {
      const link = this.on.chosen();
      this.place = [this.shape.ends[2 * link], this.shape.ends[2 * link + 1]];
      this.held = "keys";
      this.on.grab(link, ...this.place);
    }
    const way = part * this.shape.reach;
    this.place = [this.place[0] + way * x, this.place[1] + way * y];
    this.on.pull(...this.place);
  }

  /** Nothing is held any more, and the pivot stands where it does at a beginning. */
  settle() {
    this.held = null;
    this.height.settle();
  }

  /** Draws a picture as `drawPendulum` knows it, but for the height. */
  draw(picture) {
    this.shape = picture.shape;
    this.height.see(picture.shape.ends, picture.shape.reach, isCalm.matches);
    drawPendulum(this.canvas, { ...picture, high: this.height.high });
  }
}
