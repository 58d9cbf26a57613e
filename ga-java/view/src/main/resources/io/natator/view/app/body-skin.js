/** A skin for bodies without a mesh: a smooth surface around their particles that moves with them. */

import {surfaceAround} from './body-surface.js';
import {bodySpacing, solids} from './scene.js';
import {ClusterMotion} from './skin.js';

/** Particles that a vertex follows, the nearest ones. */
const FOLLOWED = 6;

/** What a vertex follows: particles nearest to it, with their weights. */
function nearest(place, places, spacing) {
  const found = Array.from({length: Math.min(FOLLOWED, places.length)}, () => ({i: 0, square: Infinity}));
  places.forEach(([x, y, z], i) => {
    const square = (x - place[0]) ** 2 + (y - place[1]) ** 2 + (z - place[2]) ** 2;
    let k = found.length;
    while (k > 0 && square < found[k - 1].square) {
      k--;
    }
    if (k < found.length) {
      found.splice(k, 0, {i, square});
      found.pop();
    }
  });
  return found.map(({i, square}) => ({i, weight: Math.exp(-(square - found[0].square) / (spacing * spacing))}));
}

/** Each vertex goes with the particles next to it and turns with their clusters. */
export class BodySkin {
  #particles;
  #clusters;
  #offsets;
  #followed;
  #shares;
  #clusterOf;

  /** x, y, z of each vertex, from `update` on. */
  places;
  /** Three vertices for each triangle, counter-clockwise as seen from outside. */
  triangles;
  /** For each vertex, the cluster that it goes with most; -1 for one of no cluster. */
  cluster;

  /**
   * @param {Scene} scene SCEN
   * @param {Float32Array} position of all particles, from which on the skin follows
   */
  constructor(scene, position) {
    this.#particles = solids(scene);
    const places = this.#particles.map(particle => Array.from(position.subarray(3 * particle, 3 * particle + 3)));
    const spacing = bodySpacing(scene);
    const {vertices, triangles} = surfaceAround(places, spacing);
    const placeOf = new Map(this.#particles.map((particle, i) => [particle, places[i]]));
    this.#clusters = scene.clusters.map(particles => new ClusterMotion(particles, particles.map(one => placeOf.get(one))));
    const clusterOf = new Map();
    scene.clusters.forEach((particles, cluster) => particles.forEach(one => clusterOf.has(one) || clusterOf.set(one, cluster)));
    this.#clusterOf = this.#particles.map(particle => clusterOf.get(particle) ?? -1);
    this.places = Float32Array.from(vertices);
    this.triangles = triangles;
    this.#bind(places, spacing);
  }

  #bind(places, spacing) {
    const count = this.places.length / 3;
    this.#followed = new Uint32Array(FOLLOWED * count);
    this.#shares = new Float32Array(FOLLOWED * count);
    this.#offsets = new Float32Array(3 * FOLLOWED * count);
    this.cluster = new Int32Array(count);
    for (let vertex = 0; vertex < count; vertex++) {
      const place = this.places.subarray(3 * vertex, 3 * vertex + 3);
      const found = nearest(place, places, spacing);
      const all = found.reduce((sum, {weight}) => sum + weight, 0);
      this.cluster[vertex] = this.#clusterOf[found[0].i];
      found.forEach(({i, weight}, k) => {
        const at = FOLLOWED * vertex + k;
        this.#followed[at] = i;
        this.#shares[at] = weight / all;
        place.forEach((value, axis) => {
          this.#offsets[3 * at + axis] = value - places[i][axis];
        });
      });
    }
  }

  /**
   * Moves the vertices to where the body is in a frame.
   *
   * @param {Frame} frame
   */
  update(frame) {
    this.#clusters.forEach(cluster => cluster.update(frame.position));
    this.places.fill(0);
    for (let at = 0; at < this.#followed.length; at++) {
      const i = this.#followed[at];
      const share = this.#shares[at];
      const out = 3 * Math.floor(at / FOLLOWED);
      const particle = 3 * this.#particles[i];
      for (let axis = 0; axis < 3; axis++) {
        this.places[out + axis] += share * frame.position[particle + axis];
      }
      const cluster = this.#clusters[this.#clusterOf[i]];
      if (cluster === undefined) {
        for (let axis = 0; axis < 3; axis++) {
          this.places[out + axis] += share * this.#offsets[3 * at + axis];
        }
      } else {
        cluster.addTurned(this.#offsets, 3 * at, share, this.places, out);
      }
    }
  }
}
