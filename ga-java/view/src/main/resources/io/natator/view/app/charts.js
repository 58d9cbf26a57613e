/** Line charts on a 2-d canvas. */

import {axis, axisText} from './scaling.js';

const LEFT = 44;
const BOTTOM = 18;
const TOP = 6;
const RIGHT = 8;
/** Seconds that a chart over time shows. */
const WINDOW_S = 10;

/** The colours that the page's style gives to charts. */
export function chartColours(element) {
  const style = getComputedStyle(element);
  const read = name => style.getPropertyValue(name).trim();
  return {
    text: read('--muted'), grid: read('--line'), paper: read('--card'), strong: read('--text'),
    series: [1, 2, 3].map(i => read(`--series-${i}`)), other: read('--series-b'),
  };
}

/** Axes, and lines in the units of the data. */
class Chart {
  #canvas;
  #context;
  #x = {low: 0, high: 1};
  #y = {low: 0, high: 1};

  /** Set it when the theme changes; see `chartColours`. */
  colours;

  constructor(canvas) {
    this.#canvas = canvas;
    this.#context = canvas.getContext('2d');
    this.colours = chartColours(canvas);
  }

  /** Empties the canvas and draws axes over these ranges. */
  begin(x, y) {
    const ratio = Math.min(devicePixelRatio, 2);
    const width = Math.round(this.#canvas.clientWidth * ratio);
    const height = Math.round(this.#canvas.clientHeight * ratio);
    if (this.#canvas.width !== width || this.#canvas.height !== height) {
      this.#canvas.width = width;
      this.#canvas.height = height;
    }
    this.#x = x;
    this.#y = y;
    const context = this.#context;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, this.#canvas.clientWidth, this.#canvas.clientHeight);
    context.lineWidth = 1;
    context.font = '11px system-ui, sans-serif';
    context.fillStyle = this.colours.text;
    context.strokeStyle = this.colours.grid;
    this.#marks();
    context.lineJoin = 'round';
  }

  #marks() {
    const context = this.#context;
    context.beginPath();
    context.textAlign = 'right';
    context.textBaseline = 'middle';
    for (const mark of this.#y.marks) {
      const y = Math.round(this.toY(mark)) + 0.5;
      context.moveTo(LEFT, y);
      context.lineTo(this.#canvas.clientWidth - RIGHT, y);
      context.fillText(axisText(mark, this.#y.step), LEFT - 6, y);
    }
    context.stroke();
    context.textAlign = 'center';
    context.textBaseline = 'top';
    for (const mark of this.#x.marks) {
      if (mark >= this.#x.low - 1e-9 && mark <= this.#x.high + 1e-9) {
        context.fillText(axisText(mark, this.#x.step), this.toX(mark), this.#canvas.clientHeight - BOTTOM + 5);
      }
    }
  }

  /** Where a value lies on the canvas, in CSS pixels. */
  toX(value) {
    const width = this.#canvas.clientWidth - LEFT - RIGHT;
    return LEFT + (value - this.#x.low) / (this.#x.high - this.#x.low) * width;
  }

  toY(value) {
    const height = this.#canvas.clientHeight - TOP - BOTTOM;
    return TOP + (this.#y.high - value) / (this.#y.high - this.#y.low) * height;
  }

  /** The value at a place on the canvas. */
  fromX(pixel) {
    const width = this.#canvas.clientWidth - LEFT - RIGHT;
    return this.#x.low + (pixel - LEFT) / width * (this.#x.high - this.#x.low);
  }

  /** A line through `count` points; `style` has colour, width and dash. */
  line(count, xOf, yOf, style) {
    const context = this.#context;
    context.save();
    context.beginPath();
    context.rect(LEFT, 0, this.#canvas.clientWidth - LEFT - RIGHT + 1, this.#canvas.clientHeight - BOTTOM + 1);
    context.clip();
    context.beginPath();
    context.strokeStyle = style.colour;
    context.lineWidth = style.width ?? 1.5;
    context.setLineDash(style.dash ?? []);
    for (let i = 0; i < count; i++) {
      context.lineTo(this.toX(xOf(i)), this.toY(yOf(i)));
    }
    context.stroke();
    context.restore();
  }

  /** A filled dot. */
  dot(x, y, radius, colour) {
    const context = this.#context;
    context.beginPath();
    context.fillStyle = colour;
    context.arc(this.toX(x), this.toY(y), radius, 0, 2 * Math.PI);
    context.fill();
  }

  /** A line from bottom to top. */
  upright(x, colour) {
    const at = Math.round(this.toX(x)) + 0.5;
    const context = this.#context;
    context.beginPath();
    context.strokeStyle = colour;
    context.moveTo(at, TOP);
    context.lineTo(at, this.#canvas.clientHeight - BOTTOM);
    context.stroke();
  }

  /** A line of text in the middle. */
  note(text) {
    const context = this.#context;
    context.fillStyle = this.colours.text;
    context.textAlign = 'center';
    context.textBaseline = 'middle';
    context.fillText(text, (this.#canvas.clientWidth + LEFT) / 2, (this.#canvas.clientHeight - BOTTOM) / 2);
  }
}

/** Columns of histories over the last seconds. */
export class TimeChart extends Chart {
  #columns;
  #least;

  /** `columns` are names of `History`; the axis goes at least from 0 to `least`. */
  constructor(canvas, columns, least) {
    super(canvas);
    this.#columns = columns;
    this.#least = least;
  }

  /** Draws one history, or two, each in one colour; `until` ends the axis of time, by default where the longest ends. */
  draw(histories, {from = null, until = null, cursor = null} = {}) {
    const filled = histories.filter(history => history.length > 1);
    const end = until ?? Math.max(WINDOW_S, ...filled.map(history => history.last('time')));
    const start = from ?? Math.max(0, end - WINDOW_S);
    const [low, high] = this.#extent(filled, start);
    const marks = axis(start, end, 5);
    this.begin({...marks, low: start, high: end}, axis(low, high, 3));
    histories.forEach((history, which) => this.#columns.forEach((column, i) => this.#series(history, column, start, {
      colour: which === 1 ? this.colours.other : this.colours.series[histories.length === 1 ? i : 0],
      dash: i === 0 ? [] : [4, 3],
      width: i === 0 ? 1.8 : 1.2,
    })));
    if (cursor !== null) {
      this.upright(cursor, this.colours.strong);
    }
  }

  #series(history, column, start, style) {
    const first = firstAfter(history, start);
    const stride = Math.max(1, Math.ceil((history.length - first) / 300));
    const count = Math.ceil((history.length - first) / stride);
    const index = i => Math.min(first + i * stride, history.length - 1);
    this.line(count, i => history.at('time', index(i)), i => history.at(column, index(i)), style);
  }

  #extent(histories, start) {
    let low = 0;
    let high = this.#least;
    for (const history of histories) {
      for (let i = firstAfter(history, start); i < history.length; i += 2) {
        for (const column of this.#columns) {
          const value = history.at(column, i);
          low = value < low ? value : low;
          high = value > high ? value : high;
        }
      }
    }
    return [low, high];
  }
}

function firstAfter(history, start) {
  let first = 0;
  while (first < history.length - 1 && history.at('time', first + 1) < start) {
    first++;
  }
  return first;
}

/** Best and mean fitness over the generations of a run. */
export class FitnessChart extends Chart {
  /** `chosen` and `other` are generations that are marked, or null. */
  draw(generations, bests, chosen, other) {
    const values = generations.flatMap(one => [one.bestEver ?? one.best, one.mean]);
    const first = generations[0]?.generation ?? 0;
    const last = Math.max(generations.at(-1)?.generation ?? 1, 1);
    const x = axis(first, last, Math.min(5, Math.max(last - first, 1)));  // marks at whole generations
    this.begin({...x, high: last}, axis(Math.min(0, ...values), Math.max(1e-4, ...values), 3));
    for (const [generation, colour] of [[other, this.colours.other], [chosen, this.colours.strong]]) {
      if (generation !== null) {
        this.upright(generation, colour);
      }
    }
    const count = generations.length;
    const xOf = i => generations[i].generation;
    this.line(count, xOf, i => generations[i].mean, {colour: this.colours.series[1], width: 1.2, dash: [4, 3]});
    this.line(count, xOf, i => generations[i].best, {colour: this.colours.series[2], width: 1.2});
    this.line(count, xOf, i => generations[i].bestEver, {colour: this.colours.series[0], width: 2});
    for (const best of bests) {
      this.dot(best.generation, best.fitness, best.generation === chosen ? 5 : 2.5, this.colours.series[0]);
    }
  }
}
