// What the page looks like, and for whom.

const assert = require("node:assert/strict");
const { pathToFileURL } = require("node:url");
const { address, pictures, watched, opened, frames, violations } = require("./helpers.cjs");

module.exports = {
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

  async "copies have colours of their own"(page) {
    const colours = await page.evaluate(async () => {
      const { coloursOf } = await import("./palette.js");
      const of = (parents) => parents.map((_, link) => coloursOf(parents)(link));
      // Nine children; and a limb, a limb, two twigs on each.
      return [of([-1, ...new Array(9).fill(0)]), of([-1, 0, 1, 1, 0, 4, 4])];
    });
    for (const own of colours) assert.equal(new Set(own).size, own.length, own.join());
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
