// The page: WebAssembly computes, this draws and listens.

import { Pendulum, with_branch, without_branch } from "./wasm/branched_pendulum_web.js";
import { AccuracyPanel } from "./accuracy.js";
import { Comparison } from "./compare.js";
import { EnergyPanel } from "./energy.js";
import { showLinks } from "./links.js";
import { coloursOf } from "./palette.js";
import { Recorder } from "./recorder.js";
import { areDifferent, onEnter, readRelease, writeRelease } from "./release-fields.js";
import { ReleaseMapPanel } from "./release-map.js";
import { savePicture } from "./save.js";
import { reshaped, shapeOf } from "./shape.js";
import { sharing } from "./share.js";
import { start } from "./start.js";
import { addressOf, beginningOf, Memory, read } from "./state.js";
import { Traces } from "./traces.js";
import { TreePanel } from "./tree.js";
import { examples } from "./examples.js";
import { View } from "./view.js";

const DEGREE = Math.PI / 180;

/** Longest frame that is followed: after a pause the motion goes on where it stood, s. */
const LONGEST_FRAME = 0.05;

/** Length of a single step before the speed, s. */
const STEP = 1 / 60;

/** Frames between two drawings of curves and numbers, and of two points of the curves. */
const FRAMES_A_DRAWING = 6;
const FRAMES_A_POINT = 3;

/** Frames between two rows of the table of a tree with so many links. */
const framesARow = (links) => (links > 63 ? FRAMES_A_POINT : 1);

/** Milliseconds of work from which a frame is slow, and of slow frames in a row after which the motion is paused. */
const SLOW = 250;
const MOST_SLOW = 500;

/** Milliseconds without a change after which the map begins anew. */
const CALM = 400;

const element = (id) => document.getElementById(id);

try {
  await start();
} catch (error) {
  element("not-started").hidden = false;
  element("not-started").textContent = `The page could not be loaded: ${error}. A browser of 2023 or later is needed.`;
  throw error;
}

const isEmbedded = document.body.classList.contains("embed");
const isNarrow = matchMedia("(max-width: 59.99rem)").matches;
for (const panel of ["map-panel", "tree-panel", "accuracy-panel"]) element(panel).open = !isNarrow;

let pendulum;
// Names of the links, what they hang from, their colours, if the tree before had others, and
// milliseconds of its last slow frames.
let links;
let method = ["dop853", 1e-6];
let chosen = 0;
let released;
let beginning;
let isRunning = false;
let frames = 0;
let mapTimer;

const traces = new Traces();
const recorder = new Recorder();
const comparison = new Comparison();
const view = new View(element("pendulum"), {
  grab(link, x, y) {
    choose(link);
    pendulum.grab(link, x, y);
  },
  pull: (x, y) => pendulum.pull(x, y),
  letGo: () => pendulum.let_go(),
  choose: (by) => choose((chosen + by + links.names.length) % links.names.length),
  chosen: () => chosen,
  pause: () => run(!isRunning),
});
const memory = new Memory(state, apply, (undos, redos) => {
  element("undo").disabled = undos === 0;
  element("redo").disabled = redos === 0;
  element("whole").href = addressOf(state());
});
const energy = new EnergyPanel(() => {
  recorder.begin(links.names, energy.definition);
  begin();
  memory.changed();
});
const map = isEmbedded ? null : new ReleaseMapPanel(releaseAt);
const accuracy = new AccuracyPanel((name, setting) => {
  try {
    pendulum.set_method(name, setting);
    method = [name, setting];
    tell("");
    memory.changed();
  } catch (error) {
    tell(String(error));
  }
});
const tree = new TreePanel({
  replace: replaceTree,
  change: changeParameter,
  typed() {
    // Other numbers of the same links go on as they move.
    if (links.areOthers) release();
  },
  begin(example) {
    beginning = beginningOf(example);
    apply(beginning, true);
  },
});

/** The state that the address has. */
function state() {
  const [name, setting] = method;
  return {
    text: tree.text,
    values: tree.values,
    release: { ...released },
    speed: Number(element("speed").value),
    method: name,
    setting,
    definition: energy.definition,
    plays: beginning.plays,
  };
}

/** Takes a state: goes on moving, unless the release is another or is asked for `again`. */
function apply(next, again = false) {
  const isKnown = next.text === tree.text && [...next.values].every(([name, value]) => tree.values.get(name) === value);
  if (!isKnown && !tree.write(next.text, next.values) && !pendulum) {
    const { told } = tree;
    apply({ ...beginningOf(examples[0]), release: next.release }, true);
    tree.tell(told);
    element("description").value = next.text;
    element("tree-panel").open = true;
    return;
  }
  if (method[0] !== next.method || method[1] !== next.setting) accuracy.show(next.method, next.setting);
  if (energy.definition !== next.definition) {
    energy.definition = next.definition;
    energy.begin();
    recorder.begin(links.names, energy.definition);
  }
  showSpeed(next.speed);
  if (!again && !areDifferent(next.release, released)) return;
  writeRelease(next.release);
  release();
}

/** Chooses the speed, one that the page does not offer too. */
function showSpeed(speed) {
  const select = element("speed");
  select.value = String(speed);
  if (select.selectedIndex < 0) {
    select.add(new Option(String(speed)));
    select.value = String(speed);
  }
}

/** Says what went wrong; nothing, if the text is empty. */
function tell(text) {
  element("failure").textContent = text;
}

function choose(link) {
  chosen = link;
  element("link").selectedIndex = link;
  drawPendulum();
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
  view.held = null;
  const [names, parents] = [pendulum.names(), [...pendulum.parents()]];
  const areOthers = names.join() !== links?.names.join();
  links = { names, parents, areOthers, slow: 0, colours: coloursOf(parents) };
  traces.begin(parents);
  element("link").replaceChildren(...names.map((name, link) => new Option(name, link)));
  energy.offer(!pendulum.has_unequal_copies());
  recorder.begin(names, energy.definition);
  choose(Math.min(chosen, names.length - 1));
  begin();
  waitForMap(0, text, values);
  memory.changed();
}

function changeParameter(name, value) {
  pendulum.set_parameter(name, value);
  reshaped(pendulum);
  begin();
  waitForMap(CALM);
  memory.changed();
}

/** Begins the map of the tree after so many milliseconds without another, if it is seen. */
function waitForMap(wait, text = tree.text, values = tree.values) {
  clearTimeout(mapTimer);
  if (!map || !element("map-panel").open) return;
  const start = () => map.begin(text, values, pendulum.has_copies());
  if (wait === 0) start();
  else mapTimer = setTimeout(() => map.begin(tree.text, tree.values, pendulum.has_copies()), wait);
}

/** Begins the sums anew. */
function begin() {
  accuracy.begin();
  tell("");
  record();
  drawPendulum();
  drawNumbers();
  drawTransfers();
}

/** Releases the tree from rest at the angles of root and all others, rad. */
function releaseAt(root, rest) {
  const [rounded, others] = [root, rest].map((angle) => Number((angle / DEGREE).toFixed(1)));
  writeRelease({ ...released, root: rounded, others });
  release();
}

/** Releases the tree at the angles that are written on the page. */
function release() {
  released = readRelease(released);
  const [root, others, apart] = [released.root, released.others, released.apart].map((angle) => angle * DEGREE);
  pendulum.release(root, others, apart);
  view.settle();
  traces.begin(links.parents);
  recorder.begin(links.names, energy.definition);
  map?.mark(root, others);
  energy.begin();
  begin();
  memory.changed();
}

/** Moves the pendulum by so much motion (s) and draws it: the page's whole work between two frames. */
export function frame(duration) {
  const evaluations = pendulum.evaluations();
  const begun = performance.now();
  try {
    pendulum.advance(duration);
  } catch (error) {
    tell(`${error}. Choose a smaller step or another method, or start again.`);
    run(false);
  }
  accuracy.count(duration, performance.now() - begun, pendulum.evaluations() - evaluations);
  frames += 1;
  if (frames % framesARow(links.names.length) === 0) record(frames % FRAMES_A_POINT === 0);
  drawPendulum();
  // Not both charts in one frame: it has 16 ms.
  if (frames % FRAMES_A_DRAWING === 0) drawNumbers();
  if (frames % FRAMES_A_DRAWING === FRAMES_A_DRAWING / 2) drawTransfers();
  pauseIfSlow(performance.now() - begun);
}

/** Pauses a tree, once, whose frames take so long that the page would not answer. */
function pauseIfSlow(work) {
  if (links.slow >= MOST_SLOW) return;
  links.slow = work < SLOW ? 0 : links.slow + work;
  if (links.slow < MOST_SLOW) return;
  run(false);
  tell(`A frame of these ${links.names.length} links takes ${(work / 1000).toFixed(1)} s of computing here, so the motion is
    paused. One step moves it, and Play goes on at that pace.`.replace(/\s+/g, " "));
}

/** Adds a row to the table, and a point to the curves if it is asked for. */
function record(isPoint = true) {
  const budget = pendulum.budget(energy.definition === "parseval");
  const { energies, received, powers } = budget ?? {};
  const known = budget && { energies, received, powers };
  budget?.free();
  const time = pendulum.time();
  if (isPoint) {
    energy.take(energies?.length ?? 0, pendulum.refused_energies());
    energy.record(time, pendulum.energy(), known);
  }
  const [angles, rates] = [pendulum.angles(), pendulum.rates()];
  recorder.add({ time, angles, rates, energy: pendulum.energy(), budget: known });
}

/** What the page knows of the motion now. */
export function motion() {
  return {
    time: pendulum.time(),
    names: links.names,
    angles: [...pendulum.angles()],
    ends: [...pendulum.ends()],
    energy: pendulum.energy(),
    energyError: pendulum.energy_error(),
  };
}

/** Where a place (m) is on the picture, and a release (rad) on the map, CSS pixels from their corners. */
export const pictureOf = (x, y) => view.frame().toPixels(x, y);
export const mapPlaceOf = (root, rest) => map.placeOf(root, rest);

function drawPendulum() {
  const shape = shapeOf(pendulum);
  traces.add(pendulum.time(), shape.ends);
  view.draw({
    shape,
    chosen,
    traces,
    colours: links.colours,
    hand: pendulum.hand(),
    ghost: element("ghost").checked ? pendulum.ghost() : [],
  });
}

const isEnergySeen = () => !isEmbedded && element("energy-panel").open;

function drawTransfers() {
  if (isEnergySeen()) energy.drawTransfers();
}

function drawNumbers() {
  if (isEnergySeen()) energy.draw();
  accuracy.draw(pendulum.energy_error());
  element("clock").textContent = `${pendulum.time().toFixed(2)} s`;
  const turned = Math.round((pendulum.angles()[chosen] / DEGREE) * 10) / 10;
  element("angle").textContent = `${turned.toFixed(1)}°`.replace("-", "−");
}

/** Lets the pendulum swing, or stand still. */
export function run(on) {
  isRunning = on;
  element("play").textContent = on ? "Pause" : "Play";
}

/** Lets the pendulum swing if the address does not ask for a still one, nor the reader for calm. */
function playAsAsked() {
  run(beginning.plays && !matchMedia("(prefers-reduced-motion: reduce)").matches);
}

function branch(change) {
  try {
    tree.write(change(tree.text, links.names[chosen]));
  } catch (error) {
    tell(String(error));
  }
}

function step() {
  run(false);
  frame(STEP * Number(element("speed").value));
  record();
  drawNumbers();
  drawTransfers();
}

const clicks = {
  play: () => run(!isRunning),
  step,
  release,
  more: () => branch(with_branch),
  less: () => branch(without_branch),
  undo: () => memory.undo(),
  redo: () => memory.redo(),
  reset: () => apply(beginning, true),
  picture: () => savePicture(element("pendulum"), "branched-pendulum.png"),
  "motion-csv": () => recorder.save(),
};
for (const [id, act] of Object.entries(clicks)) element(id).addEventListener("click", act);
onEnter(release);
element("link").addEventListener("change", (event) => choose(event.target.selectedIndex));
element("speed").addEventListener("change", () => memory.changed());
element("ghost").addEventListener("change", drawPendulum);
element("map-panel").addEventListener("toggle", ({ target }) => (target.open ? waitForMap(0) : map?.stop()));
element("energy-panel").addEventListener("toggle", () => {
  drawNumbers();
  drawTransfers();
});
addEventListener("keydown", (event) => {
  const isStep = (event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "z";
  if (!isStep || event.target.matches("textarea, input:not([type=range]):not([type=checkbox])")) return;
  event.preventDefault();
  if (event.shiftKey) memory.redo();
  else memory.undo();
});
addEventListener("hashchange", () => {
  beginning = read(location.hash);
  apply(beginning, true);
  playAsAsked();
});

sharing(() => {
  memory.settle();
  return state();
});
showLinks(element("links"));
beginning = read(location.hash);
apply(beginning, true);
accuracy.show(...method);
memory.begin();
playAsAsked();
new ResizeObserver(() => {
  drawPendulum();
  drawNumbers();
  drawTransfers();
  comparison.draw();
  map?.draw();
}).observe(document.body);

let last;
function animate(now) {
  const duration = Math.min((now - (last ?? now)) / 1000, LONGEST_FRAME);
  last = now;
  if (duration > 0) comparison.frame(duration);
  // A hand moves the pendulum even where it is paused.
  if (duration > 0 && (isRunning || view.held !== null)) frame(duration * Number(element("speed").value));
  requestAnimationFrame(animate);
}
requestAnimationFrame(animate);
