/** Equal steps of value are equal steps of colour as people see it. */

import assert from 'node:assert/strict';
import {test} from 'node:test';
import {SCALES} from '#page/colours.js';

test('colours are even, but where a scale turns to the next of its stops', () => {
  assert.equal(Object.keys(SCALES).length, 3);
  for (const [name, scale] of Object.entries(SCALES)) {
    const steps = scale.slice(1).map((colour, i) => Math.hypot(...colour.map((value, k) => value - scale[i][k])));
    const uneven = steps.filter(step => step < 0.97 * Math.max(...steps));

    assert.ok(uneven.length <= 3, `${name}: ${uneven.length} uneven steps`);
  }
});

test('the sequential scale gets lighter and lighter', () => {
  assert.ok(SCALES.sequential.every((one, i, all) => i === 0 || one[0] > all[i - 1][0]));
});
