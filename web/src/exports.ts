/** What can be taken away: eigenvalues as CSV, the figure as SVG. */

import type { Curves } from "./chart";
import { colourOf } from "./style";
import { readable } from "./units";

export function save(name: string, content: string | Blob, type = "text/plain"): void {
  const blob = typeof content === "string" ? new Blob([content], { type }) : content;
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** The columns of `singletrack eigenvalues --csv`: speed, then real and imaginary part of each mode. */
export function csv(curves: Curves): string {
  const counts = new Map<string, number>();
  const columns = curves.names.map((name) => {
    counts.set(name, (counts.get(name) ?? 0) + 1);
    return curves.names.filter((other) => other === name).length > 1 ? `${name} ${counts.get(name)}` : name;
  });
  const header = ["speed", ...columns.flatMap((name) => [`Re ${name}`, `Im ${name}`])];
  const rows = Array.from(curves.speeds, (speed, k) => [speed, ...curves.eigenvalues.flatMap((roots) => [roots[k].re, roots[k].im])]);
  return [header, ...rows].map((row) => row.join(",")).join("\n") + "\n";
}

const SIZE = { width: 640, height: 420, left: 56, right: 14, top: 34, bottom: 44 };
const LIMIT = 10;

/** The eigenvalue figure as SVG, for a page or a paper. */
export function figure(curves: Curves, title: string): string {
  const { width, height, left, right, top, bottom } = SIZE;
  const last = curves.speeds.at(-1) as number;
  const x = (v: number) => left + ((width - left - right) * v) / last;
  const y = (value: number) => top + ((height - top - bottom) * (LIMIT - value)) / (2 * LIMIT);
  const parts = [`<rect width="${width}" height="${height}" fill="white"/>`];
  for (const [low, high] of curves.critical.stableRanges) {
    const end = Math.min(high, last);
    if (low < last) parts.push(`<rect x="${x(low)}" y="${top}" width="${x(end) - x(low)}" height="${height - top - bottom}" fill="#DDEFD9"/>`);
  }
  for (let v = 0; v <= last + 1e-9; v += 2) {
    parts.push(`<text x="${x(v)}" y="${height - bottom + 16}" text-anchor="middle">${readable(v)}</text>`);
    parts.push(`<line x1="${x(v)}" x2="${x(v)}" y1="${height - bottom}" y2="${height - bottom + 4}" stroke="black"/>`);
  }
  for (let value = -LIMIT; value <= LIMIT; value += 5) {
    parts.push(`<text x="${left - 8}" y="${y(value) + 4}" text-anchor="end">${readable(value)}</text>`);
    parts.push(`<line x1="${left - 4}" x2="${left}" y1="${y(value)}" y2="${y(value)}" stroke="black"/>`);
  }
  parts.push(`<path d="M${left} ${top}V${height - bottom}H${width - right}M${left} ${y(0)}H${width - right}" fill="none" stroke="black"/>`);
  curves.names.forEach((name, mode) => {
    const roots = curves.eigenvalues[mode];
    parts.push(path(Array.from(curves.speeds, (v, k) => [x(v), y(roots[k].re), Math.abs(roots[k].re) <= LIMIT]), colourOf(name), ""));
    parts.push(path(Array.from(curves.speeds, (v, k) => [x(v), y(roots[k].im), roots[k].im > 0 && roots[k].im <= LIMIT]), colourOf(name), "6 4"));
  });
  [...new Set(curves.names)].forEach((name, k) => {
    parts.push(`<text x="${left + 10 + 90 * k}" y="${height - bottom - 8}" fill="${colourOf(name)}">${escape(name)}</text>`);
  });
  parts.push(`<text x="${left}" y="20" font-size="14">${escape(title)}</text>`);
  parts.push(`<text x="${(left + width - right) / 2}" y="${height - 8}" text-anchor="middle">forward speed v (m/s)</text>`);
  parts.push(`<text transform="translate(14 ${(top + height - bottom) / 2}) rotate(-90)" text-anchor="middle">Re λ solid, Im λ dashed (1/s)</text>`);
  return `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" font-family="sans-serif" font-size="12">${parts.join("")}</svg>\n`;
}

function path(points: [number, number, boolean][], colour: string, dash: string): string {
  let pen = false;
  const steps = points.map(([x, y, drawn]) => {
    const step = drawn ? `${pen ? "L" : "M"}${x.toFixed(2)} ${y.toFixed(2)}` : "";
    pen = drawn;
    return step;
  });
  return `<path d="${steps.join("")}" fill="none" stroke="${colour}" stroke-width="1.8" stroke-dasharray="${dash}"/>`;
}

const escape = (text: string): string => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
