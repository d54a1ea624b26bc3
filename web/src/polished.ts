/** Roots of a polynomial near known ones: a few joint Newton steps (Ehrlich and Aberth) instead of a search. */

import { byRealPart, complex, type Complex, divide, multiply, size, subtract } from "./complex";
import { paired, roots } from "./polynomial";

/** All roots of a real polynomial (coefficients ascending), from near guesses; as `roots` gives them. */
export function rootsNear(coefficients: readonly number[], guesses: readonly Complex[]): Complex[] {
  const degree = coefficients.length - 1;
  const re = guesses.map((guess) => guess.re);
  const im = guesses.map((guess) => guess.im);
  for (let step = 0; step < 12; step++) {
    let moving = false;
    for (let i = 0; i < degree; i++) {
      // Horner for value and slope, and the size of all terms.
      let [vr, vi, sr, si, terms] = [0, 0, 0, 0, 0];
      const [x, y] = [re[i], im[i]];
      const radius = Math.hypot(x, y);
      for (let k = degree; k >= 0; k--) {
        [sr, si] = [sr * x - si * y + vr, sr * y + si * x + vi];
        [vr, vi] = [vr * x - vi * y + coefficients[k], vr * y + vi * x];
        terms = terms * radius + Math.abs(coefficients[k]);
      }
      if (Math.hypot(vr, vi) <= 4e-16 * terms) continue;
      moving = true;
      const newton = divide(complex(vr, vi), complex(sr || 1e-300, si));
      let pull = complex(0);
      for (let j = 0; j < degree; j++) {
        const gap = complex(x - re[j], y - im[j]);
        if (j !== i && (gap.re !== 0 || gap.im !== 0)) {
          const inverse = divide(complex(1), gap);
          pull = complex(pull.re + inverse.re, pull.im + inverse.im);
        }
      }
      const move = divide(newton, subtract(complex(1), multiply(newton, pull)));
      if (!Number.isFinite(move.re) || !Number.isFinite(move.im) || size(move) > 2 * radius + 1) return roots(coefficients);
      re[i] -= move.re;
      im[i] -= move.im;
    }
    if (!moving) return paired(re.map((x, i) => complex(x, im[i]))).sort(byRealPart);
  }
  return roots(coefficients);
}
