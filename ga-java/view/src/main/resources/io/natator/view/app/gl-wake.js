/** The wake: a slice of vorticity, or surfaces around vortices. */

import * as THREE from 'three';
import {SCALES, fadingBytes, risingBytes, scaleBytes} from './colours.js';
import {GlArrows} from './gl-arrows.js';
import {NO_ARROWS} from './arrows.js';
import {shader} from './gl-shader.js';
import {scaleTexture} from './gl-spheres.js';
import {vortexOpacity} from './wake.js';

/** Numbers of half precision go up to 65504. */
const MOST = 6e4;
/** Half the width of an arrow, in cells. */
const ARROW_WIDTH = 0.12;

const SLICE_VERTEX = `
  in vec2 along;
  out vec2 place;
  void main() {
    place = along;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;

/** Cubic B-splines by four linear samples (Sigg and Hadwiger: Fast Third-Order Texture Filtering, 2005): cells are not seen. */
const SLICE_FRAGMENT = `
  uniform sampler2D map;
  uniform sampler2D scale;
  uniform vec2 low;
  uniform float cell;
  uniform vec2 ends;
  in vec2 place;
  out vec4 shown;
  void main() {
    vec2 size = vec2(textureSize(map, 0));
    vec2 at = (place - low) / cell - 0.5;
    vec2 share = fract(at);
    vec2 rest = 1.0 - share;
    vec2 first = rest * rest * rest / 6.0;
    vec2 second = 2.0 / 3.0 - 0.5 * share * share * (2.0 - share);
    vec2 third = 2.0 / 3.0 - 0.5 * rest * rest * (2.0 - rest);
    vec2 fourth = share * share * share / 6.0;
    vec2 before = (floor(at) - 0.5 + second / (first + second)) / size;
    vec2 after = (floor(at) + 1.5 + fourth / (third + fourth)) / size;
    vec2 weight = first + second;
    float value = mix(
      mix(texture(map, after).r, texture(map, vec2(before.x, after.y)).r, weight.x),
      mix(texture(map, vec2(after.x, before.y)).r, texture(map, before).r, weight.x), weight.y);
    shown = texture(scale, vec2(clamp((value - ends.x) / (ends.y - ends.x), 0.002, 0.998), 0.5));
  }`;

const VORTEX_VERTEX = `
  in float turns;
  out float turning;
  out vec3 facing;
  out vec3 place;
  void main() {
    vec4 eye = modelViewMatrix * vec4(position, 1.0);
    turning = turns;
    facing = normalMatrix * normal;
    place = eye.xyz;
    gl_Position = projectionMatrix * eye;
  }`;

const VORTEX_FRAGMENT = `
  uniform sampler2D scale;
  uniform float most;
  uniform float opacity;
  in float turning;
  in vec3 facing;
  in vec3 place;
  out vec4 shown;
  void main() {
    vec3 colour = texture(scale, vec2(0.5 + 0.498 * clamp(turning / most, -1.0, 1.0), 0.5)).rgb;
    vec3 up = (viewMatrix * vec4(0.0, 1.0, 0.0, 0.0)).xyz;
    vec3 normal = normalize(facing);
    float rim = 1.0 - abs(dot(normal, normalize(-place)));
    shown = vec4(colour * (0.4 + 0.22 * dot(normal, up) + 0.55 * (1.0 - rim)), mix(opacity, 1.0, 0.6 * rim * rim));
  }`;

/** Draws a `Wake`. */
export class GlWake {
  #wake;
  #version = -1;
  /** What the numbers of the map are multiples of. */
  #unit = 1;
  #arrows = new GlArrows(0.8, false);
  #scales = {
    vorticity: scaleTexture(fadingBytes(SCALES.turning)), velocity: scaleTexture(risingBytes(SCALES.sequential)),
    pressure: scaleTexture(fadingBytes(SCALES.diverging)),
  };
  #slice = new THREE.Mesh(new THREE.BufferGeometry(), shader(SLICE_VERTEX, SLICE_FRAGMENT, {
    map: null, scale: null, low: new THREE.Vector2(), cell: 1, ends: new THREE.Vector2(),
  }, {side: THREE.DoubleSide, transparent: true, depthWrite: false}));
  /** Of what lies behind each other only the nearest is seen: its depth is drawn first. */
  #nearest = new THREE.Mesh(new THREE.BufferGeometry(),
      new THREE.MeshBasicMaterial({colorWrite: false, side: THREE.DoubleSide}));
  #vortices = new THREE.Mesh(this.#nearest.geometry, shader(VORTEX_VERTEX, VORTEX_FRAGMENT, {
    scale: scaleTexture(scaleBytes(SCALES.turning)), most: 1, opacity: 1,
  }, {side: THREE.DoubleSide, transparent: true}));

  /** What to add to a scene of three.js. */
  object = new THREE.Group();

  constructor(wake) {
    this.#wake = wake;
    [this.#slice, this.#nearest, this.#vortices].forEach((part, i) => {
      part.frustumCulled = false;
      part.renderOrder = 11 + i;
      this.object.add(part);
    });
    this.#nearest.material.transparent = true;  // to be drawn after bodies
    this.#arrows.object.renderOrder = 14;
    this.object.add(this.#arrows.object);
  }

  /** The colour of arrows, as CSS. */
  setInk(colour) {
    this.#arrows.setColour(colour);
  }

  /** Brings what changed to the GPU. */
  update(opacity) {
    const {slice, vortices, version, range: [low, most]} = this.#wake;
    this.#vortices.material.uniforms.most.value = most;
    this.#vortices.material.uniforms.opacity.value = vortexOpacity(opacity);
    if (version !== this.#version) {
      this.#version = version;
      this.#renew(slice, vortices, most);
    }
    this.#slice.material.uniforms.ends.value.set(low, most).divideScalar(this.#unit);
  }

  #renew(slice, vortices, most) {
    this.#unit = most;
    this.#slice.visible = slice !== null;
    this.#arrows.show(slice?.arrows ?? NO_ARROWS, ARROW_WIDTH * (slice?.cell ?? 1));
    this.#nearest.visible = this.#vortices.visible = vortices !== null;
    if (slice !== null) {
      this.#cut(slice);
    }
    if (vortices !== null) {
      this.#surround(vortices);
    }
  }

  #cut({values, columns, rows, cell, low, axis, sides, height, from: [x0, z0], to: [x1, z1]}) {
    const {uniforms} = this.#slice.material;
    uniforms.scale.value = this.#scales[this.#wake.kind];
    uniforms.map.value?.dispose();
    const halves = Uint16Array.from(values, value => THREE.DataUtils.toHalfFloat(Math.max(-MOST, Math.min(MOST, value / this.#unit))));
    const map = new THREE.DataTexture(halves, columns, rows, THREE.RedFormat, THREE.HalfFloatType);
    map.magFilter = map.minFilter = THREE.LinearFilter;
    map.wrapS = map.wrapT = THREE.RepeatWrapping;
    map.needsUpdate = true;
    uniforms.map.value = map;
    uniforms.low.value.fromArray(low);
    uniforms.cell.value = cell;
    this.#slice.geometry.dispose();
    const along = [x0, z0, x0, z1, x1, z0, x1, z1];
    const corners = Float32Array.from({length: 12}, (_, i) => i % 3 === axis ? height : along[2 * Math.floor(i / 3) + sides.indexOf(i % 3)]);
    this.#slice.geometry = new THREE.BufferGeometry().setIndex([0, 1, 2, 2, 1, 3])
        .setAttribute('position', new THREE.BufferAttribute(corners, 3))
        .setAttribute('along', new THREE.Float32BufferAttribute(along, 2));
  }

  #surround({vertices, triangles, normals, turns}) {
    this.#vortices.geometry.dispose();
    const geometry = new THREE.BufferGeometry()
        .setAttribute('position', new THREE.BufferAttribute(vertices, 3))
        .setAttribute('normal', new THREE.BufferAttribute(normals, 3))
        .setAttribute('turns', new THREE.BufferAttribute(turns, 1))
        .setIndex(new THREE.BufferAttribute(triangles, 1));
    this.#nearest.geometry = this.#vortices.geometry = geometry;
  }

  dispose() {
    for (const part of [this.#slice, this.#nearest, this.#vortices]) {
      part.geometry.dispose();
      part.material.dispose();
    }
    this.#slice.material.uniforms.map.value?.dispose();
    this.#arrows.dispose();
  }
}
