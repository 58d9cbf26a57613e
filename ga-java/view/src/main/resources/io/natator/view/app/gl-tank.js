/** Floor and edges of the tank. */

import * as THREE from 'three';
import {GlLightMap} from './gl-light-map.js';
import {shader} from './gl-shader.js';
import {MARK_SPACING, tankLines} from './scene.js';

const FLOOR_VERTEX = `
  out vec3 place;
  void main() {
    place = position;
    gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  }`;

/** Tiles within the tank, and a table around it that fades away, darker under the tank. */
const FLOOR_FRAGMENT = `
  uniform vec3 floor_;
  uniform vec3 marks;
  uniform vec3 background;
  uniform vec4 tank;
  uniform float spacing;
  uniform float reach;
  uniform sampler2D map;
  in vec3 place;
  out vec4 shown;
  ${GlLightMap.CODE}
  void main() {
    vec2 beyond = max(tank.xy - place.xz, place.xz - tank.zw);
    float off = length(max(beyond, vec2(0.0))) + min(max(beyond.x, beyond.y), 0.0);
    vec2 cell = place.xz / spacing;
    vec2 line = abs(fract(cell - 0.5) - 0.5) / (fwidth(cell) * 1.2);
    float mark = (1.0 - min(min(line.x, line.y), 1.0)) * step(off, 0.0);
    vec3 colour = mix(floor_, marks, mark);
    colour *= lightAt(map, tank, place);
    colour *= 1.0 - 0.16 * exp(-max(off, 0.0) * 5.0) * step(0.0, off);
    shown = vec4(mix(colour, background, smoothstep(0.0, reach, off)), 1.0);
  }`;

const EDGE_VERTEX = `
  void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`;

const EDGE_FRAGMENT = `
  uniform vec3 ink;
  out vec4 shown;
  void main() { shown = vec4(ink, 1.0); }`;

/** A box without a lid, drawn as lines over a floor. */
export class GlTank {
  #floor = new THREE.Mesh(new THREE.BufferGeometry(), shader(FLOOR_VERTEX, FLOOR_FRAGMENT, {
    floor_: new THREE.Color(), marks: new THREE.Color(), background: new THREE.Color(), tank: new THREE.Vector4(),
    spacing: MARK_SPACING, reach: 1, map: null,
  }, {side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 4}));
  #edges = new THREE.LineSegments(new THREE.BufferGeometry(), shader(EDGE_VERTEX, EDGE_FRAGMENT, {ink: new THREE.Color()}));

  /** What to add to a scene of three.js. */
  object = new THREE.Group();

  constructor() {
    this.#floor.renderOrder = -3;
    this.#edges.renderOrder = -1;
    for (const part of [this.#floor, this.#edges]) {
      part.frustumCulled = false;
      this.object.add(part);
    }
  }

  /** Shows these bounds; see `tankBounds`. */
  setBounds(bounds) {
    const {min: [x0, y0, z0], max: [x1, , z1]} = bounds;
    const reach = 0.5 * Math.max(x1 - x0, z1 - z0);
    const [left, right, back, front] = [x0 - reach, x1 + reach, z0 - reach, z1 + reach];
    replace(this.#floor, [left, y0, back, left, y0, front, right, y0, front, left, y0, back, right, y0, front, right, y0, back]);
    this.#floor.material.uniforms.tank.value.set(x0, z0, x1, z1);
    this.#floor.material.uniforms.reach.value = reach;
    replace(this.#edges, tankLines(bounds).edges);
  }

  /** Whether edges are in the depth that is drawn. */
  set areEdgesDeep(value) {
    this.#edges.material.depthWrite = value;
  }

  /** Light on the floor (`GlLightMap`). */
  set light(texture) {
    this.#floor.material.uniforms.map.value = texture;
  }

  /** Colours as CSS: floor, marks, edges, background. */
  setColours({floor, marks, edges, background}) {
    const {uniforms} = this.#floor.material;
    uniforms.floor_.value.set(floor);
    uniforms.marks.value.set(marks);
    uniforms.background.value.set(background);
    this.#edges.material.uniforms.ink.value.set(edges);
  }
}

function replace(part, numbers) {
  part.geometry.dispose();
  part.geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(numbers, 3));
}
