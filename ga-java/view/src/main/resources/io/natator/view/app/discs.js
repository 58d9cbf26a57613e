/** Discs of any radius and place within a pixel, with how bright a sphere would be there. */

/** Levels of light. */
export const LIGHTS = 32;
/** Places within a pixel, along each side. */
const PARTS = 4;
const LARGEST = 90;

/** Rows of a disc: from `start` to before `end`, light (and height) of each of its pixels; centred at `half`. */
class Disc {
  constructor(radius, offX, offY) {
    this.half = Math.ceil(radius) + 1;
    this.size = 2 * this.half + 1;
    this.start = new Int16Array(this.size);
    this.end = new Int16Array(this.size);
    this.light = new Uint8Array(this.size * this.size);
    this.height = new Float32Array(this.size * this.size);
    for (let y = 0; y < this.size; y++) {
      this.#row(y, radius, offX, offY);
    }
  }

  #row(y, radius, offX, offY) {
    const sideY = (y + 0.5 - this.half - offY) / radius;
    const reach = Math.sqrt(Math.max(0, 1 - sideY * sideY)) * radius;
    const start = reach === 0 ? 0 : Math.ceil(this.half + offX - reach - 0.5);
    const end = reach === 0 ? 0 : Math.floor(this.half + offX + reach - 0.5) + 1;
    this.start[y] = start;
    this.end[y] = end;
    for (let x = start; x < end; x++) {
      const sideX = (x + 0.5 - this.half - offX) / radius;
      const height = Math.sqrt(Math.max(0, 1 - sideX * sideX - sideY * sideY));
      const light = (0.55 * height + 0.45 - 0.24 * sideY - 0.12 * sideX) / 1.1;
      this.light[y * this.size + x] = Math.round((LIGHTS - 1) * Math.min(1, Math.max(0, light)));
      this.height[y * this.size + x] = height;
    }
  }
}

/** Makes discs when they are needed and keeps them. */
export class Discs {
  #kept = new Map();

  /** A disc of about this radius whose centre lies at these shares (0 to 1) of a pixel. */
  of(radius, shareX, shareY) {
    const step = radius < 8 ? 8 : radius < 24 ? 4 : 1;
    const wanted = Math.max(0.6, Math.min(LARGEST, Math.round(radius * step) / step));
    const x = Math.min(PARTS - 1, Math.floor(shareX * PARTS));
    const y = Math.min(PARTS - 1, Math.floor(shareY * PARTS));
    const key = (Math.round(wanted * 8) * PARTS + x) * PARTS + y;
    let disc = this.#kept.get(key);
    if (disc === undefined) {
      disc = new Disc(wanted, (x + 0.5) / PARTS, (y + 0.5) / PARTS);
      this.#kept.set(key, disc);
    }
    return disc;
  }
}
