/** Roots of real polynomials: all at once (Ehrlich and Aberth), each polished to rounding, pairs exact conjugates. */

import { add, byRealPart, complex, type Complex, conjugate, divide, multiply, scale, size, subtract } from "./complex";

const MOST_STEPS = 200;

/** Value, slope and sum of the sizes of all terms at s; coefficients ascending. */
function horner(coefficients: readonly number[], s: Complex): [Complex, Complex, number] {
  let value = complex(0);
  let slope = complex(0);
  let terms = 0;
  const radius = size(s);
  for (let k = coefficients.length - 1; k >= 0; k--) {
    slope = add(multiply(slope, s), value);
    value = add(multiply(value, s), complex(coefficients[k]));
    terms = terms * radius + Math.abs(coefficients[k]);
  }
  return [value, slope, terms];
}

/** Starting points on circles whose radii are the slopes of the Newton polygon (Bini). */
function startingPoints(coefficients: readonly number[]): Complex[] {
  const degree = coefficients.length - 1;
  const heights = coefficients.map((c) => Math.log(Math.abs(c)));
  const corners = [0];
  while (corners[corners.length - 1] < degree) {
    const from = corners[corners.length - 1];
    let best = from + 1;
    let steepest = -Infinity;
    for (let k = from + 1; k <= degree; k++) {
      const slope = (heights[k] - heights[from]) / (k - from);
      if (slope >= steepest) [steepest, best] = [slope, k];
    }
    corners.push(best);
  }
  const points: Complex[] = [];
  for (let c = 1; c < corners.length; c++) {
    const count = corners[c] - corners[c - 1];
    const radius = Math.exp((heights[corners[c - 1]] - heights[corners[c]]) / count);
    for (let k = 0; k < count; k++) {
      const turn = (2 * Math.PI * k) / count + 0.4 + 0.7 * c;
      points.push({ re: radius * Math.cos(turn), im: radius * Math.sin(turn) });
    }
  }
  return points;
}

/** All roots of a real polynomial, coefficients ascending, sorted by real, then imaginary part. */
export function roots(coefficients: readonly number[]): Complex[] {
  let all = [...coefficients];
  while (all.length > 1 && all[all.length - 1] === 0) all.pop();
  const zeros: Complex[] = [];
  while (all.length > 1 && all[0] === 0) {
    all = all.slice(1);
    zeros.push(complex(0));
  }
  if (!all.every(Number.isFinite)) return all.slice(1).map(() => complex(NaN, NaN));
  const found = startingPoints(all);
  const done = found.map(() => false);
  for (let step = 0; step < MOST_STEPS && !done.every(Boolean); step++) {
    for (let i = 0; i < found.length; i++) {
      if (done[i]) continue;
      const [value, slope, terms] = horner(all, found[i]);
      if (size(value) <= 4e-16 * terms) {
        done[i] = true;
        continue;
      }
      const newton = divide(value, size(slope) === 0 ? complex(1e-300) : slope);
      let pull = complex(0);
      for (let j = 0; j < found.length; j++) {
        const gap = subtract(found[i], found[j]);
        if (j !== i && size(gap) > 0) pull = add(pull, divide(complex(1), gap));
      }
      found[i] = subtract(found[i], divide(newton, subtract(complex(1), multiply(newton, pull))));
    }
  }
  return [...zeros, ...paired(found)].sort(byRealPart);
}

/** Roots of a real polynomial are real or come in pairs: nearest conjugates are made exact, the rest real. */
export function paired(found: readonly Complex[]): Complex[] {
  const result: Complex[] = [];
  const left = [...found].sort((a, b) => Math.abs(b.im) - Math.abs(a.im));
  while (left.length > 0) {
    const root = left.shift() as Complex;
    const near = 1e-13 * size(root);
    if (Math.abs(root.im) <= near || left.length === 0) {
      result.push(complex(root.re));
      continue;
    }
    const mirrored = conjugate(root);
    let best = 0;
    left.forEach((other, k) => {
      if (size(subtract(other, mirrored)) < size(subtract(left[best], mirrored))) best = k;
    });
    // Two real roots that nearly meet look like a pair with a tiny imaginary part: their partner is not their mirror.
    const partner = left[best];
    if (size(subtract(partner, mirrored)) > 0.5 * Math.abs(root.im) && Math.abs(root.im) < 1e-6 * size(root)) {
      result.push(complex(root.re));
      continue;
    }
    left.splice(best, 1);
    const mean = scale(add(root, conjugate(partner)), 0.5);
    result.push(mean, conjugate(mean));
  }
  return result;
}

/** Positive real roots, ascending; a root counts as real within what a double root can lose. */
export function positiveRealRoots(coefficients: readonly number[], tolerance = 1e-7): number[] {
  return roots(coefficients)
    .filter((root) => root.re > 0 && Math.abs(root.im) <= tolerance * size(root))
    .map((root) => root.re)
    .sort((a, b) => a - b);
}

/** Product of polynomials, coefficients ascending. */
export function product(a: readonly number[], b: readonly number[]): number[] {
  const result = new Array<number>(a.length + b.length - 1).fill(0);
  a.forEach((x, i) => b.forEach((y, j) => (result[i + j] += x * y)));
  return result;
}

/** Sum of polynomials, each times a factor. */
export function sum(...terms: [number, readonly number[]][]): number[] {
  const result = new Array<number>(Math.max(...terms.map(([, p]) => p.length))).fill(0);
  for (const [factor, p] of terms) p.forEach((x, i) => (result[i] += factor * x));
  return result;
}

/** Value at x, coefficients ascending. */
export function valueAt(coefficients: readonly number[], x: number): number {
  let value = 0;
  for (let k = coefficients.length - 1; k >= 0; k--) value = value * x + coefficients[k];
  return value;
}
