/** Puts the gaits of a run into the views: in place of what swims there, or beside it. */

import {isSameGait} from './gait.js';
import {errorOf} from './live.js';
import {isSamePatch} from './swimmer.js';

/** Whether two settings (scene, overrides, gait), of which the second may be absent, are the same swim. */
function isSameSwim(one, other) {
  return other !== undefined && one.scene === other.scene && isSamePatch(one.overrides, other.overrides)
      && isSameGait(one.gait, other.gait);
}

/** What was put into the first view, and what swam there before. */
export class Watching {
  #page;
  #browsed = null;

  /** @param {import('./main.js').Page} page with `views`, the chosen `view`, `toggleCompare` and `reset` */
  constructor(page) {
    this.#page = page;
  }

  /**
   * Shows a gait of a run (its `label` says which) in the chosen view, or beside what swims in the first one: if that is the same, beside
   * what swam there before the generations were browsed.
   *
   * @returns {Promise<string|null>} why not, or null
   */
  async watch(run, best, beside) {
    const page = this.#page;
    const swim = {scene: run.scene, overrides: best.overrides ?? run.overrides, gait: best.gait,
      origin: {run: run.name, label: best.label, gait: best.gait}};
    if (!beside) {
      if (page.view === page.views[0] && !isSameSwim(page.view.setting, this.#browsed?.last)) {
        this.#browsed = {before: page.view.setting};
      }
      const error = await this.#swim(page.view, swim);
      if (page.view === page.views[0] && error === null) {
        this.#browsed = {...this.#browsed, last: swim};
      }
      return error;
    }
    const [first, second] = page.views;
    if (isSameSwim(first.setting, swim)) {
      const before = this.#browsed?.before;
      if (before === undefined || isSameSwim(before, swim)) {
        return 'This gait swims already: choose another one first.';
      }
      this.#browsed = null;
      const error = await this.#swim(first, before);
      if (error !== null) {
        return error;
      }
    }
    if (second === undefined) {
      page.toggleCompare({...swim, rate: first.setting.rate, paused: first.isPaused});
      return null;
    }
    return this.#swim(second, swim);
  }

  async #swim(view, {scene, overrides, gait, origin = null}) {
    const isHere = view.scene !== null && view.scene.scene === scene && isSamePatch(view.scene.overrides, overrides);
    const error = isHere && gait !== null ? await view.setGait(gait, origin)
        : await view.setScene(scene, overrides, gait, origin);
    if (error === null && isHere) {
      await this.#page.reset();
    }
    return errorOf(error);
  }
}
