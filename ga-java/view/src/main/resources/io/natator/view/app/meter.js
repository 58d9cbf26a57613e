/** Rates of what is shown, over the last second. */

const WINDOW_MS = 1000;

/** Counts drawn frames and the simulated time between them. */
export class Meter {
  #since = 0;
  #drawn = 0;
  #startTime = null;
  #lastTime = null;

  /** New frames drawn per second of wall time; 0 when none come. */
  fps = 0;
  /** Simulated seconds per second of wall time. */
  pace = 0;

  /** Counts a new frame; `time` is simulated, s. */
  drawn(time) {
    this.#drawn++;
    if (this.#startTime === null || time < this.#lastTime) {
      this.#startTime = time;
    }
    this.#lastTime = time;
  }

  /** To be called often; `now` in milliseconds. */
  update(now) {
    const passed = now - this.#since;
    if (passed < WINDOW_MS) {
      return;
    }
    this.fps = 1000 * this.#drawn / passed;
    this.pace = this.#startTime === null ? 0 : 1000 * (this.#lastTime - this.#startTime) / passed;
    this.#since = now;
    this.#drawn = 0;
    this.#startTime = this.#lastTime;
  }
}
