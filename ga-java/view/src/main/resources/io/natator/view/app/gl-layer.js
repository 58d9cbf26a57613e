/** Pictures of a part of the scene, which others are made of. */

import * as THREE from 'three';
import {target} from './gl-pass.js';

/** Samples of each pixel, so that edges are smooth. */
const SAMPLES = 4;

/** A target with its depth that has the size of the picture. */
export class Layer {
  target = target(1, 1, {
    samples: SAMPLES, depthBuffer: true, depthTexture: new THREE.DepthTexture(1, 1, THREE.UnsignedIntType),
    minFilter: THREE.LinearFilter, magFilter: THREE.LinearFilter,
  });

  /** The target, with this size in pixels. */
  of(width, height) {
    this.target.setSize(width, height);
    return this.target;
  }

  dispose() {
    this.target.dispose();
  }
}
