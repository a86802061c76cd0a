// Loads the WebAssembly. It stands packed in the folder, so that it is as short from a server
// that does not pack what it sends.

import initialise from "./wasm/branched_pendulum_web.js";

/** Makes the functions of the WebAssembly ready. */
export async function start() {
  const address = new URL("wasm/branched_pendulum_web.packed", import.meta.url);
  const packed = await fetch(address);
  if (!packed.ok) throw new Error(`${address}: ${packed.status}`);
  const bytes = packed.body.pipeThrough(new DecompressionStream("gzip"));
  const headers = { "Content-Type": "application/wasm" };
  await initialise({ module_or_path: new Response(bytes, { headers }) });
}
