/** Complex numbers, as few operations as eigenvalues need. */

export interface Complex {
  re: number;
  im: number;
}

export const complex = (re: number, im = 0): Complex => ({ re, im });
export const add = (a: Complex, b: Complex): Complex => ({ re: a.re + b.re, im: a.im + b.im });
export const subtract = (a: Complex, b: Complex): Complex => ({ re: a.re - b.re, im: a.im - b.im });
export const scale = (a: Complex, factor: number): Complex => ({ re: a.re * factor, im: a.im * factor });
export const conjugate = (a: Complex): Complex => ({ re: a.re, im: -a.im });
export const size = (a: Complex): number => Math.hypot(a.re, a.im);
export const angle = (a: Complex): number => Math.atan2(a.im, a.re);

export function multiply(a: Complex, b: Complex): Complex {
  return { re: a.re * b.re - a.im * b.im, im: a.re * b.im + a.im * b.re };
}

/** Division that neither overflows nor loses small numbers (Smith). */
export function divide(a: Complex, b: Complex): Complex {
  if (Math.abs(b.re) >= Math.abs(b.im)) {
    const ratio = b.im / b.re;
    const base = b.re + b.im * ratio;
    return { re: (a.re + a.im * ratio) / base, im: (a.im - a.re * ratio) / base };
  }
  const ratio = b.re / b.im;
  const base = b.re * ratio + b.im;
  return { re: (a.re * ratio + a.im) / base, im: (a.im * ratio - a.re) / base };
}

/** exp(a). */
export function exponential(a: Complex): Complex {
  const growth = Math.exp(a.re);
  return { re: growth * Math.cos(a.im), im: growth * Math.sin(a.im) };
}

/** By real, then by imaginary part. */
export const byRealPart = (a: Complex, b: Complex): number => a.re - b.re || a.im - b.im;
