/** Run, step, back to the start and the rate: of one view, or of two that go on together. */

import {byId} from './element.js';
import {Lockstep} from './lockstep.js';

/** The controls of time. */
export class Transport {
  #page;
  #lockstep;

  /** @param {import('./main.js').Page} page with `views`, the chosen `view` and `remember` */
  constructor(page) {
    this.#page = page;
    this.renew();
    byId('run').addEventListener('click', () => this.toggleRun());
    byId('step').addEventListener('click', () => this.step());
    byId('reset').addEventListener('click', () => this.reset());
    byId('rate').addEventListener('change', () => this.setRate(Number(byId('rate').value)));
  }

  /** What leads two views is another from here on; the one before has no more say, though its last step may still be under way. */
  renew() {
    const lockstep = new Lockstep();
    lockstep.onStep = error => lockstep === this.#lockstep && this.#stepped(error);
    this.#lockstep = lockstep;
  }

  /** To be called for each drawing of the screen, in milliseconds: takes frames, and leads two views on. */
  tick(now) {
    const {views} = this.#page;
    if (!this.#lockstep.isBusy) {
      views.forEach(view => view.receive());
    }
    if (views.length > 1) {
      this.#lockstep.tick(now, views);
    }
  }

  /** Shows what is set for the chosen view. */
  show() {
    this.#showRun();
    byId('rate').value = String(this.#page.view.setting.rate);
  }

  #showRun() {
    byId('run').textContent = this.#page.view.isPaused ? 'Run' : 'Pause';
  }

  async #all(action) {
    const answers = await Promise.all(this.#page.views.map(action));
    byId('transport-error').textContent = answers.find(answer => typeof answer === 'string') ?? '';
    this.#showRun();
    this.#page.remember();
  }

  toggleRun() {
    const {isPaused} = this.#page.view;
    return this.#all(view => isPaused ? view.run() : view.pause());
  }

  step() {
    if (this.#page.views.length > 1) {
      this.#lockstep.wanted++;
      return this.#all(view => view.pause());
    }
    return this.#all(view => view.step());
  }

  /** All back to the start. */
  reset() {
    const {views} = this.#page;
    return views.length > 1 ? this.#lockstep.reset(views) : this.#all(view => view.reset());
  }

  setRate(value) {
    byId('rate').value = String(value);
    return this.#all(view => view.setRate(value));
  }

  /** To the rate that stands so many places further on in the list. */
  moveRate(step) {
    const {options, selectedIndex} = byId('rate');
    const at = Math.min(options.length - 1, Math.max(0, selectedIndex + step));
    this.setRate(Number(options[at].value));
  }

  /** After a step of two views: where one cannot go on, neither does. */
  #stepped(error) {
    const {views} = this.#page;
    byId('transport-error').textContent = error ?? '';
    if (error !== null && views.every(view => view.isReady)) {
      views.forEach(view => view.pause());
      this.#showRun();
    }
  }
}
