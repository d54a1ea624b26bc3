/** Eigenvalues as named modes, followed through the speeds: the rules of linear/modes.py, for one design. */

import { monicAt, type Quartic, quarticOf, type LinearModel } from "./characteristic";
import { byRealPart, type Complex, conjugate, size, subtract } from "./complex";
import { findMeetings, type Meetings, speedsBetween } from "./meetings";
import { quarticRoots } from "./quartic";

export const NAMES = ["weave", "weave", "capsize", "castering"];
const WEAVES = 2;

/** Follows the four modes of one design; at any speed all four roots, in the order of NAMES. */
export class Modes {
  readonly names = NAMES;
  private readonly p: Quartic;
  private readonly meetings: Meetings;
  private readonly counts: number[];
  private readonly labels: number[][];

  constructor(model: LinearModel) {
    this.p = quarticOf(model);
    this.meetings = findMeetings(this.p);
    this.counts = speedsBetween(this.meetings).map((v) => realCount(this.rootsAt(v)));
    this.labels = this.followDown();
  }

  rootsAt(v: number): Complex[] {
    return quarticRoots(...monicAt(this.p, v));
  }

  at(v: number): Complex[] {
    const interval = this.meetings.speeds.filter((meeting) => v > meeting).length;
    const ordered = inOrder(this.rootsAt(v), this.counts[interval], v < this.meetings.passing);
    const named = new Array<Complex>(4);
    this.labels[interval].forEach((label, place) => (named[label] = ordered[place]));
    const [first, second] = named;
    const bothReal = first.im === 0 && second.im === 0;
    if ((first.im < 0 && second.im > 0) || (bothReal && first.re > second.re)) {
      [named[0], named[1]] = [second, first];
    }
    return named;
  }

  private followDown(): number[][] {
    const { speeds, passing } = this.meetings;
    const last = speeds.length;
    const labels = new Array<number[]>(last + 1);
    labels[last] = labelsAtInfinity(this.p, this.counts[last]);
    for (let k = last - 1; k >= 0; k--) {
      const at = this.rootsAt(speeds[k]);
      labels[k] = labelsBelow(labels[k + 1], this.counts[k + 1], this.counts[k], at, speeds[k] < passing);
    }
    return labels;
  }
}

const realCount = (roots: readonly Complex[]): number => roots.filter((root) => root.im === 0).length;
const pick = <T>(items: readonly T[], order: readonly number[]): T[] => order.map((k) => items[k]);

/** Roots in the fixed order in which following is bookkeeping: real ones ascending, then pairs. */
function inOrder(roots: readonly Complex[], count: number, descending: boolean): Complex[] {
  const found = [...roots].sort(byRealPart);
  if (count === 4) return found;
  const pair = pairPlaces(found, realCount(found));
  const rest = [0, 1, 2, 3].filter((k) => !pair.includes(k));
  const first = pick(found, rest);
  const second = pick(found, pair).reverse();
  if (count !== 0) return [...first, ...second];
  const swap = first[0].re > second[0].re !== descending;
  const upper = [...first].reverse();
  return swap ? [...second, ...upper] : [...upper, ...second];
}

/** The two of four sorted roots that count as a pair if only two do. */
function pairPlaces(found: readonly Complex[], actual: number): number[] {
  if (actual === 4) {
    let closest = 0;
    for (let k = 1; k < 3; k++) {
      if (found[k + 1].re - found[k].re < found[closest + 1].re - found[closest].re) closest = k;
    }
    return [closest, closest + 1];
  }
  let upper = 3;
  for (let k = 2; k >= 0; k--) if (Math.abs(found[k].im) > Math.abs(found[upper].im)) upper = k;
  const mirrored = conjugate(found[upper]);
  let partner = 0;
  found.forEach((root, k) => {
    if (size(subtract(root, mirrored)) < size(subtract(found[partner], mirrored))) partner = k;
  });
  return [Math.min(upper, partner), Math.max(upper, partner)];
}

/** Above the last meeting: one real root stays bounded (capsize), a real one and a pair grow with the speed. */
function labelsAtInfinity(p: Quartic, count: number): number[] {
  const cubic = [p.a4[0], p.a3[0], p.a2[1], p.a1[1]];
  const mirrored = cubic.map((x, k) => (k % 2 ? x : -x));
  const changes = mirrored.slice(1).filter((x, k) => Math.sign(x) !== Math.sign(mirrored[k])).length;
  const capsize = count === 4 ? changes : cubic[3] * cubic[0] > 0 ? 1 : 0;
  const castering = capsize === 0 ? 1 : 0;
  const labels = new Array<number>(4);
  labels[capsize] = 2;
  labels[castering] = 3;
  const free = [0, 1, 2, 3].filter((k) => k !== capsize && k !== castering);
  [labels[free[0]], labels[free[1]]] = [0, 1];
  return labels;
}

function labelsBelow(labels: number[], above: number, below: number, at: Complex[], descending: boolean): number[] {
  if (below === above) return labels;
  const [place, others] = meetingRoots(at);
  const othersReal = Math.abs(others[0].im) <= size(subtract(others[0], others[1])) * 1e-12;
  const before = others.filter((root) => root.re < place).length;
  const pairFirst = place < others[0].re !== descending;
  const exchange = pick(labels, pairFirst ? [0, 1, 2, 3] : [2, 3, 0, 1]);
  if (below > above) return othersReal ? pick(labels, INSERTED[before]) : exchange;
  return othersReal ? joined(pick(labels, EXTRACTED[before])) : exchange;
}

const INSERTED = [[2, 3, 0, 1], [0, 2, 3, 1], [0, 1, 2, 3]];
const EXTRACTED = [[2, 3, 0, 1], [0, 3, 1, 2], [0, 1, 2, 3]];

/** A pair of weave and another mode is all weave: the oscillation keeps its name. */
function joined(labels: number[]): number[] {
  const taken = [...labels];
  const real = taken.slice(0, 2).map((label) => label < WEAVES);
  const other = taken.slice(2).map((label) => label >= WEAVES);
  if (real.filter(Boolean).length === 1 && other.filter(Boolean).length === 1) {
    const [single, partner] = [real.indexOf(true), 2 + other.indexOf(true)];
    [taken[single], taken[partner]] = [taken[partner], taken[single]];
  }
  return taken;
}

/** The double root and the two others. */
function meetingRoots(at: readonly Complex[]): [number, Complex[]] {
  let best = [0, 1];
  for (let i = 0; i < 4; i++) {
    for (let j = i + 1; j < 4; j++) {
      if (size(subtract(at[i], at[j])) < size(subtract(at[best[0]], at[best[1]]))) best = [i, j];
    }
  }
  const others = [0, 1, 2, 3].filter((k) => !best.includes(k));
  return [(at[best[0]].re + at[best[1]].re) / 2, pick(at, others)];
}
