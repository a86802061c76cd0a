// Drives a browser through the page: `node browser.cjs ADDRESS CHROMIUM FOLDER`.

const { mkdirSync } = require("node:fs");
const { chromium } = require("playwright-core");
const { faults, opened, pictures } = require("./helpers.cjs");

const [, executablePath] = process.argv.slice(2);

const tests = { ...require("./motion.cjs"), ...require("./memory.cjs"), ...require("./typing.cjs"), ...require("./face.cjs") };

const FLAGS = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
  "--disable-background-networking", "--disable-component-update", "--disable-sync",
];

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
