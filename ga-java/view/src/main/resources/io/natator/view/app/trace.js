/** Where the spine has been: its last positions, and the path of the head. */

import {centreOf} from './scene.js';

/** Spines kept. */
export const SPINES = 28;
/** Places of the head kept. */
export const HEAD_PLACES = 240;
/** Simulated time between two of them, s. */
export const SPINE_INTERVAL = 0.1;
const HEAD_INTERVAL = 1 / 30;

/** Rings of places that a drawing can read as they are. */
export class SpineTrace {
  /** @type {Scene|null} */
  #scene = null;
  #slices = 0;
  #next = 0;
  #spineTime = -Infinity;
  #headTime = -Infinity;
  #centre = [0, 0, 0];

  /** Three numbers for each slice of each of `SPINES` spines. */
  spines = new Float32Array(0);
  /** How strong each spine is drawn, 0 to 1. */
  strength = new Float32Array(SPINES);
  /** Three numbers for each place of the head, the oldest first. */
  head = new Float32Array(3 * HEAD_PLACES);
  /** How many places of the head there are. */
  headPlaces = 0;
  /** Counts changes. */
  version = 0;

  /** Slices of each spine. */
  get slices() {
    return this.#slices;
  }

  /**
   * Takes over what is known of a scene (SCEN).
   *
   * @param {Scene} scene
   */
  setScene(scene) {
    const isOther = scene.restarted || this.#slices !== scene.slices.length;
    this.#scene = scene;
    if (isOther) {
      this.#slices = scene.slices.length;
      this.spines = new Float32Array(3 * SPINES * this.#slices);
      this.clear();
    }
  }

  /** Forgets what was. */
  clear() {
    this.#next = 0;
    this.#spineTime = -Infinity;
    this.#headTime = -Infinity;
    this.strength.fill(0);
    this.headPlaces = 0;
    this.version++;
  }

  /**
   * Adds the spine of a frame when it is time for it; a jump back in time begins anew.
   *
   * @param {Frame} frame
   */
  update(frame) {
    if (this.#slices < 2) {
      return;
    }
    if (frame.time < this.#headTime - 1e-9) {
      this.clear();
    }
    if (frame.time >= this.#headTime + HEAD_INTERVAL - 1e-6) {
      this.#addHead(frame);
    }
    if (frame.time >= this.#spineTime + SPINE_INTERVAL - 1e-6) {
      this.#addSpine(frame);
    }
  }

  #addHead(frame) {
    this.#headTime = frame.time;
    if (this.headPlaces === HEAD_PLACES) {
      this.head.copyWithin(0, 3);
      this.headPlaces--;
    }
    this.head.set(centreOf(this.#scene.slices[0], frame.position, this.#centre), 3 * this.headPlaces++);
    this.version++;
  }

  #addSpine(frame) {
    this.#spineTime = frame.time;
    for (let spine = 0; spine < SPINES; spine++) {
      this.strength[spine] = Math.max(0, this.strength[spine] - 1 / SPINES);
    }
    this.strength[this.#next] = 1;
    for (let slice = 0; slice < this.#slices; slice++) {
      const place = centreOf(this.#scene.slices[slice], frame.position, this.#centre);
      this.spines.set(place, 3 * (this.#next * this.#slices + slice));
    }
    this.#next = (this.#next + 1) % SPINES;
    this.version++;
  }
}
