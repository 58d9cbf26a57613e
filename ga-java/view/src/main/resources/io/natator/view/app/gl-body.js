/** The body: spheres coloured by cluster, joints marked, and the mesh that it was made of. */

import * as THREE from 'three';
import {clusterColours} from './colours.js';
import {GlSkin} from './gl-skin.js';
import {BODY_RADIUS, clusterOfBody, jointOfBody} from './scene.js';

const VERTEX = `
  attribute vec3 tint;
  attribute float joint;
  uniform float radius;
  uniform float pixelsPerUnit;
  varying vec3 colour;
  varying float ring;
  void main() {
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * eye;
    gl_PointSize = max(1.0, 2.0 * radius * pixelsPerUnit / -eye.z);
    colour = tint;
    ring = joint;
  }`;

const FRAGMENT = `
  varying vec3 colour;
  varying float ring;
  void main() {
    vec2 side = gl_PointCoord * 2.0 - 1.0;
    float square = dot(side, side);
    if (square > 1.0) discard;
    float light = 0.55 + 0.5 * sqrt(1.0 - square) - 0.2 * side.y - 0.1 * side.x;
    vec3 shown = mix(colour, vec3(1.0), ring * step(square, 0.22));
    gl_FragColor = vec4(shown * light, 1.0);
  }`;

/** One point per body particle. */
export class GlBody {
  #scene = null;
  #position = null;
  #skin = new GlSkin();
  #material = new THREE.ShaderMaterial({
    vertexShader: VERTEX, fragmentShader: FRAGMENT,
    uniforms: {radius: {value: 1}, pixelsPerUnit: {value: 1}},
  });

  /** What to add to a scene of three.js. */
  object = new THREE.Group();

  /** The points themselves. */
  points = new THREE.Points(new THREE.BufferGeometry(), this.#material);

  constructor() {
    this.points.frustumCulled = false;
    this.object.add(this.points, this.#skin.object);
  }

  /** Takes over what is known of a scene (SCEN). */
  setScene(scene) {
    this.#scene = scene;
    this.#skin.setScene(scene);
    const colours = clusterColours(scene.clusters.length);
    const tint = clusterOfBody(scene).flatMap(cluster => colours[cluster] ?? [0.8, 0.6, 0.4]);
    const joint = jointOfBody(scene).map(Number);
    this.#position = new THREE.BufferAttribute(new Float32Array(3 * scene.body.length), 3)
        .setUsage(THREE.DynamicDrawUsage);
    this.points.geometry.dispose();
    this.points.geometry = new THREE.BufferGeometry()
        .setAttribute('position', this.#position)
        .setAttribute('tint', new THREE.Float32BufferAttribute(tint, 3))
        .setAttribute('joint', new THREE.Float32BufferAttribute(joint, 1));
    this.points.visible = scene.body.length > 0;
    this.#material.uniforms.radius.value = BODY_RADIUS * scene.solidRestDistance;
  }

  /** Moves the particles to where they are in a frame. */
  update(frame) {
    const places = this.#position.array;
    this.#scene.body.forEach((particle, i) => {
      places[3 * i] = frame.position[3 * particle];
      places[3 * i + 1] = frame.position[3 * particle + 1];
      places[3 * i + 2] = frame.position[3 * particle + 2];
    });
    this.#position.needsUpdate = true;
    this.#skin.update(frame);
  }

  /** See `GlWater.setPixels`. */
  setPixels(pixelsPerUnit) {
    this.#material.uniforms.pixelsPerUnit.value = pixelsPerUnit;
  }
}
