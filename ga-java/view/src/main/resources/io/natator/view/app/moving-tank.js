/** Where a tank that moves along with its swimmer has come to (`movingTank` of a scene): frames tell places within it. */

import {centreOf} from './scene.js';

/** Puts frames where they are over ground, taken from the first one on. */
export class MovingTank {
  /** @type {Scene|null} */
  #scene = null;
  #axes = [];
  #step = 0;
  /** Where the body's middle is in the tank at first: it moves once that is a step away. */
  #home = null;
  #before = null;
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
      this.#home = null;
    }
  }

  /**
   * Adds to a frame how far its tank has moved (`origin`), and to its places as much. The tank moves by whole steps, which
   * are much more than a body goes in a frame: what the body's middle lacks of how far it went is the tank's.
   *
   * @param {Frame} frame
   */
  follow(frame) {
    frame.origin = [0, 0, 0];
    if (this.#axes.length === 0) {
      return;
    }
    const {time, distance, velocity} = frame;
    const centre = centreOf(this.#scene.body, frame.position, [0, 0, 0]);
    const now = {time, distance, velocity, centre, origin: frame.origin};
    const last = this.#home === null ? now : this.#last;
    this.#home ??= [...centre];
    for (const axis of this.#axes) {
      const gone = axis === 0 ? distance - last.distance : (time - last.time) * (velocity[axis] + last.velocity[axis]) / 2;
      frame.origin[axis] = last.origin[axis] + this.#step * Math.round((gone - centre[axis] + last.centre[axis] - last.origin[axis]) / this.#step);
      centre[axis] += frame.origin[axis];
      for (let i = axis; i < frame.position.length; i += 3) {
        frame.position[i] += frame.origin[axis];
      }
    }
    this.#before = last;
    this.#last = now;
  }

  /** How far the tank had moved at a time between the last two frames, from one of which to the other the body goes evenly. */
  originAt(time) {
    if (this.#axes.length === 0) {
      return [0, 0, 0];
    }
    const [from, to] = [this.#before, this.#last];
    const share = to.time > from.time ? Math.min(1, Math.max(0, (time - from.time) / (to.time - from.time))) : 1;
    return to.origin.map((end, axis) => {
      const begin = from.origin[axis];
      const ahead = from.centre[axis] + share * (to.centre[axis] - from.centre[axis]) - begin - this.#home[axis];
      const moved = begin + this.#step * Math.trunc(ahead / this.#step);
      return share === 1 ? end : Math.min(Math.max(begin, end), Math.max(Math.min(begin, end), moved));
    });
  }
}
