/** The pressure of the water on a body, read off the water on a grid a little outside of its skin. */

import {RoundEnd} from './scaling.js';
import {bodySpacing, centreOf} from './scene.js';
import {excessPressure, quantile, valueAt} from './vorticity.js';

/** So far outside, in cells: nearer the cells have some of the body's motion. */
const OUTSIDE = 1.5;
/** The share of the body with less pressure than the scale's end. */
const STRONGEST = 0.9;
const LEAST = 1e-4;

/** Of one picture. */
export class SkinPressure {
  /** @type {Scene|null} */
  #scene = null;
  #water = null;
  /** @type {Float32Array} */
  #excess = new Float32Array(0);
  #wraps = [false, false, false];
  #end = new RoundEnd(LEAST);
  #one = new Float32Array(1);
  #isShown = false;
  /** The last water, and the places with it. */
  #last = null;
  #sides = [];

  /** For each particle −1 to 1: its share of the scale's end; 0 for what is no body. */
  shares = new Float32Array(0);
  /** Counts changes. */
  version = 0;
  /** Ends that hold instead of its own, for pictures that share a scale; null for its own. */
  shared = null;

  /**
   * Called with its ends, mass/(length s²), when they change.
   *
   * @type {(range: number[]) => void}
   */
  onRange = () => {};

  /** Whether it is shown. */
  get isShown() {
    return this.#isShown;
  }

  set isShown(value) {
    const isNew = value && !this.#isShown;
    this.#isShown = value;
    if (isNew && this.#last !== null) {
      this.setWater(this.#last.water, this.#last.position);
    }
  }

  /** Whether it is shown and known. */
  get isKnown() {
    return this.isShown && this.#water !== null;
  }

  /**
   * Takes over what is known of a scene (SCEN).
   *
   * @param {Scene} scene
   */
  setScene(scene) {
    this.#scene = scene;
    this.#wraps = ['x', 'y', 'z'].map(axis => axis in (scene.periodic ?? {}));
    this.#sides = [scene.slices, ...(scene.companions ?? []).map(one => one.slices)].flat();
    if (scene.restarted) {
      this.#water = this.#last = null;
      this.#end = new RoundEnd(LEAST);
      this.version++;
    }
  }

  /**
   * Takes over the water, and the places of the particles in its frame.
   *
   * @param {Water} water
   */
  setWater(water, position) {
    this.#last = {water, position};
    if (!this.isShown || !water.pressure || water.density.length === 0) {
      return;
    }
    this.#water = water;
    this.#excess = excessPressure(water);
    this.shares = new Float32Array(position.length / 3);
    const isPlane = water.cells[1] === 1;
    const spacing = bodySpacing(this.#scene);
    const [centre, found] = [[0, 0, 0], []];
    for (const slice of this.#sides) {
      centreOf(slice, position, centre);
      const ways = slice.map(particle => centre.map((one, axis) => position[3 * particle + axis] - one));
      const sizes = ways.map(way => Math.hypot(...way));
      const widest = Math.max(...sizes);
      slice.forEach((particle, i) => {
        const size = isPlane ? widest : sizes[i];  // what is seen from above is inside: as it is on that side
        const out = sizes[i] > 0 ? (size + 0.5 * spacing) / sizes[i] : 0;
        const normal = ways[i].map(one => sizes[i] > 0 ? one / sizes[i] : 0);
        this.shares[particle] = this.#at(centre.map((one, axis) => one + out * ways[i][axis]), normal);
        found.push(this.shares[particle]);
      });
    }
    if (this.#end.follow(quantile(Float32Array.from(found), STRONGEST, Math.abs))) {
      this.onRange([-this.#end.value, this.#end.value]);
    }
    const most = this.#most;
    this.shares = this.shares.map(one => Math.max(-1, Math.min(1, one / most)));
    this.version++;
  }

  /** The share, −1 to 1, at a place of the skin, whose normal points outwards. */
  share(place, normal) {
    return Math.max(-1, Math.min(1, this.#at(place, normal) / this.#most));
  }

  get #most() {
    return this.shared?.[1] ?? this.#end.value;
  }

  #at(place, normal) {
    const {cell, origin} = this.#water;
    return valueAt(this.#water, this.#excess, place.map((one, axis) => one + OUTSIDE * cell * normal[axis] - origin[axis]), this.#wraps,
        this.#one)[0];
  }
}
