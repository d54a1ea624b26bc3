/** Critical speeds and stable ranges as roots of polynomials in the speed (linear/critical.py), for one design. */

import { type LinearModel, type Quartic, quarticOf } from "./characteristic";
import { valueAt } from "./polynomial";

export interface CriticalSpeeds {
  weave: number[];
  capsize: number[];
  /** From, to; "to" may be Infinity. */
  stableRanges: [number, number][];
}

export function criticalSpeeds(model: LinearModel): CriticalSpeeds {
  const p = quarticOf(model);
  const [a4, a3, a2, a1, a0] = [p.a4[0], p.a3[0], p.a2, p.a1, p.a0];
  const capsize = positiveRoots(a0[0], a0[1], a0[2]);
  const crossings = positiveRoots(
    a3 * a1[0] * a2[0] - a4 * a1[0] ** 2 - a3 ** 2 * a0[0],
    a3 * (a1[0] * a2[1] + a1[1] * a2[0]) - 2 * a4 * a1[0] * a1[1] - a3 ** 2 * a0[1],
    a3 * a1[1] * a2[1] - a4 * a1[1] ** 2 - a3 ** 2 * a0[2],
  );
  const weave = crossings.filter((u) => valueAt(a1, u) / a3 > 0);
  return {
    weave: weave.map(Math.sqrt),
    capsize: capsize.map(Math.sqrt),
    stableRanges: stableRanges(p, [...weave, ...capsize]),
  };
}

/** Positive real roots of c0 + c1 x + c2 x², without cancellation; a double root changes no sign and is left out. */
function positiveRoots(c0: number, c1: number, c2: number): number[] {
  const discriminant = c1 * c1 - 4 * c2 * c0;
  if (!(discriminant > 0)) return [];
  const half = -0.5 * (c1 + (c1 < 0 ? -1 : 1) * Math.sqrt(discriminant));
  return [half / c2, c0 / half].filter((x) => x > 0 && Number.isFinite(x)).sort((a, b) => a - b);
}

function stableRanges(p: Quartic, bounds: number[]): [number, number][] {
  const edges = [0, ...bounds.sort((a, b) => a - b), Infinity];
  const ranges: [number, number][] = [];
  for (let k = 0; k + 1 < edges.length; k++) {
    const [low, high] = [edges[k], edges[k + 1]];
    if (!(high > low) || !isStable(p, high === Infinity ? 2 * low + 1 : (low + high) / 2)) continue;
    const last = ranges[ranges.length - 1];
    // A speed at which stability does not change divides nothing.
    if (last && last[1] === low) last[1] = high;
    else ranges.push([low, high]);
  }
  return ranges.map(([low, high]) => [Math.sqrt(low), Math.sqrt(high)]);
}

/** Routh and Hurwitz at u = v² > 0. */
function isStable(p: Quartic, u: number): boolean {
  const sign = Math.sign(p.a4[0]);
  const [a4, a3, a2, a1, a0] = [p.a4, p.a3, p.a2, p.a1, p.a0].map((a) => sign * valueAt(a, u));
  return a3 > 0 && a2 > 0 && a1 > 0 && a0 > 0 && a1 * a2 * a3 - a4 * a1 ** 2 - a0 * a3 ** 2 > 0;
}
