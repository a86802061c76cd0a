// The page: WebAssembly computes, this draws and listens.

import { Pendulum, with_branch, without_branch } from "./wasm/branched_pendulum_web.js";
import { AccuracyPanel } from "./accuracy.js";
import { EnergyPanel } from "./energy.js";
import { ReleaseMapPanel } from "./release-map.js";
import { start } from "./start.js";
import { TreePanel } from "./tree.js";
import { examples } from "./examples.js";
import { View } from "./view.js";

const DEGREE = Math.PI / 180;

/** Longest frame that is followed: after a pause the motion goes on where it stood, s. */
const LONGEST_FRAME = 0.05;

/** Frames between two drawings of curves and numbers, and of two points of the curves. */
const FRAMES_A_DRAWING = 6;
const FRAMES_A_POINT = 3;

/** Milliseconds without a change after which the map begins anew. */
const CALM = 400;

const element = (id) => document.getElementById(id);

await start();

let pendulum;
let method = ["dop853", 1e-6];
let chosen = 0;
let isRunning = !matchMedia("(prefers-reduced-motion: reduce)").matches;
let frames = 0;
let mapTimer;

const view = new View(element("pendulum"), {
  grab(link, x, y) {
    choose(link);
    pendulum.grab(link, x, y);
  },
  pull: (x, y) => pendulum.pull(x, y),
  letGo: () => pendulum.let_go(),
});
const energy = new EnergyPanel();
const map = new ReleaseMapPanel(releaseAt);
const accuracy = new AccuracyPanel((name, setting) => {
  method = [name, setting];
  pendulum?.set_method(name, setting);
  tell("");
});
const tree = new TreePanel(replaceTree, changeParameter);

/** Says what went wrong; nothing, if the text is empty. */
function tell(text) {
  element("failure").textContent = text;
}

function choose(link) {
  chosen = link;
  element("link").selectedIndex = link;
}

/** Takes another tree, which goes on as the one before moves. */
function replaceTree(text, values) {
  const next = new Pendulum(text, [...values.keys()], new Float64Array(values.values()));
  next.set_method(...method);
  if (pendulum) {
    next.take_up(pendulum);
    pendulum.free();
  }
  pendulum = next;
  const names = pendulum.names();
  element("link").replaceChildren(...names.map((name, link) => new Option(name, link)));
  choose(Math.min(chosen, names.length - 1));
  begin();
  map.begin(text, values, pendulum.has_copies());
}

function changeParameter(name, value) {
  pendulum.set_parameter(name, value);
  begin();
  clearTimeout(mapTimer);
  mapTimer = setTimeout(() => map.begin(tree.text, tree.values, pendulum.has_copies()), CALM);
}

/** Begins the sums anew. */
function begin() {
  accuracy.begin();
  tell("");
  record();
  drawPendulum();
  drawNumbers();
}

/** Releases the tree from rest at the angles of root and all others, rad. */
function releaseAt(root, rest) {
  element("root").value = (root / DEGREE).toFixed(1);
  element("rest").value = (rest / DEGREE).toFixed(1);
  release();
}

/** Releases the tree at the angles that are written on the page. */
function release() {
  const [root, rest, difference] = ["root", "rest", "difference"].map(
    (id) => Number(element(id).value) * DEGREE,
  );
  pendulum.release(root, rest, difference);
  map.mark(root, rest);
  energy.begin();
  begin();
}

/** Moves the pendulum by a frame (s) and draws it: the page's whole work between two frames. */
export function frame(duration) {
  const evaluations = pendulum.evaluations();
  const begun = performance.now();
  try {
    pendulum.advance(duration);
  } catch (error) {
    tell(`${error}. Choose a smaller step or another method, or release again.`);
    run(false);
  }
  accuracy.count(duration, performance.now() - begun, pendulum.evaluations() - evaluations);
  frames += 1;
  if (frames % FRAMES_A_POINT === 0) record();
  drawPendulum();
  if (frames % FRAMES_A_DRAWING === 0) drawNumbers();
}

function record() {
  const budget = pendulum.budget();
  const { energies, received, powers } = budget ?? {};
  energy.take(energies?.length ?? 0);
  energy.record(pendulum.time(), pendulum.energy(), budget && { energies, received, powers });
  budget?.free();
}

/** What the page knows of the motion now. */
export function motion() {
  return {
    time: pendulum.time(),
    names: pendulum.names(),
    angles: [...pendulum.angles()],
    ends: [...pendulum.ends()],
    energy: pendulum.energy(),
    energyError: pendulum.energy_error(),
    reach: pendulum.reach(),
  };
}

function drawPendulum() {
  const shape = {
    pivots: pendulum.pivots(),
    ends: pendulum.ends(),
    masses: pendulum.masses(),
    reach: pendulum.reach(),
  };
  view.draw(shape, chosen, pendulum.hand());
}

function drawNumbers() {
  energy.draw();
  accuracy.draw(pendulum.energy_error());
  element("clock").textContent = `${pendulum.time().toFixed(1)} s`;
}

/** Lets the pendulum swing, or stand still. */
export function run(on) {
  isRunning = on;
  element("play").textContent = on ? "Pause" : "Play";
}

function branch(change) {
  const names = pendulum.names();
  try {
    tree.write(change(tree.text, names[chosen]));
  } catch (error) {
    tell(String(error));
  }
}

element("play").addEventListener("click", () => run(!isRunning));
element("release").addEventListener("click", release);
element("link").addEventListener("change", (event) => choose(event.target.selectedIndex));
element("more").addEventListener("click", () => branch(with_branch));
element("less").addEventListener("click", () => branch(without_branch));
new ResizeObserver(() => {
  drawPendulum();
  drawNumbers();
  map.draw();
}).observe(document.body);

tree.show(examples[0]);
[element("root").value, element("rest").value, element("difference").value] = [47.8, 0, 0.6];
release();
run(isRunning);

let last;
function animate(now) {
  const duration = Math.min((now - (last ?? now)) / 1000, LONGEST_FRAME);
  last = now;
  // A hand moves the pendulum even where it is paused.
  if (duration > 0 && (isRunning || view.held !== null)) frame(duration);
  requestAnimationFrame(animate);
}
requestAnimationFrame(animate);
