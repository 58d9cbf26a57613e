/** Floor and edges of the tank, with marks every half unit of length. */

import * as THREE from 'three';

const SPACING = 0.5;

/** A box without a lid, drawn as lines over a floor. */
export class Tank {
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
  setBounds({min, max, walls}) {
    const [x0, y0, z0] = min;
    const [x1, y1, z1] = max;
    this.#floor.geometry.dispose();
    this.#floor.geometry = lines([x0, y0, z0, x0, y0, z1, x1, y0, z1, x0, y0, z0, x1, y0, z1, x1, y0, z0]);
    const marks = [];
    for (let x = Math.ceil(x0 / SPACING) * SPACING; x < x1; x += SPACING) {
      marks.push(x, y0, z0, x, y0, z1);
    }
    for (let z = Math.ceil(z0 / SPACING) * SPACING; z < z1; z += SPACING) {
      marks.push(x0, y0, z, x1, y0, z);
    }
    this.#marks.geometry.dispose();
    this.#marks.geometry = lines(marks);
    const corners = [[x0, z0], [x1, z0], [x1, z1], [x0, z1]];
    const edges = [];
    corners.forEach(([x, z], i) => {
      const [nextX, nextZ] = corners[(i + 1) % 4];
      edges.push(x, y0, z, nextX, y0, nextZ);
      if (walls) {
        edges.push(x, y1, z, nextX, y1, nextZ, x, y0, z, x, y1, z);
      }
    });
    this.#edges.geometry.dispose();
    this.#edges.geometry = lines(edges);
  }

  /** Colours as CSS: floor, marks, edges. */
  setColours(floor, marks, edges) {
    this.#floor.material.color.set(floor);
    this.#marks.material.color.set(marks);
    this.#edges.material.color.set(edges);
  }
}

function lines(numbers) {
  return new THREE.BufferGeometry().setAttribute('position', new THREE.Float32BufferAttribute(numbers, 3));
}
