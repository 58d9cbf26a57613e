"""The surface of water that is particles, frame by frame, for `natator export --water-surface`; see exporting.md.

Standard input: a line of JSON, {"spacing": rest distance of the water, "particles": N, "planes": [[nx, ny, nz, d], ...]},
then for each frame N places, x, y, z as little-endian 32-bit floats. Standard output for each frame: the numbers V of
vertices and T of triangles, unsigned 32-bit, V times x, y, z, and T times three vertices, counter-clockwise seen from
outside the water, unsigned 32-bit. Ends with its input.
"""

import json
import sys

import numpy as np
import pysplashsurf

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
    """What is behind a wall goes to the nearest place on it."""
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


def surface(places, spacing, planes):
    """Vertices (V, 3) and triangles (T, 3) of the closed surface of the water."""
    radius = spacing / 2
    mesh = pysplashsurf.reconstruction_pipeline(
        with_mirrored(places, planes, 2 * SMOOTHING_LENGTH * radius), particle_radius=radius,
        smoothing_length=SMOOTHING_LENGTH, cube_size=CUBE, iso_surface_threshold=ISO_VALUE, mesh_cleanup=True,
        decimate_barnacles=True, mesh_smoothing_iters=SMOOTHINGS, mesh_smoothing_weights=True,
        multi_threading=False)[0].mesh
    vertices, triangles = np.array(mesh.vertices), np.array(mesh.triangles).astype(np.int64)
    return without_cavities(onto_walls(vertices, planes), triangles)


def main(source, target):
    head = json.loads(source.readline())
    planes = np.array(head["planes"], float).reshape(-1, 4)
    size = 12 * head["particles"]
    while len(frame := source.read(size)) == size:
        places = np.frombuffer(frame, "<f4").reshape(-1, 3).astype(float)
        vertices, triangles = surface(places, head["spacing"], planes)
        target.write(np.array([len(vertices), len(triangles)], "<u4").tobytes())
        target.write(vertices.astype("<f4").tobytes())
        target.write(triangles.astype("<u4").tobytes())
        target.flush()


if __name__ == "__main__":
    main(sys.stdin.buffer, sys.stdout.buffer)
