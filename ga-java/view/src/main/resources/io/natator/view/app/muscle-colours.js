/** How far the muscles beneath each vertex of a skin are contracted or stretched. */

import {distinctMuscles, muscleChange} from './scene.js';

/** Muscles that count for a vertex, the nearest ones, and how far they reach, in spacings. */
const COUNTED = 4;
const REACH = 1.6;

/** A mean over the muscles that are near a vertex at first. */
export class MuscleColours {
  #muscles;
  #counted;
  #shares;

  /** For each vertex −1 (contracted) to 1 (stretched), 0 without a muscle near, from `update` on. */
  change;

  /**
   * @param {Scene} scene SCEN
   * @param {Float32Array} position of all particles
   * @param {Float32Array} places of the vertices with them
   * @param {number} spacing of particles in the body, length
   */
  constructor(scene, position, places, spacing) {
    this.#muscles = distinctMuscles(scene);
    const count = places.length / 3;
    this.change = new Float32Array(count);
    this.#counted = new Uint32Array(COUNTED * count);
    this.#shares = new Float32Array(COUNTED * count);
    const nearest = new Float64Array(COUNTED);
    for (let vertex = 0; vertex < count; vertex++) {
      nearest.fill(Infinity);
      for (let muscle = 0; muscle < this.#muscles.length; muscle++) {
        const square = squareToLine(places, 3 * vertex, position, 3 * this.#muscles[muscle].a, 3 * this.#muscles[muscle].b);
        this.#insert(nearest, COUNTED * vertex, muscle, square);
      }
      let sum = 0.02;
      for (let k = 0; k < COUNTED; k++) {
        this.#shares[COUNTED * vertex + k] = Math.exp(-nearest[k] / (REACH * spacing) ** 2);
        sum += this.#shares[COUNTED * vertex + k];
      }
      for (let k = 0; k < COUNTED; k++) {
        this.#shares[COUNTED * vertex + k] /= sum;
      }
    }
  }

  /** Keeps the nearest ones sorted. */
  #insert(nearest, from, muscle, square) {
    for (let k = COUNTED - 1; k >= 0 && square < nearest[k]; k--) {
      if (k + 1 < COUNTED) {
        nearest[k + 1] = nearest[k];
        this.#counted[from + k + 1] = this.#counted[from + k];
      }
      nearest[k] = square;
      this.#counted[from + k] = muscle;
    }
  }

  update(frame) {
    const changes = this.#muscles.map(muscle => muscleChange(muscle, frame));
    for (let vertex = 0; vertex < this.change.length; vertex++) {
      let sum = 0;
      for (let k = COUNTED * vertex; k < COUNTED * (vertex + 1); k++) {
        sum += this.#shares[k] * (changes[this.#counted[k]] ?? 0);
      }
      this.change[vertex] = sum;
    }
  }
}

/** The square of the distance from a place to the line between two. */
function squareToLine(places, at, position, a, b) {
  let along = 0;
  let length = 0;
  for (let axis = 0; axis < 3; axis++) {
    const side = position[b + axis] - position[a + axis];
    along += side * (places[at + axis] - position[a + axis]);
    length += side * side;
  }
  const share = length > 0 ? Math.min(1, Math.max(0, along / length)) : 0;
  let square = 0;
  for (let axis = 0; axis < 3; axis++) {
    square += (position[a + axis] + share * (position[b + axis] - position[a + axis]) - places[at + axis]) ** 2;
  }
  return square;
}
