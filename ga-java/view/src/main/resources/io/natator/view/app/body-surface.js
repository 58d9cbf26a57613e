/** A smooth surface around particles: where they have been averaged to a place that is a radius away. */

import {surfaceNet} from './surface-net.js';

/** Radius of the surface around a layer of particles, and the reach of the average, in spacings. */
const RADIUS = 0.62;
const REACH = 2;
/** Width of a cell, in spacings; wider where there would be too many. */
const CELL = 0.42;
const MOST_NODES = 3e6;
const ROUNDS = 4;

/**
 * The surface of Zhu and Bridson (Animating Sand as a Fluid, 2005), |x − mean of the places near x| = radius, evened out.
 *
 * @param {number[][]} places x, y, z of each particle
 * @param {number} spacing distance of neighbours, length
 * @returns {{vertices: Float32Array, triangles: Uint32Array}} three numbers for each vertex; three vertices for each
 *     triangle, counter-clockwise as seen from outside
 */
export function surfaceAround(places, spacing) {
  const {vertices, triangles} = surfaceNet(distances(places, spacing));
  smooth(vertices, triangles);
  return {vertices, triangles};
}

/** Signed distances on the nodes of a grid around the places, negative inside. */
function distances(places, spacing) {
  const reach = REACH * spacing;
  const low = [0, 1, 2].map(axis => Math.min(...places.map(place => place[axis])) - reach);
  const high = [0, 1, 2].map(axis => Math.max(...places.map(place => place[axis])) + reach);
  const volume = low.reduce((product, value, axis) => product * (high[axis] - value), 1);
  const cell = Math.max(CELL * spacing, Math.cbrt(volume / MOST_NODES));
  const size = low.map((value, axis) => Math.ceil((high[axis] - value) / cell) + 2);
  const sums = new Float32Array(4 * size[0] * size[1] * size[2]);
  for (const place of places) {
    const from = place.map((value, axis) => Math.max(0, Math.ceil((value - reach - low[axis]) / cell)));
    const to = place.map((value, axis) => Math.min(size[axis] - 1, Math.floor((value + reach - low[axis]) / cell)));
    for (let z = from[2]; z <= to[2]; z++) {
      for (let y = from[1]; y <= to[1]; y++) {
        for (let x = from[0]; x <= to[0]; x++) {
          const square = (low[0] + x * cell - place[0]) ** 2 + (low[1] + y * cell - place[1]) ** 2
              + (low[2] + z * cell - place[2]) ** 2;
          const share = 1 - square / (reach * reach);
          if (share > 0) {
            const weight = share ** 3;
            const at = 4 * (x + size[0] * (y + size[1] * z));
            sums[at] += weight;
            place.forEach((value, axis) => sums[at + 1 + axis] += weight * value);
          }
        }
      }
    }
  }
  const values = new Float32Array(sums.length / 4).fill(reach);
  for (let i = 0; i < values.length; i++) {
    const weight = sums[4 * i];
    if (weight > 0) {
      const x = i % size[0];
      const y = Math.floor(i / size[0]) % size[1];
      const z = Math.floor(i / size[0] / size[1]);
      values[i] = Math.hypot(low[0] + x * cell - sums[4 * i + 1] / weight, low[1] + y * cell - sums[4 * i + 2] / weight,
          low[2] + z * cell - sums[4 * i + 3] / weight) - RADIUS * spacing;
    }
  }
  return {values, size, low, cell};
}

/** Moves vertices to and fro along their neighbours' mean, which takes the steps of the grid away and keeps the volume (Taubin 1995). */
function smooth(vertices, triangles) {
  const count = vertices.length / 3;
  for (let round = 0; round < 2 * ROUNDS; round++) {
    const sum = new Float32Array(vertices.length);
    const number = new Uint16Array(count);
    for (let i = 0; i < triangles.length; i += 3) {
      for (let corner = 0; corner < 3; corner++) {
        const a = triangles[i + corner];
        const b = triangles[i + (corner + 1) % 3];
        number[a]++;
        for (let axis = 0; axis < 3; axis++) {
          sum[3 * a + axis] += vertices[3 * b + axis];
        }
      }
    }
    const share = round % 2 === 0 ? 0.5 : -0.52;
    for (let i = 0; i < vertices.length; i++) {
      vertices[i] += share * (sum[i] / number[Math.floor(i / 3)] - vertices[i]);
    }
  }
}
