/** A plane through the water by the processor: a ray through each pixel. */

import {addArrows} from './arrows.js';
import {SCALES, fadingBytes, risingBytes} from './colours.js';
import {NEAREST} from './projector.js';

/** Pixels of the picture for each that is computed, along each side. */
const SHARE = 0.5;
/** Half the width of an arrow, pixels. */
const ARROW_WIDTH = 0.6;
const ARROW_OPACITY = 0.8;

/** Draws the slice of a `Wake`. */
export class PlainSlice {
  #canvas = document.createElement('canvas');
  #context = this.#canvas.getContext('2d');
  #colours = {
    vorticity: new Uint32Array(fadingBytes(SCALES.turning).buffer), velocity: new Uint32Array(risingBytes(SCALES.sequential).buffer),
    pressure: new Uint32Array(fadingBytes(SCALES.diverging).buffer),
  };

  /** Over a canvas of this size, as a `Projector` sees it; arrows in a colour, as CSS. */
  draw(context, width, height, projector, wake, ink) {
    const columns = Math.max(1, Math.round(SHARE * width));
    const rows = Math.max(1, Math.round(SHARE * height));
    if (this.#canvas.width !== columns || this.#canvas.height !== rows) {
      this.#canvas.width = columns;
      this.#canvas.height = rows;
    }
    const image = this.#context.createImageData(columns, rows);
    const pixels = new Uint32Array(image.data.buffer);
    const {eye, forward, right, up} = projector;
    const {slice, kind, range: [least, most]} = wake;
    const colours = this.#colours[kind];
    const last = colours.length - 1;
    const [normal, u, v] = [slice.axis, ...slice.sides].map(axis => 'xyz'[axis]);
    for (let row = 0, at = 0; row < rows; row++) {
      const upwards = (projector.middleY - (row + 0.5) * height / rows) / projector.pixels;
      for (let column = 0; column < columns; column++, at++) {
        const across = ((column + 0.5) * width / columns - projector.middleX) / projector.pixels;
        const depth = (slice.height - eye[normal]) / (forward[normal] + across * right[normal] + upwards * up[normal]);
        if (depth > NEAREST) {
          const x = eye[u] + depth * (forward[u] + across * right[u] + upwards * up[u]);
          const z = eye[v] + depth * (forward[v] + across * right[v] + upwards * up[v]);
          if (x > slice.from[0] && x < slice.to[0] && z > slice.from[1] && z < slice.to[1]) {
            const share = Math.min(1, Math.max(0, (sample(slice, x, z) - least) / (most - least)));
            pixels[at] = colours[Math.round(last * share)];
          }
        }
      }
    }
    this.#context.putImageData(image, 0, 0);
    context.drawImage(this.#canvas, 0, 0, width, height);
    context.fillStyle = ink;
    context.globalAlpha = ARROW_OPACITY;
    context.beginPath();
    addArrows(context, projector, slice.arrows, ARROW_WIDTH);
    context.fill();
    context.globalAlpha = 1;
  }
}

/** A number counted on from 0 where it has reached `count`. */
function within(number, count) {
  return (number % count + count) % count;
}

/** The value at a place, interpolated between the middles of cells. */
function sample({values, columns, rows, cell, low}, x, z) {
  const across = (x - low[0]) / cell - 0.5;
  const along = (z - low[1]) / cell - 0.5;
  const left = Math.floor(across);
  const back = Math.floor(along);
  const shareX = across - left;
  const shareZ = along - back;
  const x0 = within(left, columns);
  const x1 = within(left + 1, columns);
  const z0 = columns * within(back, rows);
  const z1 = columns * within(back + 1, rows);
  return (1 - shareZ) * ((1 - shareX) * values[x0 + z0] + shareX * values[x1 + z0])
      + shareZ * ((1 - shareX) * values[x0 + z1] + shareX * values[x1 + z1]);
}
