/** A slider and its number, without a browser. */

import assert from 'node:assert/strict';
import {test} from 'node:test';
import {Slider} from '#page/sliders.js';

class Input extends EventTarget {
  dataset = {};
  value = '';

  setAttribute() {}

  append() {}
}

/** A slider that says what it was changed to, and its number's field. */
function slider(changes) {
  globalThis.document = {createElement: () => new Input()};
  const made = new Slider({id: 'tail', label: 'Tail', min: 0, max: 1.2, step: 0.02}, new Input(), async value => {
    changes.push(value);
    return null;
  });
  return {made, number: made.inputs[1]};
}

function type(number, value) {
  number.value = value;
  number.dispatchEvent(new Event('input'));
}

test('a number that is being typed stays, whatever comes in force meanwhile', () => {
  const changes = [];
  const {made, number} = slider(changes);
  made.show(1);
  type(number, '0.5');
  made.show(1);

  assert.equal(number.value, '0.5');
  number.dispatchEvent(new Event('change'));
  assert.deepEqual(changes, [0.5]);
});

test('a number that was left unchanged shows what is in force', () => {
  const {made, number} = slider([]);
  type(number, '1');
  number.dispatchEvent(new Event('blur'));
  made.show(0.7);

  assert.equal(number.value, 0.7);
});
