/** Where a tank that moves along with its swimmer has come to (`movingTank` of a scene): frames tell places within it. */

import {centreOf} from './scene.js';

/** Puts frames where they are over ground, taken from the first one on. */
export class MovingTank {
  /** @type {Scene|null} */
  #scene = null;
  #axes = [];
  #step = 0;
  #origin = [0, 0, 0];
  #last = null;

  /**
   * Takes over what is known of a scene (SCEN).
   *
   * @param {Scene} scene
   */
  setScene(scene) {
    const {movingTank} = scene.definition ?? {};
    this.#axes = movingTank && scene.body.length > 0 ? [...movingTank.along ?? 'x'].map(axis => 'xyz'.indexOf(axis)) : [];
    this.#step = movingTank?.step ?? 0.4;
    this.#scene = scene;
    if (scene.restarted) {
      this.#origin = [0, 0, 0];
      this.#last = null;
    }
  }

  /**
   * Adds to a frame how far its tank has moved (`origin`), and to its places as much. The tank moves by whole steps, which
   * are much more than a body goes in a frame: what the body's middle lacks of how far it went is the tank's.
   *
   * @param {Frame} frame
   */
  follow(frame) {
    if (this.#axes.length === 0) {
      frame.origin = [0, 0, 0];
      return;
    }
    const {time, distance} = frame;
    const velocity = Array.from(frame.velocity);
    const centre = centreOf(this.#scene.body, frame.position, [0, 0, 0]);
    const last = this.#last ?? {time, distance, velocity, centre};
    for (const axis of this.#axes) {
      const gone = axis === 0 ? distance - last.distance : (time - last.time) * (velocity[axis] + last.velocity[axis]) / 2;
      this.#origin[axis] += this.#step * Math.round((gone - centre[axis] + last.centre[axis]) / this.#step);
    }
    this.#last = {time, distance, velocity, centre};
    frame.origin = [...this.#origin];
    for (const axis of this.#axes) {
      for (let i = axis; i < frame.position.length; i += 3) {
        frame.position[i] += this.#origin[axis];
      }
    }
  }
}
