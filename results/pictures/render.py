"""Draws one frame of `python -m natator export --format vtp`: water as spheres coloured by speed, the body by cluster.

    render.py FOLDER TIME PICTURE.png

Off screen, with pyvista (./setup.sh --readers).
"""

import json
import sys
from pathlib import Path

import numpy as np
import pyvista
from PIL import Image

SIZE = (1200, 480)
SPEEDS = ["#d0e6f6", "#a9d0ec", "#7fbbe0", "#4a9bcf", "#2579b5", "#145a94", "#0a3d6e", "#06254a"]
CLUSTERS = ["#e4822d", "#d6474d", "#bd4a92", "#735fb9", "#fbbc4b"]

BAR = {"title": "speed of the water [length/s]", "color": "#333333", "n_labels": 2, "fmt": "%.2f",
       "title_font_size": 15, "label_font_size": 13, "width": 0.25, "height": 0.07, "position_x": 0.72,
       "position_y": 0.88}


def spheres(points, radius, detail):
    ball = pyvista.Sphere(radius=radius, theta_resolution=detail, phi_resolution=detail)
    return points.glyph(geom=ball, scale=False, orient=False)


def tank(planes, top):
    """Edges of the box that the planes x, y, z = constant bound; open upwards, drawn up to `top`. None in vacuum."""
    low, high = [0.0] * 3, [None, top, None]
    for nx, ny, nz, d in planes:
        for axis, n in enumerate((nx, ny, nz)):
            if n > 0:
                low[axis] = -d / n
            elif n < 0:
                high[axis] = -d / n
    if None in high:
        return None
    return pyvista.Box(bounds=[low[0], high[0], low[1], high[1], low[2], high[2]]).extract_all_edges()


def main(folder, time, picture):
    folder = Path(folder)
    metadata = json.loads((folder / "metadata.json").read_text())
    reader = pyvista.get_reader(folder / "swim.pvd")
    reader.set_active_time_value(min(reader.time_values, key=lambda value: abs(value - float(time))))
    parts = list(reader.read())
    has_water = metadata["water"] and any(np.all(part["kind"] == 0) for part in parts if "kind" in part.point_data)
    water = parts[0] if has_water else None
    body = parts[1 if has_water else 0]

    plotter = pyvista.Plotter(off_screen=True, window_size=SIZE)
    plotter.set_background("#fbfcfd")
    top = 1.0
    if water is not None:
        water["speed"] = np.linalg.norm(water["velocity"], axis=1)
        top = float(np.quantile(water.points[:, 1], 0.995)) + metadata["solidRestDistance"]
        plotter.add_mesh(spheres(water, 0.36 * metadata["fluidRestDistance"], 10), scalars="speed", cmap=SPEEDS,
                         n_colors=len(SPEEDS), clim=[0, np.quantile(water["speed"], 0.99)], opacity=0.25,
                         smooth_shading=True, ambient=0.25, scalar_bar_args=BAR)
    colours = [CLUSTERS[max(0, cluster) % len(CLUSTERS)] for cluster in body["cluster"]]
    body["rgb"] = np.array([[int(colour[i:i + 2], 16) for i in (1, 3, 5)] for colour in colours], "u1")
    if body.n_faces:
        skin = pyvista.PolyData(body.points, faces=body.faces)
        skin["rgb"] = body["rgb"]
    else:
        skin = spheres(body, 0.25 * metadata["solidRestDistance"], 12)
    plotter.add_mesh(skin, scalars="rgb", rgb=True, specular=0.3, ambient=0.2)

    box = tank(metadata["planes"], top)
    if box is not None:
        plotter.add_mesh(box, color="#8a99a8", line_width=1.5)
    frame = box if box is not None else body
    focus = 0.8 * np.array(frame.center) + 0.2 * np.array(body.center)
    plotter.camera.focal_point = focus
    plotter.camera.position = focus + frame.length * np.array([0.1, 0.62, 1.0])
    plotter.camera.up = (0, 1, 0)
    plotter.camera.zoom(1.27)
    plotter.enable_depth_peeling(12)
    plotter.enable_anti_aliasing("ssaa")
    plotter.screenshot(picture)
    # A palette makes the file a third as large.
    Image.open(picture).convert("RGB").quantize(256, dither=Image.Dither.FLOYDSTEINBERG).save(picture, optimize=True)


if __name__ == "__main__":
    main(*sys.argv[1:])
