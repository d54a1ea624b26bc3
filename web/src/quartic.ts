/** Quartics by two real quadratic factors, as in the Python package (linear/quartic): the same algorithm, number by number. */

import { byRealPart, type Complex } from "./complex";
import { roots } from "./polynomial";

const THIRD = 1 / 3;
const ROUNDING = 2e-15;

/** The roots of s⁴ + b s³ + c s² + d s + e, sorted by real, then imaginary part; pairs are exact conjugates. */
export function quarticRoots(b: number, c: number, d: number, e: number): Complex[] {
  const factors = factor(b, c, d, e);
  if (factors === null) return roots([e, d, c, b, 1]);
  const [p1, q1, p2, q2] = factors;
  return [...quadraticRoots(p1, q1), ...quadraticRoots(p2, q2)].sort(byRealPart);
}

function factor(b: number, c: number, d: number, e: number): [number, number, number, number] | null {
  const y = resolventRoot(b, c, d, e);
  const mSquare = 0.25 * b * b - c + y;
  const nSquare = 0.25 * y * y - e;
  const mKept = mSquare * (0.25 * y * y + Math.abs(e)) > nSquare * (0.25 * b * b + Math.abs(c) + Math.abs(y));
  const first = Math.sqrt(mKept ? mSquare : nSquare);
  const other = (0.25 * b * y - 0.5 * d) / first;
  const [m, n] = mKept ? [first, other] : [other, first];
  const turn = y < 0 === n < 0 ? 1 : -1;
  let [p1, q1] = [0.5 * b + turn * m, 0.5 * y + turn * n];
  let q2 = e / q1;
  let p2 = (d - p1 * q2) / q1;
  for (let step = 0; step < 12; step++) {
    [p1, q1, p2, q2] = newtonStep(b, c, d, e, p1, q1, p2, q2);
    if (reproduces(b, c, d, e, p1, q1, p2, q2)) return [p1, q1, p2, q2];
  }
  return null;
}

function resolventRoot(b: number, c: number, d: number, e: number): number {
  const bd4e = b * d - 4 * e;
  const P = bd4e - c * c * THIRD;
  const Q = c * (bd4e * THIRD - c * c * (2 / 27)) - b * b * e + 4 * c * e - d * d;
  const three = P < 0 && Q * Q * 6.75 <= -P * P * P;
  const fourReal =
    8 * c < 3 * b * b && 64 * e - 16 * c * c + 16 * b * b * c - 16 * b * d < 3 * b * b * b * b;
  const inner = three && Q > 0 && !fourReal;
  const sign = inner || Q <= 0 ? 1 : -1;
  const q = -sign * Q;
  let u = cubicStart(P, q, inner);
  for (let step = 0; step < 4; step++) {
    const value = u * (u * u + P) - q;
    const slope = 3 * u * u + P;
    u -= (value * slope) / (slope * slope - 3 * u * value);
  }
  return sign * u + c * THIRD;
}

function cubicStart(P: number, q: number, inner: boolean): number {
  const root = Math.sqrt(Math.abs(P));
  if (inner) {
    const h = root * 0.57735026918962576;
    const cosine = Math.sqrt(0.5 + (0.25 * q) / (h * h * h));
    return h * (1 + cosine * (1.1547 - 0.166 * cosine));
  }
  const outer = Math.cbrt(Math.abs(q) + (P < 0 ? Math.abs(P) * root : 0) + 1e-300);
  return P < 0 ? outer : q / (P + outer * outer);
}

function newtonStep(
  ...[b, c, d, e, p1, q1, p2, q2]: [number, number, number, number, number, number, number, number]
): [number, number, number, number] {
  const [rb, rc] = [b - (p1 + p2), c - (q1 + q2 + p1 * p2)];
  const [rd, re] = [d - (p1 * q2 + p2 * q1), e - q1 * q2];
  const [dp, dq] = [p2 - p1, q2 - q1];
  const inverse = 1 / (dq * dq + dp * (q1 * p2 - p1 * q2));
  const [s1, t1] = [rd - p1 * rc + (p1 * p1 - q1) * rb, re + q1 * (p1 * rb - rc)];
  const [s2, t2] = [rd - p2 * rc + (p2 * p2 - q2) * rb, re + q2 * (p2 * rb - rc)];
  return [
    p1 + (s1 * dq - t1 * dp) * inverse,
    q1 + (t1 * (dq - p1 * dp) + s1 * q1 * dp) * inverse,
    p2 + (t2 * dp - s2 * dq) * inverse,
    q2 - (t2 * (dq - p2 * dp) + s2 * q2 * dp) * inverse,
  ];
}

function reproduces(
  ...[b, c, d, e, p1, q1, p2, q2]: [number, number, number, number, number, number, number, number]
): boolean {
  const [p12, p1q2, p2q1, q12] = [p1 * p2, p1 * q2, p2 * q1, q1 * q2];
  return (
    Math.abs(b - (p1 + p2)) <= ROUNDING * (Math.abs(p1) + Math.abs(p2)) &&
    Math.abs(c - (q1 + q2 + p12)) <= ROUNDING * (Math.abs(q1) + Math.abs(q2) + Math.abs(p12)) &&
    Math.abs(d - (p1q2 + p2q1)) <= ROUNDING * (Math.abs(p1q2) + Math.abs(p2q1)) &&
    Math.abs(e - q12) <= ROUNDING * Math.abs(q12)
  );
}

function quadraticRoots(p: number, q: number): Complex[] {
  const half = -0.5 * p;
  const discriminant = half * half - q;
  const root = Math.sqrt(Math.abs(discriminant));
  if (discriminant < 0) return [{ re: half, im: -root }, { re: half, im: root }];
  const big = half < 0 ? half - root : half + root;
  return [{ re: big, im: 0 }, { re: big === 0 ? 0 : q / big, im: 0 }];
}
