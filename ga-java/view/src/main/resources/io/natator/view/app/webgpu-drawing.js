/** WebGPU as what draws a `GlPicture`: the same methods as `WebGlDrawing`. */

import {GpuRenderer} from './gpu-renderer.js';

/** On one canvas. */
export class WebGpuDrawing {
  #device;
  #pending = 0;

  /** What draws, for people. */
  name = 'WebGPU';
  renderer;

  /** `device` is that of `gpuDevice`. */
  constructor(canvas, device) {
    this.#device = device;
    this.renderer = new GpuRenderer(canvas, device);
  }

  /** To be called when a picture has been drawn. */
  finish() {
    this.renderer.finish();
    this.#pending++;
    const done = () => {
      this.#pending--;
    };
    this.#device.queue.onSubmittedWorkDone().then(done, done);
  }

  /** Whether the card still draws. */
  get isBusy() {
    return this.#pending > 0;
  }

  dispose() {
    this.renderer.dispose();
  }
}
