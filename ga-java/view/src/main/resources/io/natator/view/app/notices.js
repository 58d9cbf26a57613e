/** What the page tells about itself: the state of its connection, and notes across its top. */

import {byId} from './element.js';

/** `state` is how the text is coloured; where a connection is `lost`, the pictures say so too. */
export function showStatus(state, text) {
  byId('status').dataset.state = state;
  byId('status').textContent = text;
  if (state === 'lost') {
    document.querySelectorAll('.overlay').forEach(one => {
      one.textContent = text;
    });
  }
}

/** A note, or something bad; `again`, where it is given, is what its button does. */
export function showBanner(text, isBad, again = null) {
  byId('banner').dataset.kind = isBad ? 'bad' : 'note';
  byId('banner-text').textContent = text;
  byId('banner-again').hidden = again === null;
  byId('banner-again').onclick = () => {
    byId('banner').hidden = true;
    again();
  };
  byId('banner').hidden = false;
}

/** The banner's cross closes it. */
export function listenToBanner() {
  byId('banner-close').addEventListener('click', () => {
    byId('banner').hidden = true;
  });
}
