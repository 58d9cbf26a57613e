/** How the shapes of water lie in an array. */

/**
 * Numbers of each shape: centre x, y, z, value; xx, yy, zz of its matrix, foam; xy, xz, yz of its matrix, and 1 if it is of
 * a free surface and no spray, else 0.
 */
export const SHAPE_NUMBERS = 12;
