/** The best gait of every kind, as a heat map. */

import {SCALES, colourAt, cssGradient} from './colours.js';
import {GaitPlot, draw, short} from './gaitplot.js';
import {byId} from './element.js';

const WIDTH = 320;
const LEFT = 48;
const BOTTOM = 40;
const TOP = 24;
const RIGHT = 10;
const MOST_HEIGHT = 230;
const MOST_ROW = 24;
const MOST_COLUMN = 48;
/** So many labels fit along the columns. */
const MOST_LABELS = 7;

/** Columns by beats for a body length, rows by cost of transport, colours by worth. */
export class EliteMap extends GaitPlot {
  #svg = byId('elites');

  /** See `GaitPlot`. */
  constructor(onWatch, onLook) {
    super(byId('elites'), onWatch, onLook);
  }

  /** Shows a map (MapResponse.java), or nothing of a run that has none. */
  show(map) {
    byId('elites-figure').hidden = map === null;
    if (map === null) {
      this.fill([], []);
      return;
    }
    const columns = map.beats.length - 1;
    const rows = map.costs.length - 1;
    const width = Math.min(MOST_COLUMN, (WIDTH - LEFT - RIGHT) / columns);
    const height = Math.min(MOST_ROW, MOST_HEIGHT / rows);
    const bottom = TOP + rows * height;
    this.#svg.setAttribute('viewBox', `0 0 ${WIDTH} ${bottom + BOTTOM}`);
    const worths = map.elites.map(elite => elite.worth);
    const most = Math.max(...worths);
    const least = most > 0 ? Math.max(0, Math.min(...worths)) : Math.min(...worths);
    const colour = worth => colourAt(SCALES.sequential, most > least ? (worth - least) / (most - least) : 1)
        .map(one => Math.round(255 * one)).join(' ');
    const items = map.elites.map(elite => {
      const x = LEFT + elite.column * width;
      const y = bottom - (elite.row + 1) * height;
      const element = draw('rect', {x, y, width, height, 'data-testid': `elite-${elite.column}-${elite.row}`});
      const isPoor = most > 0 && elite.worth <= 0;
      element.setAttribute('class', isPoor ? 'poor' : '');
      element.setAttribute('fill', isPoor ? 'none' : `rgb(${colour(elite.worth)})`);
      return {x: x + width / 2, y: y + height / 2, element, gait: elite.gait, overrides: elite.overrides,
        label: `elite of ${short(elite.beats)} beats per length`,
        text: `${short(elite.beats)} beats per body length, cost of transport ${short(elite.cost)} mass · length/s²: `
            + `${map.worth.split(',')[0]} ${short(elite.worth)}`
            + ` (${elite.runs === 1 ? 'one run' : `${elite.runs} runs`})`};
    });
    this.fill([
      draw('rect', {class: 'paper', x: LEFT, y: TOP, width: columns * width, height: rows * height}),
      ...this.#marks(map.beats, i => [LEFT + i * width, bottom + 18], 'middle', MOST_LABELS),
      ...this.#marks(map.costs, i => [LEFT - 5, bottom - i * height + 4], 'end', Math.floor(rows * height / 14)),
      draw('text', {x: (LEFT + WIDTH - RIGHT) / 2, y: bottom + BOTTOM - 5, 'text-anchor': 'middle', class: 'axis'},
          'beats per body length'),
      draw('text', {x: 2, y: 11, class: 'axis'}, 'cost of transport, mass · length/s²'),
    ], items);
    byId('elites-worth').textContent = map.worth;
    byId('elites-low').textContent = short(least);
    byId('elites-high').textContent = short(most);
    byId('elites-bar').style.background = cssGradient(SCALES.sequential);
    byId('elites-poor').hidden = !(most > 0 && Math.min(...worths) <= 0);
  }

  /** Labels at the ends of cells, only at whole octaves, and no more than fit. */
  #marks(ends, place, anchor, most) {
    const octaves = ends.map((_, i) => i).filter(i => Math.abs(Math.log2(ends[i]) % 1) < 1e-6);
    const every = Math.max(1, Math.ceil(octaves.length / Math.max(1, most)));
    return octaves.filter((_, i) => i % every === 0).map(i => {
      const [x, y] = place(i);
      return draw('text', {x, y, 'text-anchor': anchor}, short(ends[i]));
    });
  }
}
