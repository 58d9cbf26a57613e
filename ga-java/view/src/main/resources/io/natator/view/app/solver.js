/** Controls of the solver's settings; all but gravity have the names and units of the scene file. */

import {byId} from './element.js';
import {sliderRow} from './sliders.js';

/** What is in force where a scene does not say. */
const DEFAULTS = {
  substeps: 4, numIterations: 4, solidIterations: 1, viscosity: 0, particleFriction: 0, dynamicFriction: 0, damping: 0, gravity: [0, -10, 0],
};

const SETTINGS = [
  {id: 'substeps', label: 'Substeps', title: 'per frame of 1/60 s', min: 1, max: 16, step: 1, accepts: [1, 1000]},
  {id: 'numIterations', label: 'Iterations', title: 'per substep', min: 1, max: 16, step: 1, accepts: [1, 1000]},
  {id: 'solidIterations', label: 'Of solids', title: 'solidIterations: of springs, clusters and contacts in each iteration; not of scheme flex',
    min: 1, max: 32, step: 1, accepts: [1, 1000], not: 'flex'},
  {id: 'viscosity', label: 'Viscosity', title: 'of the fluid', min: 0, max: 60, step: 0.5, accepts: [0, 10000]},
  {id: 'particleFriction', label: 'Friction', title: 'between particles: particleFriction', min: 0, max: 1, step: 0.01,
    accepts: [0, 100]},
  {id: 'dynamicFriction', label: 'Wall friction', title: 'with the walls: dynamicFriction', min: 0, max: 1, step: 0.01,
    accepts: [0, 100]},
  {id: 'damping', label: 'Damping', title: '1/s', unit: '/s', min: 0, max: 10, step: 0.1, accepts: [0, 1000]},
  {id: 'gravity', label: 'Gravity', title: 'downwards, length/s²', unit: 'length/s²', min: 0, max: 20, step: 0.1,
    accepts: [-1000, 1000]},
];

/** Overrides without those that are set here, so that the scene's own hold. */
export function withoutSettings(overrides) {
  const {solver, ...others} = overrides ?? {};
  const kept = Object.entries(solver ?? {}).filter(([key]) => SETTINGS.every(({id}) => id !== key));
  return kept.length > 0 ? {...others, solver: Object.fromEntries(kept)} : others;
}

/** One slider for each setting. */
export class SolverControls {
  #sliders = new Map();
  #gravity = DEFAULTS.gravity;

  /** `onChange(key, patch)` sends a merge patch; a promise of an error, null or SUPERSEDED. */
  constructor(onChange) {
    for (const setting of SETTINGS) {
      const {slider, row} = sliderRow(setting,
          value => onChange(setting.id, {solver: {[setting.id]: this.#json(setting, value)}}));
      this.#sliders.set(setting.id, slider);
      byId('solver').append(row);
    }
  }

  /**
   * Shows the settings of a scene (SCEN).
   *
   * @param {Scene} scene
   */
  show(scene) {
    const solver = {...DEFAULTS, ...scene.definition.solver};
    this.#gravity = solver.gravity;
    for (const {id, not} of SETTINGS) {
      const slider = this.#sliders.get(id);
      slider.disabled = not === scene.scheme;
      slider.show(id === 'gravity' ? -solver.gravity[1] : solver[id]);
    }
  }

  #json(setting, value) {
    return setting.id === 'gravity' ? this.#gravity.with(1, -value) : value;
  }
}
