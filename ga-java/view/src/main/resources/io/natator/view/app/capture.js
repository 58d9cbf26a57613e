/** Pictures and films of what is seen: the pictures beside each other, with their captions and the legend. */

import {byId} from './element.js';
import {saveBlob} from './save.js';

const FRAMES_PER_S = 60;
const BITS_PER_S = 16e6;
/** How often an encoder that has given nothing yet is asked again once the film is to end, ms. */
const ASKED_EVERY_MS = 100;
const FORMATS = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/webm'];

/** Paints text and colour scales of the page where they stand over the pictures, in pixels of the screen. */
function paintWords(context, corner) {
  const seen = [...document.querySelectorAll('.stage:not([hidden]) figcaption, #legend:not([hidden])')];
  for (const box of seen) {
    const style = getComputedStyle(box);
    const place = box.getBoundingClientRect();
    context.fillStyle = style.backgroundColor;
    context.fillRect(place.x - corner.x, place.y - corner.y, place.width, place.height);
    for (const part of [box, ...box.querySelectorAll('*')]) {
      paintPart(context, part, corner);
    }
  }
}

function paintPart(context, part, corner) {
  const own = getComputedStyle(part);
  const place = part.getBoundingClientRect();
  if (part.className === 'legend-bar') {
    const gradient = context.createLinearGradient(place.left - corner.x, 0, place.right - corner.x, 0);
    const colours = own.backgroundImage.match(/rgba?\([^)]*\)/g) ?? [];
    colours.forEach((colour, i) => gradient.addColorStop(i / Math.max(1, colours.length - 1), colour));
    context.fillStyle = gradient;
    context.fillRect(place.x - corner.x, place.y - corner.y, place.width, place.height);
  }
  context.font = `${own.fontWeight} ${own.fontSize} ${own.fontFamily}`;
  context.fillStyle = own.color;
  context.textBaseline = 'middle';
  for (const node of part.childNodes) {
    if (node.nodeType === Node.TEXT_NODE && node.data.trim() !== '' && place.width > 0) {
      const range = document.createRange();
      range.selectNodeContents(node);
      const line = range.getBoundingClientRect();
      context.fillText(node.data, line.x - corner.x, line.y - corner.y + line.height / 2, line.width + 1);
    }
  }
}

/** Saves PNG pictures and records WebM films. */
export class Capture {
  #stages;
  #canvas = document.createElement('canvas');
  #context = this.#canvas.getContext('2d');
  #recorder = null;
  #isEnding = false;

  /**
   * Called with whether a film is being recorded.
   *
   * @type {(isOn: boolean) => void}
   */
  onRecording = () => {};

  /** `stages()` gives those that are seen (`Stage`). */
  constructor(stages) {
    this.#stages = stages;
  }

  get isRecording() {
    return this.#recorder !== null;
  }

  /** Saves a picture under this name. */
  async savePicture(name) {
    this.#fit();
    this.#paint();
    const blob = await new Promise(done => this.#canvas.toBlob(done, 'image/png'));
    saveBlob(name, blob);
  }

  /** Begins to record, or ends and saves the film under this name; an error text, or null. */
  toggleRecording(name) {
    if (this.isRecording) {
      this.#end();
      return null;
    }
    const format = globalThis.MediaRecorder === undefined ? undefined : FORMATS.find(one => MediaRecorder.isTypeSupported(one));
    if (format === undefined) {
      return 'This browser records no WebM.';
    }
    this.#fit();
    this.#paint();
    const parts = [];
    const stream = this.#canvas.captureStream(FRAMES_PER_S);
    this.#recorder = new MediaRecorder(stream, {mimeType: format, videoBitsPerSecond: BITS_PER_S});
    this.#isEnding = false;
    this.#recorder.ondataavailable = event => {
      if (event.data.size > 0) {
        parts.push(event.data);
      }
      if (this.#isEnding && this.#recorder.state === 'recording') {
        this.#endOrAsk(parts);
      }
    };
    this.#recorder.onstop = () => {
      stream.getTracks().forEach(track => track.stop());
      this.#recorder = null;
      this.onRecording(false);
      if (parts.length > 0) {
        saveBlob(name, new Blob(parts, {type: 'video/webm'}));
      }
    };
    this.#recorder.start(1000);
    this.onRecording(true);
    return null;
  }

  /** To be called after the pictures were drawn: takes the next picture of the film. */
  tick() {
    if (this.isRecording) {
      this.#paint();
    }
  }

  /** A film that is ended before the encoder gave any of it would be empty, so that is waited for; not if asked to end again. */
  #end() {
    if (this.#isEnding) {
      this.#recorder.stop();
    } else {
      this.#isEnding = true;
      this.#recorder.requestData();
    }
  }

  #endOrAsk(parts) {
    if (parts.length > 0) {
      this.#recorder.stop();
      return;
    }
    setTimeout(() => {
      if (this.#recorder?.state === 'recording') {
        this.#paint();
        this.#recorder.requestData();
      }
    }, ASKED_EVERY_MS);
  }

  /** Gives the canvas the size of the pictures; a film keeps the size that it began with. */
  #fit() {
    const box = byId('stages').getBoundingClientRect();
    if (!this.isRecording) {
      this.#canvas.width = 2 * Math.round(box.width * devicePixelRatio / 2);
      this.#canvas.height = 2 * Math.round(box.height * devicePixelRatio / 2);
    }
  }

  #paint() {
    const box = byId('stages').getBoundingClientRect();
    const context = this.#context;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = getComputedStyle(document.body).backgroundColor;
    context.fillRect(0, 0, this.#canvas.width, this.#canvas.height);
    context.setTransform(this.#canvas.width / box.width, 0, 0, this.#canvas.height / box.height, 0, 0);
    for (const stage of this.#stages()) {
      stage.paintOn(context, box);
    }
    paintWords(context, box);
  }
}
