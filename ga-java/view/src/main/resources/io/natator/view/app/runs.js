/** Browses the gaits of a run: the best of its generations, of its kinds, and by its objectives. */

import {showBodies} from './bodies.js';
import {FitnessChart, chartColours} from './charts.js';
import {EliteMap} from './elitemap.js';
import {byId, fillSelect, make} from './element.js';
import {namedFacts} from './facts.js';
import {ParetoPlot} from './front.js';
import {isSameSwimmer} from './swimmer.js';

/** The fitness curve; a click or the arrow keys choose a generation. Beside it a map of gaits or a front, if the run has one. */
export class RunBrowser {
  #onWatch;
  #onSettled;
  #canvas = byId('chart-fitness');
  #chart = new FitnessChart(this.#canvas);
  #run = null;
  /** What is chosen: gait, overrides, label and text; of the best of a generation also that. */
  #best = null;
  #pending = 0;
  #swims = null;
  #elites;
  #front;

  /** `onWatch(run, best, beside)` shows a gait; a promise of an error or null. `onSettled()` is to mark what swims. */
  constructor(runs, onWatch, onSettled) {
    this.#onWatch = onWatch;
    this.#onSettled = onSettled;
    byId('runs-none').hidden = runs.length > 0;
    byId('runs').hidden = runs.length === 0;
    if (runs.length > 0) {
      // Whoever comes for a run reads of it first.
      byId('which').after(byId('runs-section'));
    }
    const watch = item => {
      this.#choose(item);
      this.#watch(false);
    };
    const look = item => {
      byId('gait-looked-at').textContent = item?.text ?? 'Point at a gait to read what it does.';
    };
    this.#elites = new EliteMap(watch, look);
    this.#front = new ParetoPlot(watch, look, () => this.#front.mark(this.#swims));
    fillSelect(byId('run-choice'), runs.map(({id, name}) => [id, name]));
    byId('run-choice').addEventListener('change', async () => {
      await this.load(byId('run-choice').value);
      this.#onSettled();
    });
    byId('run-watch').addEventListener('click', () => this.#watch(false));
    byId('run-compare').addEventListener('click', () => this.#watch(true));
    this.#canvas.addEventListener('click', event => {
      this.#choose(this.#nearest(this.#chart.fromX(event.offsetX)));
      this.#watch(false);
    });
    this.#canvas.addEventListener('keydown', event => this.#key(event));
    new ResizeObserver(() => this.draw()).observe(this.#canvas);
  }

  /** What was chosen, to be remembered. */
  get choice() {
    return this.#run === null ? null : {run: this.#run.id};
  }

  /** Reads a run and shows its curve. */
  async load(id) {
    byId('run-error').textContent = '';
    try {
      const answer = await fetch(`/api/runs/${encodeURIComponent(id)}`);
      if (!answer.ok) {
        throw new Error(`${answer.status} ${await answer.text()}`);
      }
      this.#run = await answer.json();
    } catch (error) {
      byId('run-error').textContent = `The run cannot be read: ${error.message}`;
      return;
    }
    byId('run-choice').value = id;
    const {scene, optimizer, seed, generations, verdict, facts, map, front, bodies} = this.#run;
    this.#run.bests.forEach(best => Object.assign(best, {label: `generation ${best.generation}`,
      text: `Generation ${best.generation}: best gait, fitness ${best.fitness.toFixed(4)}`}));
    byId('run-verdict').hidden = !verdict;
    byId('run-verdict').textContent = verdict ? `Best gait ${verdict.text}${verdict.advice ? `; ${verdict.advice}` : ''}.` : '';
    byId('run-fresh').replaceChildren(...namedFacts(facts).filter(([name]) => name !== 'Verdict').flatMap(([name, text]) => [
      make('dt', {textContent: name}), make('dd', {textContent: text}),
    ]));
    this.#elites.show(map ?? null);
    this.#front.show(front ?? null);
    showBodies(bodies ?? null);
    byId('gait-looked-at').hidden = !map && !front;
    const last = generations.at(-1)?.generation ?? 0;  // the random one, 0, is not counted, as everywhere
    byId('run-facts').textContent = `${scene}, ${optimizer}, seed ${seed}, ${last} generation${last === 1 ? '' : 's'}`;
    this.#choose(null);
  }

  /**
   * Where a scene's (SCEN) gait is from, if it is of this run and in its scene; `origin` is what is known of that.
   *
   * @returns {{run: string, label: string, item: object}|null} of several the last generation, unless `origin` says which
   */
  find(scene, origin) {
    if (this.#run === null || scene.scene !== this.#run.scene && origin?.run !== this.#run.name) {
      return null;
    }
    const {name, bests} = this.#run;
    const found = [...this.#elites.items, ...this.#front.items, ...bests].filter(one => isSameSwimmer(one, scene));
    const known = origin?.run === name ? found.find(one => one.label === origin.label) : undefined;
    const item = known ?? found.at(-1);
    return item === undefined ? null : {run: name, label: item.label, item};
  }

  /** Marks what swims: what `find` found, null for nothing of this run; while another one is to swim, that stays marked. */
  mark(item) {
    if (this.#pending > 0 || this.#run === null) {
      return;
    }
    this.#swims = item;
    this.#elites.mark(this.#swims);
    this.#front.mark(this.#swims);
    if (item !== this.#best) {
      this.#choose(item);
    }
  }

  /** Draws the curve anew, as after a change of colours. */
  draw() {
    if (this.#run !== null && this.#canvas.clientWidth > 0) {
      this.#chart.colours = chartColours(this.#canvas);
      this.#chart.draw(this.#run.generations, this.#run.bests, this.#best?.generation ?? null, null);
    }
  }

  /** Chooses the next generation (1) or the one before (-1), and shows it. */
  move(step) {
    if (this.#run === null || this.#run.bests.length === 0) {
      return;
    }
    const bests = this.#run.bests;
    const at = bests.indexOf(this.#best) + step;
    this.#choose(bests[Math.min(bests.length - 1, Math.max(0, at))]);
    this.#watch(false);
  }

  #key(event) {
    const step = {ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, Home: -1e9, End: 1e9,
      PageDown: -10, PageUp: 10}[event.key];
    if (step !== undefined) {
      event.preventDefault();
      this.move(step);
    } else if (event.key === 'Enter') {
      event.preventDefault();
      this.#watch(false);
    }
  }

  #nearest(generation) {
    const off = best => Math.abs(best.generation - generation);
    return this.#run.bests.reduce((near, best) => near === null || off(best) < off(near) ? best : near, null);
  }

  #choose(best) {
    this.#best = best;
    byId('run-watch').disabled = best === null;
    byId('run-compare').disabled = best === null;
    const text = best === null && this.#run.bests.length === 0 ? 'No gait of this run is known yet.'
        : best === null ? 'What swims is not of this run. Click a generation, or choose with the arrow keys.'
        : best.text;
    byId('run-chosen').textContent = text;
    this.#canvas.setAttribute('aria-valuemax', this.#run.generations.at(-1)?.generation ?? 0);
    this.#canvas.setAttribute('aria-valuenow', best?.generation ?? 0);
    this.#canvas.setAttribute('aria-valuetext', text);
    this.draw();
  }

  async #watch(beside) {
    if (this.#best === null) {
      return;
    }
    this.#pending++;
    byId('run-error').textContent = await this.#onWatch(this.#run, this.#best, beside) ?? '';
    this.#pending--;
    this.#onSettled();
  }
}
