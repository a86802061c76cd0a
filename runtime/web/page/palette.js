// Colours of links: copies that hang from one link differ in them.

/** Hues of copies, degrees: blue and orange first, which all eyes tell apart. */
const HUES = [212, 28, 152, 285, 48, 188, 335, 100];

/** Range of hue (degrees) and lightness (per cent) among copies on a copy, halved in each generation. */
const SPREAD = { hue: 44, lightness: 26 };

const dark = matchMedia("(prefers-color-scheme: dark)");

/** A colour for each link by those that they hang from (-1 for the root): `of(link, alpha)`. */
export function coloursOf(parents) {
  const children = parents.map(() => []);
  parents.forEach((parent, own) => children[parent]?.push(own));
  const tints = [{ hue: 220, saturation: 12, lightness: 0, spread: SPREAD }];
  parents.forEach((_, link) => {
    children[link].forEach((child, place) => {
      tints[child] = tint(tints[link], place, children[link].length);
    });
  });
  return (link, alpha = 1) => {
    const { hue, saturation, lightness } = tints[link];
    const middle = dark.matches ? 66 : 44;
    return `hsl(${hue} ${saturation}% ${middle + lightness}% / ${alpha})`;
  };
}

/** The tint of a child on a link: its own where it is the only one. */
function tint(above, place, count) {
  if (count === 1) return above;
  if (above.saturation < 50) {
    const hue = count > HUES.length ? HUES[0] + (360 * place) / count : HUES[place];
    return { ...above, hue, saturation: 70 };
  }
  const part = place / (count - 1) - 0.5;
  return {
    ...above,
    hue: above.hue + part * above.spread.hue,
    lightness: above.lightness + part * above.spread.lightness,
    spread: { hue: above.spread.hue / 2, lightness: above.spread.lightness / 2 },
  };
}
