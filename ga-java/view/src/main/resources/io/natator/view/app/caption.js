/** What stands below a picture. */

import {isSameGait} from './gait.js';

/**
 * Who swims there: run and generation, or which other gait, and in what.
 *
 * @param {object} view with `scene` and `origin`
 * @param {object} gaits the published ones by scene, or absent
 * @returns {string[]} a name, and a line beneath it
 */
export function caption({scene, origin}, gaits) {
  const place = scene.scene.split('/').at(-1);
  const figures = [scene.scheme, ...scene.actuators > 0 ? [`${scene.gait.frequency.toFixed(2)} beats/s`] : [],
    `${scene.particles} particles`];
  if (origin !== null) {
    return [`${origin.run}, ${origin.label ?? 'a gait'}`, [place, ...figures].join(', ')];
  }
  const published = gaits?.[scene.scene] ?? null;
  const gait = scene.actuators === 0 ? '' : isSameGait(scene.gait, published) ? ', published gait' : ', gait of your own';
  return [place + gait, figures.join(', ')];
}
