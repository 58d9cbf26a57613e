/** Browses the generations of a run. */

import {FitnessChart, chartColours} from './charts.js';
import {byId, fillSelect} from './element.js';
import {isSameGait} from './gait.js';

/** The fitness curve; a click or the arrow keys choose a generation. */
export class RunBrowser {
  #onWatch;
  #onSettled;
  #canvas = byId('chart-fitness');
  #chart = new FitnessChart(this.#canvas);
  #run = null;
  #best = null;
  #pending = 0;

  /** `onWatch(run, best, beside)` shows a gait; a promise of an error or null. `onSettled()` is to mark what swims. */
  constructor(runs, onWatch, onSettled) {
    this.#onWatch = onWatch;
    this.#onSettled = onSettled;
    byId('runs-none').hidden = runs.length > 0;
    byId('runs').hidden = runs.length === 0;
    fillSelect(byId('run-choice'), runs.map(({id, name}) => [id, name]));
    byId('run-choice').addEventListener('change', async event => {
      await this.load(event.target.value);
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
    const {scene, optimizer, seed, generations, verdict, mechanics} = this.#run;
    byId('run-verdict').hidden = !verdict;
    byId('run-verdict').textContent = verdict ? `Best gait ${verdict.text}${verdict.advice ? `; ${verdict.advice}` : ''}.` : '';
    byId('run-mechanics').hidden = !mechanics;
    byId('run-mechanics').textContent = mechanics ? `${mechanics}.` : '';
    byId('run-facts').textContent = `${scene}, ${optimizer}, seed ${seed}, ${generations.length} generations`;
    this.#choose(null);
  }

  /**
   * Where a scene's (SCEN) gait is from, if it is of this run and in its scene; `origin` is what is known of that.
   *
   * @returns {{run: string, generation: number}|null} of several generations the last one, unless `origin` says which
   */
  find(scene, origin) {
    if (this.#run === null || scene.scene !== this.#run.scene && origin?.run !== this.#run.name) {
      return null;
    }
    const {name, bests} = this.#run;
    const found = bests.filter(best => isSameGait(best.gait, scene.gait));
    const known = origin?.run === name ? found.find(best => best.generation === origin.generation) : undefined;
    const best = known ?? found.at(-1);
    return best === undefined ? null : {run: name, generation: best.generation};
  }

  /** Marks the generation that swims, null for none; while another one is to swim, that stays marked. */
  mark(generation) {
    if (this.#pending === 0 && this.#run !== null && generation !== (this.#best?.generation ?? null)) {
      this.#choose(generation === null ? null : this.#nearest(generation));
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
    this.#pending++;
    byId('run-error').textContent = await this.#onWatch(this.#run, this.#best, beside) ?? '';
    this.#pending--;
    this.#onSettled();
  }
}
