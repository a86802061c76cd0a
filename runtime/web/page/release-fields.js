// The fields for a release: angles of the root and of all others, and of copies to either side.

/** Fields by the names that a state has for them. */
const FIELDS = { root: "root", others: "rest", apart: "difference" };

const entries = Object.entries(FIELDS).map(([name, id]) => [name, document.getElementById(id)]);

/** Writes a release (degrees). */
export function writeRelease(release) {
  for (const [name, field] of entries) field.value = release[name];
}

/** The release that is written, within the bounds of the fields; what is not a number is as it was `before`. */
export function readRelease(before) {
  const read = entries.map(([name, field]) => {
    const typed = field.valueAsNumber;
    const known = Number.isFinite(typed) ? typed : before?.[name] ?? 0;
    field.value = Math.min(Math.max(known, Number(field.min)), Number(field.max));
    return [name, Number(field.value)];
  });
  return Object.fromEntries(read);
}

/** Returns true if two releases differ. */
export const areDifferent = (one, other) => entries.some(([name]) => one?.[name] !== other?.[name]);

/** Calls `release()` at Enter in a field. */
export function onEnter(release) {
  for (const [, field] of entries) field.addEventListener("keydown", ({ key }) => key === "Enter" && release());
}
