/** A surface between the nodes of a grid. */

/**
 * Where values change their sign, by naive surface nets (Gibson 1998): a vertex in each cell that the surface goes through.
 *
 * @param {object} grid `values` of its nodes, x varies fastest, negative inside and above 0 at the grid's ends; `size`: nodes
 *     along x, y, z; `low`: place of the first; `cell`: distance of neighbours
 * @returns {{vertices: Float32Array, triangles: Uint32Array}} three numbers for each vertex; three vertices for each
 *     triangle, counter-clockwise as seen from outside
 */
export function surfaceNet(grid) {
  const {vertices, vertexOf} = net(grid);
  return {vertices, triangles: faces(grid, vertexOf)};
}

/** A vertex in each cell whose corners lie on both sides: the mean of where its edges are crossed. */
function net({values, size, low, cell}) {
  const vertexOf = new Int32Array(values.length).fill(-1);
  const vertices = [];
  const [across, up, along] = size;
  const steps = [1, across, across * up];
  const corners = Array.from({length: 8}, (_, i) => (i & 1) * steps[0] + (i >> 1 & 1) * steps[1] + (i >> 2) * steps[2]);
  for (let z = 0; z + 1 < along; z++) {
    for (let y = 0; y + 1 < up; y++) {
      for (let x = 0; x + 1 < across; x++) {
        const at = x + across * (y + up * z);
        let inside = 0;
        for (let i = 0; i < 8; i++) {
          inside += values[at + corners[i]] < 0 ? 1 : 0;
        }
        if (inside > 0 && inside < 8) {
          vertexOf[at] = vertices.length / 3;
          const middle = crossing(values, at, steps);
          [x, y, z].forEach((value, axis) => vertices.push(low[axis] + cell * (value + middle[axis])));
        }
      }
    }
  }
  return {vertices: Float32Array.from(vertices), vertexOf};
}

/** The mean of where the edges of a cell are crossed, in cells from its lowest corner. */
function crossing(values, at, steps) {
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
  return sum.map(value => value / crossed);
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

/**
 * A surface without those of its parts that have fewer than this share of the vertices of the largest.
 *
 * @param {{vertices: Float32Array, triangles: Uint32Array}} surface see `surfaceNet`
 * @param {number} least 0 to 1
 * @returns {{vertices: Float32Array, triangles: Uint32Array}}
 */
export function largeParts({vertices, triangles}, least) {
  const first = Uint32Array.from({length: vertices.length / 3}, (_, i) => i);
  const partOf = vertex => {
    let at = vertex;
    while (first[at] !== at) {
      first[at] = first[first[at]];
      at = first[at];
    }
    return at;
  };
  for (let i = 0; i < triangles.length; i += 3) {
    const part = partOf(triangles[i]);
    first[partOf(triangles[i + 1])] = part;
    first[partOf(triangles[i + 2])] = part;
  }
  const sizes = new Uint32Array(first.length);
  for (let i = 0; i < first.length; i++) {
    sizes[partOf(i)]++;
  }
  const enough = least * sizes.reduce((most, size) => Math.max(most, size), 0);
  const kept = [...first.keys()].filter(i => sizes[partOf(i)] >= enough);
  const now = new Uint32Array(first.length);
  kept.forEach((vertex, i) => now[vertex] = i);
  return {
    vertices: Float32Array.from({length: 3 * kept.length}, (_, i) => vertices[3 * kept[Math.floor(i / 3)] + i % 3]),
    triangles: triangles.filter((_, i) => sizes[partOf(triangles[i - i % 3])] >= enough).map(vertex => now[vertex]),
  };
}

/**
 * Directions outwards at the vertices of a surface, of length 1.
 *
 * @param {{vertices: Float32Array, triangles: Uint32Array}} surface see `surfaceNet`
 * @returns {Float32Array} three numbers for each vertex
 */
export function normalsOf({vertices, triangles}) {
  const normals = new Float32Array(vertices.length);
  const [u, v] = [[0, 0, 0], [0, 0, 0]];
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [3 * triangles[i], 3 * triangles[i + 1], 3 * triangles[i + 2]];
    for (let axis = 0; axis < 3; axis++) {
      u[axis] = vertices[b + axis] - vertices[a + axis];
      v[axis] = vertices[c + axis] - vertices[a + axis];
    }
    for (let axis = 0; axis < 3; axis++) {
      const [p, q] = [(axis + 1) % 3, (axis + 2) % 3];
      const part = u[p] * v[q] - u[q] * v[p];
      normals[a + axis] += part;
      normals[b + axis] += part;
      normals[c + axis] += part;
    }
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let axis = 0; axis < 3; axis++) {
      normals[i + axis] /= length;
    }
  }
  return normals;
}
