// What all tests of the page use.

const { readFileSync } = require("node:fs");

const [address, , pictures] = process.argv.slice(2);

/** Frames that are followed, and the part of the energy that may be lost or won in them. */
const FRAMES = 10_000;
const ENERGY = 0.02;

/** Milliseconds for anything to happen: machines may be busy. */
const PATIENCE = 240_000;

/** Faults that the page has written to its console. */
const faults = [];

function watched(page) {
  page.setDefaultTimeout(PATIENCE);
  page.on("pageerror", (error) => faults.push(String(error)));
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) faults.push(message.text());
  });
  page.on("requestfailed", (request) => faults.push(`not loaded: ${request.url()}`));
  return page;
}

async function opened(browser, options, part = "") {
  const page = watched(await browser.newPage(options));
  await page.goto(address + part);
  await page.waitForFunction(() => document.querySelector("#link").options.length > 0);
  return page;
}

const motion = (page) => page.evaluate(async () => (await import("./main.js")).motion());
const run = (page, on) => page.evaluate(async (on) => (await import("./main.js")).run(on), on);

/** Moves the page by frames, of a sixtieth of a second. */
const frames = (page, count, duration = 1 / 60) =>
  page.evaluate(async ([count, duration]) => {
    const { frame } = await import("./main.js");
    for (let number = 0; number < count; number += 1) frame(duration);
  }, [count, duration]);

/** The place of a link's end on the screen. */
const endOnScreen = (page, link) =>
  page.evaluate(async (link) => {
    const { motion, pictureOf } = await import("./main.js");
    const { ends } = motion();
    const box = document.querySelector("#pendulum").getBoundingClientRect();
    const [x, y] = pictureOf(ends[2 * link], ends[2 * link + 1]);
    return { x: box.x + x, y: box.y + y };
  }, link);

const degrees = ({ angles }) => angles.map((angle) => (angle * 180) / Math.PI);

/** The text of a file that a click gives. */
async function given(page, selector) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.click(selector)]);
  return readFileSync(await download.path());
}

/** Rows of a table of numbers, and the names of its columns. */
function table(text) {
  const [head, ...rows] = String(text).trim().split("\n");
  return { columns: head.split(","), rows: rows.map((row) => row.split(",").map(Number)) };
}

/** What axe finds wrong in a page. */
async function violations(page) {
  await page.addScriptTag({ path: require.resolve("axe-core") });
  const found = await page.evaluate(async () => (await window.axe.run()).violations);
  return found.map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html).join(" ")}`);
}

module.exports = {
  address, pictures, FRAMES, ENERGY, faults, watched, opened, motion, run, frames, endOnScreen, degrees, given, table, violations,
};
