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

/** What can be read off the cells of a plane: functions of the water, an axis and its plane's, that give one of a cell and its place. */
/** @type {Record<string, (water: Water, axis: number) => (at: number, place: number[]) => number>} */
const ON_PLANE = {
  /** About the axis, 1/s, above 0 anticlockwise as seen from where it points: of y ∂u/∂z − ∂w/∂x. */
  vorticity: (water, axis) => {
    const [b, c] = [(axis + 1) % 3, (axis + 2) % 3];
    const [alongB, alongC] = [new Float32Array(3), new Float32Array(3)];
    const {cells} = water;
    const steps = [1, cells[0], cells[0] * cells[1]];
    return (at, place) => {
      derive(water, at, place[b], cells[b], steps[b], alongB);
      derive(water, at, place[c], cells[c], steps[c], alongC);
      return alongB[c] - alongC[b];
    };
  },
  velocity: ({velocity}) => at => Math.hypot(velocity[3 * at], velocity[3 * at + 1], velocity[3 * at + 2]),
  pressure: water => {
    const pressure = excessPressure(water);
    return at => pressure[at];
  },
};

/**
 * What water is like on a plane across an axis.
 *
 * @param {Water} water
 * @param {'vorticity'|'velocity'|'pressure'} what about the axis, 1/s; speed, length/s; see `excessPressure`
 * @param {number} axis 0, 1, 2
 * @param {number} height along it in the grid's coordinates, length; between layers of cells it is interpolated
 * @returns {Float32Array} a number for each cell of the plane; of its axes the lower varies fastest
 */
export function planeOf(water, what, axis, height) {
  const {cells, cell, corner} = water;
  const [first, second] = [0, 1, 2].filter(one => one !== axis);
  const steps = [1, cells[0], cells[0] * cells[1]];
  const layer = Math.min(cells[axis] - 1, Math.max(0, (height - corner[axis]) / cell - 0.5));
  const values = new Float32Array(cells[first] * cells[second]);
  const read = ON_PLANE[what](water, axis);
  const place = [0, 0, 0];
  for (place[axis] = Math.floor(layer); place[axis] <= Math.ceil(layer); place[axis]++) {
    const share = 1 - Math.abs(layer - place[axis]);
    let to = 0;
    for (place[second] = 0; place[second] < cells[second]; place[second]++) {
      for (place[first] = 0; place[first] < cells[first]; place[first]++, to++) {
        values[to] += share * read(place[0] + place[1] * steps[1] + place[2] * steps[2], place);
      }
    }
  }
  return values;
}

/**
 * Pressure less the mean of the water at the same height, mass/(length s²): without what gravity adds; 0 where it is not known.
 *
 * @param {Water} water
 * @returns {Float32Array} a number for each cell
 */
export function excessPressure({pressure, density, cells: [across, up]}) {
  const isKnown = at => density[at] >= LEAST_DENSITY && !Number.isNaN(pressure[at]);
  const height = at => Math.floor(at / across) % up;
  const [sum, count] = [new Float64Array(up), new Float64Array(up)];
  pressure.forEach((value, at) => {
    if (isKnown(at)) {
      sum[height(at)] += value;
      count[height(at)]++;
    }
  });
  return pressure.map((value, at) => isKnown(at) ? value - sum[height(at)] / count[height(at)] : 0);
}

/**
 * The same water with each velocity a mean over its neighbours, by 1, 2, 1 along each axis: what changes from cell to cell is gone.
 *
 * @param {Water} water
 * @returns {Water}
 */
export function smoothed(water) {
  const {cells, density} = water;
  let from = water.velocity;
  [1, cells[0], cells[0] * cells[1]].forEach((step, axis) => {
    const to = new Float32Array(from.length);
    for (let at = 0; at < density.length; at++) {
      const place = Math.floor(at / step) % cells[axis];
      let all = 0;
      for (const [side, share] of [[-1, 1], [0, 2], [1, 1]]) {
        const next = at + side * step;
        if (place + side >= 0 && place + side < cells[axis] && (side === 0 || density[next] >= LEAST_DENSITY)) {
          all += share;
          for (let i = 0; i < 3; i++) {
            to[3 * at + i] += share * from[3 * next + i];
          }
        }
      }
      for (let i = 0; i < 3; i++) {
        to[3 * at + i] /= all;
      }
    }
    from = to;
  });
  return {...water, velocity: from};
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
export function velocityAt(water, place, wraps, out) {
  return valueAt(water, water.velocity, place, wraps, out);
}

/** The same of other numbers of its cells, as many for each as `out` has. */
export function valueAt({cells, cell, corner}, values, place, wraps, out) {
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
    for (let i = 0; i < out.length; i++) {
      out[i] += weight * values[out.length * index + i];
    }
  }
  return out;
}
