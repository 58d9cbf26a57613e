/** Commands that follow a slider: while one is under way, only the last of those after it is sent. */

/** The answer to a command that a later one took the place of. */
export const SUPERSEDED = Symbol('superseded');

/**
 * The error in an answer; null where there is none, or where a later command took its place, which has an answer of its own.
 *
 * @param {string|null|symbol} answer
 */
export function errorOf(answer) {
  return typeof answer === 'string' ? answer : null;
}

/** Sends commands of the same key one after another. */
export class Live {
  #send;
  #busy = new Set();
  #next = new Map();

  /** `send(command)` gives a promise of an error text or null. */
  constructor(send) {
    this.#send = send;
  }

  /**
   * Sends a command, or keeps it until the one before is answered.
   *
   * @returns {Promise<string|null|symbol>} the error, null, or SUPERSEDED
   */
  submit(key, command) {
    return new Promise(resolve => {
      this.#next.get(key)?.resolve(SUPERSEDED);
      this.#next.set(key, {command, resolve});
      this.#go(key);
    });
  }

  async #go(key) {
    if (this.#busy.has(key)) {
      return;
    }
    this.#busy.add(key);
    while (this.#next.has(key)) {
      const {command, resolve} = this.#next.get(key);
      this.#next.delete(key);
      resolve(await this.#send(command));
    }
    this.#busy.delete(key);
  }
}
