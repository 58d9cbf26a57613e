/** What follows from a SCEN message and is needed in more than one place. */

/** Radius of drawn water in rest distances of the fluid. */
export const WATER_RADIUS = 0.58;
/** The same for the surface: larger, to close gaps. */
export const SURFACE_RADIUS = 0.85;
/** Radius of drawn body particles in rest distances of solids; neighbours in a body are half of one apart. */
export const BODY_RADIUS = 0.3;
/** Width of a drawn muscle in rest distances of solids. */
export const MUSCLE_WIDTH = 0.17;

/** Distance between marks on the floor, in length units. */
const MARK_SPACING = 0.5;
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

/**
 * What is drawn of a tank, from its bounds.
 *
 * @returns {{floor: number[][], marks: number[], edges: number[]}} corners of the floor; lines as six numbers each
 */
export function tankLines({min, max, walls}) {
  const [x0, y0, z0] = min;
  const [x1, y1, z1] = max;
  const marks = [];
  for (let x = Math.ceil(x0 / MARK_SPACING) * MARK_SPACING; x < x1; x += MARK_SPACING) {
    marks.push(x, y0, z0, x, y0, z1);
  }
  for (let z = Math.ceil(z0 / MARK_SPACING) * MARK_SPACING; z < z1; z += MARK_SPACING) {
    marks.push(x0, y0, z, x1, y0, z);
  }
  const corners = [[x0, z0], [x0, z1], [x1, z1], [x1, z0]];
  const edges = [];
  corners.forEach(([x, z], i) => {
    const [nextX, nextZ] = corners[(i + 1) % 4];
    edges.push(x, y0, z, nextX, y0, nextZ);
    if (walls) {
      edges.push(x, y1, z, nextX, y1, nextZ, x, y0, z, x, y1, z);
    }
  });
  return {floor: corners.map(([x, z]) => [x, y0, z]), marks, edges};
}

/** Muscles of a scene, of several between the same particles only one. */
export function distinctMuscles(scene) {
  return [...new Map(scene.muscles.map(muscle => [`${muscle.a} ${muscle.b}`, muscle])).values()];
}

/** How much a muscle is stretched (above 0) or contracted (below), -1 to 1. */
export function muscleChange(muscle, frame) {
  return Math.max(-1, Math.min(1, muscle.lateral * frame.activation[muscle.actuator]));
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
