/** A slider and a number that are the same setting; its error is shown beneath. */

import {make} from './element.js';
import {SUPERSEDED} from './live.js';

/** The inputs of one setting. `onChange(value)` gives a promise of an error, null or SUPERSEDED. */
export class Slider {
  #range;
  #number;
  #error;
  #onChange;
  #pending = 0;
  #isTyped = false;
  #label;
  #expected;

  /**
   * `setting` has id, label, min, max, step, unit if there is one, and the range `accepts` of what can be typed if that is
   * wider than the slider's. What is beyond it is not sent: it stays in its field, marked, with what was expected, until
   * the setting is changed or shown anew.
   */
  constructor(setting, error, onChange) {
    const {id, label, title = '', min, max, step, unit, accepts = [min, max]} = setting;
    this.#label = label;
    const [low, high] = accepts;
    this.#expected = {low, high, text: `${low} to ${high}${unit === undefined ? '' : ` ${unit}`}`};
    const shared = {min, max, step, title, 'aria-label': label};
    this.#range = make('input', {type: 'range', ...shared, 'data-testid': id});
    this.#number = make('input', {type: 'number', ...shared, step: 'any', id, 'data-testid': `${id}-number`});
    this.#error = error;
    this.#onChange = onChange;
    this.#range.addEventListener('input', () => this.#changed(this.#range.value));
    this.#number.addEventListener('input', () => this.#isTyped = true);
    this.#number.addEventListener('change', () => this.#changed(this.#number.value));
    this.#number.addEventListener('blur', () => this.#isTyped = false);
  }

  get inputs() {
    return [this.#range, this.#number];
  }

  get value() {
    return Number(this.#number.value);
  }

  /** Shows what is in force, unless the user is just changing it: has typed and not left the field, or waits for an answer. */
  show(value) {
    if (this.#pending === 0 && !this.#isTyped) {
      this.#range.value = value;
      this.#number.value = Math.round(1000 * value) / 1000;
      this.#fail(null);
    }
  }

  set disabled(value) {
    this.#range.disabled = value;
    this.#number.disabled = value;
  }

  async #changed(text) {
    this.#isTyped = false;
    const value = Number(text);
    const {low, high, text: expected} = this.#expected;
    if (text === '' || !Number.isFinite(value) || value < low || value > high) {
      this.#fail(`${this.#label}: ${text === '' ? 'no number' : `${text} is not used`}; expected ${expected}`);
      return;
    }
    this.#range.value = value;
    this.#number.value = value;
    this.#pending++;
    const error = await this.#onChange(value);
    this.#pending--;
    if (error !== SUPERSEDED) {
      this.#fail(error);
    }
  }

  #fail(error) {
    this.#number.setAttribute('aria-invalid', error !== null);
    if (error !== null || this.#error.dataset.from === this.#number.id) {
      this.#error.textContent = error ?? '';
      this.#error.dataset.from = error === null ? '' : this.#number.id;
    }
  }
}

/** A slider in a row with its label and its own error. */
export function sliderRow(setting, onChange) {
  const error = make('output', {className: 'error', role: 'alert', 'data-testid': `${setting.id}-error`});
  const slider = new Slider(setting, error, onChange);
  const label = make('label', {htmlFor: setting.id, title: setting.title ?? ''}, setting.label);
  const row = make('div', {className: 'control'}, label, ...slider.inputs, error);
  return {slider, row};
}
