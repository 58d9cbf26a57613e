/** Leads two or more views frame by frame, so that all show the same simulated time; the faster ones wait. */

/** The most simulated time that is asked for at once, as wall time of the slowest simulator, s. */
const MOST_WORK_S = 1 / 30;
/** Time that is not made up for: the most between two steps that counts, s. */
const MOST_PAUSE_S = 0.1;

/** Whether two simulated times are the same but for less than half a frame of this length. */
function isSame(one, other, timeStep) {
  return Math.abs(one - other) < timeStep / 2;
}

/**
 * Frames that each simulation is to go on so that all get to the same time.
 *
 * @param {{time: number, timeStep: number}[]} all where each is and how long its frames are, s
 * @param {number} count frames of the one with the longest
 * @returns {number[]}
 */
export function framesOfEach(all, count) {
  const longest = Math.max(...all.map(one => one.timeStep));
  const target = Math.max(...all.map(one => one.time)) + count * longest;
  return all.map(({time, timeStep}) => Math.max(0, Math.round((target - time) / timeStep)));
}

/** Frames that are due, of `timeStep` s: no more than are owed, nor than the slowest simulator does soon; 0 for none yet. */
export function framesDue(owed, timeStep, wallTime, rate) {
  const most = Math.max(1, Math.floor(MOST_WORK_S / Math.max(wallTime, 1e-6)));
  return rate === 0 ? most : Math.min(most, Math.floor(owed / timeStep + 1e-6));
}

/** The step that two views take together; while one is under way none of them takes a frame. */
export class Lockstep {
  #busy = 0;
  #owed = 0;
  #last = null;

  /** Frames that the user has asked for one by one. */
  wanted = 0;

  /**
   * Called with an error text, or null, after each step.
   *
   * @type {(error: string|null) => void}
   */
  onStep = () => {};

  /** Whether frames are to be left where they are, since one of the views does not have its own yet. */
  get isBusy() {
    return this.#busy > 0;
  }

  /** To be called for each drawing of the screen, in milliseconds; `views` have `isLed` set. */
  tick(now, views) {
    const seconds = this.#last === null ? 0 : Math.min((now - this.#last) / 1000, MOST_PAUSE_S);
    this.#last = now;
    if (this.isBusy || !views.every(view => view.isReady)) {
      return;
    }
    const timeStep = Math.max(...views.map(view => view.scene.timeStep));
    if (!views.every(view => isSame(view.frame.time, views[0].frame.time, timeStep))) {
      this.reset(views);
      return;
    }
    if (this.wanted > 0) {
      this.wanted--;
      this.#step(views, 1);
      return;
    }
    if (views.some(view => view.isPaused)) {
      this.#owed = 0;
      return;
    }
    const {rate} = views[0].setting;
    this.#owed = Math.min(this.#owed + rate * seconds, rate * MOST_PAUSE_S + timeStep);
    const count = framesDue(this.#owed, timeStep, Math.max(...views.map(view => view.frame.wallTime)), rate);
    if (count > 0) {
      this.#owed = Math.max(0, this.#owed - count * timeStep);
      this.#step(views, count);
    }
  }

  #step(views, count) {
    const all = views.map(view => ({time: view.frame.time, timeStep: view.scene.timeStep}));
    const frames = framesOfEach(all, count);
    this.#do(() => Promise.all(views.map((view, i) => frames[i] === 0 ? null : view.step(frames[i]))));
  }

  /** All back to the start; a promise of the end of that. */
  reset(views) {
    this.wanted = 0;
    return this.#do(() => Promise.all(views.map(view => view.reset())));
  }

  async #do(action) {
    this.#busy++;
    try {
      const errors = await action();
      this.onStep(errors.find(error => typeof error === 'string') ?? null);
      return errors;
    } finally {
      this.#busy--;
    }
  }
}
