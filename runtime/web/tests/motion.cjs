// Motion, energies, trees and the map.

const assert = require("node:assert/strict");
const { pictures, FRAMES, ENERGY, motion, run, frames, endOnScreen, degrees, given, table } = require("./helpers.cjs");

module.exports = {
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

  async "H_d and W of any tree with copies, in a table that closes"(page) {
    for (const example of ["1", "3"]) {
      await page.selectOption("#example", example);
      await run(page, false);
      await frames(page, 600, 1 / 240);
      const { columns, rows } = table(await given(page, "#motion-csv"));
      const of = (name) => columns.indexOf(name);
      const [time, energy, w, work] = ["time (s)", "energy of scale 1 from momenta (J)", "W of scale 1 from momenta (W)", "work of scale 1 from momenta (W)"].map(of);
      assert.ok(time === 0 && energy > 0 && w > 0 && work > 0, columns.join());
      let gained = 0;
      for (let row = 1; row < rows.length; row += 1) {
        const rate = (index) => rows[index][w] + rows[index][work];
        gained += 0.5 * (rows[row][time] - rows[row - 1][time]) * (rate(row) + rate(row - 1));
      }
      const energies = rows.map((row) => row[energy]);
      const change = energies.at(-1) - energies[0];
      assert.ok(Math.abs(gained - change) < 0.01 * Math.max(...energies), `${gained} against ${change}`);
    }
    // At every branching: no scale is at rest.
    await page.selectOption("#example", "1");
    const { columns, rows } = table(await given(page, "#motion-csv"));
    for (const scale of [1, 2]) assert.ok(rows[0][columns.indexOf(`energy of scale ${scale} from momenta (J)`)] > 0);
  },

  async "zero is drawn as zero"(page) {
    await page.selectOption("#example", "0");
    await page.fill("#difference", "0");
    await page.click("#release");
    await run(page, false);
    await frames(page, 120);
    // The curve of the difference lies in the band of zero, below the lowest power of ten.
    const low = await page.evaluate(() => {
      const canvas = document.querySelector("#energies");
      const { data, width, height } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
      const rows = new Set();
      for (let i = 0; i < data.length; i += 4) {
        const [red, green, blue, alpha] = data.slice(i, i + 4);
        if (alpha > 200 && red > 150 && green < 110 && blue < 110) rows.add(Math.floor(i / 4 / width));
      }
      return [...rows].map((row) => row / height);
    });
    assert.ok(low.length > 0 && Math.min(...low) > 0.8, `${low}`);
    await page.click("#reset");
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
    const [root, rest] = [100, 67];
    await run(page, false);
    const [x, y] = await page.evaluate(async (angles) => {
      const { mapPlaceOf } = await import("./main.js");
      return mapPlaceOf(...angles.map((angle) => (angle * Math.PI) / 180));
    }, [root, rest]);
    await page.locator("#map").click({ position: { x, y } });
    const after = await motion(page);
    assert.equal(after.time, 0);
    const now = degrees(after);
    assert.ok(Math.abs(now[0] - root) < 1, `${now}`);
    assert.ok(Math.abs((now[1] + now[2]) / 2 - rest) < 1, `${now}`);
    // Kept while a slider moves, and back at once where it returns.
    const count = async () => Number((await page.textContent("#map-state")).match(/^\d+/)[0]);
    const before = await count();
    const slide = (value) => page.evaluate((value) => {
      const field = document.querySelector('[aria-label="mass of child m, number"]');
      field.value = value;
      field.dispatchEvent(new Event("change"));
    }, value);
    await slide(0.2);
    await page.waitForFunction(
      (before) => Number.parseInt(document.querySelector("#map-state").textContent) < before, before,
    );
    await slide(0.10531);
    await page.waitForFunction(
      (before) => Number.parseInt(document.querySelector("#map-state").textContent) >= before, before,
    );
    const shades = await page.evaluate(() => {
      const map = document.querySelector("#map");
      const { data } = map.getContext("2d").getImageData(0, 0, map.width, map.height);
      const colours = new Set();
      for (let i = 0; i < data.length; i += 4) colours.add(data.slice(i, i + 3).join());
      return colours.size;
    });
    assert.ok(shades > 50, `${shades} colours`);
    const { columns, rows } = table(await given(page, "#map-csv"));
    assert.equal(columns.length, 5);
    for (const own of [0, 1, 2]) assert.ok(rows.length >= 100 && rows.some((row) => row[4] === own), `class ${own}`);
    return page.textContent("#map-state");
  },

  async "every example runs"(page) {
    const titles = await page.locator("#example option:not([hidden])").allTextContents();
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
};
