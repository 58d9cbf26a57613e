/** Controls of the gait: one frequency, where it steers, amplitude and phase of each actuator. */

import {byId, make} from './element.js';
import {Slider, sliderRow} from './sliders.js';

/** Ranges in which gaits are looked for, and those that the simulator accepts. */
const FREQUENCY = {id: 'frequency', label: 'Frequency', title: 'beats per second', unit: '/s', min: 0.5, max: 2, step: 0.01,
  accepts: [0.01, 60]};
const STEER = {id: 'steer', label: 'Steer', title: 'bends the body beside the beat: above 0 to its left', min: -1, max: 1, step: 0.01,
  accepts: [-2, 2]};
/** What an actuator may be driven by at most, by beat and steering together. */
const MOST_DRIVE = 2;

/** A gait of any actuators that swims a little: a wave from head to tail. */
export function waveGait(actuators) {
  return {
    frequency: 1.5,
    amplitude: Array(actuators).fill(0.6),
    phase: Array.from({length: actuators}, (_, i) => Math.round(1000 * (i * 0.75 % 1)) / 1000),
  };
}

/**
 * What drives each actuator beside the beat.
 *
 * @param {Gait} gait
 */
function offsets(gait) {
  return gait.offset ?? gait.amplitude.map(() => 0);
}

/** Numbers of the actuators of a scene (SCEN) that bend the body sideways. */
function sidewaysActuators({actuators, muscles}) {
  const others = new Set(muscles.filter(muscle => muscle.bend).map(muscle => muscle.actuator));
  return Array.from({length: actuators}, (_, i) => i).filter(i => !others.has(i));
}

/**
 * Mean offset of some of a gait's actuators.
 *
 * @param {Gait} gait
 */
function steering(gait, sideways) {
  return sideways.reduce((sum, i) => sum + offsets(gait)[i], 0) / sideways.length;
}

/**
 * The offsets of a gait that steers by this mean: all of these actuators by as much more, as far as they can be driven.
 *
 * @param {Gait} gait
 */
function steered(gait, sideways, mean) {
  const more = mean - steering(gait, sideways);
  return offsets(gait).map((offset, i) => {
    const most = MOST_DRIVE - gait.amplitude[i];
    return sideways.includes(i) ? Math.min(Math.max(offset + more, -most), most) : offset;
  });
}

/** Whether a scene (SCEN) has muscles, and a gait that does not move them. */
export function isAtRest({actuators, gait}) {
  return actuators > 0 && (gait === null || [...gait.amplitude, ...offsets(gait)].every(one => one === 0));
}

/** Whether two gaits, of which either may be null, move muscles in the same way. */
export function isSameGait(one, other) {
  const isSame = (a, b) => a.length === b.length && a.every((value, i) => Math.abs(value - b[i]) < 1e-9);
  return one !== null && other !== null && isSame([one.frequency, one.power ?? 1], [other.frequency, other.power ?? 1])
      && isSame(one.amplitude, other.amplitude) && isSame(one.phase, other.phase) && isSame(offsets(one), offsets(other));
}

/** Any gait within the ranges. */
export function randomGait(actuators) {
  const any = (low, high) => Math.round(1000 * (low + Math.random() * (high - low))) / 1000;
  return {
    frequency: any(FREQUENCY.min, FREQUENCY.max),
    amplitude: Array.from({length: actuators}, () => any(0.2, 1)),
    phase: Array.from({length: actuators}, (_, i) => i === 0 ? 0 : any(0, 1)),
  };
}

/**
 * Reads a gait from the text of a file: a gait itself, or what holds one, as best.json of a run.
 *
 * @throws {Error} if there is none
 */
export function parseGait(text) {
  let found;
  try {
    found = JSON.parse(text);
  } catch (error) {
    throw new Error(`not JSON: ${error.message}`);
  }
  const gait = found?.gait ?? found;
  const isNumbers = list => Array.isArray(list) && list.every(Number.isFinite);
  if (!Number.isFinite(gait?.frequency) || !isNumbers(gait.amplitude) || !isNumbers(gait.phase)) {
    throw new Error('no gait: expected {"frequency": …, "amplitude": […], "phase": […]}');
  }
  const {frequency, amplitude, phase, power, offset} = gait;
  if (offset !== undefined && !isNumbers(offset)) {
    throw new Error('offset: expected a list of numbers, one for each actuator, or none');
  }
  return {frequency, amplitude, phase, ...(power === undefined ? {} : {power}), ...(offset === undefined ? {} : {offset})};
}

/** Fits itself to the number of actuators of the scene. */
export class GaitControls {
  #place = byId('gait');
  #onChange;
  #actuators = -1;
  #frequency = null;
  #steer = null;
  #sideways = [];
  #amplitude = [];
  #phase = [];
  #gait = null;

  /** `onChange(gait)` gives a promise of an error, null or SUPERSEDED. */
  constructor(onChange) {
    this.#onChange = onChange;
  }

  /**
   * Shows the gait of a scene (SCEN).
   *
   * @param {Scene} scene
   */
  show(scene) {
    const sideways = sidewaysActuators(scene);
    if (scene.actuators !== this.#actuators || String(sideways) !== String(this.#sideways)) {
      this.#sideways = sideways;
      this.#build(scene.actuators);
    }
    const still = Array(scene.actuators).fill(0);
    const gait = scene.gait ?? {frequency: 1, amplitude: still, phase: still};
    this.#gait = gait;
    this.#frequency?.show(gait.frequency);
    this.#steer?.show(steering(gait, sideways));
    this.#amplitude.forEach((slider, i) => slider.show(gait.amplitude[i] ?? 0));
    this.#phase.forEach((slider, i) => slider.show(gait.phase[i] ?? 0));
  }

  #build(actuators) {
    this.#actuators = actuators;
    this.#amplitude = [];
    this.#phase = [];
    this.#frequency = null;
    this.#steer = null;
    if (actuators === 0) {
      this.#place.replaceChildren(make('p', {className: 'hint', textContent: 'No muscles in this scene.'}));
      return;
    }
    const {slider, row} = sliderRow(FREQUENCY, value => this.#send({frequency: value}));
    this.#frequency = slider;
    const settings = [row];
    if (this.#sideways.length > 0) {
      const steer = sliderRow(STEER, value => this.#send({offset: steered(this.#gait, this.#sideways, value)}));
      this.#steer = steer.slider;
      settings.push(steer.row);
    }
    const error = make('output', {className: 'error', role: 'alert', 'data-testid': 'actuator-error'});
    const rows = Array.from({length: actuators}, (_, i) => this.#actuatorRow(i, actuators, error));
    const head = make('tr', {}, ...['Actuator', 'Amplitude', 'Phase'].map((text, i) =>
      make('th', {scope: 'col'}, make('span', {className: i === 0 ? 'hidden' : '', textContent: text}))));
    this.#place.replaceChildren(...settings, make('table', {className: 'actuators'},
        make('caption', {className: 'hidden', textContent: 'Actuators from head to tail'}),
        make('thead', {}, head), make('tbody', {}, ...rows)), error);
  }

  #actuatorRow(i, actuators, error) {
    const end = actuators > 1 && i === 0 ? ' head' : actuators > 1 && i === actuators - 1 ? ' tail' : '';
    const slider = (name, list, most) => {
      const setting = {id: `${name}-${i + 1}`, label: `${name} of actuator ${i + 1}`, min: 0, max: 1, step: 0.005, accepts: [0, most]};
      list[i] = new Slider(setting, error, value => this.#send({[name]: this.#gait[name].with(i, value)}));
      return make('td', {}, make('div', {className: 'pair'}, ...list[i].inputs));
    };
    return make('tr', {}, make('th', {scope: 'row', textContent: `${i + 1}${end}`}),
        slider('amplitude', this.#amplitude, 2), slider('phase', this.#phase, 1));
  }

  /** What is refused is not kept: the next change is one of the gait that is in force. */
  async #send(change) {
    const before = this.#gait;
    const gait = {...before, ...change};
    this.#gait = gait;
    const error = await this.#onChange(gait);
    if (typeof error === 'string' && this.#gait === gait) {
      this.#gait = before;
    }
    return error;
  }
}
