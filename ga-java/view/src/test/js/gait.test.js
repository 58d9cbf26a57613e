/** Gaits: what steers one is a part of it, in files, where gaits are told apart, and of one that is still. */

import assert from 'node:assert/strict';
import {test} from 'node:test';
import {isAtRest, isSameGait, parseGait} from '#page/gait.js';

const left = {frequency: 1, amplitude: [0, 0], phase: [0, 0], offset: [0.2, 0.2]};
const straight = {frequency: 1, amplitude: [0, 0], phase: [0, 0]};

test('a gait of a file has an offset', () => {
  assert.deepEqual(parseGait(JSON.stringify({gait: left})), left);
  assert.throws(() => parseGait(JSON.stringify({...left, offset: 0.2})),
      {message: 'offset: expected a list of numbers, one for each actuator, or none'});
});

test('gaits that steer otherwise are not the same', () => {
  assert.equal(isSameGait(left, {...left}), true);
  assert.equal(isSameGait(left, {...left, offset: [-0.2, -0.2]}), false);
  assert.equal(isSameGait(left, straight), false);
  assert.equal(isSameGait(straight, {...straight, offset: [0, 0]}), true);
});

test('a gait that steers is not at rest', () => {
  assert.equal(isAtRest({actuators: 2, gait: left}), false);
  assert.equal(isAtRest({actuators: 2, gait: straight}), true);
});
