/** The moving picture: a motion in time, heading and path on the road, drawn once a frame. */

import type { Answer } from "./answers";
import type { Complex } from "./complex";
import { skeletonOf } from "./equations";
import { byId } from "./elements";
import { at, kickedMotion, modalMotion, type Motion } from "./motion";
import { Scene } from "./scene";

/** Beyond this lean (rad) small angles are none: the ride begins again. */
const FALLEN = 0.75;

export class Ride {
  private readonly scene: Scene;
  private found: Answer | null = null;
  private roots: Complex[] = [];
  private motion: Motion | null = null;
  private chosen = new Set(["weave"]);
  private kicked = false;
  private time = 0;
  private last = 0;
  private place = { x: 0, y: 0, heading: 0, rolled: 0 };
  playing = true;
  pace = 0.5;

  constructor() {
    this.scene = new Scene(byId<HTMLCanvasElement>("scene"));
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) this.playing = false;
    requestAnimationFrame((now) => this.frame(now));
  }

  set follows(value: boolean) {
    this.scene.follows = value;
  }

  /** Takes the answer to a design and its eigenvalues at the speed that is shown. */
  take(found: Answer, roots: Complex[]): void {
    const rebuilt = this.found === null || this.found.values !== found.values;
    this.found = found;
    this.roots = roots;
    if (rebuilt) this.scene.build(found.values, this.points([]));
    this.scene.stale = true;
    this.begin();
    this.showChoices();
  }

  choose(mode: string): void {
    this.kicked = false;
    if (this.chosen.has(mode) && this.chosen.size > 1) this.chosen.delete(mode);
    else this.chosen.add(mode);
    this.begin();
    this.showChoices();
  }

  /** Shows one mode alone. */
  only(mode: string): void {
    this.chosen = new Set([mode]);
    this.kicked = false;
    this.begin();
    this.showChoices();
  }

  kick(): void {
    this.kicked = true;
    this.begin();
    this.showChoices();
  }

  private begin(): void {
    const found = this.found as Answer;
    const { model, design } = found;
    this.time = 0;
    this.place = { x: 0, y: 0, heading: 0, rolled: 0 };
    this.scene.clearPaths();
    if (this.kicked) {
      this.motion = kickedMotion(model, design.speed, this.roots);
      return;
    }
    // Of a pair one root is enough: the other is its mirror.
    const wanted = this.roots.filter((root, k) => this.chosen.has(found.names[k]) && root.im >= 0);
    this.motion = modalMotion(model, design.speed, wanted.length ? wanted : [this.roots[0]]);
  }

  private showChoices(): void {
    const names = [...new Set((this.found as Answer).names)];
    for (const name of [...this.chosen]) if (!names.includes(name)) this.chosen.delete(name);
    if (this.chosen.size === 0) this.chosen.add(names[0]);
    const host = byId("motions");
    const buttons = names.map((name) => {
      const button = document.createElement("button");
      Object.assign(button, { type: "button", textContent: name });
      button.setAttribute("aria-pressed", String(!this.kicked && this.chosen.has(name)));
      button.addEventListener("click", () => (this.kicked ? this.only(name) : this.choose(name)));
      return button;
    });
    if (host.textContent !== names.join("")) host.replaceChildren(...buttons);
    else host.querySelectorAll("button").forEach((old, k) => old.replaceWith(buttons[k]));
    byId("kick").setAttribute("aria-pressed", String(this.kicked));
  }

  private points(freedoms: number[]): Float64Array | null {
    const found = this.found as Answer;
    const all = found.variant.coordinates.slice(1).map((_, k) => freedoms[k] ?? 0);
    return skeletonOf(found.variant, found.inputs, all);
  }

  private frame(now: number): void {
    requestAnimationFrame((next) => this.frame(next));
    const step = Math.min((now - this.last) / 1000, 0.1) * this.pace;
    this.last = now;
    if (this.found === null || this.motion === null) return;
    if (this.playing) this.advance(step);
    else if (!this.scene.stale) return; // a still picture is drawn once: a phone's battery is small
    const { angles } = at(this.motion, this.time);
    const [lean, ...others] = angles;
    const pose = { points: this.points(others), lean, steer: others[0] ?? 0, ...this.place };
    this.scene.draw(pose, this.playing);
  }

  private advance(step: number): void {
    const motion = this.motion as Motion;
    const { values, design } = this.found as Answer;
    this.time += step;
    const { angles, rates } = at(motion, this.time);
    if (this.time > motion.duration || Math.abs(angles[0]) > FALLEN || Math.abs(angles[1]) > 1.2) {
      this.begin();
      return;
    }
    // The rear contact goes where the rear wheel points; steer turns the heading, by trail even at rest.
    const cosine = Math.cos(values.steer_axis_tilt) / values.wheel_base;
    this.place.heading += step * cosine * (design.speed * angles[1] + values.trail * rates[1]);
    this.place.x += step * design.speed * Math.cos(this.place.heading);
    this.place.y += step * design.speed * Math.sin(this.place.heading);
    this.place.rolled += step * design.speed;
  }
}
