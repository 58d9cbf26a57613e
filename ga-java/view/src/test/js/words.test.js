/** What the page says: stops, axes. */

import assert from 'node:assert/strict';
import {test} from 'node:test';
import {stopText} from '#page/protocol.js';
import {axis, axisText, niceStep} from '#page/scaling.js';

test('an unstable swim tells the law that it broke', () => {
  assert.equal(stopText({reason: 'unstable', time: 1.5, particle: 7, stage: 'frame', law: 'tank'}),
      'Became unstable at 1.50 s (broke law tank, particle 7, frame). Reset to go on.');
  assert.equal(stopText({reason: 'unstable', time: 0.25, particle: 3, stage: 'springs'}),
      'Became unstable at 0.25 s (particle 3, springs). Reset to go on.');
  assert.equal(stopText({reason: 'until'}), 'Came to its end.');
});

test('axes end on round numbers', () => {
  assert.deepEqual(axis(0, 0.93, 3), {low: 0, high: 1, step: 0.5, marks: [0, 0.5, 1]});
  assert.deepEqual(axis(-0.2, 7, 4), {low: -2, high: 8, step: 2, marks: [-2, 0, 2, 4, 6, 8]});
  assert.deepEqual(axis(2, 2), {low: 2, high: 2.5, step: 0.5, marks: [2, 2.5]});
  assert.equal(niceStep(0.0021), 0.005);
  assert.equal(axisText(0.25, 0.05), '0.25');
  assert.equal(axisText(-1e-12, 0.5), '0.0');
  assert.equal(axisText(40, 20), '40');
});
