/** What follows from a SCEN message and is needed in more than one place. */

import {clusterColours} from './colours.js';

/** Radius of drawn water in rest distances of the fluid. */
export const WATER_RADIUS = 0.58;
/** The same for the surface: larger, to close gaps. */
export const SURFACE_RADIUS = 0.85;
/** Radius of drawn body particles in spacings of the body. */
export const BODY_RADIUS = 0.6;
/** Width of a drawn muscle, likewise. */
export const MUSCLE_WIDTH = 0.34;

/** Distance between marks on the floor, in length units. */
export const MARK_SPACING = 0.5;
/** Margin around what has no walls, in length units. */
const MARGIN = 0.6;

/**
 * The tank: the box that axis-parallel planes make. It has no lid; it is as high as what it holds at first, or as its lattice. A periodic axis
 * has no walls: of it as much is shown around the body as the tank is long.
 *
 * @param {Scene} scene SCEN
 * @param {Float32Array} position of all particles in the settled start
 * @returns {{min: number[], max: number[], walls: boolean, open: boolean[]}} walls is false where planes are missing and the
 *     box is just around the particles; whether an axis is periodic
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
  if (hasLattice(scene)) {
    const {count, spacing, origin} = lattice(scene);
    low[1] = origin[1] - spacing / 2;
    high[1] = low[1] + count[1] * spacing;
  } else if (walls > 0) {
    high[1] = max[1] + scene.solidRestDistance;
  }
  return boundsAround({min: low, max: high, walls: walls > 0, open: AXES.map(axis => axis in periodic(scene))}, scene, position);
}

const AXES = ['x', 'y', 'z'];

/**
 * The axes that have no ends, each with where its tank begins and ends; streams of before know none.
 *
 * @param {Scene} scene
 */
function periodic(scene) {
  return scene.periodic ?? {};
}

/**
 * Whether its tank moves along with the body.
 *
 * @param {Scene} scene
 */
export function hasOpenAxes(scene) {
  return Object.keys(periodic(scene)).length > 0;
}

/**
 * The same bounds where a tank has moved to (`MovingTank`).
 *
 * @param {number[]} origin
 */
export function movedBounds(bounds, origin) {
  return {...bounds, min: bounds.min.map((value, axis) => value + origin[axis]),
    max: bounds.max.map((value, axis) => value + origin[axis])};
}

/**
 * The same bounds about where the body now is along periodic axes; without a body where the tank is.
 *
 * @param {Scene} scene
 */
export function boundsAround(bounds, scene, position) {
  const min = [...bounds.min];
  const max = [...bounds.max];
  const centre = scene.body.length > 0 ? centreOf(scene.body, position, [0, 0, 0]) : null;
  for (const [name, [low, high]] of Object.entries(periodic(scene))) {
    const axis = AXES.indexOf(name);
    const middle = centre === null ? (low + high) / 2 : centre[axis];
    min[axis] = middle - (high - low) / 2;
    max[axis] = middle + (high - low) / 2;
  }
  return {...bounds, min, max};
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
 * What is drawn of a tank, from its bounds: nothing where an open axis is cut off.
 *
 * @returns {{floor: number[][], marks: number[], edges: number[]}} corners of the floor; lines as six numbers each
 */
export function tankLines({min, max, walls, open}) {
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
    if (!open[x === nextX ? 0 : 2]) {
      edges.push(x, y0, z, nextX, y0, nextZ);
      if (walls) {
        edges.push(x, y1, z, nextX, y1, nextZ);
      }
    }
    if (walls && !open[0] && !open[2]) {
      edges.push(x, y0, z, x, y1, z);
    }
  });
  return {floor: corners.map(([x, z]) => [x, y0, z]), marks, edges};
}

/**
 * Distance of neighbouring particles in a body, length.
 *
 * @param {Scene} scene
 */
export function bodySpacing(scene) {
  return scene.slices.length > 1 ? scene.bodyLength / (scene.slices.length - 1) : scene.solidRestDistance / 2;
}

/**
 * How far what is around a body reaches, length: as far as that is long; without a body half the tank.
 *
 * @param {Scene} scene
 * @param {number} tank how long that is
 */
export function bodiesReach(scene, tank) {
  return scene.bodyLength > 0 ? scene.bodyLength : tank / 2;
}

/**
 * All particles that are no water: of the body, of companions, of obstacles.
 *
 * @param {Scene} scene
 */
export function solids(scene) {
  const [first, count] = scene.fluid;
  return Array.from({length: scene.particles}, (_, i) => i).filter(i => i < first || i >= first + count);
}

/**
 * Muscles of a scene, of several between the same particles only one.
 *
 * @param {Scene} scene
 */
export function distinctMuscles(scene) {
  return [...new Map(scene.muscles.map(muscle => [`${muscle.a} ${muscle.b}`, muscle])).values()];
}

/**
 * How much a muscle is stretched (above 0) or contracted (below), -1 to 1.
 *
 * @param {Frame} frame
 */
export function muscleChange(muscle, frame) {
  return Math.max(-1, Math.min(1, muscle.lateral * frame.activation[muscle.actuator]));
}

/**
 * Whether the water is on a lattice. The definition of a recording has `fluid` only where that water is in it.
 *
 * @param {Scene} scene
 */
function hasLattice(scene) {
  return scene.scheme === 'lattice' && !!scene.definition?.fluid;
}

/** The cells of such water: `fluid` of a scene, with its defaults. */
function lattice(scene) {
  return {count: [50, 7, 17], spacing: 0.09, origin: [0.05, 0.05, 0.05], ...scene.definition.fluid};
}

/** Whether water is shown as its particles are, and else as it flows. */
export function isParticles(water) {
  return water === 'spheres' || water === 'surface';
}

/** Whether water is shown on a plane through it. */
export function isPlane(water) {
  return water === 'vorticity' || water === 'velocity' || water === 'pressure';
}

/** The ways to show water, of what `contents` tells: on a lattice there are no particles, in plane flow no vortices in space. */
export function watersOf({water, wake, vortices, forces}) {
  const has = {spheres: water, surface: water, vorticity: wake, velocity: wake, pressure: wake && forces, vortices, none: true};
  return Object.keys(has).filter(name => has[name]);
}

/** What is shown where a look asks for a way to show water that is not there: the vortices, in plane flow its vorticity. */
export function waterShown(water, has) {
  return watersOf(has).includes(water) ? water : has.vortices ? 'vortices' : has.wake ? 'vorticity' : 'none';
}

/**
 * What there is to be seen in some scenes: water of particles, water on a lattice, a wake (in any water), vortices in space,
 * forces of the water and its pressure, muscles, bodies, others (companions and obstacles). Of recordings a wake is known where their definition has `fluid`.
 *
 * @param {Scene[]} scenes
 */
export function contents(scenes) {
  const isWet = scene => scene.fluid[1] > 0 || hasLattice(scene);
  return {
    water: scenes.some(({fluid}) => fluid[1] > 0),
    lattice: scenes.some(hasLattice),
    wake: scenes.some(scene => isWet(scene) && !!scene.definition?.fluid),
    vortices: scenes.some(scene => isWet(scene) && !!scene.definition?.fluid && !(hasLattice(scene) && lattice(scene).count[1] === 1)),
    forces: scenes.some(({fields}) => fields?.includes('force') ?? false),
    muscles: scenes.some(({muscles}) => muscles.length > 0),
    bodies: scenes.some(({body}) => body.length > 0),
    others: scenes.some(({particles, fluid, body}) => particles > fluid[1] + body.length),
  };
}

/** Companions and obstacles. */
const OTHER_COLOUR = [0.56, 0.62, 0.66];

/**
 * What is drawn of the particles that are no water.
 *
 * @returns {{colours: number[][], of: Int16Array, joint: Uint8Array}} colours of the body's clusters, from the head on, and
 *     after them one for companions and obstacles; for each particle which colour it has, −1 for water (a joint's particles
 *     count to the cluster in front); and whether it belongs to a joint of the body
 */
export function solidKinds(scene) {
  const own = new Set(scene.body);
  const clusters = scene.clusters.filter(particles => own.has(particles[0]));
  const of = new Int16Array(scene.particles).fill(-1);
  solids(scene).forEach(particle => {
    of[particle] = own.has(particle) && clusters.length === 0 ? 0 : clusters.length;
  });
  clusters.toReversed().forEach((particles, behind) => particles.forEach(particle => {
    of[particle] = clusters.length - 1 - behind;
  }));
  const joint = new Uint8Array(scene.particles);
  scene.joints.forEach(slice => scene.slices[slice].forEach(particle => {
    joint[particle] = 1;
  }));
  return {colours: [...clusterColours(clusters.length), OTHER_COLOUR], of, joint};
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
