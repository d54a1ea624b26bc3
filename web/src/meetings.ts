/** Speeds at which roots meet: zeros of the quartic's discriminant, along which modes are followed (linear/meetings.py). */

import type { Quartic } from "./characteristic";
import { positiveRealRoots, product, sum, valueAt } from "./polynomial";

export interface Meetings {
  /** Speeds at which two roots are equal, ascending, in m/s. */
  speeds: number[];
  /** Speed at which the real parts of two pairs are equal; NaN if never. */
  passing: number;
}

const shift = (p: readonly number[]): number[] => [0, ...p];

export function findMeetings(p: Quartic): Meetings {
  const ratio = Math.sqrt(Math.abs(p.a2[0] / p.a2[1]));
  const scale = Number.isFinite(ratio) && ratio > 0 ? ratio : 1;
  const square = scale * scale;
  const scaled = (a: number[]) => a.map((x, k) => (x / p.a4[0]) * square ** k);
  const b = p.a3[0] / p.a4[0];
  const [c, d, e] = [scaled(p.a2), scaled(p.a1), scaled(p.a0)];
  const i = sum([12, e], [-3 * square * b, shift(d)], [1, product(c, c)]);
  const j = sum(
    [72, product(c, e)],
    [9 * square * b, shift(product(c, d))],
    [-27 * square, shift(product(d, d))],
    [-27 * square * b * b, shift(e)],
    [-2, product(c, product(c, c))],
  );
  const discriminant = sum([4, product(i, product(i, i))], [-1, product(j, j)]).slice(0, 7);
  const largest = Math.max(...discriminant.map(Math.abs));
  const usable = discriminant.every(Number.isFinite) && Math.abs(discriminant[6]) > 1e-300 * largest;
  const speeds = usable ? positiveRealRoots(discriminant).map((u) => scale * Math.sqrt(u)) : [];
  return { speeds, passing: scale * passing(scale * b, c, d.map((x) => x * scale), e) };
}

function passing(b: number, c: number[], d: number[], e: number[]): number {
  const constant = d[0] - (b * c[0]) / 2;
  const slope = d[1] - (b * c[1]) / 2 + b ** 3 / 8;
  const u = -constant / slope;
  const bb = b * b * u;
  const cu = valueAt(c, u);
  const P = cu - (3 * bb) / 8;
  const R = valueAt(e, u) - (b * valueAt(d, u) * u) / 4 + (bb * cu) / 16 - (3 * bb * bb) / 256;
  return u > 0 && P > 0 && R > 0 && P * P > 4 * R ? Math.sqrt(u) : NaN;
}

/** A speed inside each interval that the meetings bound. */
export function speedsBetween(meetings: Meetings): number[] {
  const bounds = [0, ...meetings.speeds];
  return bounds.map((low, k) => (k + 1 < bounds.length ? (low + bounds[k + 1]) / 2 : 2 * low + 1));
}
