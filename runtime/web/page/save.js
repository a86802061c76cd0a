// Files that the page gives away: tables and pictures.

import { colour } from "./canvas.js";

function give(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

/** A name as a cell of a table. */
const quoted = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

/** Gives a table: names of the columns with their units, rows of numbers. */
export function saveTable(columns, rows, name) {
  const lines = [columns.map(quoted), ...rows].map((row) => row.join(","));
  give(new Blob([lines.join("\n"), "\n"], { type: "text/csv" }), name);
}

/** Gives a canvas as a picture on the colour of the page. */
export function savePicture(canvas, name) {
  const copy = document.createElement("canvas");
  [copy.width, copy.height] = [canvas.width, canvas.height];
  const context = copy.getContext("2d");
  context.fillStyle = colour("panel");
  context.fillRect(0, 0, copy.width, copy.height);
  context.drawImage(canvas, 0, 0);
  copy.toBlob((blob) => blob && give(blob, name), "image/png");
}
