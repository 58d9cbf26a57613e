/** The figures that are always shown on a stage. */

import {fixed} from './scaling.js';

const SLOW_FPS = 50;

/** Time, frames drawn and dropped, pace, distance and detail of the picture. */
export class Figures {
  #cells;
  #title;
  #overlay;

  constructor(stage) {
    const cell = name => stage.querySelector(`[data-figure="${name}"]`);
    const names = ['time', 'fps', 'dropped', 'pace', 'distance', 'quality'];
    this.#cells = Object.fromEntries(names.map(name => [name, cell(name)]));
    this.#title = stage.querySelector('figcaption');
    this.#overlay = stage.querySelector('.overlay');
  }

  /** Shows those of a view (`View`, or what replays). */
  show(view) {
    const {frame, scene} = view;
    this.#overlay.hidden = frame !== null;
    if (frame === null) {
      return;
    }
    const moving = !view.isPaused;
    this.#write('time', `${frame.time.toFixed(2)} s`);
    this.#write('fps', moving ? `${view.fps.toFixed(0)} /s` : 'paused', moving && view.pace > 0.9 && view.fps < SLOW_FPS);
    this.#write('dropped', String(view.dropped), false);
    this.#write('pace', moving ? `${view.pace.toFixed(2)} ×` : '–');
    this.#write('distance', scene.bodyLength > 0 ? fixed(frame.distance, 3) : '–');
    this.#write('quality', `${Math.round(100 * view.stage.share)} %`);
  }

  /** A name, and a line beneath it. */
  name(title, detail) {
    const small = document.createElement('small');
    small.textContent = detail;
    this.#title.replaceChildren(title, small);
  }

  #write(name, text, isBad = false) {
    const cell = this.#cells[name];
    if (cell === null) {
      return;
    }
    if (cell.textContent !== text) {
      cell.textContent = text;
    }
    cell.dataset.bad = isBad;
  }
}
