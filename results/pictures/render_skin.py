"""Draws times of `python -m natator export --format usd` below each other: the mesh that the body was made of, as it moves.

    render_skin.py FOLDER/swim.usda PICTURE.png TIMECODE...

Off screen, with pyvista and usd-core (./setup.sh --readers).
"""

import sys

import numpy as np
import pyvista
from PIL import Image
from pxr import Usd, UsdGeom


def main(file, picture, *codes):
    stage = Usd.Stage.Open(file)
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/Swim/Body"))
    corners = np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)
    faces = np.hstack([np.full((len(corners), 1), 3), corners])
    colours = (255 * np.array(mesh.GetDisplayColorAttr().Get())).astype("u1")

    plotter = pyvista.Plotter(off_screen=True, window_size=(900, 260 * len(codes)))
    plotter.set_background("#fbfcfd")
    for row, code in enumerate(codes):
        points = np.array(mesh.GetPointsAttr().Get(float(code)), float)
        drop = 0.75 * row
        body = pyvista.PolyData(points - [0, drop, 0], faces.ravel())
        body["rgb"] = colours
        plotter.add_mesh(body, scalars="rgb", rgb=True, specular=0.3, ambient=0.2, smooth_shading=True)
    focus = np.array([1.75, 0.8 - 0.75 * (len(codes) - 1) / 2, 0.8])
    plotter.camera.focal_point = focus
    plotter.camera.position = focus + np.array([0.6, 2.2, 5.0])
    plotter.camera.up = (0, 1, 0)
    plotter.camera.parallel_projection = True
    plotter.camera.parallel_scale = 0.34 * len(codes)
    plotter.enable_anti_aliasing("ssaa")
    plotter.screenshot(picture)
    Image.open(picture).convert("RGB").quantize(256, dither=Image.Dither.FLOYDSTEINBERG).save(picture, optimize=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
