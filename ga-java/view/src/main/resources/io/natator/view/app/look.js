/** What of the scene is shown, and how: water, body, colours, muscles, trace. */

import {byId, choose, fillSegments, fillSelect, make} from './element.js';
import {FIELDS} from './fields.js';
import {Legend} from './legend.js';
import {LEVELS} from './quality.js';
import {isParticles, isPlane, waterShown, watersOf} from './scene.js';

const WATERS = [['spheres', 'Spheres'], ['surface', 'Surface'], ['vorticity', 'Vorticity', 'A plane, coloured by how the water turns'],
  ['velocity', 'Velocity', 'A plane, coloured by speed, with arrows along it'],
  ['pressure', 'Pressure', 'A plane, coloured by the pressure less its mean at that height'],
  ['vortices', 'Vortices', 'Surfaces around water that turns more than it strains (Q-criterion)'], ['none', 'None']];
const BODIES = [['skin', 'Skin'], ['particles', 'Particles']];
const SWITCHES = [
  ['muscles', 'Muscles', 'm'], ['trace', 'Trace', 't'], ['dye', 'Dye', 'y'], ['cut', 'Cut open', 'x'],
  ['pressure', 'Pressure on the body', 'u'], ['forces', 'Forces on it', 'o'],
];
const PLANES = [['level', 'Level'], ['along', 'Along', 'Upright, along the tank'], ['across', 'Across', 'Upright, across the tank']];

/** Controls of the picture and its legend; for the live page and for replays. */
export class LookControls {
  #look;
  #onChange;
  #water;
  #plane;
  #place;
  #body;
  #legend = new Legend();
  #colour;
  #opacity;
  #quality;
  #drawing;
  #switches = new Map();
  #has = {water: true, lattice: false, wake: true, vortices: true, forces: true, muscles: true, bodies: true, others: false};

  /** `onChange(look)` is called with each change; see `DEFAULT_LOOK` in stage.js. */
  constructor(look, onChange) {
    this.#look = {...look};
    this.#onChange = onChange;
    this.#water = make('div', {className: 'segments wide', role: 'radiogroup', 'aria-label': 'Water'});
    fillSegments(this.#water, 'water', WATERS, value => this.set({water: value}));
    this.#plane = make('div', {className: 'segments wide', role: 'radiogroup', 'aria-label': 'Plane through the water'});
    fillSegments(this.#plane, 'plane', PLANES, value => this.set({plane: value}));
    this.#place = make('input', {type: 'range', id: 'place', min: -1, max: 1, step: 0.02, 'data-testid': 'place',
      title: 'Of the plane, from the body: −1 to 1 body lengths'});
    this.#place.addEventListener('input', () => this.set({place: Number(this.#place.value)}));
    this.#body = make('div', {className: 'segments wide', role: 'radiogroup', 'aria-label': 'Body',
      title: 'Without a graphics card it is drawn as particles'});
    fillSegments(this.#body, 'body', BODIES, value => this.set({body: value}));
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
    byId('look').replaceChildren(row('Water', this.#water, null), row('Plane', this.#plane, null),
        row('Place', this.#place, 'place'), row('Body', this.#body, null), row('Coloured by', this.#colour, 'colour'),
        row('Opacity', this.#opacity, 'opacity'), row('Detail', this.#quality, 'quality'),
        row('Drawn by', this.#drawing, 'drawing'),
        make('div', {className: 'switches'}, ...switches));
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

  /** The next way to show water or the body, or to colour water. */
  next(name) {
    const choices = {water: watersOf(this.#has), body: valuesOf(BODIES), plane: valuesOf(PLANES)}[name] ?? Object.keys(FIELDS);
    const now = name === 'water' ? waterShown(this.#look.water, this.#has) : this.#look[name];
    this.set({[name]: choices[(choices.indexOf(now) + 1) % choices.length]});
  }

  toggle(name) {
    this.set({[name]: !this.#look[name]});
  }

  /** What there is that the legend is about; see `Legend.show`. */
  set has(value) {
    this.#has = value;
    this.#show();
  }

  /** Ends of the colour scale. */
  showRange(range) {
    this.#legend.range = range;
    this.#show();
  }

  /** Ends of the colour scale of vorticity. */
  showTurning(range) {
    this.#legend.turning = range;
    this.#show();
  }

  /** Likewise of pressure on the body. */
  showPressure(range) {
    this.#legend.pressed = range;
    this.#show();
  }

  /** The force of an arrow of 0.4 body lengths, behind 0. */
  showForce(range) {
    this.#legend.force = range[1];
    this.#show();
  }

  #show() {
    const {plane, place, body, colour, opacity, quality, drawing} = this.#look;
    const water = waterShown(this.#look.water, this.#has);
    choose(this.#water, water);
    for (const input of this.#water.querySelectorAll('input')) {
      input.parentElement.hidden = !watersOf(this.#has).includes(input.value);
    }
    this.#colour.disabled = !isParticles(water);
    this.#opacity.disabled = isPlane(water) || water === 'none';
    this.#plane.parentElement.hidden = this.#place.parentElement.hidden = !isPlane(water) || !this.#has.vortices;
    choose(this.#plane, plane);
    this.#place.value = place;
    this.#place.setAttribute('aria-valuetext', `${place} body lengths from the body`);
    choose(this.#body, body);
    this.#colour.value = colour;
    this.#opacity.value = opacity;
    this.#quality.value = quality;
    this.#drawing.value = drawing;
    for (const [name, input] of this.#switches) {
      input.checked = this.#look[name];
      input.disabled = name === 'dye' && !this.#has.wake || name === 'forces' && !this.#has.forces
          || name === 'pressure' && !(this.#has.forces && this.#has.wake);
    }
    this.#legend.show(this.#look, this.#has);
  }
}

function valuesOf(choices) {
  return choices.map(([value]) => value);
}

function row(text, input, id) {
  const label = id === null ? make('span', {textContent: text}) : make('label', {htmlFor: id, textContent: text});
  input.style.gridColumn = '2 / -1';
  return make('div', {className: 'control'}, label, input);
}
