// Ways of the outermost ends over the last seconds, which fade.

/** Seconds of motion that a trace shows, points that it has at most, and points that all have. */
const SPAN = 3.5;
const MOST_POINTS = 260;
const ALL_POINTS = 1000;

/** Most ends that leave traces. */
const MOST_ENDS = 32;

/** Parts of a trace, each fainter than the next. */
const PARTS = 8;

export class Traces {
  /** Begins with the links that nothing hangs from. */
  begin(parents) {
    const bearing = new Set(parents);
    this.links = [...parents.keys()].filter((link) => !bearing.has(link)).slice(0, MOST_ENDS);
    this.most = Math.min(MOST_POINTS, Math.ceil(ALL_POINTS / Math.max(this.links.length, 1)));
    this.points = [];
  }

  /** Adds the ends (m) at a time (s). */
  add(time, ends) {
    const last = this.points.at(-1);
    if (last && time <= last.time) return;
    this.points.push({ time, ends });
    while (this.points.length > this.most || this.points[0].time < time - SPAN) this.points.shift();
  }

  draw(context, toPixels, colour) {
    const { points } = this;
    if (points.length < 2) return;
    const now = points.at(-1).time;
    const span = points.length < this.most ? SPAN : now - points[0].time;
    // Where each part begins; parts share a point.
    const age = (point) => Math.min(Math.floor((PARTS * (now - point.time)) / span), PARTS - 1);
    context.lineJoin = "bevel";
    context.lineCap = "butt";
    for (const link of this.links) {
      let begun = 0;
      for (let index = 1; index < points.length; index += 1) {
        const isLast = index === points.length - 1;
        if (!isLast && age(points[index]) === age(points[begun])) continue;
        const fresh = 1 - age(points[begun]) / PARTS;
        context.strokeStyle = colour(link, 0.75 * fresh ** 1.5);
        context.lineWidth = 0.6 + 1.6 * fresh;
        context.beginPath();
        for (let own = begun; own <= index; own += 1) {
          const { ends } = points[own];
          context.lineTo(...toPixels(ends[2 * link], ends[2 * link + 1]));
        }
        context.stroke();
        begun = index;
      }
    }
  }
}
