/** What water can be coloured by. */

import {niceStep} from './scaling.js';

/** How often the ends of a scale are looked at again, in frames. */
const PERIOD = 12;
const SAMPLES = 400;
/** The share of the scale that gives water its colour where it is coloured by nothing. */
const PLAIN = 0.3;

/** Name, title, unit, and least width of the scale of each. */
export const FIELDS = {
  speed: {title: 'Speed', unit: 'length/s', least: 0.05},
  density: {title: 'Density', unit: 'rest densities', least: 0.02},
  mass: {title: 'Mass', unit: 'mass of a particle', least: 0.01},
  none: {title: 'nothing', unit: '', least: 1},
};

/** Values of one field for the particles of a scene, and the ends of their scale, which follow slowly. */
export class FieldValues {
  /** @type {Scene|null} */
  #scene = null;
  #field = null;
  #age = 0;
  #sample = new Float32Array(SAMPLES);

  #own = [0, 1];

  /** Ends that hold instead of its own, for pictures that share a scale; null for its own. */
  shared = null;

  /**
   * Called with its own ends when they change.
   *
   * @type {(range: number[]) => void}
   */
  onRange = () => {};

  /** Ends of the scale. */
  get range() {
    return this.shared ?? this.#own;
  }

  /**
   * Fills `out` with the values of `count` particles from `first` on.
   *
   * @param {Scene} scene
   * @param {Frame} frame
   */
  read(field, scene, frame, first, count, out) {
    const {velocities, density} = frame;
    if (field === 'speed' && velocities !== null) {
      for (let i = 0, k = 3 * first; i < count; i++, k += 3) {
        const x = velocities[k];
        const y = velocities[k + 1];
        const z = velocities[k + 2];
        out[i] = Math.sqrt(x * x + y * y + z * z);
      }
    } else if (field === 'density' && density !== null) {
      out.set(density.subarray(first, first + count));
    } else if (field === 'mass') {
      for (let i = 0; i < count; i++) {
        out[i] = scene.mass[first + i] ?? 0;
      }
    } else {
      out.fill(field === 'none' ? PLAIN : 0, 0, count);
    }
    this.#follow(field, scene, out, count);
  }

  #follow(field, scene, values, count) {
    const isNew = field !== this.#field || scene !== this.#scene;
    if (count === 0 || !isNew && ++this.#age < PERIOD) {
      return;
    }
    this.#field = field;
    this.#scene = scene;
    this.#age = 0;
    const taken = Math.min(count, SAMPLES);
    const sample = this.#sample.subarray(0, taken);
    for (let i = 0; i < taken; i++) {
      sample[i] = values[Math.floor(i * count / taken)];
    }
    sample.sort();
    const ends = this.#ends(field, sample);
    const [low, high] = this.#own;
    const fits = !isNew && ends[0] >= low && ends[1] <= high && ends[1] - ends[0] > 0.4 * (high - low);
    if (!fits && (isNew || ends[0] !== low || ends[1] !== high)) {
      this.#own = ends;
      this.onRange(ends);
    }
  }

  /** Round numbers around most of a sorted sample. */
  #ends(field, sample) {
    if (field === 'none') {
      return [0, 1];
    }
    const low = field === 'speed' ? 0 : sample[Math.floor(0.01 * (sample.length - 1))];
    const high = Math.max(sample[Math.ceil(0.99 * (sample.length - 1))], low + FIELDS[field].least);
    const step = niceStep((high - low) / 4);
    return [Math.floor(low / step + 1e-6) * step, Math.ceil(high / step - 1e-6) * step];
  }
}
