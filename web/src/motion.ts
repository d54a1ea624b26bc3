/** Motion in modes: q(t) = Σ Re(a v exp(λ t)), and what follows for heading and path on the road. */

import { add, type Complex, complex, divide, exponential, multiply, scale, size, subtract } from "./complex";
import type { LinearModel } from "./characteristic";

export interface Motion {
  eigenvalues: Complex[];
  /** One vector a motion: amplitudes of the coordinates. */
  vectors: Complex[][];
  /** Seconds after which it begins again. */
  duration: number;
}

type ComplexMatrix = Complex[][];

function pencil(model: LinearModel, v: number, s: Complex): ComplexMatrix {
  const g = model.gravity;
  return model.M.map((row, i) =>
    row.map((m, j) => {
      const damping = scale(s, model.C0[i][j] + v * model.C1[i][j]);
      const stiffness = complex(model.S0[i][j] + g * model.K0[i][j] + v * v * model.K2[i][j]);
      return add(add(scale(multiply(s, s), m), damping), stiffness);
    }),
  );
}

/** Solves A x = b by elimination with the largest pivots. */
function solve(A: ComplexMatrix, b: Complex[]): Complex[] {
  const rows = A.map((row, i) => [...row, b[i]]);
  const n = rows.length;
  for (let k = 0; k < n; k++) {
    let best = k;
    for (let i = k + 1; i < n; i++) if (size(rows[i][k]) > size(rows[best][k])) best = i;
    [rows[k], rows[best]] = [rows[best], rows[k]];
    for (let i = k + 1; i < n; i++) {
      const factor = divide(rows[i][k], rows[k][k]);
      for (let j = k; j <= n; j++) rows[i][j] = subtract(rows[i][j], multiply(factor, rows[k][j]));
    }
  }
  const x = new Array<Complex>(n);
  for (let k = n - 1; k >= 0; k--) {
    let value = rows[k][n];
    for (let j = k + 1; j < n; j++) value = subtract(value, multiply(rows[k][j], x[j]));
    x[k] = divide(value, rows[k][k]);
  }
  return x;
}

/** The eigenmotion of a root, lean normalised to one (or the largest coordinate, where lean takes no part). */
export function eigenmotion(model: LinearModel, v: number, root: Complex): Complex[] {
  const P = pencil(model, v, root);
  const n = P.length;
  if (n === 2) {
    const weight = (row: Complex[]) => size(row[0]) + size(row[1]);
    const row = weight(P[0]) >= weight(P[1]) ? P[0] : P[1];
    return normalised([row[1], scale(row[0], -1)]);
  }
  // Inverse iteration: a hair beside the root the pencil is regular, and its inverse picks the vector out.
  const beside = add(root, complex(1e-9 * (1 + size(root))));
  let vector = Array.from({ length: n }, (_, k) => complex(1, 0.3 * k));
  for (let step = 0; step < 3; step++) {
    const next = solve(pencil(model, v, beside), vector);
    const largest = Math.max(...next.map(size));
    vector = next.map((x) => scale(x, 1 / largest));
  }
  return normalised(vector);
}

function normalised(vector: Complex[]): Complex[] {
  const largest = Math.max(...vector.map(size));
  if (size(vector[0]) > 1e-12 * largest) return vector.map((x) => divide(x, vector[0]));
  return vector.map((x) => scale(x, 1 / (largest || 1)));
}

const LIMIT = 0.16; // rad: about 9 deg, still a small angle for the eye

/** Motion in some modes together, each of a size that can be seen at its largest. */
export function modalMotion(model: LinearModel, v: number, roots: Complex[]): Motion {
  const vectors = roots.map((root) => eigenmotion(model, v, root));
  const slowest = Math.min(...roots.map((root) => Math.abs(root.re)));
  const duration = Math.min(Math.max(2.5 / Math.max(slowest, 0.05), 4), 12);
  const sized = vectors.map((vector, k) => {
    const growth = Math.max(0, roots[k].re) * duration;
    const factor = (LIMIT * Math.exp(-growth)) / (Math.max(...vector.map(size)) * roots.length);
    return vector.map((x) => scale(x, factor));
  });
  return { eigenvalues: roots, vectors: sized, duration };
}

/** The ride after a push that starts the bicycle leaning at a rate (rad/s): all modes, as the push excites them. */
export function kickedMotion(model: LinearModel, v: number, roots: Complex[], rate = 0.35): Motion {
  const vectors = roots.map((root) => eigenmotion(model, v, root));
  const n = model.coordinates.length;
  const states = [...Array(2 * n).keys()].map((i) =>
    roots.map((root, k) => (i < n ? vectors[k][i] : multiply(root, vectors[k][i - n]))),
  );
  const push = [...Array(2 * n).keys()].map((i) => complex(i === n ? rate : 0));
  const amounts = solve(states, push);
  return { eigenvalues: roots, vectors: vectors.map((vector, k) => vector.map((x) => multiply(x, amounts[k]))), duration: 8 };
}

/** Coordinates and their rates at a time (s). */
export function at(motion: Motion, time: number): { angles: number[]; rates: number[] } {
  const n = motion.vectors[0]?.length ?? 2;
  const [angles, rates] = [new Array<number>(n).fill(0), new Array<number>(n).fill(0)];
  motion.eigenvalues.forEach((root, k) => {
    const factor = exponential(scale(root, time));
    motion.vectors[k].forEach((x, i) => {
      const value = multiply(x, factor);
      angles[i] += value.re;
      rates[i] += multiply(root, value).re;
    });
  });
  return { angles, rates };
}
