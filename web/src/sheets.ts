/** Bicycles from a geometry sheet: its entries by the traced program of the catalogue, one for each kind of handlebar. */

import { type ParameterRecord, program, type Sheet, SHEETS, type Values } from "./data";

/** The name of the bicycle that the sheet makes. */
export const SHEET = "geometry sheet";
/** Entries of the sheet in addresses and for programs: "sheet.head_angle". */
export const PREFIX = "sheet.";

export const sheetOf = (bar: string): Sheet => SHEETS.find((sheet) => sheet.bar === bar) ?? SHEETS[0];

/** All entries of a sheet: what it begins at, and what was changed. */
export function entriesOf(bar: string, changes: Values): Values {
  const values = Object.fromEntries(sheetOf(bar).inputs.map((input) => [input.name, input.value]));
  return { ...values, ...changes };
}

export const isEntry = (name: string): boolean => SHEETS[0].inputs.some((input) => input.name === name);

let last: { key: string; record: ParameterRecord } | undefined;

/** The bicycle of a sheet; parameters are NaN where no such frame can be. */
export function sheetRecord(bar: string, changes: Values): ParameterRecord {
  const key = JSON.stringify([bar, changes]);
  if (last?.key === key) return last.record;
  const sheet = sheetOf(bar);
  const entries = entriesOf(bar, changes);
  const out = new Float64Array(sheet.outputs.length);
  program(sheet.program)(sheet.inputs.map((input) => entries[input.name]), out);
  const record: ParameterRecord = {
    kind: "bicycle",
    name: SHEET,
    description: `from its geometry sheet, ${bar} bar`,
    source: "estimated from its geometry and from what components weigh (singletrack, the page)",
    values: Object.fromEntries(sheet.outputs.map((name, k) => [name, out[k]])),
  };
  last = { key, record };
  return record;
}

/** Why a sheet makes no bicycle, or "". */
export function sheetFault(record: ParameterRecord): string {
  const open = Object.entries(record.values).filter(([, value]) => !Number.isFinite(value));
  return open.length ? `the sheet makes no frame: its lengths do not meet (${open[0][0]})` : "";
}

/** "37-622" as width and bead diameter in m, or undefined. */
export function tyreOf(text: string): [number, number] | undefined {
  const match = /^\s*(\d{2,3})\s*-\s*(\d{3})\s*$/.exec(text);
  if (match === null) return undefined;
  const [width, diameter] = [Number(match[1]) / 1000, Number(match[2]) / 1000];
  return width >= 0.015 && width <= 0.13 && diameter >= 0.15 && diameter <= 0.7 ? [width, diameter] : undefined;
}
