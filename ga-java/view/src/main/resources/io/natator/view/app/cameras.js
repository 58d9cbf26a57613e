/** Where the picture is taken from: follow, side, top, or free. */

import * as THREE from 'three';
import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

/** Names of the cameras in the order of their keys. */
export const CAMERAS = ['follow', 'side', 'top', 'free'];

/** Directions from what is looked at to the camera. */
const DIRECTIONS = {
  follow: new THREE.Vector3(-0.55, 0.62, 0.78).normalize(),
  side: new THREE.Vector3(0, 0.12, 1).normalize(),
  top: new THREE.Vector3(0, 1, 0.001).normalize(),
};
/** Share of the way to the target that is left after a second. */
const EASE = 0.02;
/** Closer to where it is to be than this, in length units, the camera goes there at once. */
const NEAR = 2e-3;
const ZOOM_LIMITS = [0.3, 4];
/** How fast the camera goes round in a presentation, rad/s. */
const ORBIT = 0.12;
const UP = new THREE.Vector3(0, 1, 0);

/** One perspective camera. A drag on the canvas frees it from where it is; the wheel zooms in every mode. */
export class CameraRig {
  #mode = 'follow';
  #controls;
  #bounds = null;
  #body = new THREE.Vector3();
  #hasBody = false;
  #target = new THREE.Vector3();
  #eye = new THREE.Vector3();
  #wantedTarget = new THREE.Vector3();
  #wantedEye = new THREE.Vector3();
  #jump = true;
  #zoom = 1;
  #isOrbiting = false;
  #angle = 0;
  #still = matchMedia('(prefers-reduced-motion: reduce)');

  camera = new THREE.PerspectiveCamera(32, 1, 0.05, 60);

  /**
   * Called with the mode when the user changes it by dragging.
   *
   * @type {(mode: string) => void}
   */
  onMode = () => {};

  constructor(host) {
    this.#controls = new OrbitControls(this.camera, host);
    this.#controls.enabled = false;
    this.#controls.autoRotateSpeed = -ORBIT * 30 / Math.PI;
    this.#controls.addEventListener('change', () => {
      this.hasMoved = true;
    });
    host.addEventListener('pointerdown', event => this.#freeByDrag(event), {capture: true});
    host.addEventListener('wheel', event => this.#wheel(event), {passive: false});
    host.addEventListener('keydown', event => this.#key(event));
    this.hasMoved = true;
  }

  get mode() {
    return this.#mode;
  }

  /** Chooses a camera by name. */
  setMode(mode) {
    if (mode === 'free') {
      this.#controls.target.copy(this.#target);
    }
    this.#mode = mode;
    this.#zoom = 1;
    this.#controls.enabled = mode === 'free';
    this.#jump = this.#jump || this.#still.matches;
    this.hasMoved = true;
  }

  /** Whether the camera goes slowly round what it looks at; not where the system asks for less motion. */
  set isOrbiting(value) {
    this.#isOrbiting = value;
    this.#angle = 0;
    this.hasMoved = true;
  }

  /** The tank; see `tankBounds`. */
  setBounds(bounds) {
    this.#bounds = bounds;
    this.#jump = true;
  }

  /** The same tank about another place. */
  moveBounds(bounds) {
    this.#bounds = bounds;
  }

  /** The centre of the body, or null without one. */
  setBody(centre) {
    this.#hasBody = centre !== null;
    if (centre !== null) {
      this.#body.fromArray(centre);
    }
  }

  /** The distance from the camera to the body along the view; negative infinity without a body. */
  depthOfBody(forward) {
    return this.#hasBody ? this.#wantedTarget.copy(this.#body).sub(this.camera.position).dot(forward) : -Infinity;
  }

  /** Moves the camera on by `seconds`; `aspect` is width over height. */
  update(seconds, aspect) {
    if (this.camera.aspect !== aspect) {
      this.camera.aspect = aspect;
      this.camera.updateProjectionMatrix();
      this.#jump = true;
    }
    if (this.#bounds === null) {
      return;
    }
    const turn = this.#isOrbiting && !this.#still.matches ? ORBIT * seconds : 0;
    this.#angle += turn;
    if (this.#mode === 'free' && !this.#jump) {
      this.#controls.autoRotate = turn > 0;
      this.#controls.update(seconds);
      this.#target.copy(this.#controls.target);
      this.#eye.copy(this.camera.position);
      return;
    }
    this.#want(aspect);
    const off = this.#eye.distanceTo(this.#wantedEye) + this.#target.distanceTo(this.#wantedTarget);
    const left = this.#jump || this.#still.matches || off < NEAR ? 0 : EASE ** seconds;
    this.#eye.lerp(this.#wantedEye, 1 - left);
    this.#target.lerp(this.#wantedTarget, 1 - left);
    this.camera.position.copy(this.#eye);
    this.camera.lookAt(this.#target);
    this.#controls.target.copy(this.#target);
    this.#jump = false;
    this.hasMoved = this.hasMoved || off > 1e-9;
  }

  #want(aspect) {
    const {min, max} = this.#bounds;
    const mode = this.#mode === 'free' ? 'follow' : this.#mode;
    const slope = Math.tan(this.camera.fov * Math.PI / 360);
    const size = [max[0] - min[0], max[1] - min[1], max[2] - min[2]];
    this.#wantedTarget.set((min[0] + max[0]) / 2, (min[1] + max[1]) / 2, (min[2] + max[2]) / 2);
    let distance;
    if (mode === 'follow') {
      if (this.#hasBody) {
        const across = Math.min(size[0], 3.1);
        distance = Math.max(0.55 * across / (slope * aspect), 0.36 * across / slope);
        this.#wantedTarget.copy(this.#body);
      } else {
        // All of the tank: the ball around it.
        distance = Math.hypot(...size) / 2 / Math.sin(Math.atan(slope * Math.min(1, aspect)));
      }
    } else {
      const high = mode === 'side' ? size[1] : size[2];
      const deep = mode === 'side' ? size[2] : size[1];
      distance = Math.max(0.54 * size[0] / (slope * aspect), 0.6 * high / slope) + deep / 2;
      if (this.#hasBody && Math.abs(this.#body.x - this.#wantedTarget.x) > 0.45 * size[0]) {
        this.#wantedTarget.x = this.#body.x;
      }
    }
    this.#wantedEye.copy(DIRECTIONS[mode]).applyAxisAngle(UP, this.#angle).multiplyScalar(distance * this.#zoom)
        .add(this.#wantedTarget);
  }

  #freeByDrag(event) {
    if (this.#mode !== 'free' && event.isPrimary && event.button === 0) {
      this.setMode('free');
      this.onMode('free');
    }
  }

  #wheel(event) {
    if (this.#mode !== 'free') {
      event.preventDefault();
      this.#zoomBy(event.deltaY * 0.001);
    }
  }

  #key(event) {
    const turn = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1]}[event.key];
    if (turn === undefined) {
      return;
    }
    event.preventDefault();
    if (this.#mode !== 'free') {
      this.setMode('free');
      this.onMode('free');
    }
    const offset = this.camera.position.clone().sub(this.#controls.target);
    const round = new THREE.Spherical().setFromVector3(offset);
    round.theta += turn[0];
    round.phi += turn[1];
    round.makeSafe();
    this.camera.position.copy(this.#controls.target).add(offset.setFromSpherical(round));
    this.camera.lookAt(this.#controls.target);
    this.hasMoved = true;
  }

  #zoomBy(amount) {
    this.#zoom = Math.min(ZOOM_LIMITS[1], Math.max(ZOOM_LIMITS[0], this.#zoom * Math.exp(amount)));
    this.hasMoved = true;
  }
}
