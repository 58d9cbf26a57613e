/** Particles in the order of their distance from the camera. */

const BINS = 2048;

/** Counting sort by depth into bins that are thinner than a particle; keeps its arrays from frame to frame. */
export class NearestFirst {
  #depth = new Float32Array(0);
  #start = new Uint32Array(BINS + 1);

  /** Indices of particles, counted from 0 at `first`. */
  order = new Uint32Array(0);

  /**
   * Orders `count` particles from `first` on along the unit vector `forward` and leaves out what is nearer than `from`.
   *
   * @param {Float32Array} position three numbers per particle
   * @param {{x: number, y: number, z: number}} eye where depth is 0
   * @returns {number} how many are left, in `order`
   */
  sort(position, first, count, eye, forward, from) {
    if (this.#depth.length < count) {
      this.#depth = new Float32Array(count);
      this.order = new Uint32Array(count);
    }
    const depth = this.#depth;
    let nearest = Infinity;
    let farthest = -Infinity;
    for (let i = 0, k = 3 * first; i < count; i++, k += 3) {
      depth[i] = (position[k] - eye.x) * forward.x + (position[k + 1] - eye.y) * forward.y
          + (position[k + 2] - eye.z) * forward.z;
      const d = depth[i];  // rounded, as the bins have it
      if (d >= from) {
        nearest = d < nearest ? d : nearest;
        farthest = d > farthest ? d : farthest;
      }
    }
    return nearest > farthest ? 0 : this.#place(count, from, nearest, (BINS - 1) / Math.max(farthest - nearest, 1e-9));
  }

  #place(count, from, nearest, perDepth) {
    const depth = this.#depth;
    const start = this.#start.fill(0);
    for (let i = 0; i < count; i++) {
      if (depth[i] >= from) {
        start[1 + Math.floor((depth[i] - nearest) * perDepth)]++;
      }
    }
    for (let bin = 0; bin < BINS; bin++) {
      start[bin + 1] += start[bin];
    }
    const left = start[BINS];
    for (let i = 0; i < count; i++) {
      if (depth[i] >= from) {
        this.order[start[Math.floor((depth[i] - nearest) * perDepth)]++] = i;
      }
    }
    return left;
  }
}
