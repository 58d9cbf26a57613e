/** Spheres put into an array of pixels, nearest first; each pixel keeps the first water and the first body it meets. */

import {LIGHTS} from './discs.js';

const OPAQUE = 0xff000000;

/**
 * Colours with all levels of light, ready for pixels (little-endian RGBA).
 *
 * @param {number[][]} colours each as three numbers from 0 to 1
 * @param {number} alpha from 0 to 1
 */
export function shades(colours, alpha) {
  const table = new Uint32Array(colours.length * LIGHTS);
  colours.forEach((colour, i) => {
    for (let light = 0; light < LIGHTS; light++) {
      const strength = 0.42 + 0.66 * light / (LIGHTS - 1);
      const [red, green, blue] = colour.map(value => Math.min(255, Math.round(255 * strength * value)));
      table[i * LIGHTS + light] = (Math.round(255 * alpha) << 24 | blue << 16 | green << 8 | red) >>> 0;
    }
  });
  return table;
}

/** Pixels that are empty (0), water (not quite opaque) or body (opaque). */
export class SphereLayer {
  #width = 0;
  #height = 0;
  #pixels = new Uint32Array(0);

  image = null;

  setSize(width, height) {
    this.#width = width;
    this.#height = height;
    this.image = new ImageData(width, height);
    this.#pixels = new Uint32Array(this.image.data.buffer);
  }

  clear() {
    this.#pixels.fill(0);
  }

  /** Fills the empty pixels of a disc at (x, y), its top left corner, from the shades at `base` of the table. */
  water(disc, x, y, table, base) {
    const pixels = this.#pixels;
    const width = this.#width;
    const {size, start, end, light} = disc;
    const last = Math.min(size, this.#height - y);
    for (let row = Math.max(0, -y); row < last; row++) {
      const to = Math.min(end[row], width - x);
      const line = (y + row) * width + x;
      const from = row * size;
      for (let column = Math.max(start[row], -x); column < to; column++) {
        if (pixels[line + column] === 0) {
          pixels[line + column] = table[base + light[from + column]];
        }
      }
    }
  }

  /** The same for a body's disc, which shows through water; a spot in its middle is white where `isJoint`. */
  body(disc, x, y, table, base, isJoint) {
    const {size, start, end, light, height} = disc;
    const last = Math.min(size, this.#height - y);
    for (let row = Math.max(0, -y); row < last; row++) {
      const to = Math.min(end[row], this.#width - x);
      const line = (y + row) * this.#width + x;
      for (let column = Math.max(start[row], -x); column < to; column++) {
        const at = row * size + column;
        const isSpot = isJoint && height[at] > 0.88;
        this.#under(line + column, isSpot ? 0xffffffff : table[base + light[at]]);
      }
    }
  }

  #under(at, colour) {
    const above = this.#pixels[at];
    if (above === 0) {
      this.#pixels[at] = colour;
    } else if (above < OPAQUE) {
      const alpha = above >>> 24;
      const mix = shift => ((above >>> shift & 255) * alpha + (colour >>> shift & 255) * (255 - alpha)) / 255 << shift;
      this.#pixels[at] = (OPAQUE | mix(16) | mix(8) | mix(0)) >>> 0;
    }
  }
}
