/** What page.d.ts says of the pages' elements is so. */

import assert from 'node:assert/strict';
import {readFileSync} from 'node:fs';
import {test} from 'node:test';

const INTERFACES = {button: 'HTMLButtonElement', dialog: 'HTMLDialogElement', input: 'HTMLInputElement', select: 'HTMLSelectElement'};

function text(path) {
  return readFileSync(new URL(`../../../${path}`, import.meta.url), 'utf8');
}

test('elements have the types that page.d.ts gives them', () => {
  const pages = ['view/app/index.html', 'replay/replay.html', 'replay/live-page.html']
      .map(page => text(`src/main/resources/io/natator/${page}`)).join('');
  const said = [...text('page.d.ts').matchAll(/^ {2}'(.+)': (\w+);$/gm)];
  const found = [...pages.matchAll(/<(\w+)\s[^>]*?\bid="([^"]+)"/g)];

  assert.ok(said.length > 0);
  for (const [, id, type] of said) {
    const tags = found.filter(one => one[2] === id).map(one => one[1]);

    assert.ok(tags.length > 0, `no element is called ${id}`);
    tags.forEach(tag => assert.equal(INTERFACES[tag], type, `<${tag} id="${id}">`));
  }
});
