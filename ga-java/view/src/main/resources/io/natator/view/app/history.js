/** What the charts show: the last numbers of a motion. */

/** What is kept of each frame. */
const COLUMNS = ['time', 'distance', 'speed', 'beatSpeed', 'momentum', 'angularMomentum', 'densityMean',
  'densityMax'];
const CAPACITY = 1500;

/** A ring of numbers for each column; a jump back in time begins anew. */
export class History {
  #columns = Object.fromEntries(COLUMNS.map(name => [name, new Float64Array(CAPACITY)]));
  #first = 0;
  #count = 0;

  get length() {
    return this.#count;
  }

  clear() {
    this.#first = 0;
    this.#count = 0;
  }

  /** A number by its age: 0 is the oldest kept. */
  at(column, index) {
    return this.#columns[column][(this.#first + index) % CAPACITY];
  }

  /** The newest number of a column; NaN without any. */
  last(column) {
    return this.#count === 0 ? NaN : this.at(column, this.#count - 1);
  }

  /**
   * Adds a frame.
   *
   * @param {number} bodyLength in length units; speeds are kept in body lengths per second
   * @param {number} frequency of the beat, over one of which the mean speed is taken; 0 for none
   */
  add(frame, bodyLength, frequency) {
    if (this.#count > 0 && frame.time < this.last('time')) {
      this.clear();
    }
    if (this.#count > 0 && frame.time === this.last('time')) {
      return;
    }
    const slot = (this.#first + this.#count) % CAPACITY;
    if (this.#count === CAPACITY) {
      this.#first = (this.#first + 1) % CAPACITY;
    } else {
      this.#count++;
    }
    const length = bodyLength > 0 ? bodyLength : 1;
    const columns = this.#columns;
    columns.time[slot] = frame.time;
    columns.distance[slot] = frame.distance;
    columns.speed[slot] = frame.velocity[0] / length;
    columns.momentum[slot] = frame.momentum;
    columns.angularMomentum[slot] = frame.angularMomentum;
    columns.densityMean[slot] = 100 * frame.densityMean;
    columns.densityMax[slot] = 100 * frame.densityMax;
    columns.beatSpeed[slot] = this.#beatSpeed(frequency) / length;
  }

  /** Mean speed over the last beat, or over what there is of it. */
  #beatSpeed(frequency) {
    const now = this.last('time');
    const from = frequency > 0 ? now - 1 / frequency : now - 1;
    let index = this.#count - 1;
    while (index > 0 && this.at('time', index) > from + 1e-9) {
      index--;
    }
    const seconds = now - this.at('time', index);
    return seconds > 0 ? (this.last('distance') - this.at('distance', index)) / seconds : 0;
  }
}
