/** The gaits of several objectives, two of these at a time, as a Pareto plot. */

import {GaitPlot, draw, short} from './gaitplot.js';
import {byId, fillSelect} from './element.js';
import {axis, axisText} from './scaling.js';

const WIDTH = 320;
const HEIGHT = 250;
const LEFT = 46;  // at least
const BOTTOM = 40;
const TOP = 24;
const RIGHT = 26;  // half of the longest label
const GAP = 5;
const DIGIT = 6.6;  // of a label, and some more than most fonts need

/** To the right the first objective, upwards one of the others. */
export class ParetoPlot extends GaitPlot {
  #svg = byId('front');
  #front = null;
  #onShown;

  /** See `GaitPlot`; `onShown()` is told when another objective is shown. */
  constructor(onWatch, onLook, onShown) {
    super(byId('front'), onWatch, onLook);
    this.#onShown = onShown;
    byId('front-other').addEventListener('change', () => {
      this.#draw(Number(byId('front-other').value));
      this.#onShown();
    });
  }

  /** Shows gaits (FrontResponse.java), or nothing of a run with a single objective. */
  show(front) {
    byId('front-figure').hidden = front === null;
    this.#front = front;
    if (front === null) {
      this.fill([], []);
      return;
    }
    fillSelect(byId('front-other'), front.goals.slice(1).map((goal, i) => [i + 1, goal.name]));
    byId('front-choice').hidden = front.goals.length < 3;
    this.#draw(1);
  }

  #draw(other) {
    const {goals, points} = this.#front;
    const shown = [0, other];
    const [x, y] = shown.map(which => axisOf(points.map(point => point.values[which])));
    const labels = y.marks.map(mark => axisText(mark, y.step));
    const left = Math.max(LEFT, GAP + DIGIT * Math.max(...labels.map(label => label.length)));
    const right = value => left + (value - x.low) / (x.high - x.low) * (WIDTH - left - RIGHT);
    const up = value => HEIGHT - BOTTOM - (value - y.low) / (y.high - y.low) * (HEIGHT - TOP - BOTTOM);
    const place = point => [right(point.values[0]), up(point.values[other])];
    const items = points.map(point => {
      const [cx, cy] = place(point);
      const kind = point.isBest ? 'best' : 'rest';
      return {x: cx, y: cy, gait: point.gait, overrides: point.overrides,
        element: draw('circle', {cx, cy, r: point.isBest ? 4.5 : 2.5, class: kind}),
        label: `${point.isBest ? 'front' : 'gait'} of ${goals[0].name} ${short(point.values[0])}`,
        text: `${goals.map((goal, i) => `${goal.name} ${short(point.values[i])}`).join(', ')}`
            + ` (${point.isBest ? 'no other is better in all' : 'another is better'}; ${point.runs === 1 ? 'one run' : `${point.runs} runs`})`};
    });
    const front = points.filter(point => point.isBest).map(place).sort((a, b) => a[0] - b[0]);
    this.#svg.setAttribute('viewBox', `0 0 ${WIDTH} ${HEIGHT}`);
    this.fill([
      draw('rect', {class: 'paper', x: left, y: TOP, width: WIDTH - left - RIGHT, height: HEIGHT - TOP - BOTTOM}),
      ...x.marks.map(mark => draw('text', {x: right(mark), y: HEIGHT - BOTTOM + 18, 'text-anchor': 'middle'}, axisText(mark, x.step))),
      ...y.marks.map((mark, i) => draw('text', {x: left - GAP, y: up(mark) + 4, 'text-anchor': 'end'}, labels[i])),
      ...y.marks.map(mark => draw('path', {class: 'grid', d: `M${left} ${up(mark)}H${WIDTH - RIGHT}`})),
      ...goals.length === 2 ? [draw('path', {class: 'front', d: `M${front.map(at => at.join(' ')).join('L')}`})] : [],
      draw('text', {x: (left + WIDTH - RIGHT) / 2, y: HEIGHT - 5, 'text-anchor': 'middle', class: 'axis'}, title(goals[0])),
      draw('text', {x: 2, y: 11, class: 'axis'}, title(goals[other])),
    ], items);
  }
}

function axisOf(values) {
  return axis(Math.min(...values), Math.max(...values), 4);
}

/** What an axis shows, and which way is better. */
function title(goal) {
  return `${goal.name}, ${goal.unit} (${goal.isLess ? 'less' : 'more'} is better)`;
}
