// The dialog with the page's address and what embeds it.

import { addressOf } from "./state.js";

const element = (id) => document.getElementById(id);

async function copy(field) {
  field.select();
  try {
    await navigator.clipboard.writeText(field.value);
    element("share-told").textContent = "Copied.";
  } catch {
    // Browsers give the clipboard to pages from safe addresses only.
    element("share-told").textContent = "Selected: copy it by Ctrl-C.";
  }
}

/** Makes the dialog; `current()` is the page's state. */
export function sharing(current) {
  element("share").addEventListener("click", () => {
    const state = current();
    element("share-link").value = addressOf(state);
    const address = addressOf(state, true).replaceAll("&", "&amp;").replaceAll('"', "&quot;");
    element("share-embed").value =
      `<iframe src="${address}" title="A branched pendulum" width="640" height="620" loading="lazy"></iframe>`;
    element("share-told").textContent = "";
    element("share-dialog").showModal();
  });
  for (const button of document.querySelectorAll("[data-copy]")) {
    button.addEventListener("click", () => copy(element(button.dataset.copy)));
  }
}
