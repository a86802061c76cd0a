// Opens every notebook of a site in Chromium: `node browser.cjs ADDRESS SITE CHROMIUM PICTURES`.
// If the site has the wheel, all cells are executed, and none may end with an error.

const { existsSync, mkdirSync, readdirSync, readFileSync } = require("node:fs");
const { basename, join } = require("node:path");
const { chromium } = require("playwright-core");

const [address, site, executablePath, pictures] = process.argv.slice(2);
const NOTEBOOKS = join(__dirname, "../notebooks");
const FLAGS = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync",
];
// For all cells of a notebook, ms.
const PATIENCE = 1_200_000;

/** Executes all cells and returns the seconds that this took. */
async function execute(page) {
  const begin = Date.now();
  await page.getByRole("menuitem", { name: "Run", exact: true }).click();
  await page.getByRole("menuitem", { name: "Run All Cells", exact: true }).click();
  const error = await page.waitForFunction(() => {
    const texts = (selector) => [...document.querySelectorAll(selector)].map((element) => element.textContent);
    const error = texts(".jp-OutputArea-output").find((text) => text.includes("Traceback (most recent call last)"));
    return error || (texts(".jp-CodeCell .jp-InputPrompt").every((prompt) => /\[\d+\]/.test(prompt)) && "none");
  }, undefined, { timeout: PATIENCE, polling: 500 });
  const message = await error.jsonValue();
  if (message !== "none") throw new Error(message);
  return (Date.now() - begin) / 1000;
}

/** Opens a notebook, compares it with the file in the repository, and executes it if possible. */
async function check(browser, name) {
  const { cells } = JSON.parse(readFileSync(join(NOTEBOOKS, name), "utf8"));
  const codes = cells.filter((cell) => cell.cell_type === "code").length;
  const page = await browser.newPage({ viewport: { width: 1280, height: 1000 } });
  try {
    await page.goto(`${address}notebooks/index.html?path=python/notebooks/${name}`);
    // Cells below the window are shown as they come near it.
    await page.waitForSelector(".jp-CodeCell .cm-content");
    await page.waitForFunction((codes) => document.querySelectorAll(".jp-CodeCell").length === codes, codes);
    const seconds = existsSync(join(site, "pyodide")) ? await execute(page) : undefined;
    return seconds === undefined ? "opened" : `executed in ${seconds.toFixed(0)} s`;
  } finally {
    await page.screenshot({ path: join(pictures, `${basename(name, ".ipynb")}.png`) });
    await page.close();
  }
}

async function main() {
  mkdirSync(pictures, { recursive: true });
  const browser = await chromium.launch({ executablePath, args: FLAGS });
  try {
    for (const name of readdirSync(NOTEBOOKS).filter((name) => name.endsWith(".ipynb"))) {
      try {
        console.log(`ok: ${name} ${await check(browser, name)}`);
      } catch (error) {
        process.exitCode = 1;
        console.log(`FAILED: ${name}\n${error.stack}`);
      }
    }
  } finally {
    await browser.close();
  }
}

main();
