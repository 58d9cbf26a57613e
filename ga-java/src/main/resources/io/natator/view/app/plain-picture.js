/** Draws without WebGL: spheres by the processor into pixels, lines with the 2-d canvas. */

import {SCALES, clusterColours, colourAt} from './colours.js';
import {Discs, LIGHTS} from './discs.js';
import {addArea, addLine, addLines} from './plain-lines.js';
import {SphereLayer, shades} from './plain-spheres.js';
import {Projector} from './projector.js';
import {BODY_RADIUS, MUSCLE_WIDTH, WATER_RADIUS, clusterOfBody, distinctMuscles, jointOfBody, muscleChange, tankLines}
  from './scene.js';
import {NearestFirst} from './sort.js';
import {SPINES} from './trace.js';

/** Colours of water. */
const COLOURS = 256;
const CHANGES = 33;

/** One canvas; the same methods as `GlPicture`. */
export class PlainPicture {
  #canvas;
  #context;
  #layerCanvas = document.createElement('canvas');
  #layerContext;
  #layer = new SphereLayer();
  #discs = new Discs();
  #order = new NearestFirst();
  #projector = new Projector();
  #lineProjector = new Projector();
  #trace;
  #field;
  #scene = null;
  #values = new Float32Array(0);
  #kinds = new Int16Array(0);
  #joints = new Uint8Array(0);
  #muscles = [];
  #lines = null;
  #look = null;
  #colours = null;
  #waterShades = null;
  #bodyShades = null;
  #changeColours = Array.from({length: CHANGES}, (_, i) => css(colourAt(SCALES.diverging, i / (CHANGES - 1))));
  #place = [0, 0, 0];

  constructor(canvas, trace, field) {
    this.#canvas = canvas;
    this.#context = canvas.getContext('2d', {alpha: false});
    this.#layerContext = this.#layerCanvas.getContext('2d');
    this.#trace = trace;
    this.#field = field;
  }

  /** How it draws, for people. */
  get name() {
    return 'processor';
  }

  setScene(scene) {
    this.#scene = scene;
    this.#values = new Float32Array(scene.fluid[1]);
    this.#kinds = new Int16Array(scene.particles).fill(-1);
    this.#joints = new Uint8Array(scene.particles);
    const clusters = clusterOfBody(scene);
    const joints = jointOfBody(scene);
    scene.body.forEach((particle, i) => {
      this.#kinds[particle] = clusters[i];
      this.#joints[particle] = joints[i] ? 1 : 0;
    });
    this.#muscles = distinctMuscles(scene);
    this.#bodyShades = shades(clusterColours(Math.max(1, scene.clusters.length)), 1);
  }

  setBounds(bounds) {
    this.#lines = tankLines(bounds);
  }

  setLook(look) {
    this.#look = look;
    const colours = Array.from({length: COLOURS}, (_, i) => colourAt(SCALES.sequential, i / (COLOURS - 1)));
    this.#waterShades = shades(colours, Math.min(look.opacity, 0.995));
  }

  setTheme(colours) {
    this.#colours = colours;
  }

  /** The size in CSS pixels, and the share of them that spheres are drawn with along each side. */
  setSize(width, height, share) {
    const ratio = Math.min(devicePixelRatio, 1);
    this.#canvas.width = Math.round(width * ratio);
    this.#canvas.height = Math.round(height * ratio);
    this.#layerCanvas.width = Math.round(width * ratio * share);
    this.#layerCanvas.height = Math.round(height * ratio * share);
    this.#layer.setSize(this.#layerCanvas.width, this.#layerCanvas.height);
  }

  /** Draws a frame; water nearer than `from` is left out. */
  draw(frame, camera, from) {
    this.#lineProjector.set(camera, this.#canvas.width, this.#canvas.height);
    this.#drawTank();
    this.#projector.set(camera, this.#layerCanvas.width, this.#layerCanvas.height);
    this.#drawSpheres(frame, from);
    this.#context.drawImage(this.#layerCanvas, 0, 0, this.#canvas.width, this.#canvas.height);
    if (this.#look.muscles) {
      this.#drawMuscles(frame);
    }
    if (this.#look.trace) {
      this.#drawTrace();
    }
  }

  dispose() {
    this.#layerCanvas.width = 0;
  }

  #drawTank() {
    const context = this.#context;
    const {background, floor, marks, edges} = this.#colours;
    context.fillStyle = background;
    context.fillRect(0, 0, this.#canvas.width, this.#canvas.height);
    context.lineWidth = 1;
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

  #drawSpheres(frame, from) {
    const {particles, fluid, fluidRestDistance, solidRestDistance} = this.#scene;
    const projector = this.#projector;
    const isWater = this.#look.water !== 'none' && fluid[1] > 0;
    if (isWater) {
      this.#field.read(this.#look.colour, this.#scene, frame, fluid[0], fluid[1], this.#values);
    }
    const [low, high] = this.#field.range;
    const perValue = (COLOURS - 1) / (high - low);
    const count = this.#order.sort(frame.position, 0, particles, projector.eye, projector.forward, 0.05);
    this.#layer.clear();
    for (let i = 0; i < count; i++) {
      const particle = this.#order.order[i];
      const kind = this.#kinds[particle];
      projector.project(frame.position[3 * particle], frame.position[3 * particle + 1], frame.position[3 * particle + 2],
          this.#place, 0);
      const [x, y, depth] = this.#place;
      if (kind >= 0) {
        this.#sphere(x, y, BODY_RADIUS * solidRestDistance / depth, this.#bodyShades, kind * LIGHTS, particle);
      } else if (isWater && depth >= from) {
        const value = Math.round((this.#values[particle - fluid[0]] - low) * perValue);
        const colour = value < 0 ? 0 : value < COLOURS ? value : COLOURS - 1;
        this.#sphere(x, y, WATER_RADIUS * fluidRestDistance / depth, this.#waterShades, colour * LIGHTS, -1);
      }
    }
    this.#layerContext.putImageData(this.#layer.image, 0, 0);
  }

  /** `radius` is that at depth 1; `particle` is -1 for water. */
  #sphere(x, y, radius, table, base, particle) {
    const pixels = radius * this.#projector.pixels;
    const left = Math.floor(x);
    const top = Math.floor(y);
    if (left + pixels < 0 || top + pixels < 0 || left - pixels > this.#layerCanvas.width
        || top - pixels > this.#layerCanvas.height) {
      return;
    }
    const disc = this.#discs.of(pixels, x - left, y - top);
    if (particle < 0) {
      this.#layer.water(disc, left - disc.half, top - disc.half, table, base);
    } else {
      this.#layer.body(disc, left - disc.half, top - disc.half, table, base, this.#joints[particle] === 1);
    }
  }

  #drawMuscles(frame) {
    const context = this.#context;
    const width = MUSCLE_WIDTH * this.#scene.solidRestDistance * this.#lineProjector.pixels;
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
    context.lineWidth = 1;
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

function css(colour) {
  return `rgb(${colour.map(value => Math.round(255 * value)).join(' ')})`;
}
