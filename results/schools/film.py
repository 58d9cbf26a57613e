#!/usr/bin/env python3
"""Films a swimmer from above and the vorticity of its water, in plane flow: `film.py RUN -o FILE.png` simulates the winner of a run folder of natator evolve in its scene, in a tank twice as long, and
writes an animated PNG of its last beats, over and over."""
import argparse
import json
import pathlib

import natator
import numpy as np
from matplotlib import colormaps
from PIL import Image, ImageDraw, ImageFont

LEVELS, BODY, INK, ZOOM = 31, 31, 32, 2  # colours of the vorticity, then of the body and the text; pixels of a cell
PALETTE = [*(int(255 * c) for k in range(LEVELS) for c in colormaps["coolwarm"](k / (LEVELS - 1))[:3]), 60, 40, 20, 0, 0, 0]
LENGTH, WIDTH, TAIL, CELL = 6.4, 2.4, 4.4, 0.02
SCENE = {"planes": [[1, 0, 0, 0], [-1, 0, 0, LENGTH], [0, 0, 1, 0], [0, 0, -1, WIDTH]], "fluid": {"count": [round(LENGTH / CELL), 1, round(WIDTH / CELL)]},
         "creature": {"rearCentre": [TAIL, 0.01, WIDTH / 2]}, "stopping": {"planeContact": False, "noProgressAfter": 0}}


def picture(stream, strength, title):
    """Red where the water turns to the left, blue where to the right. The picture shows what is along x to the right, what is along z downwards."""
    water = stream.water()
    turns = water.vorticity()[:, 0, :, 1]
    level = np.clip(np.rint((np.tanh(turns / strength) / 2 + 0.5) * (LEVELS - 1)), 0, LEVELS - 1).astype(np.uint8)
    image = Image.fromarray(np.repeat(np.repeat(level.T, ZOOM, 0), ZOOM, 1)).convert("P")
    image.putpalette(PALETTE)
    draw, radius = ImageDraw.Draw(image), ZOOM * 0.55
    for x, z in stream.frame.position[stream.scene["body"]][:, [0, 2]] / CELL * ZOOM:
        draw.ellipse([x - radius, z - radius, x + radius, z + radius], fill=BODY)
    draw.text((6, 4), title, INK, ImageFont.load_default(13))
    return image


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", type=pathlib.Path)
    parser.add_argument("-o", "--output", type=pathlib.Path, required=True)
    parser.add_argument("--after", type=float, default=5, help="s, before the film begins")
    parser.add_argument("--beats", type=int, default=3)
    parser.add_argument("--pictures", type=int, default=10, help="of a beat")
    parser.add_argument("--strength", type=float, default=12, help="1/s, of a strong colour")
    given = parser.parse_args()
    best = json.loads((given.run / "best.json").read_text())
    beat = 1 / best["gait"]["frequency"]
    with natator.Stream(best["scene"], gait=best["gait"], overrides=SCENE, fields=("position",)) as stream:
        pictures, frames = [], 0
        for k in range(given.beats * given.pictures):
            due = round((given.after + k * beat / given.pictures) * 60)
            sensed = stream.step(due - frames)
            frames = due
            pictures.append(picture(stream, given.strength, f"{sensed.time:.1f} s, {sensed.distance / stream.scene['bodyLength']:.1f} body lengths"))
    pictures[0].save(given.output, save_all=True, append_images=pictures[1:], duration=round(1000 * beat / given.pictures), loop=0, optimize=True)


if __name__ == "__main__":
    main()
