/** What of the scene is shown, and how: water, colours, muscles, trace, and the legend. */

import {SCALES, cssGradient} from './colours.js';
import {byId, choose, fillSegments, fillSelect, make} from './element.js';
import {FIELDS} from './fields.js';
import {LEVELS} from './quality.js';
import {axisText, niceStep} from './scaling.js';

const WATERS = [['spheres', 'Spheres'], ['surface', 'Surface'], ['none', 'None']];
const SWITCHES = [
  ['muscles', 'Muscles', 'm'], ['trace', 'Trace', 't'], ['cut', 'Cut open', 'x'],
];

/** Controls of the picture and its legend; for the live page and for replays. */
export class LookControls {
  #look;
  #onChange;
  #water;
  #colour;
  #opacity;
  #quality;
  #drawing;
  #switches = new Map();
  #hasWater = true;

  /** `onChange(look)` is called with each change; see `DEFAULT_LOOK` in stage.js. */
  constructor(look, onChange) {
    this.#look = {...look};
    this.#onChange = onChange;
    this.#water = make('div', {className: 'segments wide', role: 'radiogroup', 'aria-label': 'Water'});
    fillSegments(this.#water, 'water', WATERS, value => this.set({water: value}));
    this.#colour = make('select', {id: 'colour', 'data-testid': 'colour'});
    fillSelect(this.#colour, Object.entries(FIELDS).map(([name, {title}]) => [name, title]));
    this.#colour.addEventListener('change', () => this.set({colour: this.#colour.value}));
    this.#opacity = make('input', {
      type: 'range', id: 'opacity', min: 0.1, max: 1, step: 0.05, 'data-testid': 'opacity',
    });
    this.#opacity.addEventListener('input', () => this.set({opacity: Number(this.#opacity.value)}));
    this.#quality = make('select', {id: 'quality', 'data-testid': 'quality'});
    fillSelect(this.#quality, [['auto', 'automatic'],
      ...LEVELS.map(level => [level, `${Math.round(100 * level)} % of the pixels' width`])]);
    this.#quality.addEventListener('change', () => this.set({quality: this.#quality.value}));
    this.#drawing = make('select', {id: 'drawing', 'data-testid': 'drawing'});
    fillSelect(this.#drawing, [['auto', 'automatic'], ['webgl', 'WebGL'], ['plain', 'the processor']]);
    this.#drawing.addEventListener('change', () => this.set({drawing: this.#drawing.value}));
    const switches = SWITCHES.map(([name, text, key]) => {
      const input = make('input', {type: 'checkbox', 'data-testid': name});
      input.addEventListener('change', () => this.set({[name]: input.checked}));
      this.#switches.set(name, input);
      return make('label', {className: 'switch', title: `key ${key}`}, input, text);
    });
    byId('look').replaceChildren(row('Water', this.#water, null), row('Coloured by', this.#colour, 'colour'),
        row('Opacity', this.#opacity, 'opacity'), row('Detail', this.#quality, 'quality'),
        row('Drawn by', this.#drawing, 'drawing'),
        make('div', {className: 'switches'}, ...switches));
    byId('legend-bar').style.background = cssGradient(SCALES.sequential);
    byId('legend-change').style.background = cssGradient(SCALES.diverging);
    this.#show();
  }

  get look() {
    return {...this.#look};
  }

  /** Changes some of it. */
  set(change) {
    this.#look = {...this.#look, ...change};
    this.#show();
    this.#onChange(this.look);
  }

  /** The next way to show water, or to colour it. */
  next(name) {
    const choices = name === 'water' ? WATERS.map(([value]) => value) : Object.keys(FIELDS);
    this.set({[name]: choices[(choices.indexOf(this.#look[name]) + 1) % choices.length]});
  }

  toggle(name) {
    this.set({[name]: !this.#look[name]});
  }

  /** Whether there is water that the legend is about. */
  set hasWater(value) {
    this.#hasWater = value;
    this.#show();
  }

  /** Ends of the colour scale. */
  showRange([low, high]) {
    const step = niceStep((high - low) / 100);
    byId('legend-low').textContent = axisText(low, step * 10);
    byId('legend-high').textContent = axisText(high, step * 10);
  }

  #show() {
    const {water, colour, opacity, quality, drawing, muscles} = this.#look;
    choose(this.#water, water);
    this.#colour.value = colour;
    this.#opacity.value = opacity;
    this.#quality.value = quality;
    this.#drawing.value = drawing;
    for (const [name, input] of this.#switches) {
      input.checked = this.#look[name];
    }
    const {title, unit} = FIELDS[colour];
    byId('legend-title').textContent = unit === '' ? title : `${title}, ${unit}`;
    const isWater = this.#hasWater && water !== 'none';
    byId('legend-title').hidden = !isWater;
    byId('legend-bar').parentElement.hidden = !isWater;
    byId('legend-muscles').hidden = !muscles;
    byId('legend').hidden = !isWater && !muscles;
  }
}

function row(text, input, id) {
  const label = id === null ? make('span', {textContent: text}) : make('label', {htmlFor: id, textContent: text});
  input.style.gridColumn = '2 / -1';
  return make('div', {className: 'control'}, label, input);
}
