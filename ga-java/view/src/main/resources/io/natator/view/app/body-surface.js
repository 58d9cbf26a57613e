/** A smooth surface around particles: where they have been averaged to a place that is a radius away. */

/** Radius of the surface around a layer of particles, and the reach of the average, in spacings. */
const RADIUS = 0.62;
const REACH = 2;
/** Width of a cell, in spacings; wider where there would be too many. */
const CELL = 0.42;
const MOST_NODES = 3e6;
const ROUNDS = 4;

/**
 * The surface of Zhu and Bridson (Animating Sand as a Fluid, 2005), |x − mean of the places near x| = radius, by naive
 * surface nets (Gibson 1998): a vertex in each cell that it goes through; then evened out.
 *
 * @param {number[][]} places x, y, z of each particle
 * @param {number} spacing distance of neighbours, length
 * @returns {{vertices: Float32Array, triangles: Uint32Array}} three numbers for each vertex; three vertices for each
 *     triangle, counter-clockwise as seen from outside
 */
export function surfaceAround(places, spacing) {
  const grid = distances(places, spacing);
  const {vertices, vertexOf} = net(grid);
  const triangles = faces(grid, vertexOf);
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

/** A vertex in each cell whose corners lie on both sides: the mean of where its edges are crossed. */
function net({values, size, low, cell}) {
  const vertexOf = new Int32Array(values.length).fill(-1);
  const vertices = [];
  const [across, up, along] = size;
  const steps = [1, across, across * up];
  for (let z = 0; z + 1 < along; z++) {
    for (let y = 0; y + 1 < up; y++) {
      for (let x = 0; x + 1 < across; x++) {
        const at = x + across * (y + up * z);
        const sum = [0, 0, 0];
        let crossed = 0;
        for (let axis = 0; axis < 3; axis++) {
          for (let corner = 0; corner < 4; corner++) {
            const shift = [0, 0, 0];
            shift[(axis + 1) % 3] = corner & 1;
            shift[(axis + 2) % 3] = corner >> 1;
            const from = at + shift[0] * steps[0] + shift[1] * steps[1] + shift[2] * steps[2];
            const here = values[from];
            const there = values[from + steps[axis]];
            if (here < 0 !== there < 0) {
              shift[axis] = here / (here - there);
              shift.forEach((value, one) => sum[one] += value);
              crossed++;
            }
          }
        }
        if (crossed > 0) {
          vertexOf[at] = vertices.length / 3;
          [x, y, z].forEach((value, axis) => vertices.push(low[axis] + cell * (value + sum[axis] / crossed)));
        }
      }
    }
  }
  return {vertices: Float32Array.from(vertices), vertexOf};
}

/** Two triangles around each edge of the grid that goes through the surface. */
function faces({values, size}, vertexOf) {
  const steps = [1, size[0], size[0] * size[1]];
  const triangles = [];
  for (let at = 0; at < values.length; at++) {
    for (let axis = 0; axis < 3; axis++) {
      const isIn = values[at] < 0;
      if (at + steps[axis] >= values.length || isIn === values[at + steps[axis]] < 0) {
        continue;
      }
      const u = steps[(axis + 1) % 3];
      const v = steps[(axis + 2) % 3];
      const [a, b, c, d] = [vertexOf[at - u - v], vertexOf[at - v], vertexOf[at], vertexOf[at - u]];
      triangles.push(...isIn ? [a, b, c, a, c, d] : [a, c, b, a, d, c]);
    }
  }
  return Uint32Array.from(triangles);
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
