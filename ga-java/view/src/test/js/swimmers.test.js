/** What the sliders of the page that simulates by itself make of a swimmer. */

import assert from 'node:assert/strict';
import {test} from 'node:test';
import {SWIMMERS, stiffened, waveGait} from '#replay/swimmers.js';

test('a wave goes from head to tail', () => {
  assert.deepEqual(waveGait({frequency: 1.5, head: 0.2, tail: 0.8, waves: 1}, 4), {
    frequency: 1.5, amplitude: [0.2, 0.4, 0.6, 0.8], phase: [0, 0.75, 0.5, 0.25],
  });
  assert.deepEqual(waveGait({frequency: 1, head: 0, tail: 1, waves: -0.5}, 2).phase, [0, 0.25], 'or the other way');
  assert.deepEqual(waveGait({frequency: 1, head: 0.3, tail: 0.7, waves: 1}, 1), {frequency: 1, amplitude: [0.7], phase: [0]});
});

test('gaits are such as the simulator accepts', () => {
  for (const {wave, actuators} of SWIMMERS) {
    for (const waves of [-1.5, -0.333, 0, 1e-9, wave.waves, 1.5]) {
      const {amplitude, phase} = waveGait({...wave, waves}, actuators);
      assert.equal(amplitude.length, actuators);
      assert.ok(amplitude.every(one => one >= 0 && one <= 2));
      assert.ok(phase.every(one => one >= 0 && one < 1), String(phase));
    }
  }
});

test('no stiffness is beyond 1', () => {
  assert.equal(stiffened(0.4, 1.5), 0.6);
  assert.equal(stiffened(0.8, 1.5), 1);
  assert.deepEqual(stiffened([[0, 0.6], [1, 0.9]], 1.5), [[0, 0.9], [1, 1]]);
});
