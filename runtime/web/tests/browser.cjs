// Drives a browser through the page: `node browser.cjs ADDRESS CHROMIUM FOLDER`.

const assert = require("node:assert/strict");
const { mkdirSync } = require("node:fs");
const { chromium } = require("playwright-core");

const [address, executablePath, pictures] = process.argv.slice(2);

const FLAGS = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync",
];

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

async function opened(browser, options) {
  const page = watched(await browser.newPage(options));
  await page.goto(address);
  await page.waitForFunction(() => document.querySelector("#link").options.length > 0);
  return page;
}

const motion = (page) => page.evaluate(async () => (await import("./main.js")).motion());
const run = (page, on) => page.evaluate(async (on) => (await import("./main.js")).run(on), on);

/** Moves the page by frames of a sixtieth of a second. */
const frames = (page, count) =>
  page.evaluate(async (count) => {
    const { frame } = await import("./main.js");
    for (let number = 0; number < count; number += 1) frame(1 / 60);
  }, count);

/** The middle of a link's end on the screen. */
const endOnScreen = (page, link) =>
  page.evaluate(async (link) => {
    const { motion } = await import("./main.js");
    const { ends, reach } = motion();
    const box = document.querySelector("#pendulum").getBoundingClientRect();
    const scale = (0.46 * Math.min(box.width, box.height)) / reach;
    const [x, y] = [ends[2 * link], ends[2 * link + 1]];
    return { x: box.x + box.width / 2 + scale * x, y: box.y + box.height / 2 - scale * y };
  }, link);

const tests = {
  async "ten thousand frames keep the energy"(page) {
    await run(page, false);
    const before = await motion(page);
    await frames(page, FRAMES);
    const after = await motion(page);
    assert.ok(Math.abs(after.time - before.time - FRAMES / 60) < 1e-6);
    assert.ok(after.angles.some((angle, link) => Math.abs(angle - before.angles[link]) > 1e-3));
    const change = Math.abs(after.energy / before.energy - 1);
    assert.ok(change < ENERGY, `energy changed by ${change}`);
    return `energy changed by ${change.toExponential(1)} of itself`;
  },

  async "the pendulum swings by itself"(page) {
    await run(page, true);
    const { time } = await motion(page);
    await page.waitForFunction(
      async (time) => (await import("./main.js")).motion().time > time + 0.3,
      time,
    );
  },

  async "a worse method has a larger error for less work"(page) {
    await run(page, false);
    const of = async (name, setting) => {
      await page.selectOption("#method", name);
      await page.fill("#setting", String(setting));
      await page.click("#release");
      await frames(page, 300);
      return motion(page);
    };
    const [midpoint, fine] = [await of("gauss2", -2), await of("dop853", -10)];
    const [large, small] = [midpoint, fine].map(({ energyError }) => Math.abs(energyError));
    assert.ok(small < 1e-8 && large > 1e3 * small, `${large} against ${small}`);
    assert.match(await page.textContent("#error"), /e−/);
    assert.match(await page.textContent("#cost"), /ms/);
    await page.selectOption("#method", "dop853");
    await page.fill("#setting", "-6");
    return `${large.toExponential(1)} against ${small.toExponential(1)}`;
  },

  async "a link follows the mouse and keeps its motion"(page) {
    await page.fill("#root", "0");
    await page.click("#release");
    await run(page, false);
    await frames(page, 6);
    const from = await endOnScreen(page, 0);
    await page.mouse.move(from.x, from.y - 10);
    await page.mouse.down();
    await page.mouse.move(from.x + 120, from.y - 40, { steps: 8 });
    const away = async (limit) =>
      page.waitForFunction(
        async (limit) => (await import("./main.js")).motion().angles[0] > limit,
        limit,
      );
    await away(0.4);
    await frames(page, 60);
    const held = await motion(page);
    await page.mouse.up();
    await frames(page, 15);
    const free = await motion(page);
    assert.ok(free.angles[0] < held.angles[0] - 0.1, "it falls back");
    assert.ok(Math.abs(free.energyError) < 1e-3, `error ${free.energyError}`);
    return `pulled to ${held.angles[0].toFixed(2)} rad`;
  },

  async "branches come and go"(page) {
    await page.selectOption("#link", { label: "parent" });
    await page.click("#more");
    assert.equal((await motion(page)).names.length, 4);
    assert.match(await page.inputValue("#description"), /\* 3/);
    await frames(page, 60);
    await page.selectOption("#link", { label: "child_3" });
    await page.click("#more");
    assert.equal((await motion(page)).names.length, 7);
    await page.selectOption("#link", { label: "child_twig_1" });
    await page.click("#less");
    await page.selectOption("#link", { label: "child_1" });
    await page.click("#less");
    assert.deepEqual((await motion(page)).names, ["parent", "child_1", "child_2"]);
    await page.selectOption("#link", { label: "parent" });
    await page.click("#less");
    assert.match(await page.textContent("#failure"), /root/);
  },

  async "a wrong description shows where"(page) {
    const text = await page.inputValue("#description");
    await page.fill("#description", text.replace("mass", "mas"));
    await page.waitForFunction(() => document.querySelector("#message").textContent !== "");
    const message = await page.textContent("#message");
    assert.match(message, /\^\^\^/);
    assert.match(message, /did you mean `mass`/);
    await frames(page, 10);
    await page.screenshot({ path: `${pictures}/mistake.png` });
    await page.fill("#description", text);
    await page.waitForFunction(() => document.querySelector("#message").textContent === "");
  },

  async "sliders change the tree"(page) {
    await page.fill("#rest", "20");
    await page.click("#release");
    const before = await motion(page);
    await page.evaluate(() => {
      const slider = document.querySelector("#parameter-g");
      slider.value = 1;
      slider.dispatchEvent(new Event("input"));
    });
    const after = await motion(page);
    assert.deepEqual(after.angles, before.angles);
    assert.ok(after.energy < 0.2 * before.energy);
    await page.selectOption("#example", "0");
  },

  async "the map is drawn, and a click on it releases there"(page) {
    await page.waitForFunction(() => /^\d{3,} of|^4608 points/.test(document.querySelector("#map-state").textContent));
    const box = await page.locator("#map").boundingBox();
    const [x, y] = [0.75, 0.25];
    await run(page, false);
    await page.locator("#map").click({ position: { x: x * box.width, y: y * box.height } });
    const { time, angles } = await motion(page);
    assert.equal(time, 0);
    const degrees = angles.map((angle) => (angle * 180) / Math.PI);
    assert.ok(Math.abs(degrees[0] - 135 * (1 - y)) < 1, `${degrees}`);
    assert.ok(Math.abs((degrees[1] + degrees[2]) / 2 - (270 * x - 135)) < 1, `${degrees}`);
    const shades = await page.evaluate(() => {
      const map = document.querySelector("#map");
      const { data } = map.getContext("2d").getImageData(0, 0, map.width, map.height);
      const colours = new Set();
      for (let i = 0; i < data.length; i += 4) colours.add(data.slice(i, i + 3).join());
      return colours.size;
    });
    assert.ok(shades > 50, `${shades} colours`);
    return page.textContent("#map-state");
  },

  async "every example runs"(page) {
    const titles = await page.locator("#example option").allTextContents();
    for (const [index, title] of titles.entries()) {
      await page.selectOption("#example", String(index));
      await frames(page, 120);
      assert.equal(await page.textContent("#message"), "", title);
      assert.equal(await page.textContent("#failure"), "", title);
      assert.ok(Math.abs((await motion(page)).energyError) < 1e-3, title);
    }
    await page.selectOption("#example", "0");
    return `${titles.length} of them`;
  },

  async "pictures, at a desk and on a phone, light and dark"(page, browser) {
    await page.fill("#root", "47.8");
    await page.fill("#rest", "0");
    await page.click("#release");
    await frames(page, 900);
    await page.waitForFunction(() => document.querySelector("#map-state").textContent.startsWith("4608"));
    await page.screenshot({ path: `${pictures}/desk.png`, fullPage: true });
    const phone = await opened(browser, {
      viewport: { width: 390, height: 844 },
      deviceScaleFactor: 2,
      colorScheme: "dark",
      reducedMotion: "reduce",
      hasTouch: true,
    });
    assert.equal(await phone.textContent("#play"), "Play", "motion that was not asked for");
    await frames(phone, 900);
    await phone.waitForTimeout(3000);
    const wide = await phone.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= 390, `the page is ${wide} pixels wide`);
    await phone.screenshot({ path: `${pictures}/phone.png`, fullPage: true });
    await phone.close();
  },
};

async function main() {
  mkdirSync(pictures, { recursive: true });
  const browser = await chromium.launch({ executablePath, args: FLAGS });
  let failed = 0;
  try {
    const page = await opened(browser, { viewport: { width: 1500, height: 950 } });
    for (const [name, test] of Object.entries(tests)) {
      try {
        const told = await test(page, browser);
        console.log(`ok: ${name}${told ? ` (${told})` : ""}`);
      } catch (error) {
        failed += 1;
        console.log(`FAILED: ${name}\n${error.stack}`);
      }
    }
    console.log(await browser.version());
  } finally {
    await browser.close();
  }
  if (faults.length > 0) console.log(`FAILED: the console has ${faults.length} faults\n${faults.join("\n")}`);
  process.exitCode = failed + faults.length > 0 ? 1 : 0;
}

main();
