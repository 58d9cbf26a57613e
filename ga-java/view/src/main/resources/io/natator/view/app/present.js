/** Presentation: the pictures alone, which the camera goes slowly round. */

import {byId} from './element.js';

/** Hides the controls and fills the screen, where the browser lets it. */
export class Presentation {
  #onChange;
  #isOn = false;
  #before = null;

  /** `onChange(isOn)` is called with each change. */
  constructor(onChange) {
    this.#onChange = onChange;
    byId('present').addEventListener('click', () => this.toggle());
    byId('present-end').addEventListener('click', () => this.end());
    addEventListener('keydown', event => event.key === 'Escape' && this.end());
    document.addEventListener('fullscreenchange', () => document.fullscreenElement === null && this.end());
  }

  get isOn() {
    return this.#isOn;
  }

  toggle() {
    if (this.#isOn) {
      this.end();
    } else {
      this.#begin();
    }
  }

  #begin() {
    this.#isOn = true;
    this.#before = document.activeElement;
    document.body.classList.add('presenting');
    byId('present-end').hidden = false;
    byId('present-end').focus();
    // Without the whole screen it is the whole window.
    document.documentElement.requestFullscreen?.().catch(() => {});
    this.#onChange(true);
  }

  /** Back to the controls. */
  end() {
    if (!this.#isOn) {
      return;
    }
    this.#isOn = false;
    document.body.classList.remove('presenting');
    byId('present-end').hidden = true;
    if (document.fullscreenElement !== null) {
      document.exitFullscreen().catch(() => {});
    }
    this.#before?.focus();
    this.#onChange(false);
  }
}
