// The address, steps back and forth, keys and numbers.

const assert = require("node:assert/strict");
const { opened, motion, run, degrees } = require("./helpers.cjs");

module.exports = {
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
    // It may ask for a still pendulum, or for a moving one again.
    for (const [part, button] of [["&play=0", "Play"], ["", "Pause"], ["&play=0", "Play"]]) {
      await other.evaluate((part) => { location.hash = `#tree=arms&root=20&others=${10 + Math.random()}&apart=0${part}`; }, part);
      await other.waitForFunction((button) => document.querySelector("#play").textContent === button, button);
    }
    const { time } = await motion(other);
    await other.waitForTimeout(200);
    assert.equal((await motion(other)).time, time, "it stands");
    await other.close();
    const wrong = await opened(browser, {}, "#text=gravity%20%3D%201%2C%20a(mas%20%3D%201)");
    assert.match(await wrong.textContent("#message"), /did you mean `mass`/);
    assert.equal((await motion(wrong)).names.length, 3);
    await wrong.close();
    const odd = await opened(browser, {}, "#tree=nothing&root=x&others=1e9&speed=1e9&method=dop853&setting=-1&set.nothing=1");
    assert.deepEqual(
      await Promise.all(["#root", "#rest", "#speed", "#setting-number"].map((id) => odd.inputValue(id))),
      ["47.8", "180", "10", "1.0e-6"],
    );
    assert.equal((await motion(odd)).names.length, 3);
    await odd.evaluate(() => { location.hash = "#tree=paper&method=rk4"; });
    await odd.waitForFunction(() => document.querySelector("#setting-number").value === "1.0e-2");
    await odd.close();
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
};
