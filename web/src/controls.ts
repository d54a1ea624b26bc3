/** Sliders and number fields, with units people read; every one says what it is to a screen reader too. */

import { describe, type Description } from "./data";
import { shown } from "./units";

interface Slider {
  name: string;
  label: string;
  low: number;
  high: number;
  /** Shown as 90 deg less the parameter (a head angle is the complement of the steer axis tilt). */
  complement?: boolean;
}

/** Parameters with sliders; the ends are in SI. */
export const SLIDERS: Slider[] = [
  { name: "trail", label: "trail", low: -0.02, high: 0.14 },
  { name: "steer_axis_tilt", label: "head angle", low: (5 * Math.PI) / 180, high: (35 * Math.PI) / 180, complement: true },
  { name: "wheel_base", label: "wheel base", low: 0.85, high: 1.4 },
  { name: "handlebar_length", label: "grips behind the stem", low: -0.15, high: 0.3 },
  { name: "stem_length", label: "stem length", low: 0.03, high: 0.35 },
  { name: "handlebar_width", label: "handlebar width", low: 0.3, high: 0.85 },
  { name: "seat_post_length", label: "seat post length", low: 0.05, high: 0.35 },
  { name: "seat_tube_angle", label: "seat tube angle", low: (60 * Math.PI) / 180, high: (80 * Math.PI) / 180 },
  { name: "front_wheel_inertia_yy", label: "front wheel spin inertia", low: 0.02, high: 0.35 },
  { name: "rider_mass", label: "rider mass", low: 30, high: 130 },
  { name: "forward_lean_angle", label: "torso angle", low: (35 * Math.PI) / 180, high: (89 * Math.PI) / 180 },
  { name: "torso_length", label: "torso length", low: 0.35, high: 0.65 },
  { name: "upper_arm_length", label: "upper arm", low: 0.2, high: 0.4 },
  { name: "lower_arm_length", label: "lower arm and hand", low: 0.22, high: 0.45 },
  { name: "upper_leg_length", label: "upper leg", low: 0.3, high: 0.6 },
  { name: "spring at torso lean", label: "torso spring", low: 0, high: 1500 },
  { name: "damper at torso lean", label: "torso damper", low: 0, high: 150 },
  { name: "spring at steer", label: "steer spring", low: 0, high: 30 },
  { name: "damper at steer", label: "steer damper", low: 0, high: 5 },
];

interface Row {
  row: HTMLElement;
  range: HTMLInputElement;
  number: HTMLInputElement;
  reset: HTMLButtonElement;
  slider: Slider;
  description: Description;
}

export class Controls {
  private readonly rows: Row[] = [];

  constructor(
    private readonly host: HTMLElement,
    private readonly onChange: (name: string, value: number | null) => void,
  ) {
    for (const slider of SLIDERS) {
      const description = describe.get(slider.name);
      if (description !== undefined) this.rows.push(this.makeRow(slider, description));
    }
  }

  private makeRow(slider: Slider, description: Description): Row {
    const { unit, factor, step } = shown(description.unit);
    const shownEnds = [slider.low, slider.high].map((end) => this.toShown(slider, end, factor)).sort((a, b) => a - b);
    const row = document.createElement("div");
    row.className = "control";
    const label = document.createElement("label");
    const range = document.createElement("input");
    const number = document.createElement("input");
    const reset = document.createElement("button");
    label.textContent = `${slider.label} (${unit})`;
    label.htmlFor = range.id = `slider-${slider.name.replaceAll(" ", "-")}`;
    label.title = description.meaning;
    Object.assign(range, { type: "range", min: String(shownEnds[0]), max: String(shownEnds[1]), step: String(step) });
    Object.assign(number, { type: "number", step: String(step) });
    number.setAttribute("aria-label", `${slider.label} in ${unit}`);
    Object.assign(reset, { type: "button", textContent: "↺", title: `reset ${slider.label}` });
    reset.setAttribute("aria-label", `reset ${slider.label}`);
    const take = (text: string) => {
      const value = Number(text);
      if (text.trim() !== "" && Number.isFinite(value)) this.onChange(slider.name, this.fromShown(slider, value, factor));
    };
    range.addEventListener("input", () => take(range.value));
    number.addEventListener("change", () => take(number.value));
    reset.addEventListener("click", () => this.onChange(slider.name, null));
    row.append(label, range, number, reset);
    this.host.append(row);
    return { row, range, number, reset, slider, description };
  }

  private toShown(slider: Slider, value: number, factor: number): number {
    return slider.complement ? 90 - value * factor : value * factor;
  }

  private fromShown(slider: Slider, value: number, factor: number): number {
    return (slider.complement ? 90 - value : value) / factor;
  }

  /** Shows the values of a design; parameters that its model does not read are hidden. */
  show(values: Record<string, number>, changed: Record<string, number>, reads: readonly string[]): void {
    for (const { row, range, number, reset, slider, description } of this.rows) {
      const value = values[slider.name];
      row.hidden = !reads.includes(slider.name) || value === undefined || Number.isNaN(value);
      if (row.hidden) continue;
      const { factor, step } = shown(description.unit);
      const text = String(Number(this.toShown(slider, value, factor).toFixed(step < 0.01 ? 4 : 2)));
      if (document.activeElement !== range) range.value = text;
      if (document.activeElement !== number) number.value = text;
      reset.disabled = !(slider.name in changed);
    }
  }
}
