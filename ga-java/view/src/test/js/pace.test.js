/** What goes with time: detail, speeds, commands that follow a slider. */

import assert from 'node:assert/strict';
import {test} from 'node:test';
import {History} from '#page/history.js';
import {Live, SUPERSEDED, errorOf} from '#page/live.js';
import {Quality} from '#page/quality.js';

/** The share of pixels after so many seconds, in which each picture took `cost` ms. */
function after(quality, rate, seconds, cost, from) {
  for (let i = 0; i < rate * seconds; i++) {
    quality.drawn(from + i / rate, cost);
  }
  return quality.share;
}

test('detail is given up only where that helps', () => {
  assert.equal(after(new Quality(), 60, 9, 9, 0), 1, 'fast enough');
  assert.equal(after(new Quality(), 30, 5, 2, 0), 1, 'slow, but not by drawing');
  assert.ok(after(new Quality(), 0.25, 9, 4000, 0) < 1, 'seconds a picture');
});

test('detail comes back', () => {
  const quality = new Quality();
  const slow = after(quality, 30, 2.1, 20, 0);

  assert.ok(slow < 1, 'slow by drawing');
  assert.ok(after(quality, 60, 9, 9, 2.1) > slow, 'fast again');
});

test('a minute without pictures is not a slow one', () => {
  const quality = new Quality();
  after(quality, 60, 0.5, 9, 0);
  quality.rest();

  assert.equal(after(quality, 60, 0.5, 9, 60), 1);
});

test('speed is taken over a beat', () => {
  const history = new History();
  const add = (time, distance) => history.add({time, distance, velocity: [3, 0, 0], momentum: 0, angularMomentum: 0,
    densityMean: 0.01, densityMax: 0.02}, 1.5, 2);
  for (let i = 0; i <= 60; i++) {
    add(i / 60, 0.6 * (i / 60) + 0.1 * Math.sin(4 * Math.PI * i / 60));
  }

  assert.ok(Math.abs(history.last('beatSpeed') - 0.4) < 1e-9);
  assert.equal(history.last('speed'), 2);
  assert.equal(history.last('densityMean'), 1);
  assert.equal(history.length, 61);
});

test('a jump back in time begins a history anew', () => {
  const history = new History();
  for (const time of [0, 1, 2, 0]) {
    history.add({time, distance: 0, velocity: [0, 0, 0]}, 1, 0);
  }

  assert.equal(history.length, 1);
});

/** The first is under way, the second waits, and the third takes its place. */
test('a command that another took the place of has no error to show', async () => {
  const sent = [];
  const live = new Live(command => {
    sent.push(command);
    return Promise.resolve(`${command} was refused`);
  });

  const answers = await Promise.all(['first', 'second', 'third'].map(command => live.submit('gait', command)));

  assert.deepEqual(sent, ['first', 'third']);
  assert.deepEqual(answers, ['first was refused', SUPERSEDED, 'third was refused']);
  assert.deepEqual(answers.map(errorOf), ['first was refused', null, 'third was refused']);
  assert.equal(errorOf(null), null);
});
