/** WebGL 2 as what draws a `GlPicture`. */

import * as THREE from 'three';
import {Fence} from './gl-fence.js';

/** Names of what draws without a graphics card. */
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;

let known = null;

/** Whether WebGL is there and a graphics card behind it. */
export function hasGraphicsCard() {
  known ??= findGraphicsCard();
  return known;
}

function findGraphicsCard() {
  const context = document.createElement('canvas').getContext('webgl2');
  if (context === null) {
    return false;
  }
  const info = context.getExtension('WEBGL_debug_renderer_info');
  const name = info === null ? '' : context.getParameter(info.UNMASKED_RENDERER_WEBGL);
  context.getExtension('WEBGL_lose_context')?.loseContext();
  return !SOFTWARE.test(name);
}

/** On one canvas; throws where there is no WebGL. */
export class WebGlDrawing {
  #fence;

  /** What draws, for people. */
  name = 'WebGL';
  renderer;

  constructor(canvas) {
    this.renderer = new THREE.WebGLRenderer({canvas, antialias: true, alpha: false, powerPreference: 'high-performance'});
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.autoClear = false;
    this.#fence = new Fence(this.renderer.getContext());
  }

  /** To be called when a picture has been drawn. */
  finish() {
    this.#fence.set();
  }

  /** Whether the card still draws. */
  get isBusy() {
    return this.#fence.isBusy;
  }

  dispose() {
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}
