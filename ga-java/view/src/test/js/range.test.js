/** The scale that two pictures share. */

import assert from 'node:assert/strict';
import {test} from 'node:test';
import {SharedRange} from '#page/shared-range.js';

test('two pictures have one scale over both, but for those that have nothing of it', () => {
  const views = [{has: true}, {has: true}];
  const told = [];
  const range = new SharedRange(ends => told.push(ends), (view, ends) => view.ends = ends, view => view.has);

  range.changed(0, [-1, 1], views);
  range.changed(1, [-3, 2], views);
  assert.deepEqual(views.map(view => view.ends), [[-3, 2], [-3, 2]]);

  views[1].has = false;
  range.changed(0, [-2, 2], views);
  assert.deepEqual(views.map(view => view.ends), [null, null]);
  range.keepFirst(views[0]);
  assert.deepEqual(told, [[-1, 1], [-3, 2], [-2, 2], [-2, 2]]);
});
