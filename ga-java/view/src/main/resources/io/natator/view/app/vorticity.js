/** How water on a grid (`Water`) turns. */

/** Less than this share of the rest density: a cell at a surface, or in a body. Nothing is derived from its velocity. */
const LEAST_DENSITY = 0.5;

/**
 * Writes the central difference of the velocity along an axis into `out`, one-sided at the grid's ends; 0 where there is one
 * cell only, or not water on both sides.
 *
 * @param {Water} water
 * @param {number} at index of the cell
 * @param {number} place of it along the axis, of `count` cells, `step` indices apart
 */
function derive({velocity, density, cell}, at, place, count, step, out) {
  const before = place > 0 ? at - step : at;
  const after = place + 1 < count ? at + step : at;
  const share = before === after || density[before] < LEAST_DENSITY || density[after] < LEAST_DENSITY
      ? 0 : step / ((after - before) * cell);
  for (let i = 0; i < 3; i++) {
    out[i] = share * (velocity[3 * after + i] - velocity[3 * before + i]);
  }
}

/**
 * Vorticity about the vertical at a height, 1/s: ∂u/∂z − ∂w/∂x, above 0 anticlockwise as seen from above.
 *
 * @param {Water} water
 * @param {number} height in its grid's coordinates, length; between layers of cells it is interpolated
 * @returns {Float32Array} X × Z numbers, x varies fastest
 */
export function vorticityAt(water, height) {
  const {cells: [across, up, along], cell, corner} = water;
  const layer = Math.min(up - 1, Math.max(0, (height - corner[1]) / cell - 0.5));
  const low = Math.floor(layer);
  const turns = new Float32Array(across * along);
  const [alongX, alongZ] = [new Float32Array(3), new Float32Array(3)];
  for (let y = low; y <= Math.ceil(layer); y++) {
    const share = 1 - Math.abs(layer - y);
    for (let z = 0, to = 0; z < along; z++) {
      for (let x = 0; x < across; x++, to++) {
        const at = x + across * (y + up * z);
        derive(water, at, x, across, 1, alongX);
        derive(water, at, z, along, across * up, alongZ);
        turns[to] += share * (alongZ[0] - alongX[2]);
      }
    }
  }
  return turns;
}

/**
 * Vortices in space: Q = (|Ω|² − |S|²) / 2, above 0 where water turns more than it strains (Hunt, Wray, Moin 1988), and the
 * vorticity about the vertical.
 *
 * @param {Water} water
 * @returns {{q: Float32Array, turns: Float32Array}} 1/s² and 1/s of each cell
 */
export function vorticesOf(water) {
  const {cells: [across, up, along]} = water;
  const q = new Float32Array(across * up * along);
  const turns = new Float32Array(q.length);
  const [byX, byY, byZ] = [0, 1, 2].map(() => new Float32Array(3));
  for (let z = 0, at = 0; z < along; z++) {
    for (let y = 0; y < up; y++) {
      for (let x = 0; x < across; x++, at++) {
        derive(water, at, x, across, 1, byX);
        derive(water, at, y, up, across, byY);
        derive(water, at, z, along, across * up, byZ);
        q[at] = -0.5 * (byX[0] * byX[0] + byY[1] * byY[1] + byZ[2] * byZ[2])
            - byX[1] * byY[0] - byX[2] * byZ[0] - byY[2] * byZ[1];
        turns[at] = byZ[0] - byX[2];
      }
    }
  }
  return {q, turns};
}

/**
 * The value that so large a share of the numbers are below.
 *
 * @param {Float32Array} numbers
 * @param {number} share 0 to 1
 * @param {(number: number) => number} of what counts of a number
 */
export function quantile(numbers, share, of = one => one) {
  const taken = Math.min(numbers.length, 4000);
  const sample = Float32Array.from({length: taken}, (_, i) => of(numbers[Math.floor(i * numbers.length / taken)])).sort();
  return sample[Math.floor(share * (taken - 1))] ?? 0;
}

/**
 * Writes the velocity of the water at a place into `out`, which is returned: interpolated between the middles of cells; 0 beyond the grid.
 *
 * @param {Water} water
 * @param {number[]} place in its grid's coordinates, length
 * @param {boolean[]} wraps along which axes the grid closes up with itself
 */
export function velocityAt({cells, cell, corner, velocity}, place, wraps, out) {
  out.fill(0);
  const [low, share] = [[0, 0, 0], [0, 0, 0]];
  for (let axis = 0; axis < 3; axis++) {
    const at = (place[axis] - corner[axis]) / cell;
    if (!wraps[axis] && cells[axis] > 1 && (at < 0 || at > cells[axis])) {
      return out;
    }
    low[axis] = Math.floor(at - 0.5);
    share[axis] = at - 0.5 - low[axis];
  }
  for (let corner_ = 0; corner_ < 8; corner_++) {
    let weight = 1;
    let index = 0;
    for (let axis = 2; axis >= 0; axis--) {
      const side = corner_ >> axis & 1;
      weight *= side === 1 ? share[axis] : 1 - share[axis];
      const to = low[axis] + side;
      const count = cells[axis];
      index = index * count + (wraps[axis] ? (to % count + count) % count : Math.min(count - 1, Math.max(0, to)));
    }
    for (let i = 0; i < 3; i++) {
      out[i] += weight * velocity[3 * index + i];
    }
  }
  return out;
}
