/** Our parameter files (TOML), read when dropped onto the page, written when a design is taken away. */

import { parse } from "smol-toml";
import { DESCRIPTIONS, describe, type ParameterRecord, type Values } from "./data";
import { bicycleOf, type Design, riderOf, valuesOf } from "./design";
import { parseQuantity } from "./units";

/** A bicycle or rider from the text of a file; throws an Error that names the parameter. */
export function readRecord(text: string, fileName: string): ParameterRecord {
  const document = parse(text) as Record<string, unknown>;
  const kind = document.kind;
  if (kind !== "bicycle" && kind !== "rider") throw new Error(`${fileName}: kind must be "bicycle" or "rider"`);
  const table = document.parameters as Record<string, unknown> | undefined;
  if (typeof table !== "object") throw new Error(`${fileName}: has no [parameters]`);
  const record: ParameterRecord = {
    kind,
    name: String(document.name || fileName.replace(/\.toml$/i, "")),
    description: String(document.description ?? ""),
    source: String(document.source ?? ""),
    values: {},
  };
  for (const [name, found] of Object.entries(table)) {
    const description = describe.get(name);
    if (description?.of !== kind) throw new Error(`${fileName}: ${name} is no parameter of a ${kind}`);
    try {
      if (name === "forward_lean_angle" && typeof found === "object" && found !== null) {
        record.forward_lean_angles = Object.fromEntries(
          Object.entries(found).map(([bicycle, angle]) => [bicycle, parseQuantity(angle, "rad")]),
        );
      } else {
        record.values[name] = parseQuantity(found, description.unit);
      }
    } catch (error) {
      throw new Error(`${fileName}: ${name}: ${(error as Error).message}`);
    }
  }
  const missing = DESCRIPTIONS.filter((d) => d.of === kind && !d.optional && !(d.name in record.values));
  if (missing.length) throw new Error(`${fileName}: [parameters] lacks ${missing.map((d) => d.name).join(", ")}`);
  return record;
}

/** A design as our files: the bicycle's, and the rider's where there is one. */
export function writeRecords(design: Design): { name: string; text: string }[] {
  const values = valuesOf(design);
  return [bicycleOf(design), riderOf(design)]
    .filter((record) => record !== undefined)
    .map((record) => ({ name: `${record.name}-changed.toml`, text: recordText(record, values) }));
}

function recordText(record: ParameterRecord, values: Values): string {
  const quote = JSON.stringify;
  const lines = [`kind = ${quote(record.kind)}`, `name = ${quote(`${record.name}-changed`)}`];
  lines.push(`description = ${quote(record.description)}`, `source = ${quote(record.source)}`, "", "[parameters]");
  for (const { name, of, unit, meaning } of DESCRIPTIONS) {
    if (of === record.kind && name in values) {
      const number = Number.isInteger(values[name]) ? `${values[name]}.0` : String(values[name]);
      lines.push(`${name} = ${unit ? quote(`${number} ${unit.replaceAll("**", "^")}`) : number} # ${meaning}`);
    }
  }
  return `${lines.join("\n")}\n`;
}
