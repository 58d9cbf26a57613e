/** The mesh that a body was made of: where its vertices are while the body moves. */

/** Iterations in which a rotation follows that of the frame before; it converges quadratically. */
const ITERATIONS = 12;
const NEGLIGIBLE = 1e-12;

/**
 * The rigid motion of one cluster: the rotation that fits its particles best (Müller, Bender, Chentanez, Macklin: A Robust
 * Method to Extract the Rotational Part of Deformations, 2016), from the one before.
 */
export class ClusterMotion {
  #particles;
  #rest;
  #from = [0, 0, 0];
  #to = [0, 0, 0];
  #moment = new Float64Array(9);
  #turn = [1, 0, 0, 0, 1, 0, 0, 0, 1];

  constructor(particles, rest) {
    this.#particles = particles;
    for (const place of rest) {
      place.forEach((value, axis) => this.#from[axis] += value / rest.length);
    }
    this.#rest = rest.map(place => place.map((value, axis) => value - this.#from[axis]));
  }

  update(position) {
    const to = this.#to.fill(0);
    for (const particle of this.#particles) {
      for (let axis = 0; axis < 3; axis++) {
        to[axis] += position[3 * particle + axis] / this.#particles.length;
      }
    }
    this.#moment.fill(0);
    this.#particles.forEach((particle, i) => {
      for (let column = 0; column < 3; column++) {
        for (let row = 0; row < 3; row++) {
          this.#moment[3 * column + row] += (position[3 * particle + row] - to[row]) * this.#rest[i][column];
        }
      }
    });
    let left = ITERATIONS;
    while (left > 0 && this.#follow()) {
      left--;
    }
  }

  /** Turns once towards the fit; false when there. */
  #follow() {
    const turn = this.#turn;
    const moment = this.#moment;
    const axis = [0, 0, 0];
    let along = 0;
    for (let c = 0; c < 9; c += 3) {
      axis[0] += turn[c + 1] * moment[c + 2] - turn[c + 2] * moment[c + 1];
      axis[1] += turn[c + 2] * moment[c] - turn[c] * moment[c + 2];
      axis[2] += turn[c] * moment[c + 1] - turn[c + 1] * moment[c];
      along += turn[c] * moment[c] + turn[c + 1] * moment[c + 1] + turn[c + 2] * moment[c + 2];
    }
    const size = Math.hypot(...axis);
    const angle = size / (Math.abs(along) + NEGLIGIBLE);
    if (!(angle > 1e-7)) {
      return false;
    }
    const [x, y, z] = axis.map(value => value / size);
    const cos = Math.cos(angle);
    const sin = Math.sin(angle);
    for (let c = 0; c < 9; c += 3) {
      const [u, v, w] = [turn[c], turn[c + 1], turn[c + 2]];
      const dot = (x * u + y * v + z * w) * (1 - cos);
      turn[c] = u * cos + (y * w - z * v) * sin + x * dot;
      turn[c + 1] = v * cos + (z * u - x * w) * sin + y * dot;
      turn[c + 2] = w * cos + (x * v - y * u) * sin + z * dot;
    }
    return true;
  }

  /** Adds `share` of a direction at rest (three numbers of `offsets` from `from` on), turned, to `out`, from `at` on. */
  addTurned(offsets, from, share, out, at) {
    const turn = this.#turn;
    const x = share * offsets[from];
    const y = share * offsets[from + 1];
    const z = share * offsets[from + 2];
    for (let axis = 0; axis < 3; axis++) {
      out[at + axis] += turn[axis] * x + turn[3 + axis] * y + turn[6 + axis] * z;
    }
  }

  /** Adds `share` of where a place at rest is now to `out`, from `at` on. */
  add(place, share, out, at) {
    const turn = this.#turn;
    const x = place[0] - this.#from[0];
    const y = place[1] - this.#from[1];
    const z = place[2] - this.#from[2];
    for (let axis = 0; axis < 3; axis++) {
      out[at + axis] += share * (this.#to[axis] + turn[axis] * x + turn[3 + axis] * y + turn[6 + axis] * z);
    }
  }
}

/** Each vertex follows two neighbouring clusters, blended linearly. */
export class SkinMotion {
  #skin;
  #clusters;

  /** x, y, z of each vertex, from `update` on. */
  places;
  /** Three vertices for each triangle, counter-clockwise as seen from outside. */
  triangles;
  /** For each vertex, the cluster that it goes with. */
  cluster;

  /** @param {Scene} scene a SCEN with a skin */
  constructor(scene) {
    this.#skin = scene.skin;
    const rest = new Map(scene.body.map((particle, i) => [particle, scene.skin.rest[i]]));
    this.#clusters = scene.clusters.map(particles => new ClusterMotion(particles, particles.map(one => rest.get(one))));
    this.places = new Float32Array(3 * scene.skin.vertices.length);
    this.triangles = Uint32Array.from(scene.skin.triangles.flat());
    this.cluster = Int32Array.from(scene.skin.cluster);
  }

  update(frame) {
    this.#clusters.forEach(cluster => cluster.update(frame.position));
    this.places.fill(0);
    const {vertices, cluster, other, share} = this.#skin;
    vertices.forEach((vertex, i) => {
      this.#clusters[cluster[i]].add(vertex, share[i], this.places, 3 * i);
      if (share[i] < 1) {
        this.#clusters[other ? other[i] : cluster[i] + 1].add(vertex, 1 - share[i], this.places, 3 * i);
      }
    });
  }
}
