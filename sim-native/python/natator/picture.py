"""A swim at one time as a picture: the body's particles as spheres in clear water, with its tank and a scale."""

import ctypes
import itertools
import os
from pathlib import Path

import numpy as np

from natator.errors import InputError
from natator.export.bodies import Swim
from natator.export.water import WaterSurface
from natator.script import package
from natator.stream import Stream
from natator.trajectory import frames

VIEWS = {"side": (0, 0), "top": (0, 90), "front": (90, 0), "three-quarter": (32, 24)}  #: degrees: from the side to the front; up
LEAST, MOST, WIDTH = 64, 4096, 1600  # pixels each way
RADIUS = 0.71  # of a particle, in spacings: neighbours overlap
HEAD, TAIL, COMPANION, OBSTACLE = np.array([(224, 74, 43), (249, 174, 82), (140, 107, 184), (141, 152, 163)])
WATER, GROUND, GRID, EDGE, INK = "#6ab8ee", "#eef0f2", "#d9dfe4", "#9faebb", "#26323d"
OPACITY = 0.3  # of the water's surface
ROOM, ROOM_IN_VACUUM = 0.6, 0.2  # in body lengths: how much is shown before and behind a body
NEARLY_ALL = 0.7  # a tank of which this share would be shown is shown whole
VORTICES = 0.01  # share of the water whose Q is highest
STRONGEST = 0.985  # share of the cells of plane flow that turn less than what the colours end with
LEGEND = "The head is the red end. Vortices, from above: red turn left, blue right."
RESTS = "vortices: the water does not turn anywhere; expected a swim that has gone on for a while"
NOTHING_DRAWS = "a picture: nothing here can draw it; expected Mesa or a graphics driver, with EGL (Debian: apt-get install libegl1 libgl1)"
SIDES, ABOVE, BELOW = 0.03, 0.04, 0.07  # margins, in widths of the picture
FLATTEST, HIGHEST = 0.3, 0.75


def picture(scene, file, gait=None, at=None, view="side", size=None, water=True, duration=None, vortices=False, **options):
    """Simulates a swim up to a time and draws it to a PNG file. Lengths are the same near and far, so the scale holds everywhere.

    scene, gait, options: as of Stream. at: s, to the nearest frame; None is 1, or the end of a shorter swim, or 0 of a body at rest.
    view: one of VIEWS. size: pixels, or None for 1600 wide and as high as what is shown. duration: of the swim in s, None is the
    scene's. vortices: draws those in place of the water's surface: where Q (Water.q_criterion) is beyond the least of its highest
    VORTICES, coloured by the vorticity about the vertical; of plane flow a map of that. Returns the size and the time. Raises InputError, ProgramError, Unstable
    and OSError.
    """
    pyvista = package("pyvista", "pyvista", "a picture")
    from vtkmodules import vtkRenderingOpenGL2
    from vtkmodules.vtkCommonCore import vtkLogger
    from vtkmodules.vtkRenderingCore import vtkRenderWindow

    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_ERROR)  # that there is no display is no news
    if hasattr(vtkRenderingOpenGL2, "vtkEGLRenderWindow") and (
            not (os.environ.get("DISPLAY") or _has_egl()) or vtkRenderWindow().GetClassName() == "vtkOSOpenGLRenderWindow"):
        raise InputError(NOTHING_DRAWS)  # VTK would try OSMesa, and crash
    if not Path(file).parent.is_dir():
        raise InputError(f"{file} cannot be written: there is no folder {Path(file).parent}")
    if water and not vortices:
        package("pysplashsurf", "pysplashsurf", "a picture of water")
    with Stream(scene, gait=gait, fields=("position",), **options) as stream:
        swim = Swim.of(stream, water)
        duration = stream.scene["duration"] if duration is None else duration
        time = at if at is not None else min(1, duration) if gait else 0
        if not 0 <= time <= duration:
            raise InputError(f"--at is {time}; expected a time of the swim, 0 to {duration} s")
        step = stream.scene["timeStep"]
        frame = list(frames(stream, time, max(1, round(time / step))))[-1] if time else stream.frame
        field = stream.water() if vortices else None
    tank, shown = _framing(swim, frame.position)
    if field is not None and field.density.shape[1] == 1 and len(tank):
        shown = tank  # with the whole street behind
    axes = _axes(*VIEWS[view])
    extent = np.ptp(np.array(list(itertools.product(*shown.T))) @ axes.T, axis=0)[:2].clip(1e-6)
    width, height = size or (WIDTH, round(np.clip(WIDTH * ((1 - 2 * SIDES) * extent[1] / extent[0] + ABOVE + BELOW),
                                                  FLATTEST * WIDTH, HIGHEST * WIDTH)))
    above, below = ABOVE * min(width, height), BELOW * max(min(width, height), width / 2)
    scale = min(width * (1 - 2 * SIDES) / extent[0], (height - above - below) / extent[1])  # pixels of a length unit
    plotter = pyvista.Plotter(off_screen=True, window_size=(width, height))
    try:
        plotter.set_background("white")
        _draw(pyvista, plotter, swim, frame, tank, axes, water=not vortices)
        if vortices:
            _vortices(plotter, field)
        focus = shown.mean(0) + axes[1] * (above - below) / 2 / scale
        plotter.camera.parallel_projection = True
        plotter.camera.focal_point = focus
        plotter.camera.position = focus + 10 * np.linalg.norm(np.ptp(tank if len(tank) else shown, axis=0)) * axes[2]
        plotter.camera.up = axes[1]
        plotter.camera.parallel_scale = height / 2 / scale
        plotter.reset_camera_clipping_range()
        plotter.enable_depth_peeling(12)
        plotter.enable_anti_aliasing("ssaa")
        pixels = plotter.screenshot(return_img=True)
    finally:
        plotter.close()
    _label(pixels, scale, frame.time, LEGEND if vortices else "").save(file, optimize=True)
    return (width, height), frame.time


def _has_egl():
    try:
        ctypes.CDLL("libEGL.so.1")
    except OSError:
        return False
    return True


def _axes(azimuth, elevation):
    """Rows: unit vectors to the right of the picture, to its top, and to the viewer. Bodies swim along x, y is up."""
    (sin_a, sin_e), (cos_a, cos_e) = np.sin(np.radians([azimuth, elevation])), np.cos(np.radians([azimuth, elevation]))
    return np.array([[cos_a, 0, -sin_a], [-sin_a * sin_e, cos_e, -cos_a * sin_e], [sin_a * cos_e, sin_e, cos_a * cos_e]])


def _framing(swim, position):
    """Two boxes, each as its two corners: the tank, empty without walls; and what a picture must hold, the swimmer with some of the
    tank around it, or without a swimmer all of the tank."""
    def box(particles):
        return np.array([position[particles].min(0), position[particles].max(0)], float)

    scene, everything = swim.scene, box(np.arange(len(position)))
    tank = np.empty((0, 3))
    if scene["planes"]:
        tank = box(swim.all_water if len(swim.all_water) else swim.solids)
        for *normal, d in scene["planes"]:
            for axis in np.flatnonzero(np.abs(normal) > 0.999):
                tank[int(normal[axis] < 0), axis] = -d / normal[axis]
    if not scene["body"]:
        return tank, tank if len(tank) else everything
    margin = np.array([[-1.0], [1.0]]) * scene["bodyLength"]
    if not len(tank):
        return tank, everything + ROOM_IN_VACUUM * margin
    shown = tank.copy()
    along = np.array([box(scene["body"])[:, 0] + ROOM * margin[:, 0], box(swim.solids)[:, 0]])
    shown[:, 0] = np.clip([along[:, 0].min(), along[:, 1].max()], *tank[:, 0])
    return tank, shown if np.ptp(shown[:, 0]) < NEARLY_ALL * np.ptp(tank[:, 0]) else tank


def _vortices(plotter, water):
    """Surfaces of equal Q, or of plane flow a map of the vorticity below the body. Raises InputError where nothing turns."""
    if water.density.shape[1] == 1:
        flat = water.grid()
        flat.origin = water.corner - [0, water.cell / 2, 0]  # above the ground, up to the middle of the body
        turns = np.abs(flat["vorticity"][:, 1])
        if not turns.any():
            raise InputError(RESTS)
        strength = np.quantile(turns[turns > 0], STRONGEST)
        plotter.add_mesh(flat, scalars="vorticity", component=1, cmap="coolwarm", clim=[-strength, strength], show_scalar_bar=False,
                         lighting=False)
        return
    grid = water.grid().cell_data_to_point_data() if water.density.size else None
    q = grid["Q"] if grid else np.zeros(1)
    least = np.quantile(q, 1 - VORTICES)
    if not least > 0:
        raise InputError(RESTS)
    about = grid["vorticity"][:, 1]
    grid["about the vertical"] = about
    strength = np.quantile(np.abs(about[q > least]), 0.9)
    plotter.add_mesh(grid.contour([least], scalars="Q"), scalars="about the vertical", cmap="coolwarm", clim=[-strength, strength],
                     opacity=0.6, show_scalar_bar=False, smooth_shading=True)


def _draw(pyvista, plotter, swim, frame, tank, axes, water):
    if len(tank):
        if axes[2][1] > 0:
            _ground(pyvista, plotter, tank)
        for ends in _edges(tank, swim.scene.get("periodic") or {}):
            plotter.add_mesh(pyvista.Line(*ends), color=EDGE, line_width=1.5, lighting=False)
    colours = np.where(np.isinf(swim.mass)[:, None], OBSTACLE, COMPANION)
    colours[swim.scene["body"]] = HEAD
    for i, members in enumerate(swim.scene["slices"]):
        colours[members] = HEAD + (TAIL - HEAD) * i / max(1, len(swim.scene["slices"]) - 1)
    definition = swim.scene["definition"]
    creature, obstacle = definition.get("creature") or {}, (definition.get("obstacles") or [{}])[0]
    radii = {False: creature.get("spacing", 0.075) / creature.get("refinement", 1), True: obstacle.get("spacing", 0.075)}
    for held, radius in radii.items():
        particles = swim.solids[np.isinf(swim.mass[swim.solids]) == held]
        if len(particles):
            points = pyvista.PolyData(frame.position[particles])
            points["colour"] = colours[particles].astype("u1")
            plotter.add_mesh(points.glyph(geom=pyvista.Sphere(radius=RADIUS * radius), scale=False, orient=False), scalars="colour",
                             rgb=True, smooth_shading=True, specular=0.25, specular_power=28, ambient=0.15)
    if water and len(swim.water):
        vertices, triangles = WaterSurface(swim)(frame)
        plotter.add_mesh(pyvista.PolyData.from_regular_faces(vertices, triangles), color=WATER, opacity=OPACITY, ambient=0.6,
                         diffuse=0.45, specular=0.2)


def _ground(pyvista, plotter, tank):
    """The floor with a grid of round lengths."""
    step, (low, high) = _round(min(np.ptp(tank, axis=0)[[0, 2]]) / 4), tank - [0, 0.004, 0]  # below the water's own floor
    plotter.add_mesh(pyvista.Box([low[0], high[0], low[1] - 0.004, low[1] - 0.004, low[2], high[2]]), color=GROUND, lighting=False)
    for axis in (0, 2):
        for at in np.arange(np.ceil(low[axis] / step), np.floor(high[axis] / step) + 1) * step:
            ends = np.array([low, [high[0], low[1], high[2]]])
            ends[:, axis] = at
            plotter.add_mesh(pyvista.Line(*ends), color=GRID, lighting=False)


def _edges(tank, periodic):
    """Edges of the tank; none where an axis that closes up with itself is cut off."""
    open_axes = {"xyz".index(axis) for axis in periodic}
    for axis in range(3):
        if not open_axes - {axis}:
            for one, other in itertools.product((0, 1), repeat=2):
                ends = tank.copy()
                ends[:, (axis + 1) % 3], ends[:, (axis + 2) % 3] = tank[one, (axis + 1) % 3], tank[other, (axis + 2) % 3]
                yield ends


def _label(pixels, scale, time, legend=""):
    """The picture with a scale and the time at its lower edge, and a legend at the upper."""
    from PIL import Image, ImageDraw, ImageFont

    image = Image.fromarray(pixels)
    pen, (width, height) = ImageDraw.Draw(image), image.size
    size = max(10, min(width, 2 * height) / 55)
    font, left, base = ImageFont.load_default(size), 0.03 * width, height - 0.9 * size
    length = _round(0.14 * width / scale)
    pen.line((left, base - size / 3, left + length * scale, base - size / 3), INK, max(2, round(size / 7)))
    for text, place, anchor in ((f"{length:g} unit" + "s" * (length != 1), (left + length * scale + 0.6 * size, base), "ls"),
                                (f"t = {time:.2f} s", (width - left, base), "rs"), *[(legend, (left, 0.9 * size), "la")] * bool(legend)):
        pen.rectangle(pen.textbbox(place, text, font=font, anchor=anchor), "white")
        pen.text(place, text, INK, font, anchor)
    return image


def _round(length):
    """The nearest of 1, 2 and 5 times a power of ten."""
    power = 10 ** np.floor(np.log10(length))
    return float(min((times * power for times in (1, 2, 5, 10)), key=lambda one: abs(np.log(one / length))))
