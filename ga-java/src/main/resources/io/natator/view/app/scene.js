/** What follows from a SCEN message and is needed in more than one place. */

/** Margin around what has no walls, in length units. */
const MARGIN = 0.6;

/**
 * The tank: the box that axis-parallel planes make. It has no lid; it is as high as what it holds at first.
 *
 * @param {object} scene SCEN
 * @param {Float32Array} position of all particles in the settled start
 * @returns {{min: number[], max: number[], walls: boolean}} walls is false where planes are missing and the box is just
 *     around the particles
 */
export function tankBounds(scene, position) {
  const {min, max} = extent(position);
  const low = min.map(value => value - MARGIN);
  const high = max.map(value => value + MARGIN);
  let walls = 0;
  for (const [x, y, z, d] of scene.planes) {
    const normal = [x, y, z];
    const axis = normal.findIndex(component => Math.abs(component) > 0.999);
    if (axis >= 0 && normal[axis] > 0) {
      low[axis] = -d;
      walls++;
    } else if (axis >= 0) {
      high[axis] = d;
      walls++;
    }
  }
  if (walls > 0) {
    high[1] = max[1] + scene.solidRestDistance;
  }
  return {min: low, max: high, walls: walls > 0};
}

function extent(position) {
  const min = [Infinity, Infinity, Infinity];
  const max = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < position.length; i++) {
    const axis = i % 3;
    min[axis] = Math.min(min[axis], position[i]);
    max[axis] = Math.max(max[axis], position[i]);
  }
  return {min, max};
}

/** The cluster of each body particle, in the order of `scene.body`; a joint's particles count to the one in front. */
export function clusterOfBody(scene) {
  const clusterOf = new Map();
  scene.clusters.forEach((particles, cluster) => particles.forEach(particle => {
    if (!clusterOf.has(particle)) {
      clusterOf.set(particle, cluster);
    }
  }));
  return scene.body.map(particle => clusterOf.get(particle) ?? 0);
}

/** Whether each body particle, in the order of `scene.body`, belongs to a joint. */
export function jointOfBody(scene) {
  const joint = new Set(scene.joints.flatMap(slice => scene.slices[slice]));
  return scene.body.map(particle => joint.has(particle));
}

/** Mean place of some particles, written into `out`, which is returned. */
export function centreOf(particles, position, out) {
  let x = 0;
  let y = 0;
  let z = 0;
  for (const particle of particles) {
    x += position[3 * particle];
    y += position[3 * particle + 1];
    z += position[3 * particle + 2];
  }
  out[0] = x / particles.length;
  out[1] = y / particles.length;
  out[2] = z / particles.length;
  return out;
}
