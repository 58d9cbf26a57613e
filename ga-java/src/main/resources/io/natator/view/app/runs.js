/** Browses the generations of a run. */

import {FitnessChart, chartColours} from './charts.js';
import {byId, fillSelect} from './element.js';

/** The fitness curve; a click or the arrow keys choose a generation. */
export class RunBrowser {
  #onWatch;
  #canvas = byId('chart-fitness');
  #chart = new FitnessChart(this.#canvas);
  #run = null;
  #best = null;
  #compared = null;

  /** `onWatch(run, best, beside)` shows a gait; a promise of an error or null. */
  constructor(runs, onWatch) {
    this.#onWatch = onWatch;
    byId('runs-none').hidden = runs.length > 0;
    byId('runs').hidden = runs.length === 0;
    fillSelect(byId('run-choice'), runs.map(({id, name}) => [id, name]));
    byId('run-choice').addEventListener('change', event => this.load(event.target.value));
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
    return this.#run === null ? null : {run: this.#run.id, generation: this.#best?.generation ?? null};
  }

  /** Reads a run and shows its curve; the last generation is chosen unless another is given. */
  async load(id, generation = null) {
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
    const {scene, optimizer, seed, generations, verdict} = this.#run;
    byId('run-verdict').hidden = !verdict;
    byId('run-verdict').textContent = verdict ? `Best gait ${verdict.text}${verdict.advice ? `; ${verdict.advice}` : ''}.` : '';
    byId('run-facts').textContent = `${scene}, ${optimizer}, seed ${seed}, ${generations.length} generations`;
    this.#compared = null;
    this.#choose(generation === null ? this.#run.bests.at(-1) ?? null : this.#nearest(generation));
  }

  /** Draws the curve anew, as after a change of colours. */
  draw() {
    if (this.#run !== null && this.#canvas.clientWidth > 0) {
      this.#chart.colours = chartColours(this.#canvas);
      this.#chart.draw(this.#run.generations, this.#run.bests, this.#best?.generation ?? null, this.#compared);
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
    const text = best === null ? 'No gait of this run is known yet.'
        : `Generation ${best.generation}: best gait, fitness ${best.fitness.toFixed(4)}`;
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
    if (beside) {
      this.#compared = this.#best.generation;
      this.draw();
    }
    byId('run-error').textContent = await this.#onWatch(this.#run, this.#best, beside) ?? '';
  }
}
