/** What the water does to the parts of bodies, as arrows. */

import {NO_ARROWS} from './arrows.js';
import {RoundEnd} from './scaling.js';
import {bodiesReach, centreOf, solidKinds, solids} from './scene.js';

/** How long the arrow is that the scale's end belongs to, in lengths of the body. */
const LONGEST = 0.4;
const LEAST = 1e-6;

/** An arrow for each part: a cluster of a body, whose joints count to the one in front; what else is solid is one part. */
export class Forces {
  #scene = null;
  #parts = [];
  #end = new RoundEnd(LEAST);
  #isShown = false;

  /** From the middle of each part along the force on it. */
  arrows = NO_ARROWS;
  /** The force on each part, mass length/s²: three numbers. */
  forces = [];

  /** Ends of a scale that hold instead of its own, for pictures that share one; null for its own. */
  shared = null;

  /**
   * Called with 0 and the force of the longest arrow when that changes.
   *
   * @type {(range: number[]) => void}
   */
  onRange = () => {};

  /** Whether they are shown. */
  set isShown(value) {
    this.#isShown = value;
    this.arrows = value ? this.arrows : NO_ARROWS;
  }

  /**
   * Takes over what is known of a scene (SCEN).
   *
   * @param {Scene} scene
   */
  setScene(scene) {
    this.#scene = scene;
    if (scene.restarted) {
      this.#end = new RoundEnd(LEAST);
      this.arrows = NO_ARROWS;
    }
    this.#parts = partsOf(scene);
  }

  /**
   * Takes over a frame.
   *
   * @param {Frame} frame
   */
  update(frame) {
    if (!this.#isShown || !frame.force) {
      this.arrows = NO_ARROWS;
      return;
    }
    this.forces = this.#parts.map(part => [0, 1, 2].map(axis => part.reduce((sum, i) => sum + frame.force[3 * i + axis], 0)));
    if (this.#end.follow(Math.max(...this.forces.map(one => Math.hypot(...one)), 0))) {
      this.onRange([0, this.#end.value]);
    }
    const scale = LONGEST * bodiesReach(this.#scene, 2) / (this.shared?.[1] ?? this.#end.value);
    const from = this.#parts.map(part => centreOf(part, frame.position, [0, 0, 0]));
    const to = from.map((place, k) => place.map((one, axis) => one + scale * this.forces[k][axis]));
    this.arrows = {from: Float32Array.from(from.flat()), to: Float32Array.from(to.flat())};
  }
}

/** The particles of each part. */
function partsOf(scene) {
  const parts = new Map();
  const clusters = new Map();
  scene.clusters.toReversed().forEach((particles, behind) => particles.forEach(one => clusters.set(one, scene.clusters.length - behind)));
  const {of} = solidKinds(scene);
  for (const particle of solids(scene)) {
    const part = clusters.get(particle) ?? -1 - of[particle];
    if (!parts.has(part)) {
      parts.set(part, []);
    }
    parts.get(part).push(particle);
  }
  return [...parts.values()];
}
