/** Water at the walls of a tank: a smooth line, where shapes of particles that a wall cuts would leave one of bumps. */

import {SHAPE_NUMBERS} from './water-numbers.js';

/** Beads are so far apart; all lengths in spacings of particles. */
const STEP = 0.4;
/** Shapes nearer to a wall than this tell how high water is there. */
const NEAR = 1.3;
/** How far the highest of them counts along the wall. */
const REACH = 0.8;
/** How often heights are evened out with those beside them, by a quarter each. */
const ROUNDS = 8;
/** Half axes of a bead: along the wall, up, and into the tank. */
const ALONG = 0.9;
const UP = 0.55;
const INWARDS = 1.1;
/** Steps of the height that are no line but a splash. */
const STEEP = 1.2;
const ENDLESS = 1e8;

/** Lays beads along the walls, as high as the shapes there. Keeps its arrays from frame to frame. */
export class Waterline {
  #heights = new Float32Array(0);
  #other = new Float32Array(0);

  /** How many beads there can be; no more are added. */
  static most(walls, spacing) {
    const [width, , length] = walls.max.map((high, axis) => high - walls.min[axis]);
    const isTank = width < ENDLESS && length < ENDLESS;
    return isTank ? 2 * (cellsOf(width, spacing) + cellsOf(length, spacing)) : 0;
  }

  /**
   * Adds beads behind the shapes.
   *
   * @param {Float32Array} numbers of shapes, the last of which says whether it is of a free surface (see `WaterShapes`)
   * @param {number} count how many there are
   * @param {{min: number[], max: number[]}} walls
   * @returns {number} how many there are then
   */
  add(numbers, count, walls, spacing) {
    if (Waterline.most(walls, spacing) === 0) {
      return count;
    }
    let end = count;
    for (const [across, along] of [[0, 2], [2, 0]]) {
      for (const wall of [walls.min[across], walls.max[across]]) {
        end = this.#line(numbers, count, end, across, along, wall, walls.min[along], walls.max[along], spacing);
      }
    }
    return end;
  }

  #line(numbers, count, begin, across, along, wall, low, high, spacing) {
    const cells = cellsOf(high - low, spacing);
    if (this.#heights.length < cells) {
      this.#heights = new Float32Array(cells);
      this.#other = new Float32Array(cells);
    }
    const heights = this.#heights.fill(-Infinity, 0, cells);
    const reach = REACH / STEP;
    for (let i = 0, at = 0; i < count; i++, at += SHAPE_NUMBERS) {
      if (numbers[at + 11] === 1 && Math.abs(numbers[at + across] - wall) < NEAR * spacing) {
        const top = numbers[at + 1] + Math.sqrt(numbers[at + 5]);
        const place = (numbers[at + along] - low) / (STEP * spacing);
        for (let cell = Math.max(0, Math.ceil(place - reach)); cell <= Math.min(cells - 1, place + reach); cell++) {
          heights[cell] = Math.max(heights[cell], top);
        }
      }
    }
    this.#smooth(cells, spacing);
    let at = SHAPE_NUMBERS * begin;
    for (let cell = 0; cell < cells; cell++) {
      if (this.#heights[cell] > -Infinity) {
        numbers.fill(0, at, at + SHAPE_NUMBERS);
        numbers[at + across] = wall;
        numbers[at + along] = low + cell * STEP * spacing;
        numbers[at + 1] = this.#heights[cell] - UP * spacing;
        numbers[at + 4 + across] = (INWARDS * spacing) ** 2;
        numbers[at + 5] = (UP * spacing) ** 2;
        numbers[at + 4 + along] = (ALONG * spacing) ** 2;
        at += SHAPE_NUMBERS;
      }
    }
    return at / SHAPE_NUMBERS;
  }

  #smooth(cells, spacing) {
    for (let round = 0; round < ROUNDS; round++) {
      const from = this.#heights;
      const to = this.#other;
      for (let cell = 0; cell < cells; cell++) {
        const here = from[cell];
        const before = beside(from[Math.max(0, cell - 1)], here, spacing);
        const after = beside(from[Math.min(cells - 1, cell + 1)], here, spacing);
        to[cell] = here === -Infinity ? here : 0.5 * here + 0.25 * (before + after);
      }
      this.#heights = to;
      this.#other = from;
    }
  }
}

function cellsOf(length, spacing) {
  return Math.ceil(length / (STEP * spacing)) + 1;
}

/** The height beside one, where it is of the same water. */
function beside(other, here, spacing) {
  return Math.abs(other - here) < STEEP * spacing ? other : here;
}
