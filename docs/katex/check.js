#!/usr/bin/env node
// Fails where KaTeX refuses a formula of the book: in the book itself it would stand in red.
"use strict";

const fs = require("fs");
const path = require("path");
const katex = require("./katex.min.js");

const docs = path.dirname(__dirname);
const pages = fs.readdirSync(docs, { recursive: true }).filter((name) => name.endsWith(".md"));
const formula = /^ *```math\n([^]*?)^ *```$|\$`([^`]+)`\$/gm;
let count = 0;
for (const page of pages) {
    const text = fs.readFileSync(path.join(docs, page), "utf8");
    for (const [, displayed, inline] of text.matchAll(formula)) {
        count += 1;
        try {
            katex.renderToString(displayed ?? inline, { displayMode: displayed !== undefined });
        } catch (refusal) {
            console.error(`${page}: ${refusal.message}`);
            process.exitCode = 1;
        }
    }
}
console.log(`${count} formulas`);
