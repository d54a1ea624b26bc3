/** From a design to its equations of motion and to the rider's moved points, by the traced programs. */

import type { LinearModel } from "./characteristic";
import { program, type Values, type Variant } from "./data";

const MATRICES = ["M", "C0", "C1", "S0", "K0", "K2"] as const;
/** Loops whose hands miss their grips by more than this (m per rad) were solved with pivots that do not fit. */
const RESIDUAL = 1e-9;
const outputs = new Float64Array(4096);

export interface Equations {
  model: LinearModel;
  /** Why there is no model, or "". */
  fault: string;
}

export const inputsOf = (variant: Variant, values: Values): Float64Array =>
  Float64Array.from(variant.reads, (name) => values[name] ?? NaN);

export function equationsOf(variant: Variant, values: Values): Equations {
  const n = variant.coordinates.length;
  program(variant.equations)(inputsOf(variant, values), outputs);
  const model = { coordinates: variant.coordinates, gravity: values.gravity } as unknown as LinearModel;
  MATRICES.forEach((name, which) => {
    model[name] = Array.from({ length: n }, (_, i) => Array.from(outputs.subarray(which * n * n + i * n, which * n * n + i * n + n)));
  });
  model.coordinates.forEach((joint, k) => {
    model.S0[k][k] += values[`spring at ${joint}`] ?? 0;
    model.C0[k][k] += values[`damper at ${joint}`] ?? 0;
  });
  const [armShare, legShare, residual] = outputs.subarray(6 * n * n, 6 * n * n + 3);
  const fault = variant.skeleton === null ? "" : reachFault(armShare, legShare);
  if (fault) return { model, fault };
  const finite = MATRICES.every((name) => model[name].every((row) => row.every(Number.isFinite)));
  if (!finite) return { model, fault: "the frame's geometry does not close: a tube is too short for its distance" };
  if (!(residual < RESIDUAL)) return { model, fault: "the arms cannot follow the handlebar (stretched straight, or axes line up)" };
  const determinant = model.M[0][0] * model.M[1][1] - model.M[0][1] * model.M[1][0];
  if (!(model.M[0][0] > 0 && determinant > 0)) return { model, fault: "no body has such masses and inertias (M is not positive)" };
  return { model, fault: "" };
}

function reachFault(arm: number, leg: number): string {
  if (!(arm <= 1)) return `the arms are too short: the grips are ${percent(arm)} of their length away`;
  if (!(leg <= 1)) return `the legs are too short: the pedals are ${percent(leg)} of their length away`;
  return "";
}

const percent = (share: number): string => `${(100 * share).toFixed(1)} %`;

/** The 31 points of bicycle and rider, x forward, y right, z down, with freedoms other than lean as given (rad). */
export function skeletonOf(variant: Variant, inputs: Float64Array, freedoms: readonly number[]): Float64Array | null {
  if (variant.skeleton === null) return null;
  const all = new Float64Array(inputs.length + freedoms.length);
  all.set(inputs);
  all.set(freedoms, inputs.length);
  const points = new Float64Array(93);
  program(variant.skeleton)(all, points);
  return points;
}
