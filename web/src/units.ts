/** Units at the edge: what people read and type, against the SI numbers inside. */

interface Shown {
  unit: string;
  factor: number;
  step: number;
}

const SHOWN: Record<string, Shown> = {
  m: { unit: "mm", factor: 1000, step: 1 },
  rad: { unit: "deg", factor: 180 / Math.PI, step: 0.1 },
  kg: { unit: "kg", factor: 1, step: 0.01 },
  "kg*m**2": { unit: "kg m²", factor: 1, step: 0.0001 },
  "m/s**2": { unit: "m/s²", factor: 1, step: 0.01 },
  "N*m/rad": { unit: "N m/rad", factor: 1, step: 1 },
  "N*m*s/rad": { unit: "N m s/rad", factor: 1, step: 0.1 },
  "": { unit: "", factor: 1, step: 0.001 },
};

/** How a parameter of an SI unit is shown. */
export const shown = (unit: string): Shown => SHOWN[unit] ?? { unit, factor: 1, step: 0.001 };

/** A number for reading: four significant digits, no exponent where it can be avoided. */
export function readable(value: number, digits = 4): string {
  if (!Number.isFinite(value)) return Number.isNaN(value) ? "–" : value > 0 ? "∞" : "−∞";
  const text = Number(value.toPrecision(digits)).toString();
  return text.replace("-", "−");
}

const TO_SI: Record<string, number> = {
  ...{ m: 1, cm: 0.01, mm: 0.001, in: 0.0254, ft: 0.3048, kg: 1, g: 0.001, lb: 0.45359237 },
  ...{ rad: 1, deg: Math.PI / 180, "°": Math.PI / 180, "N/kg": 1, "m/s^2": 1, "m/s**2": 1, "%": 0.01 },
  ...{ "kg*m^2": 1, "kg*m**2": 1, "": 1 },
};
const LENGTHS = ["m", "cm", "mm", "in", "ft"];
const KINDS: Record<string, string[]> = {
  m: LENGTHS,
  kg: ["kg", "g", "lb"],
  rad: ["rad", "deg", "°"],
  "m/s**2": ["N/kg", "m/s^2", "m/s**2"],
  "kg*m**2": ["kg*m^2", "kg*m**2"],
  "": ["", "%"],
};
const NUMBER = "[+-]?(?:\\d+\\.?\\d*|\\.\\d+)(?:[eE][+-]?\\d+)?";
const QUANTITY = new RegExp(`^\\s*(${NUMBER})\\s*(?:(?:\\+/-|±)\\s*${NUMBER}\\s*)?(.*?)\\s*$`);

/** "290 mm" as an SI number; throws an Error that says what is wrong. */
export function parseQuantity(found: unknown, unit: string): number {
  if (typeof found === "number") return found;
  const match = typeof found === "string" ? QUANTITY.exec(found) : null;
  if (match === null) throw new Error(`found ${JSON.stringify(found)}, must be a number with an optional unit`);
  const [, value, written] = match;
  const kinds = KINDS[unit] ?? [unit];
  if (written !== "" && !kinds.includes(written)) {
    throw new Error(`found "${match[0].trim()}", must be in ${kinds.filter(Boolean).join(", ") || "no unit"}`);
  }
  const factor = written === "" ? 1 : TO_SI[written];
  // 290 mm is 0.29 m to the last digit: divide by whole numbers rather than multiply by their inverse.
  return factor < 1 && Number.isInteger(Math.round(1 / factor)) && Math.abs(factor * Math.round(1 / factor) - 1) < 1e-15
    ? Number(value) / Math.round(1 / factor)
    : Number(value) * factor;
}
