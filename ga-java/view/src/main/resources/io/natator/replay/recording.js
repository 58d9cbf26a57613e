/** Swims that `natator page` packed: expanded, and any time of them as a frame. */

import {MovingTank} from './moving-tank.js';

/** @typedef {{rows: Int32Array[], columns: {low: number, step: number}[], numbers: number}} Table whole numbers, and what they stand for */

/** Expands text (base64 of zlib) to bytes. */
export async function expanded(text) {
  const bytes = Uint8Array.from(atob(text), one => one.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

/**
 * Decodes a table of whole numbers (TimeCode.java).
 *
 * @returns {Int32Array[]} one row for each time
 */
function decodeTable(code, times, numbers, bytes, steady) {
  const mask = bytes === 4 ? -1 : (1 << 8 * bytes) - 1;
  const rows = [];
  for (let time = 0; time < times; time++) {
    const row = new Int32Array(numbers);
    const at = time * numbers * bytes;
    const last = rows[time - 1];
    const before = steady ? rows[time - 2] : undefined;
    for (let i = 0; i < numbers; i++) {
      let folded = 0;
      for (let plane = 0; plane < bytes; plane++) {
        folded |= code[at + plane * numbers + i] << 8 * plane;
      }
      const expected = last === undefined ? 0 : before === undefined ? last[i] : 2 * last[i] - before[i];
      row[i] = expected + (folded >>> 1 ^ -(folded & 1)) & mask;
    }
    rows.push(row);
  }
  return rows;
}

/** A swim: a scene like that of a SCEN message, and frames at any time. */
export class Recording {
  #scalars;
  #columns;
  #positions;
  #density;
  #origins;
  #flow;
  #start = -1;
  /** @type {Water|null} */
  #water = null;
  #work;

  /** Unpacks a swim from the text of the page. */
  static async of(text) {
    const buffer = await expanded(text);
    const length = new DataView(buffer).getUint32(0, true);
    const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
    return new Recording(head, new Uint8Array(buffer, 4 + length));
  }

  constructor(head, bytes) {
    this.title = head.title;
    this.facts = head.facts;
    this.scene = {...head.scene, number: 1, restarted: true, fields: ['position', 'velocity', 'density']};
    this.frames = head.frames;
    this.#columns = head.scalars + head.scene.actuators;
    const scalarBytes = 4 * this.#columns * head.frames;
    this.#scalars = new Float32Array(bytes.slice(0, scalarBytes).buffer);
    const tables = this.#tables(head, bytes, scalarBytes);
    this.#positions = this.#places(tables);
    this.#density = this.#densities(tables.density);
    this.#origins = this.#follow();
    this.#flow = tables.flow === undefined ? null : {...head.flow, ...tables.flow};
    this.#work = this.#emptyFrame();
  }

  /** The time of the last frame, s. */
  get duration() {
    return this.#scalar(this.frames - 1, 0);
  }

  /** Time between two frames, s. */
  get interval() {
    return this.frames > 1 ? this.duration / (this.frames - 1) : 1;
  }

  /** A frame as `decodeFrame` of protocol.js gives it, between the two that are nearest; the same object each time. */
  at(time) {
    const place = Math.min(this.frames - 1, Math.max(0, time / this.interval));
    const first = Math.min(Math.floor(place), Math.max(0, this.frames - 2));
    const second = Math.min(first + 1, this.frames - 1);
    const share = place - first;
    const frame = this.#work;
    const scalar = column => mix(this.#scalar(first, column), this.#scalar(second, column), share);
    frame.frame = Math.round(place);
    frame.time = scalar(0);
    frame.distance = scalar(1);
    for (let axis = 0; axis < 3; axis++) {
      frame.velocity[axis] = scalar(2 + axis);
    }
    frame.momentum = scalar(5);
    frame.angularMomentum = scalar(6);
    frame.densityMean = scalar(7);
    frame.densityMax = scalar(8);
    for (let i = 0; i < frame.activation.length; i++) {
      frame.activation[i] = scalar(9 + i);
    }
    this.#move(frame, this.#positions[first], this.#positions[second], share);
    frame.density.set(this.#density[share < 0.5 ? first : second]);
    frame.origin = this.#origins[share < 0.5 ? first : second];
    return frame;
  }

  /**
   * The water at a time, of the last frame that it is known of; null where it is not in the page. The same object until it is
   * another.
   */
  waterAt(time) {
    const place = Math.min(this.frames - 1, Math.max(0, Math.floor(time / this.interval + 1e-6)));
    const start = this.#flow?.starts.findLast(one => one <= place) ?? -1;
    if (start !== this.#start) {
      this.#start = start;
      this.#water = this.#waterOf(start);
    }
    return this.#water;
  }

  #waterOf(start) {
    const {rows, columns, numbers, cells, cell, corner} = this.#flow;
    const velocity = new Float32Array(3 * numbers);
    columns.forEach(({low, step}, i) => {
      for (let at = 0; at < numbers; at++) {
        velocity[3 * at + 2 * i] = low + rows[start][i * numbers + at] * step;
      }
    });
    return {scene: 1, frame: start, time: this.#scalar(start, 0), cells, cell, corner, velocity,
      density: new Float32Array(numbers).fill(1), origin: this.#origins[start]};
  }

  /** Puts places where they are over ground; gives how far the tank has moved, for each frame. */
  #follow() {
    const tank = new MovingTank();
    tank.setScene(this.scene);
    return this.#positions.map((position, i) => {
      const [time, distance, ...velocity] = [0, 1, 2, 3, 4].map(column => this.#scalar(i, column));
      const frame = {time, distance, velocity, position};
      tank.follow(/** @type {any} */ (frame));
      return /** @type {any} */ (frame).origin;
    });
  }

  #move(frame, from, to, share) {
    const perSecond = 1 / this.interval;
    for (let i = 0; i < from.length; i++) {
      const change = to[i] - from[i];
      frame.position[i] = from[i] + share * change;
      frame.velocities[i] = perSecond * change;
    }
  }

  #scalar(frame, column) {
    return this.#scalars[frame * this.#columns + column];
  }

  #tables(head, bytes, start) {
    const tables = /** @type {Record<'water' | 'others' | 'density' | 'flow', Table>} */ ({});
    let at = start;
    for (const table of head.tables) {
      const numbers = table.numbers * table.columns.length;
      const end = at + head.frames * numbers * table.bytes;
      tables[table.name] = {
        ...table, rows: decodeTable(bytes.subarray(at, end), head.frames, numbers, table.bytes, table.steady),
      };
      at = end;
    }
    return tables;
  }

  /** Places of all particles, x, y, z of each, for each frame. Water that is not in the page is left out of `fluid`. */
  #places({water, others}) {
    const {particles, fluid} = this.scene;
    const first = fluid[0];
    const fluidCount = particles - others.numbers;
    return Array.from({length: this.frames}, (_, time) => {
      const position = new Float32Array(3 * particles);
      spread(water, time, i => first + i, position);
      spread(others, time, i => i < first ? i : i + fluidCount, position);
      return position;
    });
  }

  #densities(table) {
    const [{low, step}] = table.columns;
    return table.rows.map(row => {
      const density = new Float32Array(this.scene.particles);
      row.forEach((whole, i) => {
        density[this.scene.fluid[0] + i] = low + whole * step;
      });
      return density;
    });
  }

  #emptyFrame() {
    const {particles, actuators} = this.scene;
    return {
      scene: 1, frame: 0, dropped: 0, running: true, touching: false, time: 0, wallTime: 0, distance: 0,
      velocity: new Float32Array(3), momentum: 0, angularMomentum: 0, densityMean: 0, densityMax: 0,
      activation: new Float32Array(actuators), position: new Float32Array(3 * particles),
      velocities: new Float32Array(3 * particles), density: new Float32Array(particles), origin: [0, 0, 0],
    };
  }
}

function spread({rows, columns, numbers}, time, particleOf, position) {
  columns.forEach(({low, step}, axis) => {
    for (let i = 0; i < numbers; i++) {
      position[3 * particleOf(i) + axis] = low + rows[time][axis * numbers + i] * step;
    }
  });
}

function mix(from, to, share) {
  return from + share * (to - from);
}
