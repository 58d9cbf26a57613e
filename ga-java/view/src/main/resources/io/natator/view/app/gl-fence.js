/** Tells when the graphics card has done what it was told. */

/** One at a time: the last one set counts. */
export class Fence {
  #context;
  #sync = null;

  constructor(context) {
    this.#context = context;
  }

  /** Marks the end of what the card is to do. */
  set() {
    if (this.#sync !== null) {
      this.#context.deleteSync(this.#sync);
    }
    this.#sync = this.#context.fenceSync(this.#context.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.#context.flush();
  }

  /** Whether it has not got there yet. */
  get isBusy() {
    if (this.#sync !== null
        && this.#context.clientWaitSync(this.#sync, 0, 0) !== this.#context.TIMEOUT_EXPIRED) {
      this.#context.deleteSync(this.#sync);
      this.#sync = null;
    }
    return this.#sync !== null;
  }
}
