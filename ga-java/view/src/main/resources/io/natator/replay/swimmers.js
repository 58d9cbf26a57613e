/** The swimmers of the page that simulates by itself, and how its sliders make gaits of them. */

const POOL = {scene: 'endless/small', viscosity: 0.002};
/** That of plane/loach, shorter by a third, for one core to keep up with. */
const PLANE = {planes: [[1, 0, 0, 0], [-1, 0, 0, 2.24], [0, 0, 1, 0], [0, 0, -1, 1.6]], fluid: {count: [112, 1, 80]}};

/**
 * What each is called, its scene with the kinematic viscosity there, its part of that and, where it is another, its tank, its
 * actuators, and the wave that it begins with: see `waveGait`.
 */
export const SWIMMERS = [
  {scene: 'plane/loach', viscosity: 0.0004, title: 'Loach', creature: {name: 'loach', rearCentre: [0.9, 0.01, 0.8]}, tank: PLANE,
    actuators: 5, wave: {frequency: 2, head: 0.4, tail: 0.2, waves: 0.5}},
  {...POOL, title: 'Eel', creature: {name: 'eel'}, actuators: 8, wave: {frequency: 1.5, head: 0.25, tail: 0.8, waves: 1}},
  {...POOL, title: 'Plank', creature: {name: 'creature-2', particleMass: 0.421875, clusterStiffness: 0.6, springStiffness: 0.4},
    actuators: 8, wave: {frequency: 1.5, head: 0.2, tail: 0.6, waves: 0.6}},
  {...POOL, title: 'Tadpole', creature: {name: 'tadpole'}, actuators: 5, wave: {frequency: 1.5, head: 0.6, tail: 1, waves: 0.6}},
  {...POOL, title: 'Tuna', creature: {name: 'tuna'}, actuators: 4, wave: {frequency: 2.5, head: 0.7, tail: 1.2, waves: 0.6}},
];

/** The settings that make a wave. */
export const WAVE = ['frequency', 'tail', 'head', 'waves'];

/**
 * A gait by which a wave goes from head to tail.
 *
 * @param {{frequency: number, head: number, tail: number, waves: number}} wave beats per second; how far the first and the
 *     last actuator bend; how many waves are on the body at a time, below 0 from tail to head
 * @returns {Gait}
 */
export function waveGait({frequency, head, tail, waves}, actuators) {
  const rounded = value => Math.round(1e4 * value) / 1e4;
  const share = i => actuators > 1 ? i / (actuators - 1) : 1;
  return {
    frequency,
    amplitude: Array.from({length: actuators}, (_, i) => rounded(head + share(i) * (tail - head))),
    phase: Array.from({length: actuators}, (_, i) => rounded(((-waves * i / actuators) % 1 + 1) % 1) % 1),
  };
}

/**
 * A creature's stiffness times a factor; none may be beyond 1.
 *
 * @param {number|number[][]} stiffness one number, or [place, number] pairs
 */
export function stiffened(stiffness, factor) {
  const times = value => Math.min(1, Math.round(1e4 * factor * value) / 1e4);
  return Array.isArray(stiffness) ? stiffness.map(([place, value]) => [place, times(value)]) : times(stiffness);
}
