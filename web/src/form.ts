/** The form of a geometry sheet: a field for each entry, in the units of charts; every change makes the bicycle anew. */

import { SHEETS } from "./data";
import type { Design } from "./design";
import { entriesOf, PREFIX, SHEET, sheetOf, tyreOf } from "./sheets";
import { shown } from "./units";

const ENDS = ["front", "rear"];
const words = (name: string): string => name.replaceAll("_", " ");

export class SheetForm {
  private readonly fields = new Map<string, HTMLInputElement>();
  private readonly tyres = new Map<string, HTMLInputElement>();
  private readonly bar = document.createElement("select");

  constructor(
    private readonly host: HTMLElement,
    private readonly onChange: (changes: Record<string, unknown>) => void,
  ) {
    this.bar.append(...SHEETS.map((sheet) => new Option(sheet.bar, sheet.bar)));
    this.bar.addEventListener("change", () => this.onChange({ bar: this.bar.value }));
    this.row("sheet-bar", "handlebar", "kind of handlebar; each begins at a bicycle of its kind", this.bar);
    for (const end of ENDS) this.addTyre(end);
    for (const { name, unit, meaning } of SHEETS[0].inputs) if (!name.includes("tyre")) this.addField(name, unit, meaning);
  }

  private row(id: string, label: string, title: string, field: HTMLElement): void {
    const row = document.createElement("div");
    const name = document.createElement("label");
    row.className = "entry";
    field.id = name.htmlFor = id;
    Object.assign(name, { textContent: label, title });
    row.append(name, field);
    this.host.append(row);
  }

  private addTyre(end: string): void {
    const field = Object.assign(document.createElement("input"), { type: "text", size: 7 });
    field.addEventListener("change", () => {
      const size = tyreOf(field.value);
      field.setCustomValidity(size ? "" : "width and bead diameter in mm, as 37-622");
      field.reportValidity();
      if (size) this.onChange({ [`${PREFIX}${end} tyre width`]: size[0], [`${PREFIX}${end} tyre diameter`]: size[1] });
    });
    this.tyres.set(end, field);
    this.row(`sheet-${end}-tyre`, `${end} tyre (ETRTO)`, "width and bead diameter in mm, as on its side", field);
  }

  private addField(name: string, unit: string, meaning: string): void {
    const { unit: written, factor, step } = shown(unit);
    const field = Object.assign(document.createElement("input"), { type: "number", step: String(step) });
    field.addEventListener("change", () => {
      const value = Number(field.value);
      if (field.value.trim() !== "" && Number.isFinite(value)) this.onChange({ [PREFIX + name]: value / factor });
    });
    this.fields.set(name, field);
    this.row(`sheet-${name}`, `${words(name)} (${written})`, meaning, field);
  }

  /** Shows the entries of a design. */
  show(design: Design): void {
    const entries = entriesOf(design.bar, design.sheet);
    this.host.classList.toggle("unused", design.bicycle !== SHEET);
    this.bar.value = design.bar;
    for (const { name, unit } of sheetOf(design.bar).inputs) {
      const field = this.fields.get(name);
      const { factor, step } = shown(unit);
      if (field && document.activeElement !== field) field.value = String(Number((entries[name] * factor).toFixed(step < 0.1 ? 3 : 2)));
    }
    for (const [end, field] of this.tyres) {
      const size = ["width", "diameter"].map((part) => Math.round(1000 * entries[`${end} tyre ${part}`]));
      if (document.activeElement !== field) field.value = size.join("-");
    }
  }
}
