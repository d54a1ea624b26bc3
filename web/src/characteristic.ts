/** The characteristic polynomial det(M s² + (C0 + v C1) s + S0 + g K0 + v² K2) of a linear model. */

import { product, sum } from "./polynomial";

export interface LinearModel {
  coordinates: string[];
  gravity: number;
  M: number[][];
  C0: number[][];
  C1: number[][];
  S0: number[][];
  K0: number[][];
  K2: number[][];
}

/** Coefficients of s⁴ to s⁰ in ascending powers of u = v²; a3 and a1 are to be multiplied by v (two freedoms, undamped). */
export interface Quartic {
  a4: number[];
  a3: number[];
  a2: number[];
  a1: number[];
  a0: number[];
}

export function isUndamped(model: LinearModel): boolean {
  return [model.C0, model.S0].every((matrix) => matrix.every((row) => row.every((entry) => entry === 0)));
}

export function quarticOf(model: LinearModel): Quartic {
  const { M, C1, K0, K2, gravity: g } = model;
  const bracket = (A: number[][], B: number[][]) => A[0][0] * B[1][1] - A[0][1] * B[1][0];
  const mixed = (A: number[][], B: number[][]) => bracket(A, B) + bracket(B, A);
  return {
    a4: [bracket(M, M)],
    a3: [mixed(M, C1)],
    a2: [g * mixed(M, K0), bracket(C1, C1) + mixed(M, K2)],
    a1: [g * mixed(C1, K0), mixed(C1, K2)],
    a0: [g * g * bracket(K0, K0), g * mixed(K0, K2), bracket(K2, K2)],
  };
}

/** b, c, d, e of the monic quartic at a speed v. */
export function monicAt(p: Quartic, v: number): [number, number, number, number] {
  const u = v * v;
  const [a3, [c0, c1], [d0, d1], [e0, e1, e2]] = [p.a3, p.a2, p.a1, p.a0].map((a) => a.map((x) => x / p.a4[0]));
  return [a3[0] * v, c0 + c1 * u, (d0 + d1 * u) * v, e0 + (e1 + e2 * u) * u];
}

/** Determinant of a matrix of polynomials in s, by its first row. */
export function determinant(matrix: number[][][]): number[] {
  if (matrix.length === 1) return matrix[0][0];
  const terms = matrix[0].map((entry, column): [number, number[]] => {
    const minor = matrix.slice(1).map((row) => row.filter((_, k) => k !== column));
    return [column % 2 ? -1 : 1, product(entry, determinant(minor))];
  });
  return sum(...terms);
}

/** The pencil at a speed, each entry a polynomial in s. */
export function pencilAt(model: LinearModel, v: number): number[][][] {
  const { M, C0, C1, S0, K0, K2, gravity: g } = model;
  return M.map((row, i) =>
    row.map((m, j) => [S0[i][j] + g * K0[i][j] + v * v * K2[i][j], C0[i][j] + v * C1[i][j], m]),
  );
}
