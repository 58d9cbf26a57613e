/** The mesh that a body was made of, on a 2-d canvas: translucent triangles, the farthest first. */

import {SCALES, clusterColours, colourAt} from './colours.js';
import {NEAREST} from './projector.js';
import {SkinMotion} from './skin.js';

const OPACITY = 0.6;
const LIGHTS = 16;
const PRESSURES = 33;

/** A colour as CSS for each light. */
function lights(colour) {
  return Array.from({length: LIGHTS + 1}, (_, light) =>
    `rgb(${colour.map(value => Math.round(255 * value * (0.5 + 0.5 * light / LIGHTS))).join(' ')})`);
}

/** Nothing for bodies without a mesh. */
export class PlainSkin {
  /** @type {Scene|null} */
  #scene = null;
  #motion = null;
  #colours = [];
  #pressures = Array.from({length: PRESSURES}, (_, i) => lights(colourAt(SCALES.diverging, i / (PRESSURES - 1))));
  #projected = new Float32Array(0);

  /**
   * Takes over what is known of a scene (SCEN).
   *
   * @param {Scene} scene
   */
  setScene(scene) {
    this.#scene = scene;
    this.#motion = scene.skin ? new SkinMotion(scene) : null;
    if (this.#motion !== null) {
      this.#projected = new Float32Array(this.#motion.places.length);
      this.#colours = clusterColours(scene.clusters.length).map(lights);
    }
  }

  /** Coloured by a `SkinPressure` where that is known. */
  draw(frame, context, projector, pressure) {
    if (this.#motion === null) {
      return;
    }
    this.#motion.update(frame);
    const at = this.#projected;
    const {places} = this.#motion;
    for (let i = 0; i < places.length; i += 3) {
      projector.project(places[i], places[i + 1], places[i + 2], at, i);
    }
    const shown = [];
    for (const corners of this.#scene.skin.triangles) {
      const [a, b, c] = corners.map(corner => 3 * corner);
      const depth = (at[a + 2] + at[b + 2] + at[c + 2]) / 3;
      const round = (at[b] - at[a]) * (at[c + 1] - at[a + 1]) - (at[b + 1] - at[a + 1]) * (at[c] - at[a]);
      if (round < 0 && depth > NEAREST) {  // rows count downwards, so what faces the eye goes round the other way
        shown.push({a, b, c, depth, cluster: this.#scene.skin.cluster[corners[0]]});
      }
    }
    shown.sort((one, other) => other.depth - one.depth);
    context.globalAlpha = OPACITY;
    for (const {a, b, c, cluster} of shown) {
      const {light, normal} = this.#facing(a, b, c, projector.forward);
      const colours = pressure.isKnown ? this.#pressures[this.#pressed(a, normal, pressure)] : this.#colours[cluster];
      context.fillStyle = colours[Math.round(LIGHTS * light)];
      context.beginPath();
      context.moveTo(at[a], at[a + 1]);
      context.lineTo(at[b], at[b + 1]);
      context.lineTo(at[c], at[c + 1]);
      context.fill();
    }
    context.globalAlpha = 1;
  }

  #pressed(a, normal, pressure) {
    return Math.round((PRESSURES - 1) * (0.5 + 0.5 * pressure.share(Array.from(this.#motion.places.subarray(a, a + 3)), normal)));
  }

  /** Outwards; and 1 for a triangle that faces the eye, 0 for one that is seen edge-on. */
  #facing(a, b, c, forward) {
    const {places} = this.#motion;
    const [ux, uy, uz] = [0, 1, 2].map(axis => places[b + axis] - places[a + axis]);
    const [vx, vy, vz] = [0, 1, 2].map(axis => places[c + axis] - places[a + axis]);
    const [x, y, z] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const normal = [x, y, z].map(one => one / (Math.hypot(x, y, z) || 1));
    return {light: Math.abs(normal[0] * forward.x + normal[1] * forward.y + normal[2] * forward.z), normal};
  }
}
