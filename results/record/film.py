"""Draws `python -m natator export --format npz --no-water` as a film: the body from above and from the side, each to scale.

    film.py FOLDER PICTURE.png

The picture is an animated PNG. Needs numpy and Pillow (./setup.sh --readers).
"""

import pathlib
import sys

import numpy as np
from PIL import Image, ImageDraw

UNIT, WIDTH, HEIGHT = 96, 900, 300  # pixels a length; pixels
STEP = 0.4  # of the moving tank, length
VIEWS = ((2, 80, "from above"), (1, 220, "from the side"))  # axis that is drawn downwards, its middle, its name
PAPER, INK, BODY = "#fbfcfd", "#5b6770", "#1f6f8b"


def draw(frame, time, across):
    """One picture of the body's particles, shape [n, 3]; `across`: where the middle of each axis was at the start."""
    picture = Image.new("RGB", (WIDTH, HEIGHT), PAPER)
    pen = ImageDraw.Draw(picture)
    for axis, middle, name in VIEWS:
        pen.text((8, middle - 60), name, fill=INK)
        for x, y in zip(frame[:, 0] * UNIT, middle + (frame[:, axis] - across[axis]) * UNIT * (1 if axis == 2 else -1)):
            pen.ellipse((x - 4, y - 4, x + 4, y + 4), fill=BODY)
    pen.line((WIDTH - 20 - UNIT, HEIGHT - 16, WIDTH - 20, HEIGHT - 16), fill=INK, width=2)
    pen.text((WIDTH - 20 - UNIT, HEIGHT - 32), f"1 length    {time:.2f} s", fill=INK)
    return picture


def over_ground(centres):
    """What to add to places in the moving tank, [frames, 3]: all steps that it took back so far."""
    taken_back = np.round(np.diff(centres, axis=0) / STEP) * STEP
    return -np.vstack([np.zeros(3), np.cumsum(taken_back, axis=0)])


def main(folder, picture):
    swim = np.load(pathlib.Path(folder) / "swim.npz")
    positions, times = swim["position"].astype(float), swim["time"]
    positions += over_ground(positions.mean(axis=1))[:, None, :]
    positions[:, :, 0] -= positions[0, :, 0].min() - 0.1
    across = positions[0].mean(axis=0)
    frames = [draw(frame, time, across).quantize(16) for frame, time in zip(positions, times)]
    step = 1000 * (times[1] - times[0])
    frames[0].save(picture, save_all=True, append_images=frames[1:], duration=step, loop=0, optimize=True)


main(*sys.argv[1:])
