/** The charts beneath the picture, drawn in turns. */

import {TimeChart, chartColours} from './charts.js';
import {byId} from './element.js';
import {fixed} from './scaling.js';

/** Frames of the screen between two drawings of charts. */
const TURN = 4;

/** Distance, speed, momentum and density error of one or two views. */
export class LiveCharts {
  #turn = 0;
  /** @type {[string, TimeChart][]} */
  #charts;
  #outputs;
  #shown = [];

  constructor() {
    this.#charts = [
      ['distance', new TimeChart(byId('chart-distance'), ['distance'], 0.01)],
      ['speed', new TimeChart(byId('chart-speed'), ['beatSpeed', 'speed'], 0.02)],
      ['momentum', new TimeChart(byId('chart-momentum'), ['momentum', 'angularMomentum'], 0.01)],
      ['density', new TimeChart(byId('chart-density'), ['densityMean', 'densityMax'], 0.5)],
    ];
    this.#outputs = new Map(/** @type {HTMLElement[]} */ ([...document.querySelectorAll('[data-chart]')]).map(one => [one.dataset.chart, one]));
  }

  /** Shows those that have something to tell; `has` as in `Legend.show`. */
  show(has) {
    const needed = {distance: has.bodies, speed: has.bodies, momentum: has.bodies, density: has.water};
    this.#shown = this.#charts.filter(([name]) => needed[name]);
    for (const [name] of this.#charts) {
      byId(`chart-${name}`).closest('figure').hidden = !needed[name];
    }
    /** @type {HTMLElement} */ (this.#outputs.get('distance').closest('.charts')).hidden = this.#shown.length === 0;
  }

  /** Takes over new colours. */
  recolour() {
    for (const [, chart] of this.#charts) {
      chart.colours = chartColours(byId('chart-distance'));
    }
  }

  /** To be called for each frame of the screen; draws one chart every few. */
  tick(views) {
    if (this.#turn++ % TURN === 0) {
      const turn = Math.floor(this.#turn / TURN);
      if (this.#shown.length > 0) {
        this.#draw(this.#shown[turn % this.#shown.length], views);
      }
    }
  }

  #draw([name, chart], views) {
    const text = views.map(view => this.#text(name, view)).filter(one => one !== '').join(' | ');
    if (this.#outputs.get(name).textContent !== text) {
      this.#outputs.get(name).textContent = text;
    }
    chart.draw(views.map(view => view.history));
  }

  #text(name, {history}) {
    const column = {distance: 'distance', speed: 'beatSpeed', momentum: 'momentum', density: 'densityMean'}[name];
    const value = history.last(column);
    return Number.isNaN(value) ? '' : fixed(value, name === 'density' ? 2 : 3) + (name === 'density' ? ' %' : '');
  }
}
