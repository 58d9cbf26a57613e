/**
 * What each particle of water contributes to a surface: none inside the water, a ball at a wall, and at the free surface an
 * ellipsoid that is flat across it (Yu and Turk: Reconstructing Surfaces of Particle-Based Fluids Using Anisotropic
 * Kernels, 2013), moved towards the mean of its neighbours. Spray is small balls.
 */

import {SHAPE_NUMBERS} from './water-numbers.js';
import {Waterline} from './waterline.js';

/** Radius of a ball, in spacings of particles. */
const RADIUS = 0.95;
const SPRAY_RADIUS = 0.36;
/** Neighbours are nearer than this, in spacings. */
const SUPPORT = 1.9;
/** A particle with fewer neighbours is spray; from the second number on it is all ellipsoid. */
const SPRAY_NEIGHBOURS = 3;
const ENOUGH_NEIGHBOURS = 9;
/** How far a centre goes to the mean of its neighbours: lambda of Yu and Turk. */
const TO_MEAN = 0.9;
/** Share of the ball that stays in each ellipsoid, so that none gets too flat. */
const LEAST_ROUND = 0.15;
/** Width of the cells by which the inside of the water is told, in spacings. */
const CELL = 1.25;
const MOST_CELLS = 2e6;
/** Fewer empty cells than this, of the 26 around one, are chance. */
const FEW_EMPTY = 5;
/** Foam begins where water is sheared by this share of sqrt(gravity * spacing), and is full at the second. */
const FOAM_FROM = 0.55;
const FOAM_FULL = 1.6;

/** Finds the shapes of one frame; keeps its arrays from frame to frame. */
export class WaterShapes {
  #spacing = 1;
  #foamSpeed = Infinity;
  #cell = 1;
  #low = [0, 0, 0];
  #cells = [1, 1, 1];
  #total = 1;
  #sums = new Float64Array(11);
  #end = new Uint32Array(1);
  #sorted = new Uint32Array(0);
  #cellOf = new Int32Array(0);
  #places = new Float32Array(0);
  #line = new Waterline();

  /** `SHAPE_NUMBERS` for each shape: its surface is where (x - centre)^T S^-1 (x - centre) = 1 with its matrix S. */
  numbers = new Float32Array(0);
  /** Whether the free surface is made of balls too, which takes less time. */
  isPlain = false;
  /** How many shapes there are. */
  count = 0;

  /**
   * Takes over what is known of a scene (SCEN).
   *
   * @param {Scene} scene
   */
  setScene(scene) {
    this.#spacing = scene.fluidRestDistance;
    const gravity = Math.hypot(...scene.definition?.solver?.gravity ?? [0, 0, 0]);
    this.#foamSpeed = gravity > 0 ? Math.sqrt(gravity * this.#spacing) : Infinity;
  }

  /**
   * Finds the shapes of the chosen particles.
   *
   * @param {Float32Array} position three numbers per particle, length
   * @param {Float32Array|null} velocity likewise, length/s; without it nothing foams
   * @param {number} first the first particle of water
   * @param {Uint32Array} chosen particles, counted from `first`
   * @param {number} count how many of `chosen` hold
   * @param {Float32Array} values one for each particle of water
   * @param {{min: number[], max: number[]}} walls neighbours that are missing beyond these make no free surface
   */
  update(position, velocity, first, chosen, count, values, walls) {
    const most = count + Waterline.most(walls, this.#spacing);
    if (this.numbers.length < SHAPE_NUMBERS * most) {
      this.numbers = new Float32Array(SHAPE_NUMBERS * most);
      this.#sorted = new Uint32Array(count);
      this.#cellOf = new Int32Array(count);
      this.#places = new Float32Array(3 * count);
    }
    this.count = 0;
    if (count === 0) {
      return;
    }
    this.#sort(position, first, chosen, count);
    for (let i = 0; i < count; i++) {
      const particle = first + chosen[i];
      const side = this.#side(position, particle, this.#cellOf[i], walls.min, walls.max);
      if (side > 0) {
        const at = SHAPE_NUMBERS * this.count++;
        if (side === 2 && !this.isPlain) {
          this.#ellipsoid(position, velocity, particle, this.#cellOf[i], at, walls.min, walls.max);
        } else {
          this.#ball(position, particle, at, RADIUS * this.#spacing);
          this.numbers[at + 11] = side - 1;
        }
        this.numbers[at + 3] = values[chosen[i]];
      }
    }
    this.count = this.#line.add(this.numbers, this.count, walls, this.#spacing);
  }

  /** Sorts particles by cell: those of cell c are `#sorted` from `#end[c - 1]` to before `#end[c]`. */
  #sort(position, first, chosen, count) {
    const low = this.#low.fill(Infinity);
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < count; i++) {
      for (let axis = 0, k = 3 * (first + chosen[i]); axis < 3; axis++, k++) {
        low[axis] = Math.min(low[axis], position[k]);
        high[axis] = Math.max(high[axis], position[k]);
      }
    }
    const cells = this.#chooseCells(high);
    const [across, up] = this.#cells;
    if (this.#end.length < cells) {
      this.#end = new Uint32Array(cells);
    }
    const end = this.#end.fill(0, 0, cells);
    for (let i = 0; i < count; i++) {
      const k = 3 * (first + chosen[i]);
      const x = Math.floor((position[k] - low[0]) / this.#cell) + 1;
      const y = Math.floor((position[k + 1] - low[1]) / this.#cell) + 1;
      const z = Math.floor((position[k + 2] - low[2]) / this.#cell) + 1;
      this.#cellOf[i] = x + across * (y + up * z);
      end[this.#cellOf[i]]++;
    }
    for (let cell = 0, sum = 0; cell < cells; cell++) {
      const here = end[cell];
      end[cell] = sum;
      sum += here;
    }
    for (let i = 0; i < count; i++) {
      const to = end[this.#cellOf[i]]++;
      this.#sorted[to] = first + chosen[i];
      for (let axis = 0, k = 3 * (first + chosen[i]); axis < 3; axis++, k++) {
        this.#places[3 * to + axis] = position[k];
      }
    }
  }

  /** Sets width and number of the cells: a layer of empty ones is all around. A particle far off makes them wider. */
  #chooseCells(high) {
    this.#cell = CELL * this.#spacing / 2;
    do {
      this.#cell *= 2;
      this.#cells = high.map((value, axis) => Math.floor((value - this.#low[axis]) / this.#cell) + 3);
      this.#total = this.#cells[0] * this.#cells[1] * this.#cells[2];
    } while (this.#total > MOST_CELLS);
    return this.#total;
  }

  /** 0 inside the water, 1 at a wall, 2 at the free surface: by how many of the cells around are empty. */
  #side(position, particle, cell, min, max) {
    const [across, up] = this.#cells;
    const end = this.#end;
    const k = 3 * particle;
    const reach = 0.8 * this.#cell;
    let open = 0;
    let closed = 0;
    for (let z = -1; z <= 1; z++) {
      for (let y = -1; y <= 1; y++) {
        for (let x = -1; x <= 1; x++) {
          const other = cell + x + across * (y + up * z);
          if (end[other] === end[other - 1]) {
            const isWall = isBeyond(position[k] + x * reach, min[0], max[0])
                || isBeyond(position[k + 1] + y * reach, min[1], max[1])
                || isBeyond(position[k + 2] + z * reach, min[2], max[2]);
            open += isWall ? 0 : 1;
            closed += isWall ? 1 : 0;
          }
        }
      }
    }
    if (open + closed < FEW_EMPTY) {
      return 0;
    }
    // A ball just below the surface would show above it.
    const above = cell + 2 * across;
    const isBelow = above < this.#total && end[above] === end[above - 1] && position[k + 1] + 2 * reach < max[1];
    return open >= FEW_EMPTY || isBelow ? 2 : 1;
  }

  #ball(position, particle, at, radius) {
    const numbers = this.numbers;
    numbers.fill(0, at, at + SHAPE_NUMBERS);
    for (let axis = 0; axis < 3; axis++) {
      numbers[at + axis] = position[3 * particle + axis];
      numbers[at + 4 + axis] = radius * radius;
    }
  }

  #ellipsoid(position, velocity, particle, cell, at, min, max) {
    const reach = SUPPORT * this.#spacing;
    const [across, up] = this.#cells;
    const sums = this.#sums.fill(0);
    const px = position[3 * particle];
    const py = position[3 * particle + 1];
    const pz = position[3 * particle + 2];
    // Behind a wall that is near, water goes on as in a mirror: else surfaces would sink and bend there.
    const wallX = nearer(px, min[0], max[0]);
    const wallY = nearer(py, min[1], max[1]);
    const wallZ = nearer(pz, min[2], max[2]);
    const hasX = Math.abs(wallX) < reach;
    const hasY = Math.abs(wallY) < reach;
    const hasZ = Math.abs(wallZ) < reach;
    const hasWall = hasX || hasY || hasZ;
    const places = this.#places;
    const end = this.#end;
    const perReach = 1 / reach;
    let shear = 0;
    let neighbours = 0;
    let weights = 0;
    let sx = 0;
    let sy = 0;
    let sz = 0;
    let xx = 0;
    let yy = 0;
    let zz = 0;
    let xy = 0;
    let xz = 0;
    let yz = 0;
    for (let z = -2; z <= 2; z++) {
      for (let y = -2; y <= 2; y++) {
        // The cells of a row lie behind each other, and so do their particles.
        const row = cell + across * (y + up * z);
        const last = row + 2 < this.#total ? row + 2 : this.#total - 1;
        if (row < 3 || last < row || y * y + z * z === 8) {
          continue;
        }
        for (let i = end[row - 3], until = end[last]; i < until; i++) {
          const dx = places[3 * i] - px;
          const dy = places[3 * i + 1] - py;
          const dz = places[3 * i + 2] - pz;
          const square = dx * dx + dy * dy + dz * dz;
          if (square < reach * reach) {
            const share = Math.sqrt(square) * perReach;
            const weight = 1 - share * share * share;
            const wx = weight * dx;
            const wy = weight * dy;
            neighbours++;
            weights += weight;
            sx += wx;
            sy += wy;
            sz += weight * dz;
            xx += wx * dx;
            yy += wy * dy;
            zz += weight * dz * dz;
            xy += wx * dy;
            xz += wx * dz;
            yz += wy * dz;
            if (velocity !== null) {
              const k = 3 * this.#sorted[i];
              const vx = velocity[k] - velocity[3 * particle];
              const vy = velocity[k + 1] - velocity[3 * particle + 1];
              const vz = velocity[k + 2] - velocity[3 * particle + 2];
              shear += weight * Math.sqrt(vx * vx + vy * vy + vz * vz);
            }
          }
          if (hasWall) {
            if (hasX) {
              add(sums, 2 * wallX - dx, dy, dz, reach);
            }
            if (hasY) {
              add(sums, dx, 2 * wallY - dy, dz, reach);
            }
            if (hasZ) {
              add(sums, dx, dy, 2 * wallZ - dz, reach);
            }
            if (hasX && hasZ) {
              add(sums, 2 * wallX - dx, dy, 2 * wallZ - dz, reach);
            }
          }
        }
      }
    }
    shear /= weights;
    neighbours += sums[0];
    weights += sums[1];
    // How much of a particle of the water it is, and not of spray.
    const whole = Math.min(1, Math.max(0, (neighbours - SPRAY_NEIGHBOURS) / (ENOUGH_NEIGHBOURS - SPRAY_NEIGHBOURS)));
    const radius = this.#spacing * (SPRAY_RADIUS + (RADIUS - SPRAY_RADIUS) * whole);
    this.#ball(position, particle, at, radius);
    const numbers = this.numbers;
    const foam = (shear / this.#foamSpeed - FOAM_FROM) / (FOAM_FULL - FOAM_FROM);
    numbers[at + 7] = velocity === null ? 0 : Math.min(1, Math.max(0, foam));
    if (whole === 0) {
      return;
    }
    sx = (sx + sums[2]) / weights;
    sy = (sy + sums[3]) / weights;
    sz = (sz + sums[4]) / weights;
    numbers[at] += TO_MEAN * whole * sx;
    numbers[at + 1] += TO_MEAN * whole * sy;
    numbers[at + 2] += TO_MEAN * whole * sz;
    xx = (xx + sums[5]) / weights - sx * sx;
    yy = (yy + sums[6]) / weights - sy * sy;
    zz = (zz + sums[7]) / weights - sz * sz;
    xy = (xy + sums[8]) / weights - sx * sy;
    xz = (xz + sums[9]) / weights - sx * sz;
    yz = (yz + sums[10]) / weights - sy * sz;
    // Half axes go with the eigenvalues of the covariance, as there: the matrix of the surface is its square.
    const scale = whole * (1 - LEAST_ROUND) * 3 * radius / (xx + yy + zz);
    const round = radius * (1 - whole * (1 - LEAST_ROUND));
    const a = scale * xx + round;
    const b = scale * yy + round;
    const c = scale * zz + round;
    const d = scale * xy;
    const e = scale * xz;
    const f = scale * yz;
    numbers[at + 11] = whole === 1 ? 1 : 0;
    numbers[at + 4] = a * a + d * d + e * e;
    numbers[at + 5] = b * b + d * d + f * f;
    numbers[at + 6] = c * c + e * e + f * f;
    numbers[at + 8] = a * d + d * b + e * f;
    numbers[at + 9] = a * e + d * f + e * c;
    numbers[at + 10] = d * e + b * f + f * c;
  }
}

/** Adds a mirrored neighbour at this distance to number, weights, and the first and second moments. */
function add(sums, dx, dy, dz, reach) {
  const square = dx * dx + dy * dy + dz * dz;
  if (square < reach * reach) {
    const share = Math.sqrt(square) / reach;
    const weight = 1 - share * share * share;
    sums[0]++;
    sums[1] += weight;
    sums[2] += weight * dx;
    sums[3] += weight * dy;
    sums[4] += weight * dz;
    sums[5] += weight * dx * dx;
    sums[6] += weight * dy * dy;
    sums[7] += weight * dz * dz;
    sums[8] += weight * dx * dy;
    sums[9] += weight * dx * dz;
    sums[10] += weight * dy * dz;
  }
}

/** The way from a place to the nearer of two. */
function nearer(place, low, high) {
  return place - low < high - place ? low - place : high - place;
}

function isBeyond(place, low, high) {
  return place < low || place > high;
}
