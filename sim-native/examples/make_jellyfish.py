"""Writes the mesh of the bundled jellyfish: python3 make_jellyfish.py > ../creatures/jellyfish.obj

A bell that is round about x, its top at x = 0, its rim at x = -18, open to the rear; a unit is a centimetre. Half ellipses make
its outside and, THICK further in, its inside; a half circle joins them at the rim.
"""
from math import cos, pi, sin

from rings import print_faces

HEIGHT, RADIUS, THICK = 18.0, 15.0, 5.4
AROUND, ALONG, RIM = 32, 10, 5


def outline():
    """(x, radius) from the top of the outside around the rim to the top of the inside."""
    inner = HEIGHT - THICK, RADIUS - THICK
    points = [(HEIGHT * (cos(a) - 1), RADIUS * sin(a)) for a in (pi / 2 * i / ALONG for i in range(ALONG + 1))]
    points += [(-HEIGHT - THICK / 2 * sin(a), RADIUS - THICK / 2 * (1 - cos(a))) for a in (pi * i / RIM for i in range(1, RIM))]
    return points + [(inner[0] * cos(a) - HEIGHT, inner[1] * sin(a)) for a in (pi / 2 * (1 - i / ALONG) for i in range(ALONG + 1))]


def main():
    print("# The bundled jellyfish, by make_jellyfish.py: forward x, up y, in centimetres.")
    (top, _), *rings, (hollow, _) = outline()
    print(f"v {top:.4f} 0 0")
    for x, radius in rings:
        for k in range(AROUND):
            print(f"v {x:.4f} {radius * sin(2 * pi * k / AROUND):.4f} {radius * cos(2 * pi * k / AROUND):.4f}")
    print(f"v {hollow:.4f} 0 0")
    print_faces(len(rings), AROUND)


main()
