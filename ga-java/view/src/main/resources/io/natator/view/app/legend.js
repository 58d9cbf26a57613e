/** What the colours and lines of a picture mean: what, unit and range of each. */

import {SCALES, bytesGradient, clusterColours, cssGradient, fadingBytes, risingBytes} from './colours.js';
import {byId, make} from './element.js';
import {FIELDS} from './fields.js';
import {MARK_SPACING, isParticles, waterShown} from './scene.js';
import {axisText, niceStep} from './scaling.js';
import {SPINE_INTERVAL} from './trace.js';

/** Title and colours of what can be seen of a wake. */
const WAKES = {
  vorticity: ['Water: vorticity, 1/s; above 0 it turns left', bytesGradient(fadingBytes(SCALES.turning))],
  upright: ['Water: vorticity across the plane, 1/s', bytesGradient(fadingBytes(SCALES.turning))],
  velocity: ['Water: speed, length/s; arrows along the plane', bytesGradient(risingBytes(SCALES.sequential))],
  pressure: ['Water: pressure, mass/(length s²), less the mean at its height', bytesGradient(fadingBytes(SCALES.diverging))],
  vortices: ['Vortices: vorticity about the vertical, 1/s; above 0 it turns left', cssGradient(SCALES.turning)],
};

/** A colour scale between two ends. */
class Scale {
  #title = make('span');
  #low = make('span');
  #high = make('span');
  #bar = make('div', {className: 'legend-bar'});

  constructor(testId) {
    this.element = make('div', {'data-testid': testId}, this.#title,
        make('div', {className: 'legend-scale'}, this.#low, this.#bar, this.#high));
  }

  show(title, low, high, gradient) {
    this.#title.textContent = title;
    this.#low.textContent = low;
    this.#high.textContent = high;
    this.#bar.style.background = gradient;
  }

  set hidden(value) {
    this.element.hidden = value;
  }
}

/** The legend over the pictures; entries are there only for what is shown. */
export class Legend {
  #root = byId('legend');
  #water = new Scale('legend-water');
  #turns = new Scale('legend-turns');
  #muscles = new Scale('legend-muscles');
  #pressure = new Scale('legend-pressure');
  #clusters = new Scale('legend-clusters');
  #lines = make('div', {className: 'legend-lines', 'data-testid': 'legend-lines'});
  #range = [0, 1];
  #turning = [-1, 1];
  #pressed = [-1, 1];
  #force = 1;

  constructor() {
    this.#root.replaceChildren(...[this.#water, this.#turns, this.#muscles, this.#pressure, this.#clusters].map(one => one.element), this.#lines);
  }

  /** Ends of the water's colour scale. */
  set range(range) {
    this.#range = range;
  }

  /** Likewise of vorticity. */
  set turning(range) {
    this.#turning = range;
  }

  /** Likewise of pressure on the body. */
  set pressed(range) {
    this.#pressed = range;
  }

  /** The force of an arrow of 0.4 body lengths, mass length/s². */
  set force(force) {
    this.#force = force;
  }

  /**
   * Shows what belongs to a look.
   *
   * @param {object} look see `DEFAULT_LOOK` in stage.js
   * @param {object} has what there is; see `contents`
   */
  show(look, has) {
    const {title, unit} = FIELDS[look.colour];
    const [low, high] = this.#range;
    const step = niceStep((high - low) / 100) * 10;
    this.#water.show(unit === '' ? title : `Water: ${title.toLowerCase()}, ${unit}`, axisText(low, step), axisText(high, step),
        cssGradient(SCALES.sequential));
    this.#water.hidden = !has.water || !isParticles(look.water) || look.colour === 'none';
    this.#showTurns(look, has);
    this.#muscles.show('Muscles: length asked for, against rest', '−50 %', '+50 %', cssGradient(SCALES.diverging));
    const isPressed = look.pressure && has.forces && has.bodies && has.wake;
    this.#muscles.hidden = !look.muscles || !has.muscles || isPressed && look.body === 'skin';
    this.#pressure.show('Body: pressure, mass/(length s²), less the mean at its height', endText(this.#pressed[0]), endText(this.#pressed[1]),
        cssGradient(SCALES.diverging));
    this.#pressure.hidden = !isPressed;
    const colours = clusterColours(7).map(colour => `rgb(${colour.map(value => Math.round(255 * value)).join(' ')})`);
    this.#clusters.show('Body: its clusters', 'head', 'tail', `linear-gradient(to right, ${colours.join(', ')})`);
    this.#clusters.hidden = !has.bodies || look.body === 'skin' && look.muscles || isPressed;
    const lines = [`Tiles: ${MARK_SPACING} length units`];
    if (look.trace && has.bodies) {
      lines.push(`Lines: spine every ${SPINE_INTERVAL} s, path of the head`);
    }
    if (look.dye && has.wake && has.bodies) {
      lines.push('Dots: dye from the tail');
    }
    if (look.forces && has.forces) {
      lines.push(`Arrows on the body: force of the water; one of 0.4 body lengths is ${endText(this.#force)} mass length/s²`);
    }
    if (has.others) {
      lines.push('Grey bodies: companions, obstacles');
    }
    this.#lines.replaceChildren(...lines.map(text => make('div', {textContent: text})));
  }

  #showTurns(look, has) {
    const [low, high] = this.#turning;
    const water = waterShown(look.water, has);
    const isUpright = water === 'vorticity' && has.vortices && look.plane !== 'level';
    const [title, colours] = WAKES[isUpright ? 'upright' : water] ?? ['', ''];
    this.#turns.show(title, endText(low), endText(high), colours);
    this.#turns.hidden = title === '';
  }
}

/** An end of a scale. */
function endText(value) {
  if (value !== 0 && (Math.abs(value) >= 1e4 || Math.abs(value) < 1e-3)) {
    const [digits, power] = value.toExponential(0).split('e');
    return `${digits}·10${[...String(Number(power))].map(one => '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(one)] ?? '⁻').join('')}`.replace(/^-/, '−');
  }
  return axisText(value, Math.abs(value) || 1).replace('-', '−');
}
