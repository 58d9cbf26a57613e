/**
 * Water as a smooth surface by the processor: depth of the nearest spheres, smoothed without crossing edges, normals
 * from it, light. The same as gl-surface.js does.
 */

const REACH = 4;
const ROUNDS = 2;
const WEIGHTS = Array.from({length: REACH + 1}, (_, i) => Math.exp(-i * i / 9));
const BLOCKED = -1;
/** Pixels on each side over which the slope is taken. */
const STEP = 2;
/** Direction to the lamp, as the camera sees it, and the one between it and the eye. */
const LAMP = unit(-0.35, 0.8, 0.5);
const GLOSS = unit(LAMP[0], LAMP[1], LAMP[2] + 1);

function unit(x, y, z) {
  const length = Math.hypot(x, y, z);
  return [x / length, y / length, z / length];
}

/** Depth and value of what is nearest in each pixel; 0 where nothing is, below 0 where the body is nearer. */
export class SurfaceLayer {
  #width = 0;
  #height = 0;
  #depth = new Float32Array(0);
  #value = new Float32Array(0);
  #otherDepth = new Float32Array(0);
  #otherValue = new Float32Array(0);
  #pixels = new Uint32Array(0);

  image = null;

  setSize(width, height) {
    this.#width = width;
    this.#height = height;
    this.#depth = new Float32Array(width * height);
    this.#value = new Float32Array(width * height);
    this.#otherDepth = new Float32Array(width * height);
    this.#otherValue = new Float32Array(width * height);
    this.image = new ImageData(width, height);
    this.#pixels = new Uint32Array(this.image.data.buffer);
  }

  clear() {
    this.#depth.fill(0);
  }

  /** Adds a sphere whose centre has this depth; nearest ones must come first. `value` is any number. */
  water(disc, x, y, depth, radius, value) {
    const depths = this.#depth;
    const last = Math.min(disc.size, this.#height - y);
    for (let row = Math.max(0, -y); row < last; row++) {
      const to = Math.min(disc.end[row], this.#width - x);
      const line = (y + row) * this.#width + x;
      const from = row * disc.size;
      for (let column = Math.max(disc.start[row], -x); column < to; column++) {
        const there = depths[line + column];
        const here = depth - radius * disc.height[from + column];
        if (there === 0 || here < there) {
          depths[line + column] = here;
          this.#value[line + column] = value;
        }
      }
    }
  }

  /** Hides all water behind a disc of the body. */
  block(disc, x, y) {
    const last = Math.min(disc.size, this.#height - y);
    for (let row = Math.max(0, -y); row < last; row++) {
      const to = Math.min(disc.end[row], this.#width - x);
      const line = (y + row) * this.#width + x;
      for (let column = Math.max(disc.start[row], -x); column < to; column++) {
        if (this.#depth[line + column] === 0) {
          this.#depth[line + column] = BLOCKED;
        }
      }
    }
  }

  /** Smooths depths that differ by less than `edge`. */
  smooth(edge) {
    for (let round = 0; round < ROUNDS; round++) {
      this.#pass(this.#depth, this.#value, this.#otherDepth, this.#otherValue, 1, edge);
      this.#pass(this.#otherDepth, this.#otherValue, this.#depth, this.#value, this.#width, edge);
    }
  }

  #pass(depth, value, toDepth, toValue, step, edge) {
    const perEdge = 1 / (edge * edge);
    const end = depth.length;
    for (let at = 0; at < end; at++) {
      const here = depth[at];
      toDepth[at] = here;
      if (here <= 0) {
        continue;
      }
      let depths = here;
      let values = value[at];
      let weights = 1;
      for (let i = -REACH; i <= REACH; i++) {
        const other = at + i * step;
        if (i === 0 || other < 0 || other >= end || depth[other] <= 0) {
          continue;
        }
        const off = depth[other] - here;
        const close = 1 - off * off * perEdge;
        if (close > 0) {
          const weight = WEIGHTS[i < 0 ? -i : i] * close;
          depths += weight * depth[other];
          values += weight * value[other];
          weights += weight;
        }
      }
      toDepth[at] = depths / weights;
      toValue[at] = values / weights;
    }
  }

  /**
   * Lights the surface into `image`.
   *
   * @param {import('./projector.js').Projector} projector of this layer's size
   * @param {Uint8Array} colours RGBA for each whole value
   * @param {number[]} sky three numbers from 0 to 255, seen at grazing angles
   */
  shade(projector, colours, opacity, sky, edge) {
    const depth = this.#depth;
    const width = this.#width;
    const perPixel = 1 / projector.pixels;
    this.#pixels.fill(0);
    for (let y = 0; y < this.#height; y++) {
      const above = y < STEP ? 0 : STEP * width;
      const below = y + STEP < this.#height ? STEP * width : 0;
      const up = (projector.middleY - y) * perPixel;
      for (let x = 0; x < width; x++) {
        const at = y * width + x;
        const here = depth[at];
        if (here > 0) {
          const side = (x - projector.middleX) * perPixel;
          const alongX = slope(here, depth[x < STEP ? at : at - STEP], depth[x + STEP < width ? at + STEP : at], edge);
          const alongY = slope(here, depth[at + below], depth[at - above], edge);
          this.#pixels[at] = this.#light(here, side, up, alongX, alongY, perPixel, colours, this.#value[at], opacity, sky);
        }
      }
    }
  }

  /** One pixel: `alongX` and `alongY` are changes of depth to the next pixel on the right and above. */
  #light(depth, side, up, alongX, alongY, perPixel, colours, value, opacity, sky) {
    const ax = side * alongX + perPixel * depth;
    const ay = up * alongX;
    const bx = side * alongY;
    const by = up * alongY + perPixel * depth;
    let nx = ay * -alongY + alongX * by;
    let ny = -alongX * bx + ax * alongY;
    let nz = ax * by - ay * bx;
    const length = 1 / Math.sqrt(nx * nx + ny * ny + nz * nz);
    nx *= length;
    ny *= length;
    nz *= length;
    const toEye = 1 / Math.sqrt(side * side + up * up + 1);
    const facing = Math.max(0, (nz - nx * side - ny * up) * toEye);
    const rim = (1 - facing) ** 3;
    const lamp = 0.66 + 0.4 * Math.max(0, nx * LAMP[0] + ny * LAMP[1] + nz * LAMP[2]);
    const mirrored = Math.max(0, nx * GLOSS[0] + ny * GLOSS[1] + nz * GLOSS[2]);
    const gloss = mirrored > 0.9 ? mirrored ** 48 : 0;
    const from = 4 * Math.round(value);
    const red = byte(mix(colours[from] * lamp, sky[0], 0.45 * rim) + 60 * gloss);
    const green = byte(mix(colours[from + 1] * lamp, sky[1], 0.45 * rim) + 60 * gloss);
    const blue = byte(mix(colours[from + 2] * lamp, sky[2], 0.45 * rim) + 60 * gloss);
    const alpha = byte(255 * (opacity + 0.35 * rim + 0.3 * gloss));
    return (alpha << 24 | blue << 16 | green << 8 | red) >>> 0;
  }
}

/** The change of depth per pixel, from both sides, or the one that is no edge; 0 between edges. */
function slope(here, before, after, edge) {
  const forward = after > 0 ? after - here : Infinity;
  const backward = before > 0 ? here - before : Infinity;
  const goesOn = Math.abs(forward) < edge;
  const cameFrom = Math.abs(backward) < edge;
  return ((goesOn ? forward : cameFrom ? backward : 0) + (cameFrom ? backward : goesOn ? forward : 0)) / (2 * STEP);
}

function mix(from, to, share) {
  return from + share * (to - from);
}

function byte(value) {
  return value < 0 ? 0 : value > 255 ? 255 : value | 0;
}
