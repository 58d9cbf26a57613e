/** The charts beneath the picture, drawn in turns. */

import {EnvelopeChart, TimeChart, chartColours} from './charts.js';
import {byId, make} from './element.js';
import {fixed} from './scaling.js';

/** Frames of the screen between two drawings of charts. */
const TURN = 4;

/** How near a motion (ANALYSIS) is to the real fish that it is most like, or that it is like none. */
export function likeness({modes, nearest}) {
  const fish = modes.find(mode => mode.name === nearest);
  return fish ? `e ${fish.e.toFixed(2)}` : 'like none';
}

/** Distance, speed, envelope, momentum and density error of one or two views. */
export class LiveCharts {
  #modes;
  #turn = 0;
  /** @type {[string, TimeChart|EnvelopeChart][]} */
  #charts;
  #outputs;
  #shown = [];

  /** `modes` are the envelopes of real fish. */
  constructor(modes) {
    this.#modes = modes;
    this.#charts = [
      ['distance', new TimeChart(byId('chart-distance'), ['distance'], 0.01)],
      ['speed', new TimeChart(byId('chart-speed'), ['beatSpeed', 'speed'], 0.02)],
      ['envelope', new EnvelopeChart(byId('chart-envelope'))],
      ['momentum', new TimeChart(byId('chart-momentum'), ['momentum', 'angularMomentum'], 0.01)],
      ['density', new TimeChart(byId('chart-density'), ['densityMean', 'densityMax'], 0.5)],
    ];
    byId('envelope-key').replaceChildren(...modes.flatMap(({name}, i) => [
      make('span', {}, make('i', {className: `key s${i + 2} dash`}), name), ' ',
    ]));
    this.#outputs = new Map(/** @type {HTMLElement[]} */ ([...document.querySelectorAll('[data-chart]')]).map(one => [one.dataset.chart, one]));
  }

  /** Shows those that have something to tell; `has` as in `Legend.show`. */
  show(has) {
    const needed = {distance: has.bodies, speed: has.bodies, envelope: has.muscles, momentum: has.bodies, density: has.water};
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
    if (name === 'envelope') {
      chart.draw(this.#modes, views.map(view => view.analysis));
    } else {
      chart.draw(views.map(view => view.history));
    }
  }

  #text(name, {history, analysis}) {
    if (name === 'envelope') {
      return analysis ? likeness(analysis) : '';
    }
    const column = {distance: 'distance', speed: 'beatSpeed', momentum: 'momentum', density: 'densityMean'}[name];
    const value = history.last(column);
    return Number.isNaN(value) ? '' : fixed(value, name === 'density' ? 2 : 3) + (name === 'density' ? ' %' : '');
  }
}
