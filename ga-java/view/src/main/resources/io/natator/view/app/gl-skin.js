/** The body as it is seen from outside: the mesh that it was made of, or a smooth surface around its particles. */

import * as THREE from 'three';
import {BodySkin} from './body-skin.js';
import {SCALES, scaleBytes} from './colours.js';
import {shader} from './gl-shader.js';
import {scaleTexture} from './gl-spheres.js';
import {MuscleColours} from './muscle-colours.js';
import {bodySpacing, solidKinds} from './scene.js';
import {SkinMotion} from './skin.js';

const VERTEX = `
  in vec3 tint;
  in float change;
  out vec3 colour;
  out float muscle;
  out vec3 facing;
  out vec3 place;
  void main() {
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * eye;
    colour = tint;
    muscle = change;
    facing = normalMatrix * normal;
    place = eye.xyz;
  }`;

const FRAGMENT = `
  uniform sampler2D scale;
  uniform float muscles;
  uniform vec3 lamp;
  in vec3 colour;
  in float muscle;
  in vec3 facing;
  in vec3 place;
  out vec4 shown;
  void main() {
    vec3 normal = normalize(facing);
    vec3 view = normalize(-place);
    vec3 light = normalize((viewMatrix * vec4(lamp, 0.0)).xyz);
    vec3 up = (viewMatrix * vec4(0.0, 1.0, 0.0, 0.0)).xyz;
    vec3 base = mix(colour, texture(scale, vec2(0.5 + 0.498 * muscle, 0.5)).rgb, muscles);
    float round_ = 0.5 + 0.5 * dot(normal, light);
    float sky = 0.5 + 0.5 * dot(normal, up);
    vec3 lit = base * (0.4 + 0.2 * sky + 0.48 * round_ * round_);
    float gloss = pow(max(0.0, dot(normal, normalize(light + view))), 38.0);
    float rim = pow(1.0 - max(0.0, dot(normal, view)), 3.0);
    shown = vec4(lit + 0.2 * gloss + 0.14 * rim * mix(base, vec3(1.0), 0.5), 1.0);
  }`;

/** One mesh; it is built with the first frame of a scene. */
export class GlSkin {
  /** @type {Scene|null} */
  #scene = null;
  #motion = null;
  #muscles = null;
  #pressure = null;
  #pressed = -1;
  #showsMuscles = true;
  #material = shader(VERTEX, FRAGMENT,
      {scale: scaleTexture(scaleBytes(SCALES.diverging)), muscles: 1, lamp: new THREE.Vector3(0, 1, 0)}, {side: THREE.DoubleSide});

  /** What to add to a scene of three.js. */
  object = new THREE.Mesh(new THREE.BufferGeometry(), this.#material);

  constructor() {
    this.object.frustumCulled = false;
  }

  /**
   * Takes over what is known of a scene (SCEN).
   *
   * @param {Scene} scene
   */
  setScene(scene) {
    this.#motion = this.#scene === null || scene.restarted ? null : this.#motion;
    this.#scene = scene;
  }

  /** Whether muscles are told by colour, and else clusters. */
  set showsMuscles(value) {
    this.#showsMuscles = value;
  }

  /** The pressure that is told by colour in place of muscles where it is shown: a `SkinPressure`. */
  set pressure(pressure) {
    this.#pressure = pressure;
  }

  /** The direction to the lamp. */
  set lamp(direction) {
    this.#material.uniforms.lamp.value.copy(direction);
  }

  /**
   * Moves it to where the body is in a frame.
   *
   * @param {Frame} frame
   */
  update(frame) {
    if (this.#motion === null) {
      this.#build(frame);
    }
    this.#motion.update(frame);
    const {geometry} = this.object;
    geometry.computeVertexNormals();
    const {isKnown, version} = this.#pressure;
    if (!isKnown) {
      this.#muscles.update(frame);
    } else if (version !== this.#pressed) {
      this.#press(geometry.getAttribute('normal').array);
    }
    this.#pressed = isKnown ? version : -1;
    this.#material.uniforms.muscles.value = isKnown || this.#showsMuscles ? 1 : 0;
    for (const name of ['position', 'normal', 'change']) {
      geometry.getAttribute(name).needsUpdate = true;
    }
  }

  /** Takes the pressure at each vertex over. */
  #press(normals) {
    const {places} = this.#motion;
    for (let i = 0; i < places.length; i += 3) {
      this.#muscles.change[i / 3] = this.#pressure.share([places[i], places[i + 1], places[i + 2]],
          [normals[i], normals[i + 1], normals[i + 2]]);
    }
  }

  #build(frame) {
    const scene = this.#scene;
    this.#motion = scene.skin ? new SkinMotion(scene) : new BodySkin(scene, frame.position);
    this.#motion.update(frame);
    this.#muscles = new MuscleColours(scene, frame.position, this.#motion.places, bodySpacing(scene));
    const kinds = solidKinds(scene);
    const colourOf = scene.clusters.map(particles => kinds.colours[kinds.of[particles.at(-1)]]);
    const tint = Array.from(this.#motion.cluster).flatMap(one => colourOf[one] ?? kinds.colours.at(-1));
    this.object.geometry.dispose();
    this.object.geometry = new THREE.BufferGeometry()
        .setAttribute('position', new THREE.BufferAttribute(this.#motion.places, 3).setUsage(THREE.DynamicDrawUsage))
        .setAttribute('tint', new THREE.Float32BufferAttribute(tint, 3))
        .setAttribute('change', new THREE.BufferAttribute(this.#muscles.change, 1).setUsage(THREE.DynamicDrawUsage))
        .setIndex(new THREE.BufferAttribute(this.#motion.triangles, 1));
  }

  dispose() {
    this.object.geometry.dispose();
    this.#material.dispose();
  }
}
