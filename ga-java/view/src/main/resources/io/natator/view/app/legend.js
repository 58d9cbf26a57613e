/** What the colours and lines of a picture mean: what, unit and range of each. */

import {SCALES, clusterColours, cssGradient, fadingGradient} from './colours.js';
import {byId, make} from './element.js';
import {FIELDS} from './fields.js';
import {MARK_SPACING, isParticles} from './scene.js';
import {axisText, niceStep} from './scaling.js';
import {SPINE_INTERVAL} from './trace.js';

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
  #clusters = new Scale('legend-clusters');
  #lines = make('div', {className: 'legend-lines', 'data-testid': 'legend-lines'});
  #range = [0, 1];
  #turning = [-1, 1];

  constructor() {
    this.#root.replaceChildren(...[this.#water, this.#turns, this.#muscles, this.#clusters].map(one => one.element), this.#lines);
  }

  /** Ends of the water's colour scale. */
  set range(range) {
    this.#range = range;
  }

  /** Likewise of vorticity. */
  set turning(range) {
    this.#turning = range;
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
    this.#muscles.hidden = !look.muscles || !has.muscles;
    const colours = clusterColours(7).map(colour => `rgb(${colour.map(value => Math.round(255 * value)).join(' ')})`);
    this.#clusters.show('Body: its clusters', 'head', 'tail', `linear-gradient(to right, ${colours.join(', ')})`);
    this.#clusters.hidden = !has.bodies || look.body === 'skin' && look.muscles;
    const lines = [`Tiles: ${MARK_SPACING} length units`];
    if (look.trace && has.bodies) {
      lines.push(`Lines: spine every ${SPINE_INTERVAL} s, path of the head`);
    }
    if (look.dye && has.wake && has.bodies) {
      lines.push('Dots: dye from the tail');
    }
    if (has.others) {
      lines.push('Grey bodies: companions, obstacles');
    }
    this.#lines.replaceChildren(...lines.map(text => make('div', {textContent: text})));
  }

  #showTurns({water}, has) {
    const [low, high] = this.#turning;
    const isSpace = water === 'vortices' && has.vortices;
    this.#turns.show(`${isSpace ? 'Vortices: vorticity about the vertical' : 'Water: vorticity'}, 1/s; above 0 it turns left`,
        axisText(low, high), axisText(high, high), isSpace ? cssGradient(SCALES.turning) : fadingGradient(SCALES.turning));
    this.#turns.hidden = isParticles(water) ? !has.lattice : water === 'none' || !has.wake;
  }
}
