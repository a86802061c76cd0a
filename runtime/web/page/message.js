// Messages about a description: sentences wrap, marked lines of the text keep their columns.

/** A line of the description with its number, or the marks below it. */
const isMarked = (line) => /^\s*\d*\s*[|│]/.test(line);

/** Shows a message in an element; nothing, if the text is empty. */
export function showMessage(place, text) {
  const blocks = [];
  for (const line of text === "" ? [] : text.split("\n")) {
    const kind = isMarked(line) ? "marked" : "sentence";
    if (blocks.at(-1)?.kind === kind) blocks.at(-1).lines.push(line);
    else blocks.push({ kind, lines: [line] });
  }
  place.replaceChildren(...blocks.map(({ kind, lines }) => {
    const block = document.createElement("span");
    block.className = kind;
    block.textContent = `${lines.join("\n")}\n`;
    // What scrolls can be reached by keys.
    if (kind === "marked") block.tabIndex = 0;
    return block;
  }));
}
