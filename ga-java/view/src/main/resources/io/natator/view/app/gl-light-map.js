/** Light that falls through the water onto what is below it: gathered and spread by waves, and held back by bodies. */

import * as THREE from 'three';
import {SHAPE_NUMBERS} from './water-numbers.js';

/** Width of a cell in spacings of the water, and most cells along a side. */
const CELL = 0.5;
const MOST_CELLS = 160;
/** Radius over which heights are evened out, and that of the shadow of a particle of a body, in cells. */
const REACH = 6;
const SHADOW_REACH = 3;
/** 1 - 1 / the refractive index of water: by how much of its slope a wave bends a ray that comes from above. */
const BEND = 0.25;
const LEAST = 0.85;
const MOST = 1.7;

/** How many cover a length, free of its rounding. */
function cells(length, cell) {
  return Math.max(1, Math.ceil(length / cell - 1e-6));
}

/**
 * A texture over the floor of the tank: r is the light there in parts of `MOST`, g the shadow. A ray from above that meets
 * a wave of height h is bent by BEND times its slope, so that at a depth d below it rays lie closer by 1 + BEND d ∇²h: light
 * is its inverse, to first order.
 */
export class GlLightMap {
  #width = 1;
  #height = 1;
  #bounds = null;
  #cell = 1;
  #spacing = 1;
  #weights = new Float32Array(0);
  #heights = new Float32Array(0);
  #shadow = new Float32Array(0);
  #lamp;

  texture = new THREE.DataTexture(new Uint8Array([255 / MOST, 0, 0, 255]), 1, 1);

  /** `lamp` is the direction to it. */
  constructor(lamp) {
    this.#lamp = lamp;
    this.#prepare();
  }

  /** The tank, see `tankBounds`, and the spacing of the water. */
  setBounds(bounds, spacing) {
    this.#bounds = bounds;
    this.#spacing = spacing;
    const {min, max} = bounds;
    this.#cell = Math.max(CELL * spacing, (max[0] - min[0]) / MOST_CELLS, (max[2] - min[2]) / MOST_CELLS);
    const width = cells(max[0] - min[0], this.#cell);
    const height = cells(max[2] - min[2], this.#cell);
    if (width === this.#width && height === this.#height) {
      return;  // it has only moved
    }
    this.#width = width;
    this.#height = height;
    const count = this.#width * this.#height;
    this.#weights = new Float32Array(count);
    this.#heights = new Float32Array(count);
    this.#shadow = new Float32Array(count);
    this.texture.dispose();
    this.texture = new THREE.DataTexture(new Uint8Array(4 * count), this.#width, this.#height);
    this.#prepare();
  }

  #prepare() {
    this.texture.minFilter = THREE.LinearFilter;
    this.texture.magFilter = THREE.LinearFilter;
    this.texture.needsUpdate = true;
  }

  /**
   * Takes over a frame.
   *
   * @param {import('./water-shape.js').WaterShapes|null} shapes of the water, or null without
   * @param {number[]} solids particles that cast a shadow
   * @param {Float32Array} position of all particles
   */
  update(shapes, solids, position) {
    if (this.#bounds === null) {
      return;
    }
    const {min} = this.#bounds;
    this.#weights.fill(0);
    this.#heights.fill(0);
    this.#shadow.fill(0);
    if (shapes !== null) {
      const high = this.#bounds.max[1];
      for (let i = 0, at = 0; i < shapes.count; i++, at += SHAPE_NUMBERS) {
        const y = shapes.numbers[at + 1];
        // The highest of those above each other counts most.
        const weight = Math.exp(3 * (y - high) / this.#spacing);
        this.#splat(shapes.numbers[at], shapes.numbers[at + 2], REACH, (cell, share) => {
          this.#weights[cell] += weight * share;
          this.#heights[cell] += weight * share * y;
        });
      }
    }
    for (const particle of solids) {
      const y = position[3 * particle + 1] - min[1];
      const x = position[3 * particle] - 0.6 * y * this.#lamp.x / this.#lamp.y;
      const z = position[3 * particle + 2] - 0.6 * y * this.#lamp.z / this.#lamp.y;
      this.#splat(x, z, SHADOW_REACH, (cell, share) => {
        this.#shadow[cell] += 0.35 * share;
      });
    }
    this.#write();
  }

  #splat(x, z, reach, add) {
    const {min} = this.#bounds;
    const column = (x - min[0]) / this.#cell - 0.5;
    const row = (z - min[2]) / this.#cell - 0.5;
    for (let r = Math.max(0, Math.ceil(row - reach)); r <= Math.min(this.#height - 1, row + reach); r++) {
      for (let c = Math.max(0, Math.ceil(column - reach)); c <= Math.min(this.#width - 1, column + reach); c++) {
        const share = 1 - ((c - column) ** 2 + (r - row) ** 2) / (reach * reach);
        if (share > 0) {
          add(c + this.#width * r, share * share);
        }
      }
    }
  }

  #write() {
    const heights = this.#heights;
    const low = this.#bounds.min[1];
    for (let cell = 0; cell < heights.length; cell++) {
      heights[cell] = this.#weights[cell] > 0 ? heights[cell] / this.#weights[cell] : low;
    }
    const bytes = this.texture.image.data;
    for (let row = 0, cell = 0; row < this.#height; row++) {
      for (let column = 0; column < this.#width; column++, cell++) {
        const left = heights[column > 0 ? cell - 1 : cell];
        const right = heights[column + 1 < this.#width ? cell + 1 : cell];
        const back = heights[row > 0 ? cell - this.#width : cell];
        const front = heights[row + 1 < this.#height ? cell + this.#width : cell];
        const curvature = (left + right + back + front - 4 * heights[cell]) / (this.#cell * this.#cell);
        const light = this.#weights[cell] > 0 ? 1 / Math.max(1 / MOST, 1 + BEND * (heights[cell] - low) * curvature) : 1;
        bytes[4 * cell] = 255 * Math.min(MOST, Math.max(LEAST, light)) / MOST;
        bytes[4 * cell + 1] = 255 * Math.min(1, this.#shadow[cell]);
        bytes[4 * cell + 3] = 255;
      }
    }
    this.texture.needsUpdate = true;
  }

  /** GLSL: `lightAt(map, tank, place)`, the light at a place, with tank as x, z of its corners. */
  static CODE = `
    float lightAt(sampler2D map, vec4 tank, vec3 place) {
      vec2 at = (place.xz - tank.xy) / (tank.zw - tank.xy);
      if (at.x < 0.0 || at.y < 0.0 || at.x > 1.0 || at.y > 1.0) { return 1.0; }
      vec4 texel = texture(map, at);
      return texel.r * ${MOST.toFixed(2)} * (1.0 - 0.55 * texel.g);
    }`;

  dispose() {
    this.texture.dispose();
  }
}
