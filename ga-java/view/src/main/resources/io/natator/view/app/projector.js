/** A camera's view as numbers, for drawing without WebGL. */

/** Nothing nearer than this is drawn, in length units. */
export const NEAREST = 0.05;

/** Eye, axes and scale of a camera over a picture of some size. */
export class Projector {
  eye = {x: 0, y: 0, z: 0};
  right = {x: 1, y: 0, z: 0};
  up = {x: 0, y: 1, z: 0};
  forward = {x: 0, y: 0, z: -1};
  /** Pixels per length unit at depth 1. */
  pixels = 1;
  middleX = 0;
  middleY = 0;

  /** Takes over a camera of three.js, and the width and height of the picture in pixels. */
  set(camera, width, height) {
    const m = camera.matrixWorld.elements;
    put(this.right, m[0], m[1], m[2]);
    put(this.up, m[4], m[5], m[6]);
    put(this.forward, -m[8], -m[9], -m[10]);
    put(this.eye, m[12], m[13], m[14]);
    this.pixels = height / 2 / Math.tan(camera.fov * Math.PI / 360);
    this.middleX = width / 2;
    this.middleY = height / 2;
  }

  /** Writes [x, y, depth] of a place into `out`, from `at` on: x and y in pixels, also where depth is too small. */
  project(x, y, z, out, at) {
    const dx = x - this.eye.x;
    const dy = y - this.eye.y;
    const dz = z - this.eye.z;
    const depth = dx * this.forward.x + dy * this.forward.y + dz * this.forward.z;
    const scale = this.pixels / Math.max(depth, NEAREST);
    out[at] = this.middleX + scale * (dx * this.right.x + dy * this.right.y + dz * this.right.z);
    out[at + 1] = this.middleY - scale * (dx * this.up.x + dy * this.up.y + dz * this.up.z);
    out[at + 2] = depth;
  }

  /** The depth of a place. */
  depth(x, y, z) {
    return (x - this.eye.x) * this.forward.x + (y - this.eye.y) * this.forward.y + (z - this.eye.z) * this.forward.z;
  }
}

function put(vector, x, y, z) {
  vector.x = x;
  vector.y = y;
  vector.z = z;
}
