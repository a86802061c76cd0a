// Trees that are typed: their release, their messages, their size.

const assert = require("node:assert/strict");
const { pictures, opened, motion, run, frames, degrees } = require("./helpers.cjs");

const OWN = `gravity = 9.81,
stem: rod(mass = 0.25, length = 0.28, friction = c) [
    arm: rod(mass = 0.1, length = 0.22, friction = c) * 2
], siblings(arm, spring = k)`;

const typed = async (page, text) => {
  await page.fill("#description", text);
  await page.waitForFunction((text) => location.hash.includes(encodeURIComponent(text.slice(0, 14)).slice(0, 14)), text);
};

module.exports = {
  async "a typed tree is released from the fields"(page, browser) {
    const other = await opened(browser, {}, "#tree=chain&root=70&others=25&apart=2&play=0");
    await typed(other, OWN);
    let now = await motion(other);
    assert.deepEqual(now.names, ["stem", "arm_1", "arm_2"]);
    assert.equal(now.time, 0);
    degrees(now).forEach((angle, link) => assert.ok(Math.abs(angle - [70, 27, 23][link]) < 1e-9, `${angle}`));
    for (const name of ["c", "k"]) {
      assert.ok(Number(await other.inputValue(`#parameter-${name}`)) > 0, `${name} acts`);
    }
    // Other numbers of the same links go on as they move.
    await frames(other, 30);
    await typed(other, OWN.replace("0.22", "0.2"));
    assert.ok((await motion(other)).time > 0.4);
    // An address with a mistake, mended: its own release.
    const broken = await opened(browser, {}, `#text=${encodeURIComponent(OWN.replace("mass", "mas"))}&root=33&others=11&apart=0&play=0`);
    assert.match(await broken.textContent("#message"), /did you mean `mass`/);
    await typed(broken, OWN);
    now = await motion(broken);
    assert.deepEqual(now.names, ["stem", "arm_1", "arm_2"]);
    degrees(now).forEach((angle, link) => assert.ok(Math.abs(angle - [33, 11, 11][link]) < 1e-9, `${angle}`));
    await broken.close();
    await other.close();
  },

  async "sentences of messages wrap, and marked lines keep their columns"(page, browser) {
    for (const width of [390, 1400]) {
      const other = await opened(browser, { viewport: { width, height: 844 } }, "#tree=paper&play=0");
      await other.evaluate(() => { document.querySelector("#tree-panel").open = true; });
      for (const mistake of ["gravity = 9,81, ", "gravity = g, long_name_of_a_link(mas = 1, com = 2, inertia = 3, joint = 4, friction = 5) * 2, ", "gravity = , "]) {
        await other.fill("#description", mistake + OWN);
        await other.waitForFunction(() => document.querySelector("#message").textContent !== "");
        const cut = await other.evaluate(() =>
          [...document.querySelectorAll("#message .sentence")].filter((own) => own.scrollWidth > own.clientWidth).map((own) => own.textContent));
        assert.deepEqual(cut, [], `${width} pixels`);
        assert.ok(await other.locator("#message .marked").count() > 0);
        assert.ok(await other.evaluate(() => document.documentElement.scrollWidth) <= width);
        await other.fill("#description", OWN);
        await other.waitForFunction(() => document.querySelector("#message").textContent === "");
      }
      await other.fill("#description", `gravity = 9,81, ${OWN}`);
      await other.waitForFunction(() => document.querySelector("#message").textContent !== "");
      await other.locator("#tree-panel").screenshot({ path: `${pictures}/message-${width}.png` });
      await other.close();
    }
  },

  async "labels of W have room, however small W is"(page) {
    const wide = await page.evaluate(async () => {
      const { LEFT, tickOf } = await import("./charts.js");
      const context = document.createElement("canvas").getContext("2d");
      context.font = "11px system-ui, sans-serif";
      const values = [];
      for (let exponent = -320; exponent <= 300; exponent += 1) values.push(...[1, 2, 5].map((digit) => -digit * 10 ** exponent));
      return values.map(tickOf).filter((text) => context.measureText(text).width > LEFT - 6);
    });
    assert.deepEqual(wide, []);
    assert.deepEqual(
      await page.evaluate(async () => [0, 0.002, -0.5, 1, -2000, 2e-6, -5e-11, 1e4].map((await import("./charts.js")).tickOf)),
      ["0", "0.002", "−0.5", "1", "−2000", "2·10⁻⁶", "−5·10⁻¹¹", "1·10⁴"],
    );
  },

  async "points of the map have a class"(page) {
    const classes = await page.evaluate(async () => {
      const { classOf } = await import("./release-map.js");
      return [[0.2, 0.001], [3, 0.001], [3, 0.3], [0.2, 0.3], [0.4, 0.02], [3, 0.97], [Number.NaN, Number.NaN], [2, Infinity]]
        .map(([rate, difference]) => classOf({ rate, difference }));
    });
    assert.deepEqual(classes, ["determined", "determined", "chaotic", "open", "open", "open", "open", "open"]);
  },

  async "thousands of links are followed, or paused with a word"(page, browser) {
    const other = await opened(browser, {}, "#tree=paper&play=0");
    await run(other, true);
    const rule = "gravity = 9.81, a: generations(count = 12, branching = 2, shape = rod, mass = 0.1, length = 0.3)";
    const begun = Date.now();
    await typed(other, rule);
    assert.equal((await motion(other)).names.length, 4095);
    const built = (Date.now() - begun) / 1000;
    await other.waitForFunction(() => document.querySelector("#failure").textContent !== "" || document.querySelector("#clock").textContent > "1.00");
    const told = await other.textContent("#failure");
    if (told !== "") {
      assert.match(told, /4095 links takes [\d.]+ s of computing here.*paused/);
      assert.equal(await other.textContent("#play"), "Play");
      const { time } = await motion(other);
      await other.click("#step");
      assert.ok((await motion(other)).time > time);
    }
    // Another tree moves again.
    await other.selectOption("#example", "0");
    assert.equal(await other.textContent("#failure"), "");
    await other.close();
    return `built after ${built.toFixed(1)} s; ${told}`;
  },
};
