"""Writes the mesh of the bundled turtle: python3 make_turtle.py > ../creatures/turtle.obj

Seen from above a star around x = z = 0: an ellipse, the shell, with a head, two flippers and two hind flippers; a unit is a
centimetre. The shell is domed above and flatter below.
"""
from math import cos, exp, hypot, pi, radians, sin, sqrt

from rings import print_faces

LONG, WIDE, HIGH, DEEP = 11.0, 8.5, 6.0, 4.5  # half axes of the shell
LIMBS = [(0, 7, 16), (62, 13, 17), (145, 9, 17)]  # degrees from the head, length beyond the shell, half width in degrees
THICK = 3.2  # half of the limbs
AROUND, RINGS = 72, 10


def shell(angle):
    return 1 / hypot(cos(angle) / LONG, sin(angle) / WIDE)


def edge(angle):
    """How far the outline is from the middle."""
    def beyond(degrees, length, half):
        return length * exp(-((angle - radians(degrees)) / radians(half)) ** 4)

    angle = abs(angle if angle <= pi else angle - 2 * pi)
    return shell(angle) + sum(beyond(*limb) for limb in LIMBS)


def height(part, angle, most):
    """Of the surface above or below the plane y = 0, at a part of the way to the outline."""
    inside = part * edge(angle) / shell(angle)
    return max(most * sqrt(max(0, 1 - inside ** 2)), THICK * sqrt(1 - part ** 6))


def main():
    print("# The bundled turtle, by make_turtle.py: forward x, up y, in centimetres.")
    parts = [ring / RINGS for ring in range(1, RINGS)]
    rings = [(part, HIGH) for part in parts] + [(1, 0)] + [(part, -DEEP) for part in reversed(parts)]
    print(f"v 0 {HIGH:.4f} 0")
    for part, most in rings:
        for k in range(AROUND):
            angle = 2 * pi * k / AROUND
            away, y = part * edge(angle), height(part, angle, abs(most)) * (most > 0 or -1) if most else 0
            print(f"v {away * cos(angle):.4f} {y:.4f} {away * sin(angle):.4f}")
    print(f"v 0 {-DEEP:.4f} 0")
    print_faces(len(rings), AROUND)


main()
