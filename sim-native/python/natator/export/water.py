"""The surface of water that is particles, as a closed mesh; see sim-native/docs/exporting.md."""

import numpy as np

# In radii of a particle, which is half the spacing; the iso-value is a share of the rest density.
SMOOTHING_LENGTH, CUBE, ISO_VALUE, SMOOTHINGS = 2.0, 0.75, 0.6, 15


def with_mirrored(places, planes, reach):
    """The places, and behind every wall their mirror images up to `reach`, so that the water goes on there."""
    for plane in planes:
        height = places @ plane[:3] + plane[3]
        near = height < reach
        places = np.vstack([places, places[near] - 2 * height[near, None] * plane[:3]])
    return places


def onto_walls(vertices, planes):
    """Projects points behind a wall onto it."""
    for plane in planes:
        vertices = vertices - np.minimum(vertices @ plane[:3] + plane[3], 0)[:, None] * plane[:3]
    return vertices


def components(triangles, count):
    """For each vertex the least vertex that edges connect it with."""
    label = np.arange(count)
    while True:
        before = label.copy()
        np.minimum.at(label, triangles.ravel(), np.repeat(label[triangles].min(1), 3))
        label = label[label]
        if np.array_equal(label, before):
            return label


def without_cavities(vertices, triangles):
    """Without parts that are seen from inside: what they enclose is no water, but does not reach the air."""
    label = components(triangles, len(vertices))[triangles[:, 0]]
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    volume = np.bincount(label, np.einsum("ij,ij->i", a, np.cross(b, c)), len(vertices))
    kept = triangles[volume[label] > 0]
    used, triangles = np.unique(kept, return_inverse=True)
    return vertices[used], triangles.reshape(-1, 3)


class WaterSurface:
    """Called with a frame: vertices (V, 3) and triangles (T, 3), counter-clockwise seen from outside, of the closed surface of its
    water; called with the same frame again, the same."""

    def __init__(self, swim):
        import pysplashsurf  # not everybody has it

        self._splashsurf = pysplashsurf
        self._water, self._spacing = swim.all_water, swim.scene["fluidRestDistance"]
        self._planes = np.array(swim.scene["planes"], float).reshape(-1, 4)
        self._frame = self._mesh = None

    def __call__(self, frame):
        if frame is not self._frame:
            vertices, triangles = self._made(frame.position[self._water].astype(float))
            self._frame, self._mesh = frame, (vertices.astype("f4"), triangles.astype("i4"))
        return self._mesh

    def _made(self, places):
        radius = self._spacing / 2
        mesh = self._splashsurf.reconstruction_pipeline(
            with_mirrored(places, self._planes, 2 * SMOOTHING_LENGTH * radius), particle_radius=radius,
            smoothing_length=SMOOTHING_LENGTH, cube_size=CUBE, iso_surface_threshold=ISO_VALUE, mesh_cleanup=True,
            decimate_barnacles=True, mesh_smoothing_iters=SMOOTHINGS, mesh_smoothing_weights=True,
            multi_threading=False)[0].mesh
        vertices, triangles = np.array(mesh.vertices), np.array(mesh.triangles).astype(np.int64)
        return without_cavities(onto_walls(vertices, self._planes), triangles)
