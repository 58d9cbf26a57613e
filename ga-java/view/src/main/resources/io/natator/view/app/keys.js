/** Keyboard shortcuts, and the list of them. */

import {byId, make} from './element.js';

const NAMES = {' ': 'space'};
/** Where a key is text, or moves a choice. */
const TYPING = 'input[type="number"], input[type="text"], select, textarea';

/** `shortcuts` are [key, what it does, function]; several keys for one are given as an array. */
export function listen(shortcuts) {
  const actions = new Map(shortcuts.flatMap(([keys, , action]) => [keys].flat().map(key => [key, action])));
  addEventListener('keydown', event => {
    const action = actions.get(event.key);
    if (action === undefined || event.ctrlKey || event.metaKey || event.altKey
        || document.querySelector('dialog[open]') !== null) {
      return;
    }
    const target = /** @type {Element} */ (event.target);
    const pressesButton = event.key === ' ' && target.closest('button, summary, input, a') !== null;
    if (target.closest(TYPING) !== null || pressesButton) {
      return;
    }
    event.preventDefault();
    action(event.key);
  });
  byId('help-keys').replaceChildren(...shortcuts.flatMap(([keys, text]) => [
    make('dt', {}, ...[keys].flat().map(key => make('kbd', {textContent: NAMES[key] ?? key}))),
    make('dd', {textContent: text}),
  ]));
  byId('help-open').addEventListener('click', () => byId('help').showModal());
}
