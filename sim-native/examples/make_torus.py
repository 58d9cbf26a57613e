"""Writes the mesh of the bundled torus: python3 make_torus.py > ../creatures/torus.obj

A ring that lies flat, about y; a unit is a centimetre.
"""
from math import cos, pi, sin

RADIUS, TUBE = 15.0, 4.5
AROUND, ACROSS = 40, 16


def main():
    print("# The bundled torus, by make_torus.py: forward x, up y, in centimetres.")
    for i in range(AROUND):
        for k in range(ACROSS):
            away = RADIUS + TUBE * cos(2 * pi * k / ACROSS)
            print(f"v {away * cos(2 * pi * i / AROUND):.4f} {TUBE * sin(2 * pi * k / ACROSS):.4f}"
                  f" {away * sin(2 * pi * i / AROUND):.4f}")

    def corner(i, k):
        return 1 + i % AROUND * ACROSS + k % ACROSS

    for i in range(AROUND):
        for k in range(ACROSS):
            print(f"f {corner(i, k)} {corner(i, k + 1)} {corner(i + 1, k + 1)} {corner(i + 1, k)}")


main()
