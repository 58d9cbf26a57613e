/** The swimmers of the page that simulates by itself, and how its sliders make gaits of them. */

/** Name, what it is called, and the wave that it begins with: see `waveGait`. The scene has the first. */
export const SWIMMERS = [
  {creature: 'eel', title: 'Eel', wave: {frequency: 1.5, head: 0.25, tail: 0.8, waves: 1}},
  {creature: 'tadpole', title: 'Tadpole', wave: {frequency: 1.5, head: 0.4, tail: 0.9, waves: 0.8}},
  {creature: 'tuna', title: 'Tuna', wave: {frequency: 1.5, head: 0.6, tail: 0.9, waves: 0.5}},
  {creature: 'creature-2', title: 'Two joints', wave: {frequency: 1.5, head: 0.6, tail: 0.9, waves: 0.5}},
];

/** Beside viscosity and stiffness all settings of a slider; the keys of a wave. */
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
