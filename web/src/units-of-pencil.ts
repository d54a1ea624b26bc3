/** The units in which a pencil of any number of freedoms has numbers of order one (linear/pencil.py). */

import type { LinearModel } from "./characteristic";

export interface Units {
  /** The unit of speed, in m/s. */
  speed: number;
  /** The speed, in its unit, at which the stiffnesses of gravity and of speed are alike. */
  riding: number;
  /** Square roots of the scaled masses, by coordinate. */
  weights: number[];
  /** A motion in scaled coordinates times this is one of the model. */
  masses: number[];
}

const exponentOf = (x: number): number => (x > 0 && Number.isFinite(x) ? Math.floor(Math.log2(x)) + 1 : 0);
const largest = (matrix: number[][]): number => Math.max(...matrix.flat().map(Math.abs));

/** Solves M X = R by elimination with row exchanges. */
export function solveMatrix(M: number[][], R: number[][]): number[][] {
  const rows = M.map((row, i) => [...row, ...R[i]]);
  const n = M.length;
  for (let k = 0; k < n; k++) {
    let best = k;
    for (let i = k + 1; i < n; i++) if (Math.abs(rows[i][k]) > Math.abs(rows[best][k])) best = i;
    [rows[k], rows[best]] = [rows[best], rows[k]];
    for (let i = 0; i < n; i++) {
      if (i === k) continue;
      const factor = rows[i][k] / rows[k][k];
      for (let j = k; j < rows[i].length; j++) rows[i][j] -= factor * rows[k][j];
    }
  }
  return rows.map((row, k) => row.slice(n).map((x) => x / row[k]));
}

export function unitsOf(model: LinearModel): Units {
  const masses = model.M.map((row, i) => 2 ** -Math.floor((exponentOf(row[i]) + 1) / 2));
  const scaled = (A: number[][], factor = 1) => A.map((row, i) => row.map((x, j) => x * factor * masses[i] * masses[j]));
  const M = scaled(model.M);
  const weight = scaled(model.K0, model.gravity);
  const stiffness = scaled(model.S0).map((row, i) => row.map((x, j) => x + weight[i][j]));
  const [c0, c1, k0, k2, g] = [scaled(model.C0), scaled(model.C1), stiffness, scaled(model.K2), weight].map((part) =>
    largest(solveMatrix(M, part)),
  );
  const usable = (x: number) => Number.isFinite(x) && x > 0;
  const byStiffness = Math.sqrt(k0) / Math.sqrt(k2);
  const size = usable(byStiffness) ? byStiffness : usable(c0 / c1) ? c0 / c1 : 1;
  const speed = 2 ** exponentOf(size);
  const riding = Math.sqrt(g) / Math.sqrt(k2) / speed;
  return {
    speed,
    riding: usable(riding) ? riding : 1,
    weights: M.map((row, i) => Math.sqrt(Math.abs(row[i]))),
    masses,
  };
}
