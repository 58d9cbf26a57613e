/** Bodies: a skin, or spheres coloured by cluster with joints marked. */

import * as THREE from 'three';
import {SCALES, colourAt} from './colours.js';
import {shader} from './gl-shader.js';
import {GlSkin} from './gl-skin.js';
import {BODY_RADIUS, bodySpacing, solidKinds, solids} from './scene.js';

const VERTEX = `
  in vec3 tint;
  in float joint;
  uniform float radius;
  uniform float pixelsPerUnit;
  out vec3 colour;
  out float ring;
  void main() {
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * eye;
    gl_PointSize = max(1.0, 2.0 * radius * pixelsPerUnit / -eye.z);
    colour = tint;
    ring = joint;
  }`;

const FRAGMENT = `
  in vec3 colour;
  in float ring;
  out vec4 shown;
  void main() {
    vec2 side = gl_PointCoord * 2.0 - 1.0;
    float square = dot(side, side);
    if (square > 1.0) { discard; }
    float light = 0.55 + 0.5 * sqrt(1.0 - square) - 0.2 * side.y - 0.1 * side.x;
    vec3 lit = mix(colour, vec3(1.0), ring * step(square, 0.22));
    shown = vec4(lit * light, 1.0);
  }`;

/** One mesh, or one point per particle. */
export class GlBody {
  #particles = [];
  #pressure = null;
  #coloured = 0;
  #tint = [];
  #isSkin = true;
  #position = null;
  #skin = new GlSkin();
  #material = shader(VERTEX, FRAGMENT, {radius: 1, pixelsPerUnit: 1});

  /** What to add to a scene of three.js. */
  object = new THREE.Group();

  /** The points themselves. */
  points = new THREE.Points(new THREE.BufferGeometry(), this.#material);

  constructor() {
    this.points.frustumCulled = false;
    this.object.add(this.points, this.#skin.object);
  }

  /**
   * Takes over what is known of a scene (SCEN).
   *
   * @param {Scene} scene
   */
  setScene(scene) {
    this.#skin.setScene(scene);
    this.#particles = solids(scene);
    const kinds = solidKinds(scene);
    this.#tint = this.#particles.flatMap(particle => kinds.colours[kinds.of[particle]]);
    this.#coloured = 0;
    this.#position = new THREE.BufferAttribute(new Float32Array(3 * this.#particles.length), 3)
        .setUsage(THREE.DynamicDrawUsage);
    this.points.geometry.dispose();
    this.points.geometry = new THREE.BufferGeometry()
        .setAttribute('position', this.#position)
        .setAttribute('tint', new THREE.Float32BufferAttribute(this.#tint, 3))
        .setAttribute('joint', new THREE.Float32BufferAttribute(this.#particles.map(particle => kinds.joint[particle]), 1));
    this.#material.uniforms.radius.value = BODY_RADIUS * bodySpacing(scene);
  }

  /** The pressure on it: a `SkinPressure`. */
  set pressure(pressure) {
    this.#pressure = pressure;
    this.#skin.pressure = pressure;
  }

  /**
   * Moves it to where it is in a frame.
   *
   * @param {Frame} frame
   */
  update(frame) {
    this.points.visible = !this.#isSkin && this.#particles.length > 0;
    this.#skin.object.visible = this.#isSkin && this.#particles.length > 0;
    if (this.#skin.object.visible) {
      this.#skin.update(frame);
    } else if (this.points.visible) {
      this.#particles.forEach((particle, i) => {
        for (let axis = 0; axis < 3; axis++) {
          this.#position.array[3 * i + axis] = frame.position[3 * particle + axis];
        }
      });
      this.#position.needsUpdate = true;
      this.#colour();
    }
  }

  /** By pressure where that is shown, else by cluster. */
  #colour() {
    const version = this.#pressure.isKnown ? this.#pressure.version : 0;
    if (version !== this.#coloured) {
      this.#coloured = version;
      const tint = this.points.geometry.getAttribute('tint');
      tint.array.set(this.#tint);
      if (this.#pressure.isKnown) {
        this.#particles.forEach((particle, i) =>
          tint.array.set(colourAt(SCALES.diverging, 0.5 + 0.5 * this.#pressure.shares[particle]), 3 * i));
      }
      tint.needsUpdate = true;
    }
  }

  /** Whether a skin is shown, and else particles; and whether muscles are told by its colour. */
  setLook({body, muscles}) {
    this.#isSkin = body === 'skin';
    this.#skin.showsMuscles = muscles;
  }

  /** The direction to the lamp. */
  set lamp(direction) {
    this.#skin.lamp = direction;
  }

  /** See `GlWater.setPixels`. */
  setPixels(pixelsPerUnit) {
    this.#material.uniforms.pixelsPerUnit.value = pixelsPerUnit;
  }

  dispose() {
    this.points.geometry.dispose();
    this.#material.dispose();
    this.#skin.dispose();
  }
}
