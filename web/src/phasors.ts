/** Eigenmotions as phasors: one circle a mode, one arrow a coordinate. */

import { angle, type Complex, size } from "./complex";
import { colourOf } from "./style";
import { readable } from "./units";

const NAMESPACE = "http://www.w3.org/2000/svg";
const ARROWS = ["#555", "#CC79A7", "#E69F00", "#56B4E9"];

function svg(name: string, attributes: Record<string, string | number>, text = ""): SVGElement {
  const element = document.createElementNS(NAMESPACE, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  element.textContent = text;
  return element;
}

/** Draws the eigenmotions into a host. */
export function drawPhasors(host: HTMLElement, coordinates: string[], modes: { name: string; root: Complex; motion: Complex[] }[]): void {
  host.replaceChildren(...modes.map((mode) => onePhasor(coordinates, mode)));
}

function onePhasor(coordinates: string[], mode: { name: string; root: Complex; motion: Complex[] }): SVGElement {
  const picture = svg("svg", { viewBox: "-60 -62 120 150", role: "img", class: "phasor" });
  const parts = mode.motion.map((part, k) => `${coordinates[k]} ${readable(size(part), 2)} at ${Math.round((angle(part) * 180) / Math.PI)}°`);
  picture.setAttribute("aria-label", `${mode.name}: ${parts.join(", ")}`);
  picture.append(svg("circle", { r: 45, class: "rim" }), svg("line", { x1: -48, x2: 48, class: "rim" }), svg("line", { y1: -48, y2: 48, class: "rim" }));
  const largest = Math.max(...mode.motion.map(size)) || 1;
  mode.motion.forEach((part, k) => {
    const [x, y] = [(45 * part.re) / largest, (-45 * part.im) / largest];
    picture.append(...arrow(x, y, ARROWS[k % ARROWS.length]));
    picture.append(svg("rect", { x: -56, y: 62 + 11 * k, width: 8, height: 8, fill: ARROWS[k % ARROWS.length] }));
    picture.append(svg("text", { x: -45, y: 69.5 + 11 * k, class: "small" }, parts[k]));
  });
  picture.setAttribute("viewBox", `-60 -62 120 ${124 + 11 * mode.motion.length}`);
  picture.append(svg("text", { y: -51, "text-anchor": "middle", fill: colourOf(mode.name), class: "title" }, mode.name));
  return picture;
}

/** An arrow from the middle; of a short one the head shrinks with it. */
function arrow(x: number, y: number, colour: string): SVGElement[] {
  const length = Math.hypot(x, y);
  if (length < 0.5) return [svg("circle", { r: 1.6, fill: colour })];
  const head = Math.min(7, 0.6 * length);
  const [ux, uy] = [x / length, y / length];
  const [bx, by] = [x - head * ux, y - head * uy];
  const corners = `${x},${y} ${bx - 0.4 * head * uy},${by + 0.4 * head * ux} ${bx + 0.4 * head * uy},${by - 0.4 * head * ux}`;
  return [svg("line", { x2: bx, y2: by, stroke: colour, "stroke-width": 2 }), svg("polygon", { points: corners, fill: colour })];
}
