/** Spheres put into an array of pixels, nearest first; each pixel keeps the first water and the first body it meets. */

import {LIGHTS} from './discs.js';

const OPAQUE = 0xff000000;
/** Tiles are squares of 2 to this power pixels along each side. */
const TILE_BITS = 4;

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
  #tilesAcross = 0;
  #empty = new Uint16Array(0);
  #allEmpty = new Uint16Array(0);

  image = null;

  setSize(width, height) {
    this.#width = width;
    this.#height = height;
    this.image = new ImageData(width, height);
    this.#pixels = new Uint32Array(this.image.data.buffer);
    this.#setTiles();
  }

  clear() {
    this.#pixels.fill(0);
    this.#empty.set(this.#allEmpty);
  }

  /** Fills the empty pixels of a disc at (x, y), its top left corner, from the shades at `base` of the table. */
  water(disc, x, y, table, base) {
    if (this.#isCovered(x, y, disc.size)) {
      return;
    }
    const pixels = this.#pixels;
    const empty = this.#empty;
    const width = this.#width;
    const {size, start, end, light} = disc;
    const last = Math.min(size, this.#height - y);
    for (let row = Math.max(0, -y); row < last; row++) {
      const to = Math.min(end[row], width - x);
      const line = (y + row) * width + x;
      const from = row * size;
      const tiles = (y + row >> TILE_BITS) * this.#tilesAcross;
      for (let column = Math.max(start[row], -x); column < to; column++) {
        if (pixels[line + column] === 0) {
          pixels[line + column] = table[base + light[from + column]];
          empty[tiles + (x + column >> TILE_BITS)]--;
        }
      }
    }
  }

  /** The same of one colour all over. */
  flat(disc, x, y, colour) {
    const {size, start, end} = disc;
    const last = Math.min(size, this.#height - y);
    for (let row = Math.max(0, -y); row < last; row++) {
      const to = Math.min(end[row], this.#width - x);
      const line = (y + row) * this.#width + x;
      const tiles = (y + row >> TILE_BITS) * this.#tilesAcross;
      for (let column = Math.max(start[row], -x); column < to; column++) {
        if (this.#pixels[line + column] === 0) {
          this.#pixels[line + column] = colour;
          this.#empty[tiles + (x + column >> TILE_BITS)]--;
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
        if (this.#pixels[line + column] === 0) {
          this.#empty[(y + row >> TILE_BITS) * this.#tilesAcross + (x + column >> TILE_BITS)]--;
        }
        this.#under(line + column, isSpot ? 0xffffffff : table[base + light[at]]);
      }
    }
  }

  /** How many pixels of each tile are empty at first. */
  #setTiles() {
    const side = 1 << TILE_BITS;
    this.#tilesAcross = Math.ceil(this.#width / side);
    const down = Math.ceil(this.#height / side);
    this.#allEmpty = Uint16Array.from({length: this.#tilesAcross * down}, (_, tile) => {
      const x = tile % this.#tilesAcross * side;
      const y = Math.floor(tile / this.#tilesAcross) * side;
      return Math.min(side, this.#width - x) * Math.min(side, this.#height - y);
    });
    this.#empty = new Uint16Array(this.#allEmpty.length);
  }

  /** Whether no pixel of the tiles beneath a square is empty. */
  #isCovered(x, y, size) {
    const left = Math.max(0, x) >> TILE_BITS;
    const right = Math.min(this.#width - 1, x + size - 1) >> TILE_BITS;
    const bottom = Math.min(this.#height - 1, y + size - 1) >> TILE_BITS;
    for (let row = Math.max(0, y) >> TILE_BITS; row <= bottom; row++) {
      for (let tile = row * this.#tilesAcross + left; tile <= row * this.#tilesAcross + right; tile++) {
        if (this.#empty[tile] > 0) {
          return false;
        }
      }
    }
    return true;
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
