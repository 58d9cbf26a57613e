/** Floor and edges of the tank. */

import * as THREE from 'three';
import {tankLines} from './scene.js';

/** A box without a lid, drawn as lines over a floor. */
export class GlTank {
  #floor = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial());
  #marks = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial());
  #edges = new THREE.LineSegments(new THREE.BufferGeometry(), new THREE.LineBasicMaterial());

  /** What to add to a scene of three.js. */
  object = new THREE.Group();

  constructor() {
    this.#floor.renderOrder = -3;
    this.#marks.renderOrder = -2;
    this.#edges.renderOrder = -1;
    for (const part of [this.#floor, this.#marks, this.#edges]) {
      part.frustumCulled = false;
      this.object.add(part);
    }
    this.#floor.material.polygonOffset = true;
    this.#floor.material.polygonOffsetFactor = 1;
    this.#floor.material.polygonOffsetUnits = 4;
    this.#floor.material.side = THREE.DoubleSide;
  }

  /** Shows these bounds; see `tankBounds`. */
  setBounds(bounds) {
    const {floor, marks, edges} = tankLines(bounds);
    const [a, b, c, d] = floor;
    replace(this.#floor, [...a, ...b, ...c, ...a, ...c, ...d]);
    replace(this.#marks, marks);
    replace(this.#edges, edges);
  }

  /** Colours as CSS: floor, marks, edges. */
  setColours(floor, marks, edges) {
    this.#floor.material.color.set(floor);
    this.#marks.material.color.set(marks);
    this.#edges.material.color.set(edges);
  }
}

function replace(part, numbers) {
  part.geometry.dispose();
  part.geometry = new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(numbers, 3));
}
