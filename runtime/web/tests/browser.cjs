// Drives a browser through the page: `node browser.cjs ADDRESS CHROMIUM FOLDER`.

const assert = require("node:assert/strict");
const { mkdirSync, readFileSync } = require("node:fs");
const { pathToFileURL } = require("node:url");
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

  async "the state stands in the address, and comes back from it"(page, browser) {
    const part = "#tree=arms&set.m=0.05&root=33&others=-12&apart=1.5&speed=0.25&method=rk4&setting=0.002&definition=parseval";
    const other = await opened(browser, {}, part);
    const field = (id) => other.inputValue(id);
    assert.deepEqual(
      await Promise.all(["#root", "#rest", "#difference", "#speed", "#method", "#definition"].map(field)),
      ["33", "-12", "1.5", "0.25", "rk4", "parseval"],
    );
    assert.equal(Number(await field("#parameter-m")), 0.05);
    assert.equal(Number(await field("#setting-number")), 0.002);
    assert.equal(new URL(other.url()).hash, part);
    // A tree of one's own: to the address, and from there to another page.
    const text = (await field("#description")).replace("* 2", "* 3");
    await other.fill("#description", text);
    await other.waitForFunction(() => location.hash.includes("text="));
    await other.click("#share");
    const link = await field("#share-link");
    assert.match(await field("#share-embed"), /<iframe src="[^"]*[?]embed#text=/);
    await other.goto(link);
    await other.reload();
    await other.waitForFunction(() => document.querySelector("#link").options.length > 0);
    assert.equal(await field("#description"), text);
    assert.equal((await motion(other)).names.length, 7);
    // Another address in the same page; and one with a mistake, which is told.
    await other.evaluate(() => { location.hash = "#tree=chain&root=10&others=20&apart=0"; });
    await other.waitForFunction(() => document.querySelector("#root").value === "10");
    assert.deepEqual((await motion(other)).names, ["first", "second", "third"]);
    await other.close();
    const wrong = await opened(browser, {}, "#text=gravity%20%3D%201%2C%20a(mas%20%3D%201)");
    assert.match(await wrong.textContent("#message"), /did you mean `mass`/);
    assert.equal((await motion(wrong)).names.length, 3);
    await wrong.close();
  },

  async "undo, redo and reset"(page) {
    await page.selectOption("#example", "0");
    await run(page, false);
    const hash = () => page.evaluate(() => location.hash);
    const settled = (pattern) =>
      page.waitForFunction((pattern) => new RegExp(pattern).test(location.hash), pattern);
    await settled("tree=paper&root=47.8");
    const first = await hash();
    await page.selectOption("#link", { label: "parent" });
    await page.click("#more");
    await settled("text=");
    await page.fill("#root", "1e9");
    await page.click("#release");
    assert.equal(await page.inputValue("#root"), "180", "within its bounds");
    await settled("root=180");
    await page.click("#undo");
    assert.equal(await page.inputValue("#root"), "47.8");
    assert.equal((await motion(page)).names.length, 4);
    await page.focus("#pendulum");
    await page.keyboard.press("Control+z");
    assert.equal((await motion(page)).names.length, 3);
    assert.equal(await hash(), first);
    await page.click("#redo");
    assert.equal((await motion(page)).names.length, 4);
    await page.click("#reset");
    await settled("tree=paper");
    assert.equal((await motion(page)).time, 0);
  },

  async "a step, slow motion and speed"(page) {
    await page.click("#step");
    const before = (await motion(page)).time;
    await page.click("#step");
    assert.ok(Math.abs((await motion(page)).time - before - 1 / 60) < 1e-12);
    await page.selectOption("#speed", "0.1");
    await page.click("#step");
    assert.ok(Math.abs((await motion(page)).time - before - 1.1 / 60) < 1e-12);
    await page.selectOption("#speed", "1");
  },

  async "keys choose a link and pull it"(page) {
    await page.click("#reset");
    await run(page, false);
    await page.focus("#pendulum");
    await page.keyboard.press("PageDown");
    assert.equal(await page.inputValue("#link"), "1");
    await page.keyboard.press("PageUp");
    const before = degrees(await motion(page))[0];
    for (let press = 0; press < 6; press += 1) await page.keyboard.press("ArrowLeft");
    await page.waitForFunction(
      async (limit) => (await import("./main.js")).motion().angles[0] * 180 / Math.PI < limit,
      before - 10,
    );
    await page.keyboard.press("Enter");
    const { time } = await motion(page);
    await page.waitForTimeout(200);
    assert.equal((await motion(page)).time, time, "it is let go, and stands");
    await page.keyboard.press("Space");
    assert.equal(await page.textContent("#play"), "Pause");
    await run(page, false);
  },

  async "a number beside a slider"(page) {
    const field = page.getByLabel("mass of child m, number");
    await field.fill("0.9");
    await field.press("Enter");
    assert.equal(Number(await page.inputValue("#parameter-m")), Number(await page.getAttribute("#parameter-m", "max")));
    assert.match(await field.inputValue(), /^0.9$/);
    await field.fill("-1");
    await field.press("Enter");
    assert.match(await page.textContent("#message"), /not negative/);
    assert.equal(await field.inputValue(), "0.9");
    await page.click("#reset");
  },

  async "H_d and W of any tree with copies, in a table that closes"(page) {
    for (const example of ["1", "3"]) {
      await page.selectOption("#example", example);
      await run(page, false);
      await frames(page, 600, 1 / 240);
      const { columns, rows } = table(await given(page, "#motion-csv"));
      const of = (name) => columns.indexOf(name);
      const [time, energy, w, work] = ["time (s)", "energy of scale 1 (J)", "W of scale 1 (W)", "work of scale 1 (W)"].map(of);
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
    for (const scale of [1, 2]) assert.ok(rows[0][columns.indexOf(`energy of scale ${scale} (J)`)] > 0);
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

  async "what grows at 47.8° is shown"(page) {
    const begun = Date.now();
    await page.click("#compare");
    await page.waitForFunction(() => document.querySelector("#compare-end").textContent !== "");
    const told = (await page.textContent("#compare-end")).replace(/\s+/g, " ");
    const [low, high] = [...told.matchAll(/([\d.,]+) times/g)].map(([, number]) => Number(number.replaceAll(",", "")));
    assert.ok(low < 5 && high > 100, told);
    await page.screenshot({ path: `${pictures}/comparison.png`, fullPage: true });
    return `${told} (after ${((Date.now() - begun) / 1000).toFixed(0)} s)`;
  },

  async "sixty frames a second, up to 31 links"(page, browser) {
    const told = [];
    for (const tree of ["paper", "five-generations"]) {
      const other = await opened(browser, { viewport: { width: 1500, height: 950 } }, `#tree=${tree}`);
      await other.evaluate(() => { document.querySelector("#map-panel").open = false; });
      const { links, work, gaps } = await other.evaluate(async () => {
        const { frame, motion, run } = await import("./main.js");
        run(true);
        const gaps = [];
        let last;
        await new Promise((resolve) => {
          const next = (now) => {
            if (last) gaps.push(now - last);
            last = now;
            if (gaps.length < 240) requestAnimationFrame(next);
            else resolve();
          };
          requestAnimationFrame(next);
        });
        run(false);
        const work = [];
        for (let number = 0; number < 240; number += 1) {
          const begun = performance.now();
          frame(1 / 60);
          work.push(performance.now() - begun);
        }
        return { links: motion().names.length, work, gaps };
      });
      const at = (list, part) => list.sort((a, b) => a - b)[Math.floor(part * (list.length - 1))];
      const [middle, late] = [at(work, 0.5), at(work, 0.95)];
      assert.ok(middle < 1000 / 60, `${links} links: ${middle} ms a frame`);
      const rate = 1000 / (gaps.reduce((sum, gap) => sum + gap, 0) / gaps.length);
      told.push(`${links} links: work ${middle.toFixed(1)} ms a frame, 95 % below ${late.toFixed(1)} ms, ${rate.toFixed(0)} frames a second`);
      await other.close();
    }
    return told.join("; ");
  },

  async "axe finds nothing, at a desk and on a phone, light and dark"(page, browser) {
    const options = [
      { viewport: { width: 1500, height: 950 } },
      { viewport: { width: 390, height: 844 }, hasTouch: true, colorScheme: "dark" },
    ];
    for (const option of options) {
      for (const part of ["", "teachers.html", "?embed"]) {
        const other = watched(await browser.newPage(option));
        await other.goto(address + part);
        if (part !== "teachers.html") {
          await other.waitForFunction(() => document.querySelector("#link").options.length > 0);
        }
        assert.deepEqual(await violations(other), [], `${part} ${JSON.stringify(option)}`);
        await other.close();
      }
    }
  },

  async "an embedded page is the picture and its controls"(page, browser) {
    const other = await opened(browser, { viewport: { width: 640, height: 620 } }, "?embed#tree=arms");
    assert.ok(!(await other.isVisible("#energy-panel")) && (await other.isVisible("#pendulum")));
    assert.match(await other.getAttribute("#whole", "href"), /^[^?]*#tree=arms/);
    assert.ok(await other.evaluate(() => document.documentElement.scrollHeight <= 620), "it fits");
    await other.screenshot({ path: `${pictures}/embedded.png` });
    await other.close();
  },

  async "the teachers' tasks open what they name"(page, browser) {
    const other = watched(await browser.newPage({ viewport: { width: 900, height: 900 } }));
    await other.goto(`${address}teachers.html`);
    await other.screenshot({ path: `${pictures}/teachers.png`, fullPage: true });
    const links = await other.locator("a.primary").evaluateAll((all) => all.map(({ href }) => href));
    assert.equal(links.length, 3);
    for (const link of links) {
      const task = watched(await browser.newPage());
      await task.goto(link);
      await task.waitForFunction(() => document.querySelector("#link").options.length > 0);
      assert.equal(task.url(), link, "nothing of the address is lost");
      await task.close();
    }
    await other.close();
  },

  async "a word from a file, and without JavaScript"(page, browser) {
    // Browsers refuse modules from files: that is no fault of the page's.
    const file = await browser.newPage();
    await file.goto(pathToFileURL("target/page/index.html").href);
    assert.ok(await file.isVisible("#from-file"));
    await file.close();
    const context = await browser.newContext({ javaScriptEnabled: false });
    const plain = await context.newPage();
    await plain.goto(address);
    assert.match(await plain.textContent("noscript"), /needs JavaScript/);
    await context.close();
  },

  async "targets of a finger have 44 pixels"(page, browser) {
    const phone = await opened(browser, { viewport: { width: 390, height: 844 }, hasTouch: true });
    const small = await phone.evaluate(() => {
      for (const panel of document.querySelectorAll("details")) panel.open = true;
      const targets = document.querySelectorAll("button, select, input, summary, textarea, a");
      return [...targets].flatMap((target) => {
        // A box to be ticked has its label.
        const { width, height } = (target.type === "checkbox" ? target.parentElement : target).getBoundingClientRect();
        return width > 0 && Math.min(width, height) < 43.9 ? [`${target.id || target.outerHTML}: ${width} × ${height}`] : [];
      });
    });
    assert.deepEqual(small, []);
    await phone.close();
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
    assert.ok(rows.length >= 100 && rows.some((row) => row[4] === 0) && rows.some((row) => row[4] === 1));
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

  async "pictures, at a desk and on a phone, light and dark"(page, browser) {
    await page.fill("#root", "47.8");
    await page.fill("#rest", "0");
    await page.click("#release");
    await frames(page, 900);
    await page.waitForFunction(() => /^\d{4} of|^4608 points/.test(document.querySelector("#map-state").textContent));
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
    await phone.setViewportSize({ width: 844, height: 390 });
    await phone.waitForTimeout(300);
    await phone.screenshot({ path: `${pictures}/phone-on-its-side.png` });
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
