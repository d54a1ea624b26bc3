/** Colours of modes and parts: distinguishable with all common kinds of colour blindness (Okabe and Ito). */

const MODES: Record<string, string> = { weave: "#0072B2", capsize: "#D55E00", castering: "#009E73" };
const OTHERS = ["#CC79A7", "#E69F00", "#56B4E9", "#8C6BB1"];

export const COLOURS = { scheme: "", text: "", grid: "", stable: "" };

/** The colour of a mode; modes beyond those of every bicycle take turns. */
export function colourOf(mode: string): string {
  if (!(mode in MODES)) MODES[mode] = OTHERS[(Object.keys(MODES).length - 3) % OTHERS.length];
  return MODES[mode];
}

/** Reads the colours of the page's scheme, dark or light. */
export function readScheme(): void {
  const style = getComputedStyle(document.documentElement);
  COLOURS.scheme = document.documentElement.dataset.scheme ?? "";
  COLOURS.text = style.getPropertyValue("--text").trim();
  COLOURS.grid = style.getPropertyValue("--line").trim();
  COLOURS.stable = style.getPropertyValue("--stable").trim();
}
