/** What water on a grid shows of a wake: a plane through it, or vortices; for all ways of drawing. */

import {NO_ARROWS} from './arrows.js';
import {RoundEnd} from './scaling.js';
import {bodiesReach, bodySpacing, solids} from './scene.js';
import {largeParts, normalsOf, surfaceNet} from './surface-net.js';
import {planeOf, quantile, smoothed, velocityAt, vorticesOf} from './vorticity.js';

/** The share of what is shown that is less than the ends of the colour scale. */
const STRONGEST = 0.97;
/** The share of the water that is in a vortex: that whose Q is highest. */
const IN_VORTICES = 0.01;
/** Nearer to a body's particles than this, in their spacings and in cells, water has some of its motion: no vortex is told there. */
const NEAR = {spacings: 0.6, cells: 1};
/** Vortices smaller than this share of the largest are left out. */
const LEAST_PART = 0.06;
/** Least ends of the colour scales: 1/s, length/s, mass/(length s²); below it water rests. */
const LEAST = {vorticity: 0.1, vortices: 0.1, velocity: 0.02, pressure: 1e-4};

/** Planes by name, and the axis that each is across. */
const PLANES = {level: 1, along: 2, across: 0};
/** Arrows along the longer side of a plane, at most; and how long the longest are, in distances between them. */
const ARROWS = 40;
const ARROW_LENGTH = 1.5;
/** Slower than this share of the scale's end has no arrow. */
const STILL = 0.05;

/** How opaque vortices are where water is so opaque: more, as nothing of interest is behind them. */
export function vortexOpacity(opacity) {
  return 0.5 + 0.5 * opacity;
}

/** Of one picture. */
export class Wake {
  /** @type {Scene|null} */
  #scene = null;
  /** What is shown of the water: see `waterShown`. */
  #kind = 'none';
  #plane = 'level';
  #place = 0;
  #centre = [0, 0, 0];
  /** @type {Float32Array} */
  #position = new Float32Array(0);
  #end = new RoundEnd(1);

  /**
   * The last water that came, or null.
   *
   * @type {Water|null}
   */
  water = null;
  /**
   * A plane across `axis` at `height`, or null: `columns` along its lower axis times `rows` along the other of `values`, in cells
   * of width `cell` from `low` on, shown from `from` to `to`; where it is shown beyond its cells, it begins anew. `arrows` from
   * places to places, three numbers each.
   */
  slice = null;
  /** Surfaces around vortices with the vorticity and the normal of each vertex, or null: see `surfaceNet`. */
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

  /** Ends of the colour scale: 1/s, length/s or mass/(length s²). */
  get range() {
    return this.shared ?? this.#own;
  }

  get #own() {
    return [this.kind === 'velocity' ? 0 : -this.#end.value, this.#end.value];
  }

  /** What is shown: vorticity, velocity, pressure, vortices, or nothing of these. */
  get kind() {
    return this.#kind;
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

  /** Shows what belongs to a look: on which plane, and how far from the body, as a share of how far that goes. */
  show(kind, plane = 'level', place = 0) {
    if (kind !== this.#kind) {
      this.#end = new RoundEnd(LEAST[kind] ?? 1);
    } else if (plane === this.#plane && place === this.#place) {
      return;
    }
    this.#kind = kind;
    this.#plane = plane;
    this.#place = place;
    this.#update();
  }

  /** Whether it shows something of the water. */
  get isShown() {
    return this.#kind in LEAST;
  }

  /**
   * Takes over the water of now.
   *
   * @param {Water} water
   * @param {number[]} centre of the body; without one of the tank
   * @param {Float32Array} position of all particles
   */
  setWater(water, centre, position) {
    this.water = water;
    this.#centre = centre;
    this.#position = position;
    this.#update();
  }

  #update() {
    this.slice = null;
    this.vortices = null;
    this.version++;
    if (this.water?.density.length > 0 && this.isShown && (this.#kind !== 'pressure' || this.water.pressure)) {
      this.#kind === 'vortices' ? this.#surround() : this.#cut();
    }
  }

  /** Whether the tank closes up with itself along an axis. */
  #wraps(axis) {
    return 'xyz'[axis] in (this.#scene.periodic ?? {});
  }

  #cut() {
    const {cells, cell, corner, origin} = this.water;
    const axis = cells[1] === 1 ? PLANES.level : PLANES[this.#plane];
    const sides = [0, 1, 2].filter(one => one !== axis);
    const begin = corner.map((one, i) => one + origin[i]);
    let height = this.#centre[axis] + this.#place * bodiesReach(this.#scene, cells[axis] * cell);
    if (this.#wraps(axis)) {
      height -= Math.floor((height - begin[axis]) / (cells[axis] * cell)) * cells[axis] * cell;
    }
    height = Math.min(begin[axis] + (cells[axis] - 0.5) * cell, Math.max(begin[axis] + 0.5 * cell, height));
    const values = planeOf(this.water, /** @type {any} */ (this.#kind), axis, height - origin[axis]);
    const low = sides.map(one => begin[one]);
    const ends = sides.map((one, i) => {
      const length = cell * cells[one];
      const from = this.#wraps(one) ? this.#centre[one] - length / 2 : low[i];
      return [from, from + length];
    });
    if (this.#end.follow(quantile(values.filter(value => value !== 0), STRONGEST, Math.abs))) {
      this.onRange(this.#own);
    }
    this.slice = {values, columns: cells[sides[0]], rows: cells[sides[1]], cell, low, axis, sides, height,
      from: ends.map(([from]) => from), to: ends.map(([, to]) => to)};
    this.slice.arrows = this.#kind === 'velocity' ? this.#arrows() : NO_ARROWS;
  }

  /** Along the plane, from the middles of some cells on. */
  #arrows() {
    const {sides, axis, height, from: low, to: high, cell, columns, rows} = this.slice;
    const apart = cell * Math.max(1, Math.ceil(Math.max(columns, rows) / ARROWS));
    const wraps = [0, 1, 2].map(one => this.#wraps(one));
    const [from, to] = [[], []];
    const place = [0, 0, 0];
    const flow = new Float32Array(3);
    const most = this.range[1];
    place[axis] = height;
    for (place[sides[1]] = low[1] + apart / 2; place[sides[1]] < high[1]; place[sides[1]] += apart) {
      for (place[sides[0]] = low[0] + apart / 2; place[sides[0]] < high[0]; place[sides[0]] += apart) {
        velocityAt(this.water, place.map((one, i) => one - this.water.origin[i]), wraps, flow);
        const speed = Math.hypot(flow[sides[0]], flow[sides[1]]);
        if (speed > STILL * most) {
          const scale = ARROW_LENGTH * apart / Math.max(most, speed);
          from.push(...place);
          to.push(...place.map((one, i) => i === axis ? one : one + scale * flow[i]));
        }
      }
    }
    return {from: Float32Array.from(from), to: Float32Array.from(to)};
  }

  /** Takes from q what is next to bodies. */
  #leaveOutBodies(q) {
    const {cells, cell, corner, origin} = this.water;
    const reach = NEAR.cells + NEAR.spacings * bodySpacing(this.#scene) / cell;
    for (const particle of solids(this.#scene)) {
      const at = [0, 1, 2].map(axis => (this.#position[3 * particle + axis] - origin[axis] - corner[axis]) / cell - 0.5);
      const [from, to] = [at.map(one => Math.ceil(one - reach)), at.map(one => Math.floor(one + reach))];
      for (let z = Math.max(0, from[2]); z <= Math.min(cells[2] - 1, to[2]); z++) {
        for (let y = Math.max(0, from[1]); y <= Math.min(cells[1] - 1, to[1]); y++) {
          for (let x = Math.max(0, from[0]); x <= Math.min(cells[0] - 1, to[0]); x++) {
            if ((x - at[0]) ** 2 + (y - at[1]) ** 2 + (z - at[2]) ** 2 <= reach * reach) {
              q[x + cells[0] * (y + cells[1] * z)] = 0;
            }
          }
        }
      }
    }
  }

  #surround() {
    const {cells, cell, corner, origin} = this.water;
    const {q, turns} = vorticesOf(smoothed(this.water));
    this.#leaveOutBodies(q);
    const least = Math.max(quantile(q, 1 - IN_VORTICES), LEAST.vortices * LEAST.vortices);
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
    const {vertices, triangles} = largeParts(surfaceNet({values: q, size: cells, low, cell}), LEAST_PART);
    const ofVertex = new Float32Array(vertices.length / 3);
    for (let i = 0; i < ofVertex.length; i++) {
      const [x, y, z] = [0, 1, 2].map(axis => Math.round((vertices[3 * i + axis] - low[axis]) / cell));
      ofVertex[i] = turns[x + across * (y + up * z)];
    }
    this.vortices = {vertices, triangles, normals: normalsOf({vertices, triangles}), turns: ofVertex, cell};
    if (this.#end.follow(quantile(ofVertex, 0.75, Math.abs))) {
      this.onRange(this.#own);
    }
  }
}
