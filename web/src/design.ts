/** A design: bicycle, rider, how the rider sits, speed, and what was changed. Plain data, compared and stored as such. */

import { DESCRIPTIONS, describe, findVariant, FLATNESS, given, type ParameterRecord, SHEETS, type Values, type Variant, WORDS } from "./data";
import { entriesOf, isEntry, PREFIX, SHEET, sheetRecord } from "./sheets";

export interface Design {
  bicycle: string;
  /** "" for none. */
  rider: string;
  posture: string;
  arms: string;
  torsoLean: boolean;
  /** Forward speed in m/s. */
  speed: number;
  /** Parameters that differ from those of the records, SI. */
  changes: Values;
  /** Of the bicycle from a geometry sheet: kind of handlebar, entries that differ from what the sheet begins at, SI. */
  bar: string;
  sheet: Values;
}

export const TOP_SPEED = 10;
const bicycles = new Map(given.bicycles.map((record) => [record.name, record]));
const riders = new Map(given.riders.map((record) => [record.name, record]));

export const bicycleNames = (): string[] => [...bicycles.keys(), SHEET];
export const riderNames = (): string[] => [...riders.keys()];
export const bicycleOf = (design: Design): ParameterRecord =>
  bicycles.get(design.bicycle) ?? sheetRecord(design.bar, design.sheet);
export const riderOf = (design: Design): ParameterRecord | undefined => riders.get(design.rider);

/** Puts a record that was dropped onto the page among the others. */
export function addRecord(record: ParameterRecord): void {
  (record.kind === "bicycle" ? bicycles : riders).set(record.name, record);
}

export function firstDesign(): Design {
  const design = { ...START, bicycle: given.bicycle, rider: given.rider, posture: given.rider ? given.posture : "rigid" };
  return canSeat(design) ? design : { ...design, rider: "", posture: "rigid" };
}

const START: Design = { bicycle: "", rider: "", posture: "rigid", arms: "straight", torsoLean: false, speed: 5, changes: {}, bar: "city", sheet: {} };
const GEOMETRY = DESCRIPTIONS.filter((d) => d.of === "bicycle" && d.group.startsWith("frame geometry"));

/** Whether the bicycle has the frame geometry that a rider needs. */
export function canSeat(design: Design): boolean {
  const values = bicycleOf(design).values;
  return GEOMETRY.every((d) => d.name in values || d.name === "handlebar_width");
}

export function variantOf(design: Design): Variant {
  const posture = design.rider === "" ? "bare" : design.posture;
  const found = findVariant(posture, design.arms, design.rider !== "" && design.torsoLean);
  return found ?? (findVariant(posture, design.arms, false) as Variant);
}

/** Names of the springs and dampers that a way to ride may have: at each freedom but lean. */
export function springsOf(variant: Variant): string[] {
  return variant.coordinates.flatMap((joint) => [`spring at ${joint}`, `damper at ${joint}`]).filter((name) => describe.has(name));
}

/** Every parameter of a design, SI. */
export function valuesOf(design: Design): Values {
  const bicycle = bicycleOf(design);
  const rider = riderOf(design);
  const values: Values = { ...(rider ? { handlebar_drop: 0 } : {}), ...bicycle.values, ...rider?.values };
  const angle = rider?.forward_lean_angles?.[bicycle.name];
  if (angle !== undefined) values.forward_lean_angle = angle;
  else if (rider && !("forward_lean_angle" in values)) values.forward_lean_angle = mean(rider.forward_lean_angles);
  // Without springs and dampers these are zero.
  for (const name of springsOf(variantOf(design))) values[name] = 0;
  return { ...values, ...design.changes };
}

/** A rider on a bicycle of others leans as on the average of the bicycles the angle is known for. */
function mean(angles: Values = {}): number {
  const all = Object.values(angles);
  return all.length ? all.reduce((a, b) => a + b, 0) / all.length : (75 * Math.PI) / 180;
}

/** What is wrong with single values, in words, or "". */
export function faultOf(values: Values, names: string[]): string {
  for (const name of names) {
    const description = describe.get(name);
    const value = values[name];
    if (description === undefined || (value === undefined && description.optional)) continue;
    const kind = description.allowed;
    const good =
      Number.isFinite(value) &&
      (kind !== "positive" || value > 0) &&
      (kind !== "not negative" || value >= 0) &&
      (kind !== "angle" || (value > 0 && value < Math.PI / 2)) &&
      (kind !== "above ground" || value < 0) &&
      (kind !== "fraction" || (value > 0 && value < 1));
    if (!good) return `${name} = ${value} ${description.unit}, must be ${WORDS[kind] ?? "a finite number"}`;
  }
  return BODIES.map((body) => inertiaFault(values, body)).find((fault) => fault !== "") ?? "";
}

const BODIES = ["rear_frame", "front_frame", "rear_wheel", "front_wheel"];

/** What no distribution of mass has: an inertia that is not positive, or breaks the triangle inequality. */
function inertiaFault(values: Values, body: string): string {
  const of = (axes: string) => values[`${body}_inertia_${axes}`];
  const [xx, yy, zz, xz] = [of("xx"), of("yy"), of("zz") ?? of("xx"), of("xz") ?? 0];
  const [mean, half] = [(xx + zz) / 2, Math.hypot((xx - zz) / 2, xz)];
  const [small, large] = [mean - half, mean + half];
  const slack = 1 + FLATNESS;
  if (large === 0 && yy === 0) return ""; // a body without inertia: a skate
  if (!(small > 0)) return `${body}_inertia is no body's: its smallest moment is ${small.toPrecision(4)} kg m²`;
  if (yy > slack * (small + large) || large > slack * (yy + small)) {
    return `${body}_inertia is no body's: one principal moment exceeds the sum of the other two`;
  }
  return "";
}

/** A design as an address, and back: what is not said stays as the page begins. */
export function toAddress(design: Design): string {
  const { changes, torsoLean, speed, bar, sheet, ...words } = design;
  const fields = new URLSearchParams({ ...words, speed: String(speed) });
  if (torsoLean) fields.set("torso_lean", "1");
  if (design.bicycle === SHEET) {
    fields.set("bar", bar);
    for (const [name, value] of Object.entries(sheet)) fields.set(PREFIX + name, String(value));
  }
  for (const [name, value] of Object.entries(changes)) fields.set(name, String(value));
  return fields.toString();
}

export function fromAddress(address: string): Design {
  const design = firstDesign();
  for (const [name, value] of new URLSearchParams(address)) assign(design, name, value);
  return design;
}

/** Sets one thing of a design by its name, if the value makes sense; returns whether it did. */
export function assign(design: Design, name: string, value: unknown): boolean {
  if (name === "bicycle") {
    if (!bicycles.has(String(value)) && value !== SHEET) return false;
    design.bicycle = String(value);
    if (!canSeat(design)) Object.assign(design, { rider: "", posture: "rigid", torsoLean: false });
  } else if (name === "rider") {
    if (value !== "" && value !== null && (!riders.has(String(value)) || !canSeat(design))) return false;
    design.rider = value === null ? "" : String(value);
    if (design.rider === "") Object.assign(design, { posture: "rigid", torsoLean: false });
  } else if (name === "posture" || name === "arms") {
    const wanted = { posture: design.posture, arms: design.arms, [name]: String(value) };
    if (!findVariant(wanted.posture, wanted.arms, false) || wanted.posture === "bare") return false;
    if (name === "posture" && design.rider === "" && wanted.posture !== "rigid") return false;
    Object.assign(design, wanted);
  } else if (name === "bar") {
    if (!SHEETS.some((sheet) => sheet.bar === value)) return false;
    takeSheet(design, String(value), design.sheet);
  } else if (name.startsWith(PREFIX)) {
    const [entry, number] = [name.slice(PREFIX.length), Number(value ?? NaN)];
    if (!isEntry(entry) || value === "" || !Number.isFinite(number)) return false;
    takeSheet(design, design.bar, { ...design.sheet, [entry]: number });
  } else if (name === "torso_lean") {
    design.torsoLean = value === true || value === 1 || value === "1" || value === "true";
  } else {
    const number = typeof value === "number" ? value : value === "" ? NaN : Number(value);
    if (!Number.isFinite(number)) return false;
    if (name === "speed") design.speed = Math.min(Math.max(number, 0), 1e3);
    else if (describe.has(name)) design.changes = { ...design.changes, [name]: number };
    else return false;
  }
  return true;
}

/** Makes the sheet's bicycle the design's, with these entries; what of a bicycle was changed by hand is the sheet's again. */
function takeSheet(design: Design, bar: string, entries: Values): void {
  const begins = entriesOf(bar, {});
  design.bicycle = SHEET;
  design.bar = bar;
  design.sheet = Object.fromEntries(Object.entries(entries).filter(([name, value]) => value !== begins[name]));
  design.changes = Object.fromEntries(Object.entries(design.changes).filter(([name]) => describe.get(name)?.of !== "bicycle"));
}
