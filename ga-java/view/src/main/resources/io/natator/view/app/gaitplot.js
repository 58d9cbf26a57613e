/** Plots of many gaits, of which one is chosen: by a click, or by the arrow keys and Enter. */

import {isSameSwimmer} from './swimmer.js';

const NAMESPACE = 'http://www.w3.org/2000/svg';
/** How far from a gait a click still means it, in units of the plot. */
const REACH = 18;
const ARROWS = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};

/** A new element of a picture with these attributes and this text. */
export function draw(tag, attributes = {}, text = '') {
  const element = document.createElementNS(NAMESPACE, tag);
  for (const [name, value] of Object.entries(attributes)) {
    element.setAttribute(name, value);
  }
  element.textContent = text;
  return element;
}

/** A number with three digits, never in powers of ten where that can be read. */
export function short(value) {
  const text = Number(value.toPrecision(3));
  return Math.abs(text) >= 1e6 || text !== 0 && Math.abs(text) < 1e-4 ? text.toExponential(1) : text.toLocaleString('en', {
    maximumSignificantDigits: 3, useGrouping: false,
  }).replace('-', '−');
}

/** A picture (SVG) whose items are gaits; the list of them is also there for who does not see it. */
export class GaitPlot {
  #svg;
  #onWatch;
  #onLook;
  #items = [];
  #at = null;

  /** `onWatch(item)` shows a gait; an item has label, text and gait. `onLook(item)` tells of one, null for none. */
  constructor(svg, onWatch, onLook) {
    this.#svg = svg;
    this.#onWatch = onWatch;
    this.#onLook = onLook;
    svg.addEventListener('click', event => this.#click(event));
    svg.addEventListener('keydown', event => this.#key(event));
    svg.addEventListener('pointermove', event => onLook(this.#under(event) ?? this.#at));
    svg.addEventListener('pointerleave', () => onLook(this.#at));
    svg.addEventListener('focus', () => {
      if (svg.matches(':focus-visible')) {
        this.#choose(this.#at ?? this.#items[0]);
      }
    });
  }

  /** What can be chosen. */
  get items() {
    return this.#items;
  }

  /** Shows these, the first on top: each has x, y (its middle), element, label, text, gait and overrides. */
  fill(background, items) {
    this.#items = items;
    this.#at = null;
    const group = draw('g', {role: 'presentation'});
    items.forEach((item, i) => {
      Object.entries({role: 'option', id: `${this.#svg.id}-${i}`, 'aria-label': item.text, 'aria-selected': false,
        class: `gait ${item.element.getAttribute('class') ?? ''}`}).forEach(([name, value]) => item.element.setAttribute(name, value));
      group.prepend(item.element);
    });
    this.#svg.replaceChildren(...background, group);
    this.#onLook(null);
  }

  /** Marks what swims, null for something else; it is chosen too. */
  mark(swimmer) {
    const found = swimmer === null ? undefined : this.#items.find(item => isSameSwimmer(item, swimmer));
    for (const item of this.#items) {
      item.element.classList.toggle('swims', item === found);
    }
    if (found !== undefined) {
      this.#raise(found);
      this.#choose(found);
    }
  }

  /** Above its neighbours, so that its frame is seen whole. */
  #raise(item) {
    item.element.parentNode.append(item.element);
  }

  #choose(item) {
    if (item === undefined) {
      return;
    }
    this.#at?.element.setAttribute('aria-selected', false);
    this.#at = item;
    item.element.setAttribute('aria-selected', true);
    this.#svg.setAttribute('aria-activedescendant', item.element.id);
    this.#raise(item);
    this.#onLook(item);
  }

  /** The gait at a place of the pointer. */
  #under(event) {
    const hit = this.#items.find(item => item.element === event.target);
    if (hit !== undefined) {
      return hit;
    }
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.#svg.getScreenCTM().inverse());
    const far = item => Math.hypot(item.x - at.x, item.y - at.y);
    return this.#items.filter(item => far(item) < REACH).sort((a, b) => far(a) - far(b))[0];
  }

  #click(event) {
    const item = this.#under(event);
    if (item !== undefined) {
      this.#choose(item);
      this.#onWatch(item);
    }
  }

  #key(event) {
    const {key} = event;
    if (key in ARROWS) {
      this.#choose(this.#next(...ARROWS[key]));
    } else if (key === 'Home' || key === 'End') {
      this.#choose(this.#items.at(key === 'Home' ? 0 : -1));
    } else if (key === 'Enter' && this.#at !== null) {
      this.#onWatch(this.#at);
    } else {
      return;
    }
    event.preventDefault();
  }

  /** The nearest in a direction; what lies beside it counts as three times as far. */
  #next(right, down) {
    const from = this.#at;
    if (from === null) {
      return this.#items[0];
    }
    let best;
    let least = Infinity;
    for (const item of this.#items) {
      const along = right * (item.x - from.x) + down * (item.y - from.y);
      const beside = Math.abs(down * (item.x - from.x) + right * (item.y - from.y));
      if (along > 1e-6 && along + 3 * beside < least) {
        least = along + 3 * beside;
        best = item;
      }
    }
    return best;
  }
}
