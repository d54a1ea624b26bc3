/** The page: one design that is shown, the ones before it, the pinned ones; every change goes through `change`. */

import { type Answer, answer, curvesOf, result } from "./answers";
import { Chart, type Overlay } from "./chart";
import type { Complex } from "./complex";
import { Controls } from "./controls";
import { addRecord, assign, bicycleNames, canSeat, type Design, firstDesign, fromAddress, riderNames, springsOf, toAddress } from "./design";
import { SheetForm } from "./form";
import { readRecord } from "./records";
import { Ride } from "./ride";
import { readScheme } from "./style";
import { eigenmotion } from "./motion";
import { drawPhasors } from "./phasors";
import { byId, choices, matrixTable } from "./elements";
import { VARIANTS } from "./data";
import { PREFIX, SHEET } from "./sheets";
import { readable } from "./units";

const MOST_PINS = 3;
const FIRST = ["bicycle", "bar", "rider", "posture", "arms", "torso_lean"];
const KMH = 3.6;

export class Page {
  private design: Design;
  private shownAnswer: Answer;
  private message = "";
  private readonly before: Design[] = [];
  private pins: { design: Design; overlay: Overlay }[] = [];
  private readonly ride = new Ride();
  private readonly chart: Chart;
  private readonly controls: Controls;
  private readonly form: SheetForm;
  /** How long the last redraw took, in ms. */
  lastRedraw = 0;

  constructor() {
    readScheme();
    this.chart = new Chart(byId("chart"), (speed) => this.change({ speed }));
    this.controls = new Controls(byId("controls"), (name, value) =>
      value === null ? this.dropChange(name) : this.change({ [name]: value }),
    );
    this.form = new SheetForm(byId("sheet"), (changes) => this.change(changes));
    const first = firstDesign();
    this.design = location.hash.length > 1 ? fromAddress(location.hash.slice(1)) : first;
    let found = answer(this.design);
    if (typeof found === "string") {
      this.message = found;
      this.design = first;
      found = answer(first) as Answer;
    }
    this.shownAnswer = found;
    this.show(true);
  }

  get current(): Answer {
    return this.shownAnswer;
  }

  get rides(): Ride {
    return this.ride;
  }

  /** The chart as a picture. */
  png(): Promise<Blob | null> {
    return this.chart.png();
  }

  result(): Record<string, unknown> {
    return result(this.shownAnswer, this.message);
  }

  /** Sets several things at once; what cannot be is said, and the last possible design stays. */
  change(changes: Record<string, unknown>, remember = true): void {
    const wanted: Design = { ...this.design };
    // What others depend on comes first, in whichever order it was said: a sheet's entries before its rider, and both before changes.
    const early = (name: string): boolean => FIRST.includes(name) || name.startsWith(PREFIX);
    const entries = Object.keys(changes).filter((name) => name.startsWith(PREFIX));
    const order = [...FIRST.slice(0, 2), ...entries, ...FIRST.slice(2)];
    const names = [...order.filter((name) => name in changes), ...Object.keys(changes).filter((name) => !early(name))];
    const refused = names.map((name): [string, unknown] => [name, changes[name]]).filter(([name, value]) => !assign(wanted, name, value));
    if (refused.length) {
      this.say(refused.map(([name, value]) => `${name} = ${JSON.stringify(value)} cannot be set`).join("; "));
      if (refused.length === Object.keys(changes).length) return;
    }
    this.take(wanted, remember, refused.length > 0);
  }

  private take(wanted: Design, remember: boolean, keepMessage = false): void {
    const start = performance.now();
    const onlySpeed = JSON.stringify({ ...wanted, speed: 0 }) === JSON.stringify({ ...this.design, speed: 0 });
    const found = answer(wanted);
    if (typeof found === "string" && wanted.rider && wanted.bicycle === SHEET && this.design.bicycle !== SHEET) {
      // A sheet begins with whom it fits: whoever does not is put aside, and this is said.
      this.take({ ...wanted, rider: "", posture: "rigid", torsoLean: false }, remember, true);
      if (this.design.bicycle === SHEET) this.say(`${found}: shown without rider`);
      return;
    }
    if (typeof found === "string") {
      this.say(found);
      this.showControls();
      return;
    }
    if (remember && !onlySpeed) this.before.push(this.design);
    this.design = wanted;
    this.shownAnswer = found;
    if (!keepMessage) this.say("");
    this.show(!onlySpeed);
    this.lastRedraw = performance.now() - start;
  }

  private say(message: string): void {
    this.message = message;
    byId("message").textContent = message;
  }

  undo(): void {
    const design = this.before.pop();
    if (design) this.take(design, false);
  }

  reset(): void {
    this.take({ ...this.design, changes: {}, sheet: {} }, true);
  }

  private dropChange(name: string): void {
    const { [name]: _, ...changes } = this.design.changes;
    this.take({ ...this.design, changes }, true);
  }

  /** Shows the design again, as after a change of colours. */
  refresh(): void {
    readScheme();
    this.show(true);
  }

  private show(everything: boolean): void {
    const found = this.shownAnswer;
    if (everything) {
      this.chart.show(curvesOf(found), this.pins.map((pin) => pin.overlay), this.design.speed);
      this.showControls();
      matrixTable(byId("matrices"), found.model);
      this.showChoices();
    } else {
      this.chart.moveSpeed(this.design.speed);
    }
    byId<HTMLButtonElement>("undo").disabled = this.before.length === 0;
    const roots = found.modesAt(this.design.speed);
    this.ride.take(found, roots);
    this.showSpeed(roots);
    history.replaceState(null, "", `#${toAddress(this.design)}`);
  }

  private showControls(): void {
    const { values, variant } = this.shownAnswer;
    this.controls.show(values, this.design.changes, [...variant.reads, ...springsOf(variant)]);
    this.form.show(this.design);
  }

  private showChoices(): void {
    const { design } = this;
    const seated = canSeat(design);
    choices("bicycle", bicycleNames(), design.bicycle);
    choices("rider", seated ? ["", ...riderNames()] : [""], design.rider, { "": "none" });
    const postures = design.rider ? VARIANTS.map((v) => v.posture).filter((posture) => posture !== "bare") : ["rigid"];
    choices("posture", [...new Set(postures)], design.posture);
    const arms = VARIANTS.filter((v) => v.posture === design.posture && v.arms !== null).map((v) => v.arms as string);
    choices("arms", arms.length && design.rider ? [...new Set(arms)] : [design.arms], design.arms);
    byId<HTMLSelectElement>("arms").disabled = !arms.length || !design.rider;
    const lean = byId<HTMLInputElement>("torso-lean");
    lean.checked = design.torsoLean;
    lean.disabled = !design.rider || !VARIANTS.some((v) => v.posture === design.posture && v.torso_lean);
    this.showPins();
  }

  private showSpeed(roots: Complex[]): void {
    const { speed } = this.design;
    const inKmh = byId<HTMLSelectElement>("speed-unit").value === "km/h";
    byId<HTMLInputElement>("speed").value = String(speed);
    const field = byId<HTMLInputElement>("speed-number");
    if (document.activeElement !== field) field.value = String(Number((inKmh ? speed * KMH : speed).toFixed(2)));
    const { critical } = this.shownAnswer;
    const unit = (v: number) => (v === Infinity ? "∞" : readable(inKmh ? v * KMH : v, 3));
    const ranges = critical.stableRanges.map(([low, high]) =>
      high === Infinity ? `above ${unit(low)}` : `${unit(low)} to ${unit(high)}`,
    );
    const now = roots.every((root) => root.re < 0) ? "stable at this speed" : "unstable at this speed";
    byId("summary").textContent = `${now}; stable ${ranges.length ? `${ranges.join(", ")} ${inKmh ? "km/h" : "m/s"}` : "at no speed"}`;
    const { model, names } = this.shownAnswer;
    const modes = roots
      .map((root, k) => ({ name: names[k], root, motion: eigenmotion(model, speed, root) }))
      .filter((mode) => mode.root.im >= 0);
    drawPhasors(byId("phasors"), model.coordinates, modes);
  }

  pin(): void {
    const label = "ABC"[this.pins.length % MOST_PINS];
    const kept = this.pins.length === MOST_PINS ? this.pins.slice(1) : this.pins;
    const free = [..."ABC"].find((letter) => !kept.some((pin) => pin.overlay.label === letter)) ?? label;
    this.pins = [...kept, { design: this.design, overlay: { label: free, curves: curvesOf(this.shownAnswer) } }];
    this.show(true);
  }

  private showPins(): void {
    const buttons = this.pins.map((pin, k) => {
      const button = document.createElement("button");
      const { weave, capsize } = pin.overlay.curves.critical;
      const speeds = [...weave, ...capsize].map((v) => readable(v, 3)).join(" and ");
      button.textContent = `${pin.overlay.label}: ${pin.design.bicycle}${pin.design.rider ? `, ${pin.design.posture}` : ""} ${speeds}`;
      button.title = "click: back to this design; shift-click: unpin";
      button.addEventListener("click", (event) => {
        if (event.shiftKey) {
          this.pins = this.pins.filter((_, other) => other !== k);
          this.show(true);
        } else this.take({ ...pin.design }, true);
      });
      return button;
    });
    byId("pins").replaceChildren(...buttons);
  }

  /** Takes a file that was dropped onto the page. */
  async drop(file: File): Promise<void> {
    try {
      const record = readRecord(await file.text(), file.name);
      addRecord(record);
      const kept = record.kind === "bicycle" ? {} : this.design.changes;
      this.design = { ...this.design, changes: kept };
      this.change({ [record.kind]: record.name });
    } catch (error) {
      this.say((error as Error).message);
    }
  }
}
