/** From a design to all that is shown: equations, named modes, critical speeds, or why there are none. */

import { isUndamped, type LinearModel } from "./characteristic";
import type { Curves } from "./chart";
import type { Complex } from "./complex";
import { type CriticalSpeeds, criticalSpeeds } from "./critical";
import { crossingsOf } from "./crossings";
import { describe, type Values, type Variant } from "./data";
import { bicycleOf, type Design, faultOf, springsOf, TOP_SPEED, valuesOf, variantOf } from "./design";
import { equationsOf, inputsOf } from "./equations";
import { FollowedModes } from "./followed";
import { Modes } from "./modes";
import { SHEET, sheetFault } from "./sheets";

export interface Answer {
  design: Design;
  variant: Variant;
  values: Values;
  inputs: Float64Array;
  model: LinearModel;
  names: string[];
  modesAt(speed: number): Complex[];
  critical: CriticalSpeeds;
}

/** What a design gives, or a message that says why it gives nothing. */
export function answer(design: Design): Answer | string {
  const variant = variantOf(design);
  const values = valuesOf(design);
  const open = design.bicycle === SHEET ? sheetFault(bicycleOf(design)) : "";
  if (open) return open;
  const read = [...variant.reads.filter((name) => describe.has(name)), ...springsOf(variant)];
  const fault = faultOf(values, read);
  if (fault) return fault;
  const { model, fault: reason } = equationsOf(variant, values);
  if (reason) return reason;
  const plain = model.coordinates.length === 2 && isUndamped(model);
  const modes = plain ? new Modes(model) : new FollowedModes(model);
  return {
    design,
    variant,
    values,
    inputs: inputsOf(variant, values),
    model,
    names: modes.names,
    modesAt: (speed) => modes.at(speed),
    critical: plain ? criticalSpeeds(model) : crossingsOf(model),
  };
}

const SPEEDS = Float64Array.from({ length: 201 }, (_, k) => (k * TOP_SPEED) / 200);

export function curvesOf(found: Answer): Curves {
  const columns: Complex[][] = found.names.map(() => []);
  for (const speed of SPEEDS) found.modesAt(speed).forEach((root, mode) => columns[mode].push(root));
  return { speeds: SPEEDS, names: found.names, eigenvalues: columns, critical: found.critical };
}

/** What programs get when they ask the page. */
export function result(found: Answer, message: string): Record<string, unknown> {
  const { model, critical } = found;
  const { M, C0, C1, S0, K0, K2 } = model;
  return {
    parameters: found.values,
    coordinates: model.coordinates,
    ...{ M, C0, C1, S0, K0, K2 },
    gravity: model.gravity,
    speed: found.design.speed,
    eigenvalues: found.modesAt(found.design.speed).map((root) => [root.re, root.im]),
    modes: found.names,
    weave: critical.weave,
    capsize: critical.capsize,
    stable_ranges: critical.stableRanges.map(([low, high]) => [low, high === Infinity ? null : high]),
    message,
  };
}
