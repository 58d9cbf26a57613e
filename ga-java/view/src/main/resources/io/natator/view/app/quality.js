/** Chooses how many pixels to draw so that the picture keeps up. */

/** Shares of the screen's pixels along each side. */
export const LEVELS = [1, 0.85, 0.7, 0.6, 0.5];
/** Frames per second below which it steps down. */
const TOO_SLOW = 52;
const WINDOW_S = 1;
/** Time of drawing, ms, below which fewer pixels would not help. */
const QUICK_MS = 4;
/** How long a level must have kept up before the next better one is tried; doubles each time that fails. */
const FIRST_PATIENCE_S = 4;
const LAST_PATIENCE_S = 120;

/** With less than so many frames per second over so many windows at the last level, drawing in this way is given up. */
const HOPELESS = 20;
const HOPELESS_WINDOWS = 4;

/** Steps down after a slow second, and up again after some good ones. */
export class Quality {
  #level;
  #frames = 0;
  #milliseconds = 0;
  #from = null;
  #goodSince = null;
  #patience = FIRST_PATIENCE_S;
  #raisedAt = null;
  #hopeless = 0;

  constructor(level = 0) {
    this.#level = level;
  }

  /** The share of the screen's pixels along each side. */
  get share() {
    return LEVELS[this.#level];
  }

  /**
   * Counts a drawn frame.
   *
   * @param {number} now seconds
   * @param {number} milliseconds that drawing it took
   * @returns {boolean} whether the share changed
   */
  drawn(now, milliseconds) {
    if (this.#from === null) {
      this.#begin(now);
      this.#goodSince = null;
      return false;
    }
    this.#frames++;
    this.#milliseconds += milliseconds;
    const seconds = now - this.#from;
    if (seconds < WINDOW_S) {
      return false;
    }
    const rate = this.#frames / seconds;
    const isLast = this.#level + 1 === LEVELS.length;
    this.#hopeless = isLast && rate < HOPELESS && this.#milliseconds / this.#frames >= QUICK_MS ? this.#hopeless + 1 : 0;
    const isQuick = this.#milliseconds / this.#frames < QUICK_MS;
    this.#begin(now);
    return rate >= TOO_SLOW ? this.#fast(now) : isQuick ? false : this.#slow(now);
  }

  /** Whether it has been far too slow for long, although nothing is left to give up. */
  get isHopeless() {
    return this.#hopeless >= HOPELESS_WINDOWS;
  }

  /** Forgets what was measured: nothing is drawn for a while, which says nothing about how fast it could be. */
  rest() {
    this.#from = null;
  }

  #begin(now) {
    this.#from = now;
    this.#frames = 0;
    this.#milliseconds = 0;
  }

  #slow(now) {
    if (this.#raisedAt !== null && now - this.#raisedAt < 5 * WINDOW_S) {
      this.#patience = Math.min(2 * this.#patience, LAST_PATIENCE_S);
    }
    this.#raisedAt = null;
    this.#goodSince = null;
    if (this.#level + 1 === LEVELS.length) {
      return false;
    }
    this.#level++;
    return true;
  }

  #fast(now) {
    this.#goodSince ??= now;
    if (this.#level === 0 || now - this.#goodSince < this.#patience) {
      return false;
    }
    this.#goodSince = null;
    this.#raisedAt = now;
    this.#level--;
    return true;
  }
}
