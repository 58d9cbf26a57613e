"""Writes the mesh of the bundled ray: python3 make_ray.py > ../creatures/ray.obj

Elliptic rings along x, the nose at x = 0, the end of the tail at x = -30, y up, z right; a unit is a centimetre. Half widths
and half heights of the rings are monotone cubics (PCHIP's rule) through the points below.
"""
from math import cos, pi, sin

LENGTH, RINGS, AROUND = 30.0, 24, 24
HALF_WIDTH = [(0, 1.5), (0.1, 5.0), (0.35, 9.0), (0.6, 6.0), (0.75, 3.6), (1, 3.0)]
HALF_HEIGHT = [(0, 1.5), (0.2, 3.5), (0.45, 3.7), (0.75, 2.6), (1, 1.8)]


def slopes(points):
    """Fritsch and Butland's, flat at both ends."""
    steps = [(b[0] - a[0], (b[1] - a[1]) / (b[0] - a[0])) for a, b in zip(points, points[1:])]
    result = [0.0]
    for (h0, d0), (h1, d1) in zip(steps, steps[1:]):
        w0, w1 = h0 + 2 * h1, 2 * h0 + h1
        result.append((w0 + w1) / (w0 / d0 + w1 / d1) if d0 * d1 > 0 else 0.0)
    return result + [0.0]


def value(points, at):
    """Of the curve at a part of the length."""
    slope = slopes(points)
    i = max(k for k in range(len(points) - 1) if points[k][0] <= at)
    (x0, y0), (x1, y1) = points[i], points[i + 1]
    h, t = x1 - x0, (at - x0) / (x1 - x0)
    return ((1 + 2 * t) * (1 - t) ** 2 * y0 + t * t * (3 - 2 * t) * y1
            + h * t * (1 - t) * ((1 - t) * slope[i] - t * slope[i + 1]))


def main():
    print("# The bundled ray, by make_ray.py: forward x, up y, in centimetres.")
    print("v 0 0 0")
    for ring in range(RINGS):
        part = ring / (RINGS - 1) * 0.98 + 0.01
        for k in range(AROUND):
            angle = 2 * pi * k / AROUND
            print(f"v {-LENGTH * part:.4f} {value(HALF_HEIGHT, part) * sin(angle):.4f}"
                  f" {value(HALF_WIDTH, part) * cos(angle):.4f}")
    print(f"v {-LENGTH:.4f} 0 0")
    last = 2 + RINGS * AROUND

    def corner(ring, k):
        return 2 + ring * AROUND + k % AROUND

    for k in range(AROUND):
        print(f"f 1 {corner(0, k + 1)} {corner(0, k)}")
    for ring in range(RINGS - 1):
        for k in range(AROUND):
            print(f"f {corner(ring, k)} {corner(ring + 1, k + 1)} {corner(ring + 1, k)}")
            print(f"f {corner(ring, k)} {corner(ring, k + 1)} {corner(ring + 1, k + 1)}")
    for k in range(AROUND):
        print(f"f {last} {corner(RINGS - 1, k)} {corner(RINGS - 1, k + 1)}")


main()
