/** What the page is given: descriptions of parameters, bicycles, riders, and the programs traced from the equations. */

import * as programs from "./generated/programs.js";
import manifest from "./generated/manifest.json";

export type Values = Record<string, number>;

export interface Description {
  name: string;
  of: "bicycle" | "rider" | "posture";
  unit: string;
  symbol: string;
  meaning: string;
  group: string;
  allowed: string;
  optional: boolean;
}

export interface ParameterRecord {
  kind: "bicycle" | "rider";
  name: string;
  description: string;
  source: string;
  values: Values;
  /** Of a rider: the torso's angle on bicycles by name. */
  forward_lean_angles?: Values;
}

/** One way to ride: which programs give its equations and its moved skeleton, and what they read and write. */
export interface Variant {
  posture: string;
  arms: string | null;
  torso_lean: boolean;
  coordinates: string[];
  inputs: string[];
  equations: string;
  skeleton: string | null;
  /** Names of the parameters that the programs read, in order. */
  reads: string[];
}

/** A geometry sheet with one kind of handlebar: what its program reads and begins at, and what it writes. */
export interface Sheet {
  bar: string;
  program: string;
  inputs: { name: string; unit: string; meaning: string; value: number }[];
  /** Names of the bicycle's parameters, in order. */
  outputs: string[];
}

interface Given {
  bicycles: ParameterRecord[];
  riders: ParameterRecord[];
  bicycle: string;
  rider: string;
  posture: string;
}

export type Program = (inputs: ArrayLike<number>, outputs: Float64Array) => void;

export const DESCRIPTIONS = manifest.parameters as Description[];
export const SHEETS = manifest.sheets as Sheet[];
export const VARIANTS = manifest.variants as Variant[];
/** Share by which a principal moment may exceed the sum of the other two: room for measurement errors. */
export const FLATNESS = manifest.flatness as number;
export const WORDS = manifest.allowed as Record<string, string>;

export function program(name: string): Program {
  return (programs as unknown as Record<string, Program>)[name];
}

export const describe = new Map(DESCRIPTIONS.map((description) => [description.name, description]));

/** The records that were written into the page; without any (while the page is being worked on), those of the manifest. */
export const given: Given = (() => {
  const text = document.getElementById("singletrack-data")?.textContent?.trim() ?? "";
  return (text.startsWith("{") ? JSON.parse(text) : manifest.example) as Given;
})();

export function findVariant(posture: string, arms: string | null, torsoLean: boolean): Variant | undefined {
  return VARIANTS.find((v) => v.posture === posture && v.torso_lean === torsoLean && (v.arms === null || v.arms === arms));
}
