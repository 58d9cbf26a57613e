"""A swim at one time as a picture: the body's particles as spheres in clear water, with its tank and a scale."""

import ctypes
import dataclasses
import itertools
import os
from pathlib import Path

import numpy as np

from natator.errors import InputError
from natator.export.bodies import Swim
from natator.export.water import WaterSurface
from natator.gait import number
from natator.script import package
from natator.stream import Stream
from natator.trajectory import frames
from natator.water import LEAST_DENSITY

VIEWS = {"side": (0, 0), "top": (0, 90), "front": (90, 0), "three-quarter": (32, 24)}  #: degrees: from the side to the front; up
LEAST, MOST, WIDTH = 64, 4096, 1600  # pixels each way
RADIUS = 0.71  # of a particle, in spacings: neighbours overlap
HEAD, TAIL, COMPANION, OBSTACLE = np.array([(224, 74, 43), (249, 174, 82), (140, 107, 184), (141, 152, 163)])
WATER, GROUND, GRID, EDGE, INK, FORCE = "#6ab8ee", "#eef0f2", "#d9dfe4", "#9faebb", "#26323d", "#c2185b"
OPACITY = 0.3  # of the water's surface
ROOM, ROOM_IN_VACUUM = 0.6, 0.2  # in body lengths: how much is shown before and behind a body
NEARLY_ALL = 0.7  # a tank of which this share would be shown is shown whole
VORTICES = 0.01  # share of the water whose Q is highest
STRONGEST = 0.985  # share of the cells of plane flow that turn less than what the colours end with
LEGEND = "The head is the red end. Vortices, from above: red turn left, blue right."
PLANES = {"level": 1, "along": 2, "across": 0}  #: and the axis that each is across
SLICES = {  #: of the water on a plane: what it is called, its unit, colours
    "velocity": ("speed", "length/s", "YlGnBu"), "vorticity": ("vorticity across the plane", "1/s", "PRGn"),
    "pressure": ("pressure, less the mean at its height", "mass/(length s^2)", "coolwarm")}
ARROWS = 40  # along the longer side of a plane
LONGEST = 0.4  # arrow of a force, in lengths of the body
OUTSIDE = 1.5  # cells from a particle's surface to where its pressure is read: nearer they have some of the body's motion
NEAR = 1.0  # cells from a particle's surface: vortices are not told there
LEAST_PART = 0.06  # of the largest vortex: smaller ones are left out
RESTS = "vortices: the water does not turn anywhere; expected a swim that has gone on for a while"
NOTHING_DRAWS = "a picture: nothing here can draw it; expected Mesa or a graphics driver, with EGL (Debian: apt-get install libegl1 libgl1)"
SIDES, ABOVE, BELOW = 0.03, 0.04, 0.07  # margins, in widths of the picture
FLATTEST, HIGHEST = 0.3, 0.75


def picture(scene, file, gait=None, at=None, view="side", size=None, water=True, duration=None, vortices=False, plane=None, at_plane=("level", 0.0),
            pressure=False, forces=False, **options):
    """Simulates a swim up to a time and draws it to a PNG file. Lengths are the same near and far, so the scale holds everywhere.

    scene, gait, options: as of Stream. at: s, to the nearest frame; None is 1, or the end of a shorter swim, or 0 of a body at rest.
    view: one of VIEWS. size: pixels, or None for 1600 wide and as high as what is shown. duration: of the swim in s, None is the
    scene's. vortices: draws those in place of the water's surface: where Q (Water.q_criterion) is beyond the least of its highest
    VORTICES, coloured by the vorticity about the vertical; of plane flow a map of that. plane: one of SLICES, drawn in its place on a
    plane: at_plane is one of PLANES and where it is, in body lengths from the body. pressure: colours the body by that of the water.
    forces: draws an arrow of the water's force on each cluster of the body. The last three not in scheme flex, but velocity and vorticity. Returns the size and the time. Raises InputError, ProgramError, Unstable
    and OSError.
    """
    number("--place", at_plane[1])
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
    on_grid = vortices or plane or pressure
    water = water and not (vortices or plane)
    if water:
        package("pysplashsurf", "pysplashsurf", "a picture of water")
    with Stream(scene, gait=gait, fields=("position", *["force"] * forces), **options) as stream:
        swim = Swim.of(stream, water)
        if (pressure or plane == "pressure") and stream.scene.get("scheme") == "flex":
            raise InputError("pressure: scheme flex has none; must be conserving or lattice")
        duration = stream.scene["duration"] if duration is None else duration
        time = at if at is not None else min(1, duration) if gait else 0
        if not 0 <= time <= duration:
            raise InputError(f"--at is {time}; expected a time of the swim, 0 to {duration} s")
        step = stream.scene["timeStep"]
        frame = list(frames(stream, time, max(1, round(time / step))))[-1] if time else stream.frame
        field = stream.water() if on_grid else None
        if on_grid and not field.density.size:
            raise InputError(f"a picture of water: {scene} has none; expected some")
    tank, shown = _framing(swim, frame.position)
    if (vortices or plane) and field.density.shape[1] == 1 and len(tank):
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
        legend = _draw(pyvista, plotter, swim, frame, tank, axes, water, field if pressure else None)
        if vortices:
            _vortices(plotter, field, swim, frame)
            legend.insert(0, LEGEND)
        if plane:
            legend.append(_slice(pyvista, plotter, field, swim, frame, plane, *at_plane))
        if forces:
            legend.append(_forces(pyvista, plotter, swim, frame))
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
    _label(pixels, scale, frame.time, legend).save(file, optimize=True)
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


def _reach(swim, frame):
    """The length of the body, or without one half of what all solids take; and the middle of them."""
    own = frame.position[swim.scene["body"] or swim.solids].astype(float)
    return swim.scene["bodyLength"] or np.ptp(own, axis=0).max() / 2 or 1.0, own.mean(0)


def _slice(pyvista, plotter, water, swim, frame, what, plane, place):
    """The water on a plane, with arrows of its velocity. Returns what it is."""
    shape = np.array(water.density.shape)
    axis = PLANES["level" if shape[1] == 1 else plane]
    length, middle = _reach(swim, frame)
    height = np.clip(middle[axis] + place * length, water.corner[axis] + water.cell / 2, water.corner[axis] + (shape[axis] - 0.5) * water.cell)
    values = {"velocity": lambda: np.linalg.norm(water.velocity, axis=-1), "vorticity": lambda: water.vorticity()[..., axis],
              "pressure": water.excess_pressure}[what]()
    sides = [one for one in range(3) if one != axis]
    places = np.empty((*shape[sides], 3))
    places[..., axis] = height
    places[..., sides] = np.stack(np.meshgrid(*(water.centres(one) for one in sides), indexing="ij"), -1)
    shown = water.at(values, places.reshape(-1, 3))
    most = float(np.quantile(np.abs(shown[shown != 0]), STRONGEST)) if shown.any() else 1.0
    low, dimensions = water.corner.copy(), np.ones(3, int)
    low[axis], dimensions[sides] = height - (water.cell / 4 if shape[1] == 1 else 0), shape[sides] + 1  # of plane flow below the body's middle
    sheet = pyvista.ImageData(dimensions=dimensions, spacing=[water.cell] * 3, origin=low)
    sheet.cell_data["shown"] = shown.reshape(shape[sides]).ravel(order="F")
    name, unit, colours = SLICES[what]
    plotter.add_mesh(sheet.cell_data_to_point_data(), scalars="shown", cmap=colours, clim=[0 if what == "velocity" else -most, most], show_scalar_bar=False, lighting=False,
                     opacity=1.0 if shape[1] == 1 else 0.85)
    every = int(np.ceil(shape[sides].max() / ARROWS))
    if what == "velocity":
        some = places[every // 2::every, every // 2::every].reshape(-1, 3)
        flow = water.at(water.velocity, some)
        flow[:, axis] = 0
        _arrows(pyvista, plotter, some, 1.5 * every * water.cell / most * flow, INK, 0.07 * water.cell * every)
    return f"Water: {name}, {f'0 to {most:.2g}' if what == 'velocity' else f'±{most:.2g}'} {unit}."


def _forces(pyvista, plotter, swim, frame):
    """An arrow from the middle of each cluster of all bodies, whose joints count to the one in front. Returns what they are."""
    parts = swim.cluster[swim.solids]
    forces, middles = (np.array([whole(values[swim.solids][parts == part], axis=0) for part in np.unique(parts)])
                       for whole, values in ((np.sum, frame.force.astype(float)), (np.mean, frame.position.astype(float))))
    length, _ = _reach(swim, frame)
    most = np.linalg.norm(forces, axis=1).max()
    if most:
        _arrows(pyvista, plotter, middles, LONGEST * length / most * forces, FORCE, 0.012 * length, on_top=True)
    return f"Arrows: force of the water, the longest {most:.2g} mass length/s^2."


def _arrows(pyvista, plotter, places, ways, colour, radius, on_top=False):
    lengths = np.linalg.norm(ways, axis=1)
    for place, way, length in zip(places[lengths > radius], ways[lengths > radius], lengths[lengths > radius]):
        tip = min(0.6, 5 * radius / length)
        plotter.add_mesh(pyvista.Arrow(start=place, direction=way, scale=length, tip_length=tip, tip_radius=2.4 * radius / length, shaft_radius=radius / length,
                                       tip_resolution=12, shaft_resolution=8), color=colour, lighting=on_top, ambient=0.4)


def _pressed(water, swim, frame):
    """Of each particle of a body the pressure that is on it, less the mean of the water at the same height, from the middle of its slice
    outwards; of plane flow, where what is seen is inside, at the edge on that side. nan for others."""
    found, excess = np.full(len(frame.position), np.nan), water.excess_pressure()
    spacing = _spacing(swim)
    for slices in [swim.scene["slices"], *(one["slices"] for one in swim.scene.get("companions") or [])]:
        for members in slices:
            own = frame.position[members].astype(float)
            ways = own - own.mean(0)
            sizes = np.linalg.norm(ways, axis=1, keepdims=True)
            ways = np.divide(ways, sizes, out=np.zeros_like(ways), where=sizes > 0)
            out = (sizes.max() if water.density.shape[1] == 1 else sizes) + spacing / 2 + OUTSIDE * water.cell
            found[members] = water.at(excess, own.mean(0) + out * ways)
    return found


def _spacing(swim):
    """Of particles in the body, length."""
    creature = swim.scene["definition"].get("creature") or {}
    return creature.get("spacing", 0.075) / creature.get("refinement", 1)


def _smooth(water):
    """The same water with each velocity a mean over its neighbours, by 1, 2, 1 along each axis."""
    wet = (water.density >= LEAST_DENSITY)[..., None].astype(float)
    velocity = wet * water.velocity
    for axis in range(3):
        velocity, wet = _three_means(velocity, axis), _three_means(wet, axis)
    return dataclasses.replace(water, velocity=np.divide(velocity, wet, out=np.zeros_like(velocity), where=wet > 0))


def _three_means(values, axis):
    padded = np.concatenate([values.take([0], axis), values, values.take([-1], axis)], axis)
    inner = [padded.take(range(first, first + values.shape[axis]), axis) for first in range(3)]
    return (inner[0] + 2 * inner[1] + inner[2]) / 4


def _without_bodies(water, q, swim, frame):
    """Q of the cells, 0 next to bodies."""
    q, reach = q.copy(), NEAR + 0.6 * _spacing(swim) / water.cell
    around = np.array(list(itertools.product(np.arange(-np.ceil(reach) - 1, np.ceil(reach) + 2), repeat=3)))
    at = (frame.position[swim.solids].astype(float) - water.corner) / water.cell - 0.5
    cells = np.round(at)[:, None] + around
    near = (np.linalg.norm(cells - at[:, None], axis=-1) <= reach) & (cells >= 0).all(-1) & (cells < q.shape).all(-1)
    q[tuple(cells[near].astype(int).T)] = 0
    return q


def _vortices(plotter, water, swim, frame):
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
    smooth = _smooth(water)
    grid = smooth.grid()
    grid.cell_data["Q"] = _without_bodies(water, smooth.q_criterion(), swim, frame).ravel(order="F")
    grid = grid.cell_data_to_point_data()
    q = grid["Q"]
    least = np.quantile(q, 1 - VORTICES)
    if not least > 0:
        raise InputError(RESTS)
    about = grid["vorticity"][:, 1]
    grid["about the vertical"] = about
    strength = np.quantile(np.abs(about[q > least]), 0.9)
    surfaces = grid.contour([least], scalars="Q").connectivity("all")
    parts = surfaces.cell_data["RegionId"]
    sizes = np.bincount(parts)
    large = surfaces.remove_cells(np.flatnonzero(sizes[parts] < LEAST_PART * sizes.max()))
    plotter.add_mesh(large, scalars="about the vertical", cmap="coolwarm", clim=[-strength, strength], opacity=0.9, show_scalar_bar=False,
                     smooth_shading=True)


def _draw(pyvista, plotter, swim, frame, tank, axes, water, pressed):
    """Returns what its colours are, where `pressed`, a Water, colours the body by its pressure."""
    legend = []
    if len(tank):
        if axes[2][1] > 0:
            _ground(pyvista, plotter, tank)
        for ends in _edges(tank, swim.scene.get("periodic") or {}):
            plotter.add_mesh(pyvista.Line(*ends), color=EDGE, line_width=1.5, lighting=False)
    colours = np.where(np.isinf(swim.mass)[:, None], OBSTACLE, COMPANION)
    colours[swim.scene["body"]] = HEAD
    for i, members in enumerate(swim.scene["slices"]):
        colours[members] = HEAD + (TAIL - HEAD) * i / max(1, len(swim.scene["slices"]) - 1)
    if pressed:
        import matplotlib  # pyvista needs it, too

        found = _pressed(pressed, swim, frame)
        known = ~np.isnan(found)
        if not known.any():
            raise InputError("pressure: the scene has no body in its water to read it at")
        most = float(np.quantile(np.abs(found[known]), 0.9)) or 1.0
        colours[known] = 255 * matplotlib.colormaps["coolwarm"](0.5 + 0.5 * found[known] / most)[:, :3]
        legend.append(f"Body: pressure, less the mean at its height, ±{most:.2g} mass/(length s^2).")
    obstacle = (swim.scene["definition"].get("obstacles") or [{}])[0]
    radii = {False: _spacing(swim), True: obstacle.get("spacing", 0.075)}
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
    return legend


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


def _label(pixels, scale, time, legend):
    """The picture with a scale and the time at its lower edge, and lines of a legend at the upper."""
    from PIL import Image, ImageDraw, ImageFont

    image = Image.fromarray(pixels)
    pen, (width, height) = ImageDraw.Draw(image), image.size
    size = max(10, min(width, 2 * height) / 55)
    font, left, base = ImageFont.load_default(size), 0.03 * width, height - 0.9 * size
    length = _round(0.14 * width / scale)
    pen.line((left, base - size / 3, left + length * scale, base - size / 3), INK, max(2, round(size / 7)))
    for text, place, anchor in ((f"{length:g} unit" + "s" * (length != 1), (left + length * scale + 0.6 * size, base), "ls"),
                                (f"t = {time:.2f} s", (width - left, base), "rs"), *((line, (left, (0.9 + 1.4 * i) * size), "la") for i, line in enumerate(legend))):
        pen.rectangle(pen.textbbox(place, text, font=font, anchor=anchor), "white")
        pen.text(place, text, INK, font, anchor)
    return image


def _round(length):
    """The nearest of 1, 2 and 5 times a power of ten."""
    power = 10 ** np.floor(np.log10(length))
    return float(min((times * power for times in (1, 2, 5, 10)), key=lambda one: abs(np.log(one / length))))
