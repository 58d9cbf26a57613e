/** How much water lies behind each pixel, and the value of what of it is nearest: blurred splats of all particles. */

import * as THREE from 'three';
import {Pass} from './gl-pass.js';
import {ADDING, shader} from './gl-shader.js';

const VERTEX = `
  in float value;
  uniform float radius;
  uniform float pixelsPerUnit;
  out float distance_;
  out float shade;
  void main() {
    vec4 eye = viewMatrix * vec4(position, 1.0);
    gl_Position = projectionMatrix * eye;
    gl_PointSize = clamp(2.0 * radius * pixelsPerUnit / -eye.z, 1.0, 250.0);
    distance_ = -eye.z;
    shade = value;
  }`;

/** Length of water along the ray through a soft ball whose volume is the particle's; see van der Laan and others, 2009. */
const FRAGMENT = `
  uniform sampler2D front;
  uniform vec2 size;
  uniform vec2 range;
  uniform float peak;
  uniform float radius;
  in float distance_;
  in float shade;
  out vec4 added;
  void main() {
    vec2 side = gl_PointCoord * 2.0 - 1.0;
    float square = dot(side, side);
    if (square > 1.0) { discard; }
    vec2 place = gl_FragCoord.xy / size;
    float share = (1.0 - square) * (1.0 - square);
    float nearest = texture(front, place).r;
    float weight = nearest > 0.0 ? share * exp(-max(0.0, distance_ * nearest - 1.0) / (nearest * radius)) : 0.0;
    float tint = clamp((shade - range.x) / (range.y - range.x), 0.0, 1.0);
    added = vec4(peak * share, weight * tint, 0.0, weight);
  }`;

const BLUR = `
  uniform sampler2D source;
  uniform vec2 along;
  out vec4 blurred;
  vec4 both(float far) { return texture(source, place + far * along) + texture(source, place - far * along); }
  void main() {
    blurred = 0.2 * (texture(source, place) + both(1.0)) + 0.13 * both(2.0) + 0.07 * both(3.0);
  }`;

/** Radius of a soft ball, in spacings. */
const RADIUS = 1.15;

/** One point for each particle; a target of r: thickness, length, and g: colour, weighted by a. */
export class GlFluidVolume {
  #world = new THREE.Scene();
  #points = null;
  #clear = new THREE.Color(0);
  #blur = new Pass(BLUR, {source: null, along: new THREE.Vector2()});
  #material = shader(VERTEX, FRAGMENT,
      {front: null, size: new THREE.Vector2(), range: new THREE.Vector2(), peak: 1, radius: 1, pixelsPerUnit: 1}, ADDING);

  /**
   * Draws the points of this geometry (`PlaceBuffer`) from now on.
   *
   * @param {Scene} scene
   */
  setScene(scene, geometry) {
    if (this.#points !== null) {
      this.#world.remove(this.#points);
    }
    this.#points = new THREE.Points(geometry, this.#material);
    this.#points.frustumCulled = false;
    this.#world.add(this.#points);
    const spacing = scene.fluidRestDistance;
    const radius = RADIUS * spacing;
    this.#material.uniforms.radius.value = radius;
    // The integral of (1 - q²)² over the disc is pi radius² / 3; times the peak it is spacing³.
    this.#material.uniforms.peak.value = 3 * spacing ** 3 / (Math.PI * radius * radius);
  }

  /**
   * Fills `first`; `second` is of the same size.
   *
   * @param {THREE.Texture} front 1 / depth of the nearest water
   * @param {number} pixelsPerUnit of the targets, at depth 1
   */
  draw(renderer, camera, first, second, front, range, pixelsPerUnit) {
    const {uniforms} = this.#material;
    uniforms.front.value = front;
    uniforms.size.value.set(first.width, first.height);
    uniforms.range.value.fromArray(range);
    uniforms.pixelsPerUnit.value = pixelsPerUnit;
    renderer.setRenderTarget(first);
    renderer.setClearColor(this.#clear, 0);
    renderer.clear();
    renderer.render(this.#world, camera);
    for (const stride of [1, 2]) {
      this.#blur.filter(renderer, first, second, stride);
    }
  }

  dispose() {
    this.#material.dispose();
    this.#blur.dispose();
  }
}
