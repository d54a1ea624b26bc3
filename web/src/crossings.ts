/** Critical speeds of any number of freedoms: polynomials in the speed, then each crossing refined on the roots themselves. */

import { determinant, type LinearModel, pencilAt } from "./characteristic";
import type { Complex } from "./complex";
import type { CriticalSpeeds } from "./critical";
import { positiveRealRoots, product, roots, sum, valueAt } from "./polynomial";

const FASTEST = 1e4;

/** Coefficients of s^k of the characteristic polynomial, each a polynomial in v; index k. */
function bivariate(model: LinearModel): number[][] {
  const degree = 2 * model.coordinates.length;
  // As many speeds as the degree asks for, on a scale at which bicycles ride: exact interpolation by Newton's differences.
  const speeds = Array.from({ length: degree + 1 }, (_, k) => 6 * Math.cos((Math.PI * (2 * k + 1)) / (2 * degree + 2)));
  const values = speeds.map((v) => determinant(pencilAt(model, v)));
  return Array.from({ length: degree + 1 }, (_, k) => interpolated(speeds, values.map((value) => value[k] ?? 0)));
}

function interpolated(x: number[], y: number[]): number[] {
  const differences = [...y];
  for (let order = 1; order < x.length; order++) {
    for (let k = x.length - 1; k >= order; k--) differences[k] = (differences[k] - differences[k - 1]) / (x[k] - x[k - order]);
  }
  let polynomial = [differences[x.length - 1]];
  for (let k = x.length - 2; k >= 0; k--) polynomial = sum([1, product(polynomial, [-x[k], 1])], [1, [differences[k]]]);
  const size = Math.max(...polynomial.map((c, k) => Math.abs(c) * 6 ** k));
  return polynomial.map((c, k) => (Math.abs(c) * 6 ** k < 1e-13 * size ? 0 : c));
}

/** Speeds that may be crossings of a pair: zeros of Hurwitz' determinant of the last order but one. */
function pairCandidates(a: number[][]): number[] {
  const degree = a.length - 1;
  const order = degree - 1;
  const entry = (i: number, j: number): number[] => a[degree - (2 * (j + 1) - (i + 1))] ?? [0];
  const matrix = Array.from({ length: order }, (_, i) => Array.from({ length: order }, (_, j) => entry(i, j)));
  return candidates(determinant(matrix));
}

function candidates(polynomial: number[]): number[] {
  const size = Math.max(...polynomial.map((c, k) => Math.abs(c) * 6 ** k));
  const clean = polynomial.map((c, k) => (Math.abs(c) * 6 ** k < 1e-14 * size ? 0 : c / size));
  return positiveRealRoots(clean, 1e-5).filter((v) => v < FASTEST);
}

export function crossingsOf(model: LinearModel): CriticalSpeeds {
  const a = bivariate(model);
  const rootsAt = (v: number) => roots(determinant(pencilAt(model, v)));
  const capsize = candidates(a[0]).filter((v) => valueAt(a[0], v * (1 - 1e-7)) * valueAt(a[0], v * (1 + 1e-7)) < 0);
  const weave = pairCandidates(a)
    .map((v) => refined(rootsAt, v))
    .filter((v): v is number => v !== null);
  const unique = weave.sort((x, y) => x - y).filter((v, k, all) => k === 0 || v - all[k - 1] > 1e-7 * v);
  return { weave: unique, capsize, stableRanges: ranges(rootsAt, [...unique, ...capsize]) };
}

const nearest = (found: Complex[]): Complex | null =>
  found.filter((root) => root.im > 0).reduce<Complex | null>((a, b) => (a === null || Math.abs(b.re) < Math.abs(a.re) ? b : a), null);

/** The speed near v at which a pair's real part vanishes, or null if none does. */
function refined(rootsAt: (v: number) => Complex[], v: number): number | null {
  let [x0, x1] = [v * (1 - 1e-4), v * (1 + 1e-4)];
  let [f0, f1] = [nearest(rootsAt(x0))?.re, nearest(rootsAt(x1))?.re];
  if (f0 === undefined || f1 === undefined) return null;
  for (let step = 0; step < 50 && Math.abs(x1 - x0) > 1e-14 * v && f1 !== f0; step++) {
    const x: number = x1 - (f1 * (x1 - x0)) / (f1 - f0);
    if (!(Math.abs(x - v) < 1e-2 * v)) return null;
    [x0, f0, x1, f1] = [x1, f1, x, nearest(rootsAt(x))?.re ?? NaN];
  }
  const root = nearest(rootsAt(x1));
  return root !== null && Math.abs(root.re) < 1e-8 * (1 + root.im) && root.im > 1e-6 ? x1 : null;
}

function ranges(rootsAt: (v: number) => Complex[], bounds: number[]): [number, number][] {
  const edges = [0, ...bounds.sort((x, y) => x - y), Infinity];
  const found: [number, number][] = [];
  for (let k = 0; k + 1 < edges.length; k++) {
    const [low, high] = [edges[k], edges[k + 1]];
    const inside = high === Infinity ? 2 * low + 1 : (low + high) / 2;
    if (!(high > low) || !rootsAt(inside).every((root) => root.re < 0)) continue;
    const last = found[found.length - 1];
    if (last && last[1] === low) last[1] = high;
    else found.push([low, high]);
  }
  return found;
}
