/** Draws without WebGL: spheres by the processor into pixels, lines with the 2-d canvas. */

import {Color} from 'three';
import {addArrows} from './arrows.js';
import {SCALES, colourAt, scaleBytes} from './colours.js';
import {Discs, LIGHTS} from './discs.js';
import {vortexOpacity} from './wake.js';
import {dyeStrength} from './dye.js';
import {addArea, addLine, addLines} from './plain-lines.js';
import {PlainSkin} from './plain-skin.js';
import {PlainSlice} from './plain-slice.js';
import {SphereLayer, shades} from './plain-spheres.js';
import {SurfaceLayer} from './plain-surface.js';
import {Projector} from './projector.js';
import {BODY_RADIUS, MUSCLE_WIDTH, SURFACE_RADIUS, WATER_RADIUS, bodySpacing, distinctMuscles, isParticles, muscleChange,
  solidKinds, tankLines} from './scene.js';
import {NearestFirst} from './sort.js';
import {SPINES} from './trace.js';

/** Colours of water. */
const COLOURS = 256;
const CHANGES = 33;
const DYE_STEPS = 6;
/** Half the width of an arrow of force, pixels. */
const ARROW_WIDTH = 1.5;
/** Radius of the discs that a vortex' surface is drawn with, in cells. */
const VORTEX_RADIUS = 0.72;
/** Pixels of the surface for each of the spheres' layer, along each side, while it moves. */
const SURFACE_SHARE = 0.5;

/** One canvas; the same methods as `GlPicture`. */
export class PlainPicture {
  #canvas;
  #context;
  #layerCanvas = document.createElement('canvas');
  #layerContext;
  #layer = new SphereLayer();
  #surfaceCanvas = document.createElement('canvas');
  #surfaceContext;
  #surface = new SurfaceLayer();
  #surfaceProjector = new Projector();
  #surfaceColours = scaleBytes(SCALES.sequential);
  #discs = new Discs();
  #skin = new PlainSkin();
  #slice = new PlainSlice();
  #wake;
  #dye;
  #forces;
  #pressure;
  #order = new NearestFirst();
  #projector = new Projector();
  #lineProjector = new Projector();
  #trace;
  #field;
  /** @type {Scene|null} */
  #scene = null;
  #values = new Float32Array(0);
  /** @type {Int16Array} */
  #kinds = new Int16Array(0);
  /** @type {Uint8Array} */
  #joints = new Uint8Array(0);
  #muscles = [];
  #lines = null;
  #look = null;
  #colours = null;
  #sky = [255, 255, 255];
  #waterShades = null;
  #turnShades = null;
  #bodyShades = null;
  #pressureShades = shades(Array.from({length: COLOURS}, (_, i) => colourAt(SCALES.diverging, i / (COLOURS - 1))), 1);
  #changeColours = Array.from({length: CHANGES}, (_, i) => css(colourAt(SCALES.diverging, i / (CHANGES - 1))));
  #lineWidth = 1;
  #surfaceShare = SURFACE_SHARE;
  #place = [0, 0, 0];

  constructor(canvas, {trace, field, wake, dye, forces, pressure}) {
    this.#canvas = canvas;
    this.#context = canvas.getContext('2d', {alpha: false});
    this.#layerContext = this.#layerCanvas.getContext('2d');
    this.#surfaceContext = this.#surfaceCanvas.getContext('2d');
    this.#trace = trace;
    this.#field = field;
    this.#wake = wake;
    this.#dye = dye;
    this.#forces = forces;
    this.#pressure = pressure;
  }

  /** What draws, for people. */
  get name() {
    return 'processor';
  }

  /** How often a picture that rests is drawn again by `refine`. */
  get samples() {
    return 1;
  }

  /** Whether it still draws. */
  get isBusy() {
    return false;
  }

  /**
   * Draws a picture that rests, with a finer surface.
   *
   * @param {Frame} frame
   */
  refine(frame, camera, from) {
    this.#surfaceShare = 1;
    this.#fitSurface();
    this.draw(frame, camera, from);
    this.#surfaceShare = SURFACE_SHARE;
    this.#fitSurface();
  }

  /** Makes the canvas hold what was drawn last: it does so always. */
  show() {}

  setScene(scene) {
    this.#scene = scene;
    this.#skin.setScene(scene);
    this.#values = new Float32Array(scene.fluid[1]);
    const kinds = solidKinds(scene);
    this.#kinds = kinds.of;
    this.#joints = kinds.joint;
    this.#muscles = distinctMuscles(scene);
    this.#bodyShades = shades(kinds.colours, 1);
  }

  setBounds(bounds) {
    this.#lines = tankLines(bounds);
  }

  setLook(look) {
    this.#look = look;
    const shadesOf = (scale, opacity) => shades(Array.from({length: COLOURS}, (_, i) => colourAt(scale, i / (COLOURS - 1))),
        Math.min(opacity, 0.995));
    this.#waterShades = shadesOf(SCALES.sequential, look.opacity);
    this.#turnShades = shadesOf(SCALES.turning, vortexOpacity(look.opacity));
  }

  setTheme(colours) {
    this.#colours = colours;
    this.#sky = new Color(colours.sky).toArray().map(value => 255 * value);
  }

  /** The size in CSS pixels, and the share of them that spheres are drawn with along each side. */
  setSize(width, height, share) {
    const ratio = Math.min(devicePixelRatio, 1);
    this.#canvas.width = Math.round(width * ratio * share);
    this.#canvas.height = Math.round(height * ratio * share);
    this.#layerCanvas.width = this.#canvas.width;
    this.#layerCanvas.height = this.#canvas.height;
    this.#lineWidth = Math.max(0.6, share);
    this.#layer.setSize(this.#layerCanvas.width, this.#layerCanvas.height);
    this.#fitSurface();
  }

  #fitSurface() {
    this.#surfaceCanvas.width = Math.max(4, Math.round(this.#surfaceShare * this.#layerCanvas.width));
    this.#surfaceCanvas.height = Math.max(4, Math.round(this.#surfaceShare * this.#layerCanvas.height));
    this.#surface.setSize(this.#surfaceCanvas.width, this.#surfaceCanvas.height);
  }

  /**
   * Draws a frame; water nearer than `from` is left out.
   *
   * @param {Frame} frame
   */
  draw(frame, camera, from) {
    this.#lineProjector.set(camera, this.#canvas.width, this.#canvas.height);
    this.#drawTank();
    if (this.#wake.slice !== null) {
      this.#slice.draw(this.#context, this.#canvas.width, this.#canvas.height, this.#lineProjector, this.#wake, this.#colours.ink);
    }
    this.#projector.set(camera, this.#layerCanvas.width, this.#layerCanvas.height);
    this.#surfaceProjector.set(camera, this.#surfaceCanvas.width, this.#surfaceCanvas.height);
    this.#drawParticles(frame, from);
    this.#context.drawImage(this.#layerCanvas, 0, 0, this.#canvas.width, this.#canvas.height);
    if (this.#look.water === 'surface') {
      this.#drawSurface();
    }
    this.#skin.draw(frame, this.#context, this.#lineProjector, this.#pressure);
    if (this.#look.muscles) {
      this.#drawMuscles(frame);
    }
    if (this.#look.trace) {
      this.#drawTrace();
    }
    if (this.#dye.count > 0) {
      this.#drawDye(frame.time);
    }
    this.#context.fillStyle = this.#colours.dye;
    this.#context.beginPath();
    addArrows(this.#context, this.#lineProjector, this.#forces.arrows, ARROW_WIDTH);
    this.#context.fill();
  }

  dispose() {
    this.#layerCanvas.width = 0;
  }

  #drawTank() {
    const context = this.#context;
    const {background, floor, marks, edges} = this.#colours;
    context.fillStyle = background;
    context.fillRect(0, 0, this.#canvas.width, this.#canvas.height);
    context.lineWidth = this.#lineWidth;
    this.#path(floor, null, () => addArea(context, this.#lineProjector, this.#lines.floor));
    this.#path(null, marks, () => addLines(context, this.#lineProjector, this.#lines.marks));
    this.#path(null, edges, () => addLines(context, this.#lineProjector, this.#lines.edges));
  }

  #path(fill, stroke, add) {
    const context = this.#context;
    context.beginPath();
    add();
    if (fill !== null) {
      context.fillStyle = fill;
      context.fill();
    } else {
      context.strokeStyle = stroke;
      context.stroke();
    }
  }

  #drawParticles(frame, from) {
    const {particles, fluid} = this.#scene;
    const projector = this.#projector;
    const isWater = isParticles(this.#look.water) && fluid[1] > 0;
    const isSurface = this.#look.water === 'surface';
    if (isWater) {
      this.#field.read(this.#look.colour, this.#scene, frame, fluid[0], fluid[1], this.#values);
    }
    const [low, high] = this.#field.range;
    const perValue = (COLOURS - 1) / (high - low);
    const places = this.#withVortices(frame.position);
    const count = this.#order.sort(places, 0, places.length / 3, projector.eye, projector.forward, 0.05);
    this.#layer.clear();
    if (isSurface) {
      this.#surface.clear();
    }
    for (let i = 0; i < count; i++) {
      const particle = this.#order.order[i];
      const kind = this.#kinds[particle];
      projector.project(places[3 * particle], places[3 * particle + 1], places[3 * particle + 2], this.#place, 0);
      const [x, y, depth] = this.#place;
      if (particle >= particles) {
        this.#vortexDisc(x, y, depth, particle - particles);
      } else if (kind >= 0) {
        this.#bodySphere(x, y, depth, kind, particle, isSurface);
      } else if (isWater && depth >= from) {
        const value = Math.round((this.#values[particle - fluid[0]] - low) * perValue);
        const colour = value < 0 ? 0 : value < COLOURS ? value : COLOURS - 1;
        if (isSurface) {
          this.#surfaceSphere(x, y, depth, colour);
        } else {
          this.#waterSphere(x, y, depth, colour);
        }
      }
    }
    this.#layerContext.putImageData(this.#layer.image, 0, 0);
  }

  /** Places of all particles, and of what vortices are surrounded by. */
  #withVortices(position) {
    const {vortices} = this.#wake;
    if (vortices === null) {
      return position;
    }
    const places = new Float32Array(position.length + vortices.vertices.length);
    places.set(position);
    places.set(vortices.vertices, position.length);
    return places;
  }

  /** A disc with the light that its surface has there: where they overlap, that looks smooth. */
  #vortexDisc(x, y, depth, vertex) {
    const {vortices: {turns, normals, cell}, range: [, most]} = this.#wake;
    const radius = VORTEX_RADIUS * cell / depth * this.#projector.pixels;
    if (isOn(this.#layerCanvas, x, y, radius)) {
      const {forward} = this.#projector;
      const [right, up, front] = normals.subarray(3 * vertex, 3 * vertex + 3);
      const facing = Math.abs(forward.x * right + forward.y * up + forward.z * front);
      const light = Math.round((LIGHTS - 1) * Math.min(1, Math.max(0, 0.1 + 0.7 * facing + 0.2 * up)));
      const colour = Math.round((COLOURS - 1) * (0.5 + 0.5 * Math.min(1, Math.max(-1, turns[vertex] / most))));
      const disc = this.#discs.of(radius, x - Math.floor(x), y - Math.floor(y));
      this.#layer.flat(disc, Math.floor(x) - disc.half, Math.floor(y) - disc.half, this.#turnShades[LIGHTS * colour + light]);
    }
  }

  #waterSphere(x, y, depth, colour) {
    const radius = WATER_RADIUS * this.#scene.fluidRestDistance / depth * this.#projector.pixels;
    if (isOn(this.#layerCanvas, x, y, radius)) {
      const disc = this.#discs.of(radius, x - Math.floor(x), y - Math.floor(y));
      this.#layer.water(disc, Math.floor(x) - disc.half, Math.floor(y) - disc.half, this.#waterShades, colour * LIGHTS);
    }
  }

  #bodySphere(x, y, depth, cluster, particle, blocks) {
    const radius = BODY_RADIUS * bodySpacing(this.#scene) / depth * this.#projector.pixels;
    if (!isOn(this.#layerCanvas, x, y, radius)) {
      return;
    }
    const disc = this.#discs.of(radius, x - Math.floor(x), y - Math.floor(y));
    const {isKnown, shares} = this.#pressure;
    this.#layer.body(disc, Math.floor(x) - disc.half, Math.floor(y) - disc.half, isKnown ? this.#pressureShades : this.#bodyShades,
        LIGHTS * (isKnown ? Math.round((COLOURS - 1) * (0.5 + 0.5 * shares[particle])) : cluster), this.#joints[particle] === 1);
    if (blocks) {
      const small = this.#discs.of(this.#surfaceShare * radius, 0.5, 0.5);
      this.#surface.block(small, Math.floor(this.#surfaceShare * x) - small.half, Math.floor(this.#surfaceShare * y) - small.half);
    }
  }

  #surfaceSphere(x, y, depth, colour) {
    const size = SURFACE_RADIUS * this.#scene.fluidRestDistance;
    const radius = size / depth * this.#surfaceProjector.pixels;
    const column = this.#surfaceShare * x;
    const row = this.#surfaceShare * y;
    if (isOn(this.#surfaceCanvas, column, row, radius)) {
      const disc = this.#discs.of(radius, column - Math.floor(column), row - Math.floor(row));
      this.#surface.water(disc, Math.floor(column) - disc.half, Math.floor(row) - disc.half, depth, size, colour);
    }
  }

  #drawSurface() {
    const edge = 1.5 * SURFACE_RADIUS * this.#scene.fluidRestDistance;
    this.#surface.smooth(edge);
    this.#surface.shade(this.#surfaceProjector, this.#surfaceColours, this.#look.opacity, this.#sky, edge);
    this.#surfaceContext.putImageData(this.#surface.image, 0, 0);
    this.#context.drawImage(this.#surfaceCanvas, 0, 0, this.#canvas.width, this.#canvas.height);
  }

  #drawMuscles(frame) {
    const context = this.#context;
    const width = MUSCLE_WIDTH * bodySpacing(this.#scene) * this.#lineProjector.pixels;
    const place = particle => frame.position.subarray(3 * particle, 3 * particle + 3);
    for (const muscle of this.#muscles) {
      const a = place(muscle.a);
      context.lineWidth = Math.max(1, width / Math.max(0.05, this.#lineProjector.depth(...a)));
      context.strokeStyle = this.#changeColours[Math.round((CHANGES - 1) * (0.5 + 0.5 * muscleChange(muscle, frame)))];
      context.beginPath();
      addLine(context, this.#lineProjector, Array.from(a), Array.from(place(muscle.b)));
      context.stroke();
    }
  }

  #drawTrace() {
    const context = this.#context;
    const {spines, strength, slices, head, headPlaces} = this.#trace;
    context.strokeStyle = this.#colours.ink;
    context.lineWidth = this.#lineWidth;
    for (let spine = 0; spine < SPINES; spine++) {
      if (strength[spine] > 0) {
        context.globalAlpha = 0.75 * strength[spine] ** 1.5;
        this.#polyline(spines, spine * slices, slices);
      }
    }
    context.globalAlpha = 0.9;
    this.#polyline(head, 0, headPlaces);
    context.globalAlpha = 1;
  }

  /** The older the fainter, in a few steps. */
  #drawDye(time) {
    const context = this.#context;
    const {places, born, count} = this.#dye;
    context.fillStyle = this.#colours.dye;
    for (let step = 1; step <= DYE_STEPS; step++) {
      context.globalAlpha = step / DYE_STEPS;
      context.beginPath();
      for (let i = 0; i < count; i++) {
        if (Math.ceil(DYE_STEPS * dyeStrength(time - born[i])) === step) {
          this.#lineProjector.project(places[3 * i], places[3 * i + 1], places[3 * i + 2], this.#place, 0);
          if (this.#place[2] > 0.05) {
            context.rect(this.#place[0] - 1, this.#place[1] - 1, 2, 2);
          }
        }
      }
      context.fill();
    }
    context.globalAlpha = 1;
  }

  #polyline(places, first, count) {
    const context = this.#context;
    context.beginPath();
    for (let i = first; i < first + count; i++) {
      this.#lineProjector.project(places[3 * i], places[3 * i + 1], places[3 * i + 2], this.#place, 0);
      if (this.#place[2] > 0.05) {
        context.lineTo(this.#place[0], this.#place[1]);
      }
    }
    context.stroke();
  }
}

/** Whether any of a disc is within a canvas. */
function isOn(canvas, x, y, radius) {
  return x + radius > 0 && y + radius > 0 && x - radius < canvas.width && y - radius < canvas.height;
}

function css(colour) {
  return `rgb(${colour.map(value => Math.round(255 * value)).join(' ')})`;
}
