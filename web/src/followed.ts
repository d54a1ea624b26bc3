/**
 * Modes of any number of freedoms, followed and named by the rules of linear/naming.py: further coordinates are named at a
 * riding speed, the four others at high speed; from there names are carried through all meetings of roots.
 */

import { determinant, type LinearModel, pencilAt } from "./characteristic";
import { type Complex, conjugate, size, subtract } from "./complex";
import { eigenmotion } from "./motion";
import { rootsNear } from "./polished";
import { roots } from "./polynomial";
import { type Units, unitsOf } from "./units-of-pencil";

const [CAPSIZE, CASTERING, FURTHER] = [2, 3, 4];
const EDGES = [0, ...Array.from({ length: 16 }, (_, k) => [1, 1.5].map((x) => x * 2 ** (k - 6))).flat()];
const RIDING = [3, 4, 6];
/** Two speeds nearer than this, in units of the pencil, with another number of real roots: the meeting is between. */
const NARROW = 1e-7;
/** The part that a coordinate takes in a root that is not there. */
const NONE = -9;

interface Node {
  v: number;
  roots: Complex[];
  columns: number[];
}

export class FollowedModes {
  readonly names: string[];
  private readonly units: Units;
  private readonly nodes: Node[] = [];

  constructor(private readonly model: LinearModel) {
    const further = model.coordinates.slice(2).flatMap((name) => [name, name]);
    this.names = ["weave", "weave", "capsize", "castering", ...further];
    this.units = unitsOf(model);
    this.followAll();
  }

  private polynomialAt(v: number): number[] {
    return determinant(pencilAt(this.model, v * this.units.speed));
  }

  private rootsAt(v: number, guesses?: Complex[]): Complex[] {
    const polynomial = this.polynomialAt(v);
    return guesses ? rootsNear(polynomial, guesses) : roots(polynomial);
  }

  /** Roots at a speed in m/s, in the order of names. */
  at(speed: number): Complex[] {
    const v = speed / this.units.speed;
    // Nodes run from high to low speeds: the last one that is not below.
    let [low, high] = [0, this.nodes.length - 1];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.nodes[middle].v >= v) low = middle;
      else high = middle - 1;
    }
    const node = this.nodes[low];
    const found = node.v === v ? node : this.advance(node, v);
    const named = new Array<Complex>(this.names.length);
    found.columns.forEach((column, place) => (named[column] = found.roots[place]));
    return upperFirst(named);
  }

  private followAll(): void {
    const top = EDGES[EDGES.length - 1];
    const highest = inOrder(this.rootsAt(top));
    const reference = this.ridingNode();
    const up = this.path(reference, gridBetween(reference.v, top));
    const carried = carry(up[up.length - 1], highest).map((column) => (column >= FURTHER ? column : -1));
    const columns = casteringGrows(highest, this.rootsAt(top / 2), nameFour(highest, carried));
    const start = { v: top, roots: highest, columns };
    this.nodes.push(start, ...this.path(start, gridBetween(0, top).reverse().slice(1)));
  }

  private path(start: Node, speeds: number[]): Node[] {
    const found: Node[] = [];
    let node = start;
    for (const v of speeds) {
      if (v === node.v) continue;
      node = this.advance(node, v);
      found.push(node);
    }
    return found.length ? found : [start];
  }

  /** The riding speed, of some, at which the parts that coordinates take are told apart best, with the further ones named. */
  private ridingNode(): Node {
    let best: { node: Node; clear: number } | null = null;
    for (const factor of RIDING) {
      const wanted = this.units.riding * factor;
      const place = Math.min(Math.max(EDGES.findIndex((edge) => edge >= wanted), 1), EDGES.length - 2);
      const v = EDGES[place];
      const found = inOrder(this.rootsAt(v));
      const { columns, clear } = nameFurther(found, this.parts(found, v));
      if (best === null || clear > best.clear) best = { node: { v, roots: found, columns: nameFour(found, columns) }, clear };
    }
    return (best as { node: Node }).node;
  }

  /** How much each coordinate takes part in the motion of each root; adds up to one. */
  private parts(found: Complex[], v: number): number[][] {
    return found.map((root) => {
      const motion = eigenmotion(this.model, v * this.units.speed, root);
      const squares = motion.map((x, i) => ((size(x) / this.units.masses[i]) * this.units.weights[i]) ** 2);
      const total = squares.reduce((a, b) => a + b, 0);
      return squares.map((x) => x / total);
    });
  }

  /** Carries names from a node to another speed, halving the way where it is not clear which root is which. */
  private advance(node: Node, v: number, depth = 0): Node {
    const next = this.rootsAt(v, node.roots);
    const columns = matched(node, next);
    if (columns !== null) return { v, roots: next, columns };
    if (Math.abs(v - node.v) <= NARROW * (1 + v) || depth > 40) return { v, roots: next, columns: throughMeeting(node, next, v > node.v) };
    const middle = this.advance(node, (node.v + v) / 2, depth + 1);
    return this.advance(middle, v, depth + 1);
  }
}

/** Speeds between two, closer together where a bicycle rides. */
function gridBetween(low: number, high: number): number[] {
  const inside = EDGES.flatMap((edge, k) => {
    if (k + 1 === EDGES.length) return [edge];
    const parts = edge >= 0.2 && edge < 16 ? 8 : 3;
    return Array.from({ length: parts }, (_, part) => edge + ((EDGES[k + 1] - edge) * part) / parts);
  });
  return [low, ...inside.filter((v) => v > low && v < high), high];
}

/** Real roots ascending, then pairs by modulus, the upper root first: an order that lasts above all meetings. */
function inOrder(found: readonly Complex[]): Complex[] {
  const real = found.filter((root) => root.im === 0).sort((a, b) => a.re - b.re);
  const upper = found.filter((root) => root.im > 0).sort((a, b) => size(a) - size(b));
  return [...real, ...upper.flatMap((root) => [root, conjugate(root)])];
}

/** Columns of the same roots in another order. */
function carry(node: Node, other: readonly Complex[]): number[] {
  const free = node.roots.map((_, k) => k);
  return other.map((root) => {
    let best = 0;
    free.forEach((k, place) => {
      if (size(subtract(node.roots[k], root)) < size(subtract(node.roots[free[best]], root))) best = place;
    });
    return node.columns[free.splice(best, 1)[0]];
  });
}

/** Columns of the next roots where it is clear which is which: as many real ones, in order; pairs that hardly move. */
function matched(node: Node, next: readonly Complex[]): number[] | null {
  const places = (found: readonly Complex[], wanted: (root: Complex) => boolean) =>
    found.map((root, k) => (wanted(root) ? k : -1)).filter((k) => k >= 0);
  const isReal = (root: Complex) => root.im === 0;
  const byValue = (found: readonly Complex[]) => places(found, isReal).sort((a, b) => found[a].re - found[b].re);
  const [realBefore, realAfter] = [byValue(node.roots), byValue(next)];
  if (realBefore.length !== realAfter.length) return null;
  const columns = new Array<number>(next.length);
  realAfter.forEach((place, k) => (columns[place] = node.columns[realBefore[k]]));
  const isUpper = (root: Complex) => root.im > 0;
  const [before, after] = [places(node.roots, isUpper), places(next, isUpper)];
  for (const place of after) {
    const gaps = before.map((k) => size(subtract(node.roots[k], next[place])));
    const best = gaps.indexOf(Math.min(...gaps));
    const rival = Math.min(...gaps.filter((_, k) => k !== best), Infinity);
    if (before.length > 1 && gaps[best] > 0.25 * rival) return null;
    columns[place] = node.columns[before[best]];
    const mirror = (found: readonly Complex[], k: number) =>
      found.findIndex((root) => root.re === found[k].re && root.im === -found[k].im);
    columns[mirror(next, place)] = node.columns[mirror(node.roots, before[best])];
  }
  // Real roots that come very near may have met and parted on the way: look closer.
  if (new Set(columns).size !== columns.length || columns.includes(undefined as never)) return null;
  return movedLittle(node, next, realBefore, realAfter) ? columns : null;
}

function movedLittle(node: Node, next: readonly Complex[], before: number[], after: number[]): boolean {
  for (let k = 0; k + 1 < before.length; k++) {
    const gap = node.roots[before[k + 1]].re - node.roots[before[k]].re;
    const later = next[after[k + 1]].re - next[after[k]].re;
    const moved = Math.max(Math.abs(next[after[k]].re - node.roots[before[k]].re), Math.abs(next[after[k + 1]].re - node.roots[before[k + 1]].re));
    if (Math.min(gap, later) < 0.5 * moved && Math.min(gap, later) > 1e-5 * (1 + Math.abs(next[after[k]].re))) return false;
  }
  return true;
}

/** Columns on the other side of a meeting of two real roots, or of a pair that splits. */
function throughMeeting(node: Node, next: readonly Complex[], up: boolean): number[] {
  const realBefore = node.roots.filter((root) => root.im === 0).length;
  const realAfter = next.filter((root) => root.im === 0).length;
  const joins = realAfter < realBefore;
  const [few, many] = joins ? [next, node.roots] : [node.roots, next];
  // The pair that is real on the other side: the one nearest to the real axis.
  let upper = -1;
  few.forEach((root, k) => {
    if (root.im > 0 && (upper < 0 || root.im < few[upper].im)) upper = k;
  });
  if (upper < 0 || realAfter === realBefore) return carry(node, next);
  const lower = few.findIndex((root) => root.re === few[upper].re && root.im === -few[upper].im);
  const near = many
    .map((root, k) => [root.im === 0 ? Math.abs(root.re - few[upper].re) : Infinity, k])
    .sort((a, b) => a[0] - b[0])
    .slice(0, 2)
    .map(([, k]) => k)
    .sort((a, b) => many[a].re - many[b].re);
  // The lower of two real roots goes with the upper root of the pair.
  const [from, to] = joins ? [near, [upper, lower]] : [[upper, lower], near];
  const columns = new Array<number>(next.length).fill(-1);
  const own = from.map((place) => node.columns[place]);
  // A pair of castering and a further coordinate splits: castering grows with the speed, the faster is the lower root.
  const faster = Math.abs(next[to[0]].re) >= Math.abs(next[to[1]].re) ? 0 : 1;
  const wanted = up ? faster : 1 - faster;
  if (!joins && own.includes(CASTERING) && Math.max(...own) >= FURTHER && own[wanted] !== CASTERING) own.reverse();
  to.forEach((place, k) => (columns[place] = own[k]));
  const rest = node.roots.map((_, k) => k).filter((k) => !from.includes(k));
  const others = next.map((_, k) => k).filter((k) => !to.includes(k));
  const restNode = { v: node.v, roots: rest.map((k) => node.roots[k]), columns: rest.map((k) => node.columns[k]) };
  carry(restNode, others.map((k) => next[k])).forEach((column, k) => (columns[others[k]] = column));
  return joins ? weaveGoesOn(columns, to, next) : columns;
}

/** Columns at the highest speed, where castering is no root that falls: it decays the faster the higher the speed. */
function casteringGrows(found: readonly Complex[], slower: readonly Complex[], columns: number[]): number[] {
  const nearest = (wanted: Complex) => Math.min(...slower.map((root) => size(subtract(wanted, root))));
  const grows = (root: Complex) => root.im === 0 && nearest({ re: root.re / 2, im: 0 }) < nearest(root);
  const now = columns.findIndex((column, k) => column === CASTERING && found[k].im === 0 && found[k].re > 0);
  const instead = columns.findIndex((column, k) => column >= FURTHER && grows(found[k]) && found[k].re < 0);
  const result = [...columns];
  if (now >= 0 && instead >= 0) [result[now], result[instead]] = [columns[instead], columns[now]];
  return result;
}

/** Where half of weave meets another mode's root, the oscillation goes on as weave; its other half takes the other's name. */
function weaveGoesOn(columns: number[], pair: number[], next: readonly Complex[]): number[] {
  const [one, other] = pair.map((place) => columns[place]);
  if (one < CAPSIZE === other < CAPSIZE) return columns;
  const weave = one < CAPSIZE ? one : other;
  const lostPlace = one < CAPSIZE ? pair[1] : pair[0];
  const restPlace = columns.indexOf(1 - weave);
  if (next[restPlace].im !== 0) return columns;
  const result = [...columns];
  [result[restPlace], result[lostPlace]] = [columns[lostPlace], 1 - weave];
  return result;
}

/** Columns of the roots in which further coordinates take most part, -1 for the four others; and how clear that is. */
function nameFurther(found: readonly Complex[], parts: number[][]): { columns: number[]; clear: number } {
  const columns = found.map(() => -1);
  const waiting = new Set(parts[0].slice(2).map((_, k) => k));
  // A root that is mostly steer is castering.
  const part = (k: number, which: number) => parts[k][2 + which] - parts[k][1];
  let clear = Infinity;
  while (waiting.size) {
    const choices = [...waiting].map((which) => ({ which, ...ownRoots(found, columns, (k) => part(k, which)) }));
    const best = choices.reduce((a, b) => (b.share > a.share ? b : a));
    best.places.forEach((place, k) => (columns[place] = FURTHER + 2 * best.which + k));
    waiting.delete(best.which);
    const rest = Math.max(0, ...found.map((_, k) => (columns[k] < 0 ? part(k, best.which) : 0)));
    clear = Math.min(clear, best.places.reduce((sum, k) => sum + part(k, best.which), 0) / 2 - rest);
  }
  return { columns, clear };
}

/** Two roots, of those without a column, in which a coordinate takes most part: a pair, two real ones, or one of each. */
function ownRoots(found: readonly Complex[], columns: number[], part: (k: number) => number): { share: number; places: number[] } {
  const free = found.map((_, k) => k).filter((k) => columns[k] < 0);
  const pairs = free.filter((k) => found[k].im > 0 && columns[k + 1] < 0);
  const reals = free.filter((k) => found[k].im === 0).sort((a, b) => part(b) - part(a));
  const pair = pairs.length ? pairs.reduce((a, b) => (part(b) > part(a) ? b : a)) : 0;
  const asPair = pairs.length ? part(pair) : NONE;
  const [first, second] = [0, 1].map((k) => (k < reals.length ? part(reals[k]) : NONE));
  // One root has met capsize: half of the slowest pair, beside which there is one that is weave.
  const asMixed = pairs.length > 1 && first > asPair ? (first + part(pairs[0])) / 2 : NONE;
  const asReals = (first + second) / 2;
  const share = Math.max(asPair, asReals, asMixed);
  if (asMixed > Math.max(asPair, asReals)) return { share, places: [reals[0], pairs[0] + 1] };
  return { share, places: asPair >= asReals ? [pair, pair + 1] : reals.slice(0, 2).sort((a, b) => a - b) };
}

/** Names the four roots that lean and steer have, in the order that lasts. */
function nameFour(found: readonly Complex[], columns: number[]): number[] {
  const result = [...columns];
  const four = columns.map((_, k) => k).filter((k) => columns[k] < 0);
  const real = four.filter((k) => found[k].im === 0);
  if (real.length === 0) {
    const order = found[four[0]].re < 0 ? [CASTERING, CAPSIZE, 0, 1] : [CAPSIZE, CASTERING, 0, 1];
    four.forEach((place, k) => (result[place] = order[k]));
    return result;
  }
  // Half of a pair, of which a further coordinate has the other half, is capsize.
  const half = four.filter((k) => found[k].im !== 0 && !four.some((j) => same(found[j], conjugate(found[k]))));
  const capsize = half.length ? half[0] : real.reduce((a, b) => (Math.abs(found[b].re) < Math.abs(found[a].re) ? b : a));
  const castering = capsize === four[0] ? four[1] : four[0];
  [result[capsize], result[castering]] = [CAPSIZE, CASTERING];
  four.filter((k) => k !== capsize && k !== castering).forEach((place, k) => (result[place] = k));
  return result;
}

/** The upper root of a pair, or the lower of two real ones, first: weave, and each further coordinate. */
function upperFirst(named: Complex[]): Complex[] {
  const result = [...named];
  for (const first of [0, ...named.map((_, k) => k).filter((k) => k >= FURTHER && k % 2 === 0)]) {
    const [one, other] = [result[first], result[first + 1]];
    const bothReal = one.im === 0 && other.im === 0;
    if ((one.im < 0 && other.im > 0) || (bothReal && one.re > other.re)) [result[first], result[first + 1]] = [other, one];
  }
  return result;
}

function same(one: Complex, other: Complex): boolean {
  return one.re === other.re && one.im === other.im;
}
