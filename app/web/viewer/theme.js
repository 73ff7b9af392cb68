/** The colours and the font that the style sheet gives to the root, for what is painted. */

const NAMES = ["canvas", "text", "quiet", "border", "label", "label-text", "label-quiet"];

export function themeOf(root) {
  const style = getComputedStyle(root);
  const colour = (name) => style.getPropertyValue(`--${name}`).trim();
  const theme = Object.fromEntries(
    NAMES.map((name) => [name.replace(/-(\w)/, (_, c) => c.toUpperCase()), colour(name)]),
  );
  return { ...theme, font: style.fontFamily, isDark: colour("dark") === "1" };
}

/** "#16181B" as numbers from 0 to 255. */
const bytesOf = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));

/**
 * The scene's colours under a theme: maps of distances and of differences, and those of the surface, of its inside,
 * and of where it is cut.
 * @returns {{map: number[][], diverging: number[][], background: number[], undefined: number[],
 *   back: number[], section: number[]}} from 0 to 255
 */
export function coloursOf({ colours }, theme) {
  const { map, dark_map, diverging, background, dark_background, back, dark_back, section, dark_section } = colours;
  const chosen = theme.isDark ? (dark_map ?? map) : map;
  const behind = (theme.isDark ? dark_background : background) ?? bytesOf(theme.canvas);
  return {
    map: stretched(chosen),
    diverging: stretched(diverging ?? chosen),
    background: behind,
    undefined: colours.undefined,
    back: theme.isDark ? (dark_back ?? back) : back,
    section: theme.isDark ? dark_section : section,
  };
}

/** 256 colours that lead evenly through those of a map. */
function stretched(map) {
  return Array.from({ length: 256 }, (_, k) => {
    const at = (k / 255) * (map.length - 1), below = Math.min(Math.floor(at), map.length - 2);
    return map[below].map((x, channel) => Math.round(x + (at - below) * (map[below + 1][channel] - x)));
  });
}
