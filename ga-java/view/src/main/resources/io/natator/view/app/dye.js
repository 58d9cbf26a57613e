/** Dye that runs from the tail into the water and goes along with it: streaklines. */

import {centreOf} from './scene.js';
import {velocityAt} from './vorticity.js';

/** Grains of dye at most, and per second; so they stay for 12 s. */
export const GRAINS = 3600;
const PER_SECOND = 300;

/** How strong a grain of so many seconds is, 0 to 1. */
export function dyeStrength(age) {
  return Math.max(0, 1 - age * PER_SECOND / GRAINS);
}

/** More than this of simulated time between two frames is gone through in parts, s. */
const STEP = 1 / 30;
/** Where it comes out: so many cells behind the tail, where the water is not the tail's any more. */
const BEHIND = 1.5;

/** Grains in a ring, the oldest of which is replaced by the next. */
export class Dye {
  /** @type {Scene|null} */
  #scene = null;
  #time = null;
  /** When the last grain came out. */
  #poured = 0;
  #next = 0;
  #tail = [0, 0, 0];
  #before = [0, 0, 0];
  #place = [0, 0, 0];
  #flow = new Float32Array(3);

  /** Three numbers for each grain. */
  places = new Float32Array(3 * GRAINS);
  /** When each came out, s of simulated time. */
  born = new Float64Array(GRAINS);
  /** How many there are. */
  count = 0;
  /** Counts changes. */
  version = 0;

  /**
   * Takes over what is known of a scene (SCEN).
   *
   * @param {Scene} scene
   */
  setScene(scene) {
    this.#scene = scene;
    if (scene.restarted) {
      this.clear();
    }
  }

  /** Takes all dye away. */
  clear() {
    this.#time = null;
    this.#next = 0;
    this.count = 0;
    this.version++;
  }

  /**
   * Lets dye go on to a frame, with the water as it was last; a jump back in time begins anew.
   *
   * @param {Frame} frame
   * @param {Water|null} water
   */
  update(frame, water) {
    if (this.#scene.slices.length < 2 || water === null || water.density.length === 0) {
      return;
    }
    if (this.#time === null || frame.time < this.#time) {
      this.clear();
      this.#time = this.#poured = frame.time;
    }
    const seconds = frame.time - this.#time;
    const parts = Math.ceil(seconds / STEP - 1e-6);
    for (let part = 0; part < parts; part++) {
      this.#advance(seconds / parts, water);
    }
    this.#pour(this.#outlet(frame, water.cell), frame.time);
    this.#time = frame.time;
    this.version++;
  }

  /** The place behind the last slice, away from the one before it. */
  #outlet(frame, cell) {
    const {slices} = this.#scene;
    const end = centreOf(slices.at(-1), frame.position, [0, 0, 0]);
    centreOf(slices.at(-2), frame.position, this.#before);
    const way = end.map((value, axis) => value - this.#before[axis]);
    const length = Math.hypot(...way) || 1;
    return end.map((value, axis) => value + BEHIND * cell * way[axis] / length);
  }

  /** One grain after the other along the way of the outlet since the last frame. */
  #pour(outlet, time) {
    const seconds = time - this.#time;
    for (let due = this.#poured + 1 / PER_SECOND; due <= time; due += 1 / PER_SECOND) {
      const left = (time - due) / seconds;
      this.places.set(outlet.map((value, axis) => value + left * (this.#tail[axis] - value)), 3 * this.#next);
      this.born[this.#next] = this.#poured = due;
      this.#next = (this.#next + 1) % GRAINS;
      this.count = Math.min(GRAINS, this.count + 1);
    }
    this.#tail = outlet;
  }

  /** Along the water, by the midpoint rule. */
  #advance(seconds, water) {
    const {periodic = {}} = this.#scene;
    const wraps = ['x', 'y', 'z'].map(axis => axis in periodic);
    const place = this.#place;
    const flow = this.#flow;
    for (let i = 0; i < 3 * this.count; i += 3) {
      for (let axis = 0; axis < 3; axis++) {
        place[axis] = this.places[i + axis] - water.origin[axis];
      }
      velocityAt(water, place, wraps, flow);
      for (let axis = 0; axis < 3; axis++) {
        place[axis] += 0.5 * seconds * flow[axis];
      }
      velocityAt(water, place, wraps, flow);
      for (let axis = 0; axis < 3; axis++) {
        this.places[i + axis] += seconds * flow[axis];
      }
    }
  }
}
