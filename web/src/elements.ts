/** Elements of the page by name, and the two kinds that are filled again and again. */

import type { LinearModel } from "./characteristic";

export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (found === null) throw new Error(`the page has no element ${id}`);
  return found as T;
}

/** Fills a select with values, one of them chosen. */
export function choices(id: string, values: string[], chosen: string, words: Record<string, string> = {}): void {
  const select = byId<HTMLSelectElement>(id);
  const options = values.map((value) => {
    const option = document.createElement("option");
    Object.assign(option, { value, textContent: words[value] ?? value, selected: value === chosen });
    return option;
  });
  select.replaceChildren(...options);
}

const UNITS = { M: "kg m²", C0: "N m s", C1: "kg m", S0: "N m", K0: "kg m", K2: "kg" } as const;

/** The matrices as a table; those of springs and dampers only where there are any. */
export function matrixTable(host: HTMLElement, model: LinearModel): void {
  const table = document.createElement("table");
  const head = table.insertRow();
  for (const word of ["", ...model.coordinates, ""]) {
    const cell = document.createElement("th");
    cell.textContent = word;
    head.append(cell);
  }
  for (const [name, unit] of Object.entries(UNITS)) {
    const matrix = model[name as keyof typeof UNITS];
    if ((name === "C0" || name === "S0") && matrix.every((row) => row.every((entry) => entry === 0))) continue;
    matrix.forEach((entries, k) => {
      const row = table.insertRow();
      row.className = k === 0 ? "first" : "";
      const title = document.createElement("th");
      title.textContent = k === 0 ? name : "";
      row.append(title);
      for (const entry of entries) row.insertCell().textContent = entry.toFixed(5).replace("-", "−");
      row.insertCell().textContent = k === 0 ? unit : "";
    });
  }
  host.replaceChildren(table);
}
