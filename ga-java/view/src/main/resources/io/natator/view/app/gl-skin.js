/** The mesh that a body was made of, translucent around its particles. */

import * as THREE from 'three';
import {clusterColours} from './colours.js';
import {SkinMotion} from './skin.js';

const VERTEX = `
  attribute vec3 tint;
  varying vec3 colour;
  varying vec3 place;
  void main() {
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * eye;
    colour = tint;
    place = eye.xyz;
  }`;

const FRAGMENT = `
  varying vec3 colour;
  varying vec3 place;
  void main() {
    vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
    gl_FragColor = vec4(colour * (0.5 + 0.5 * abs(normal.z)), 0.6);
  }`;

/** Nothing for bodies without a mesh. */
export class GlSkin {
  #motion = null;
  #position = null;

  /** What to add to a scene of three.js. */
  object = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.ShaderMaterial({
    vertexShader: VERTEX, fragmentShader: FRAGMENT, transparent: true, depthWrite: false,
  }));

  constructor() {
    this.object.frustumCulled = false;
    this.object.visible = false;
  }

  /** Takes over what is known of a scene (SCEN). */
  setScene(scene) {
    this.object.visible = Boolean(scene.skin);
    this.#motion = scene.skin ? new SkinMotion(scene) : null;
    if (this.#motion === null) {
      return;
    }
    const colours = clusterColours(scene.clusters.length);
    this.#position = new THREE.BufferAttribute(this.#motion.places, 3).setUsage(THREE.DynamicDrawUsage);
    this.object.geometry.dispose();
    this.object.geometry = new THREE.BufferGeometry()
        .setAttribute('position', this.#position)
        .setAttribute('tint', new THREE.Float32BufferAttribute(scene.skin.cluster.flatMap(one => colours[one]), 3))
        .setIndex(scene.skin.triangles.flat());
  }

  /** Moves it to where the body is in a frame. */
  update(frame) {
    if (this.#motion !== null) {
      this.#motion.update(frame);
      this.#position.needsUpdate = true;
    }
  }
}
