// The pendulum as it is drawn, and the pointer on it.

import { cleared, colour } from "./canvas.js";

/** Distance (CSS pixels) from which a pointer takes hold of a link. */
const NEAR = 28;

export class View {
  /** `on` has `grab(link, x, y)`, `pull(x, y)`, `letGo()` with places in metres. */
  constructor(canvas, on) {
    this.canvas = canvas;
    this.on = on;
    this.shape = { pivots: [], ends: [], masses: [], reach: 1 };
    this.held = null;
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(end, (event) => this.up(event));
    }
  }

  /** Pixels from the corner of the canvas of a place in metres, and back. */
  frame(width = this.canvas.clientWidth, height = this.canvas.clientHeight) {
    const scale = (0.46 * Math.min(width, height)) / this.shape.reach;
    const middle = [width / 2, height / 2];
    return {
      scale,
      toPixels: (x, y) => [middle[0] + scale * x, middle[1] - scale * y],
      toMetres: (x, y) => [(x - middle[0]) / scale, (middle[1] - y) / scale],
    };
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
    this.held = null;
    this.canvas.classList.remove("held");
    this.on.letGo();
  }

  /** Draws pivots, ends, masses and reach of `shape`, the chosen link and the hand. */
  draw(shape, chosen, hand) {
    this.shape = shape;
    const { context, width, height } = cleared(this.canvas);
    const { toPixels } = this.frame(width, height);
    const heaviest = Math.max(...shape.masses);
    context.lineCap = "round";
    shape.masses.forEach((mass, link) => {
      context.strokeStyle = colour(link === chosen ? "accent" : "rod");
      context.lineWidth = 3 + 7 * Math.sqrt(mass / heaviest);
      context.beginPath();
      context.moveTo(...toPixels(shape.pivots[2 * link], shape.pivots[2 * link + 1]));
      context.lineTo(...toPixels(shape.ends[2 * link], shape.ends[2 * link + 1]));
      context.stroke();
    });
    context.fillStyle = colour("panel");
    for (let link = 0; link < shape.masses.length; link += 1) {
      context.beginPath();
      context.arc(...toPixels(shape.pivots[2 * link], shape.pivots[2 * link + 1]), 2.5, 0, 7);
      context.fill();
    }
    if (hand.length === 4) {
      context.strokeStyle = colour("warn");
      context.lineWidth = 2;
      context.setLineDash([5, 4]);
      context.beginPath();
      context.moveTo(...toPixels(hand[0], hand[1]));
      context.lineTo(...toPixels(hand[2], hand[3]));
      context.stroke();
      context.setLineDash([]);
    }
  }
}
