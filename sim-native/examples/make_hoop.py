"""Writes the mesh of the bundled hoop: python3 make_hoop.py > ../creatures/hoop.obj

A torus about the x axis, y up, z right; the circle in the middle of its tube has radius 1.
"""
from math import cos, pi, sin

TUBE, AROUND, ALONG = 0.28, 16, 48  # radius of the tube; corners around it, and along the circle


def corner(along, around):
    return 1 + along % ALONG * AROUND + around % AROUND


print("# The bundled hoop, by make_hoop.py: a torus about x, its circle of radius 1.")
for along in range(ALONG):
    for around in range(AROUND):
        a, b = 2 * pi * along / ALONG, 2 * pi * around / AROUND
        radius = 1 + TUBE * cos(b)
        print(f"v {TUBE * sin(b):.5f} {radius * cos(a):.5f} {radius * sin(a):.5f}")
for along in range(ALONG):
    for around in range(AROUND):
        one, two = corner(along, around), corner(along + 1, around)
        three, four = corner(along + 1, around + 1), corner(along, around + 1)
        print(f"f {one} {two} {three}")
        print(f"f {one} {three} {four}")
