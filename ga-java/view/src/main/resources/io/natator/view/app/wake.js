/** What water on a grid shows of a wake: a slice of vorticity, or vortices; for all ways of drawing. */

import {niceStep} from './scaling.js';
import {surfaceNet} from './surface-net.js';
import {quantile, vorticesOf, vorticityAt} from './vorticity.js';

/** The share of what turns that turns less than the ends of the colour scale. */
const STRONGEST = 0.97;
/** The share of the water that is in a vortex: that whose Q is highest. */
const IN_VORTICES = 0.01;
/** Least end of the colour scale, and least Q of a vortex, in units of that squared: below it water rests. */
const LEAST = 0.1;

/** Of one picture. */
export class Wake {
  /** @type {Scene|null} */
  #scene = null;
  /** What is shown of the water: see `waterShown`. */
  #kind = 'none';
  #centre = [0, 0, 0];
  #own = [-1, 1];

  /**
   * The last water that came, or null.
   *
   * @type {Water|null}
   */
  water = null;
  /**
   * Vorticity at the height of the body's middle, or null: `columns` along x times `rows` along z `values`, 1/s, in cells of
   * width `cell` from `low` (x, z) on, shown from `from` to `to` at `height`; where it is shown beyond its cells, it begins anew.
   */
  slice = null;
  /** Surfaces around vortices with the vorticity of each vertex, or null: see `surfaceNet`. */
  vortices = null;
  /** Counts changes of both. */
  version = 0;

  /** Ends of the colour scale that hold instead of its own, for pictures that share a scale; null for its own. */
  shared = null;

  /**
   * Called with its own ends when they change.
   *
   * @type {(range: number[]) => void}
   */
  onRange = () => {};

  /** Ends of the colour scale, 1/s. */
  get range() {
    return this.shared ?? this.#own;
  }

  /**
   * Takes over what is known of a scene (SCEN).
   *
   * @param {Scene} scene
   */
  setScene(scene) {
    this.#scene = scene;
    if (scene.restarted) {
      this.water = null;
      this.#update();
    }
  }

  /** Shows what belongs to a look. */
  show(kind) {
    if (kind !== this.#kind) {
      this.#kind = kind;
      this.#own = [0, 0];
      this.#update();
    }
  }

  /** Whether it shows something of the water. */
  get isShown() {
    return this.#kind === 'vorticity' || this.#kind === 'vortices';
  }

  /**
   * Takes over the water of now.
   *
   * @param {Water} water
   * @param {number[]} centre of the body; without one of the tank
   */
  setWater(water, centre) {
    this.water = water;
    this.#centre = centre;
    this.#update();
  }

  #update() {
    this.slice = null;
    this.vortices = null;
    this.version++;
    if (this.water?.density.length > 0 && this.isShown) {
      this.#kind === 'vorticity' ? this.#cut() : this.#surround();
    }
  }

  #cut() {
    const {cells, cell, corner, origin} = this.water;
    const values = vorticityAt(this.water, this.#centre[1] - origin[1]);
    const low = [0, 2].map(axis => corner[axis] + origin[axis]);
    const ends = [0, 2].map((axis, i) => {
      const length = cell * cells[axis];
      const begin = 'xyz'[axis] in (this.#scene.periodic ?? {}) ? this.#centre[axis] - length / 2 : low[i];
      return [begin, begin + length];
    });
    const height = cells[1] === 1 ? corner[1] + origin[1] + cell / 2 : this.#centre[1];
    this.slice = {values, columns: cells[0], rows: cells[2], cell, low, height,
      from: ends.map(([begin]) => begin), to: ends.map(([, end]) => end)};
    this.#follow(quantile(values.filter(value => value !== 0), STRONGEST, Math.abs));
  }

  #surround() {
    const {cells, cell, corner, origin} = this.water;
    const {q, turns} = vorticesOf(this.water);
    const least = Math.max(quantile(q, 1 - IN_VORTICES), LEAST * LEAST);
    const [across, up, along] = cells;
    for (let z = 0, at = 0; z < along; z++) {
      for (let y = 0; y < up; y++) {
        for (let x = 0; x < across; x++, at++) {
          const isEnd = x === 0 || y === 0 || z === 0 || x + 1 === across || y + 1 === up || z + 1 === along;
          q[at] = isEnd ? least : least - q[at];
        }
      }
    }
    const low = corner.map((value, axis) => value + origin[axis] + cell / 2);
    const {vertices, triangles} = surfaceNet({values: q, size: cells, low, cell});
    const ofVertex = new Float32Array(vertices.length / 3);
    for (let i = 0; i < ofVertex.length; i++) {
      const [x, y, z] = [0, 1, 2].map(axis => Math.round((vertices[3 * i + axis] - low[axis]) / cell));
      ofVertex[i] = turns[x + across * (y + up * z)];
    }
    this.vortices = {vertices, triangles, turns: ofVertex, cell};
    this.#follow(quantile(ofVertex, 0.75, Math.abs));
  }

  /** The ends of the scale keep to round numbers, and do not change for little. */
  #follow(strength) {
    const [, high] = this.#own;
    if (strength <= high && strength > 0.5 * high) {
      return;
    }
    const least = Math.max(strength, LEAST);
    const step = niceStep(least / 4);
    const end = Math.ceil(least / step - 1e-6) * step;
    if (end !== high) {
      this.#own = [-end, end];
      this.onRange(this.#own);
    }
  }
}
