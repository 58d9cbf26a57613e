/** Swimmers: a gait and, where a run has evolved bodies, the overrides of the scene that make the body. */

import {isSameGait} from './gait.js';

/** Whether two patches, of which either may be absent, say the same, in whatever order. */
export function isSamePatch(one, other) {
  const sorted = (_, value) => value !== null && typeof value === 'object' && !Array.isArray(value)
      ? Object.fromEntries(Object.entries(value).sort(([a], [b]) => a < b ? -1 : 1)) : value;
  return JSON.stringify(one ?? {}, sorted) === JSON.stringify(other ?? {}, sorted);
}

/** Whether a swimmer of a run is another one of it, or what a scene (SCEN) holds; one without overrides has the scene's body. */
export function isSameSwimmer(swimmer, other) {
  return isSameGait(swimmer.gait, other.gait)
      && (!swimmer.overrides || isSamePatch(swimmer.overrides.creature, other.overrides?.creature));
}
