/** Round numbers for axes. */

/** The least of 1, 2 and 5 times a power of ten that is at least `size`. */
export function niceStep(size) {
  if (!(size > 0)) {
    return 1;
  }
  const power = 10 ** Math.floor(Math.log10(size));
  const factor = [1, 2, 5, 10].find(one => one * power >= size * (1 - 1e-9));
  return factor * power;
}

/**
 * An axis over values from `low` to `high`: its ends on round numbers, and the places of its marks.
 *
 * @returns {{low: number, high: number, step: number, marks: number[]}}
 */
export function axis(low, high, count = 4) {
  const span = high > low ? high - low : Math.max(Math.abs(high), 1e-6);
  const step = niceStep(span / count);
  const first = Math.floor(low / step + 1e-9);
  const last = Math.max(Math.ceil(high / step - 1e-9), first + 1);
  const marks = [];
  for (let i = first; i <= last; i++) {
    marks.push(i * step);
  }
  return {low: first * step, high: last * step, step, marks};
}

/** The end of a scale that keeps to round numbers, and does not change for little. */
export class RoundEnd {
  #least;

  /** Of the scale; 0 before it is known. */
  value = 0;

  /** @param {number} least of the end */
  constructor(least) {
    this.#least = least;
  }

  /** Whether it changes for the greatest of what is shown. */
  follow(greatest) {
    if (greatest <= this.value && greatest > 0.5 * this.value) {
      return false;
    }
    const wanted = Math.max(greatest, this.#least);
    const step = niceStep(wanted / 4);
    const end = Math.ceil(wanted / step - 1e-6) * step;
    const isOther = end !== this.value;
    this.value = end;
    return isOther;
  }
}

/** A number with as many digits as an axis with this step needs. */
export function axisText(value, step) {
  const digits = Math.max(0, Math.min(6, -Math.floor(Math.log10(step) + 1e-9)));
  return (Math.abs(value) < step / 1e3 ? 0 : value).toFixed(digits);
}

/** A number with so many digits after the point; what rounds to nothing has no sign. */
export function fixed(value, digits) {
  const text = value.toFixed(digits);
  return Number(text) === 0 ? text.replace('-', '') : text;
}
