"""One swim: its figures, and its display in a notebook or a file."""

import html
import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from natator.errors import InputError
from natator.gait import Gait, number, wave_in
from natator.program import simulator_path
from natator.script import package
from natator.source import read_json
from natator.stream import Stream
from natator.trajectory import Trajectory, frames, joined

ELSEWHERE = {"evolved-eel": "endless/evolved-eel", "fry": "lake/fry", "loach": "plane/loach"}  # creatures that are not in pool/
GAITS = {"creature-2": "fish-like", "eel": "fish-like"}  # those of others have their names
PICTURES = 30  # of a second
WIDTH, MARGIN, LEGEND = 720, 12, 22  # pixels
WATER, BODY, COMPANION, GHOST, PATH, INK = "#eaf4fb", "#1f6f8b", "#6d9f71", "#a9c9d8", "#e04a2b", "#26323d"
BAR = 0.2  # body lengths
GHOSTS = 4  # earlier places of the body that are drawn, too


def swim(creature_or_scene, duration=2.0, gait=None, policy=None, **options):
    """Simulates one swim and keeps it; it does not end early as an evaluation may.

    creature_or_scene: a creature, such as "eel" (in the scene pool/eel), a scene's name, or a path that ends in .json. duration: s, to
    the nearest frame. gait: a Gait or a dict; None is the one that comes with the creature, else a wave from head to tail. policy: a
    file of natator.policy, which drives in place of a gait. options: those of Stream. One swim is one start: evaluate several before you
    compare gaits. Returns a Swim. Raises InputError, ProgramError and Unstable.
    """
    scene = scene_of(creature_or_scene)
    if policy is not None:
        if gait is not None:
            raise InputError("gait: must be left out with a policy, which drives in its place")
        options["arguments"] = [*options.get("arguments", ()), "--policy", os.fspath(policy)]
    with Stream(scene, fields=("position",), **options) as stream:
        if not stream.actuators:
            raise InputError(f'scene "{scene}": must have a creature with actuators')
        if policy is None:
            gait = _own_gait(stream.scene, options.get("program")) if gait is None else gait
            stream.set_gait(gait)
        step = stream.scene["timeStep"]
        steps = int(number("duration", duration) / step + 0.5)
        every = next(count for count in range(max(1, round(1 / PICTURES / step)), 0, -1) if steps % count == 0)
        trajectory = joined(list(frames(stream, duration, every, least=1)), stream.scene)
        return Swim(scene, gait, trajectory, stream.ask({"do": "sense"})["senses"].get("work"))


def scene_of(creature_or_scene):
    """The name or path of a scene; a creature's is that of its scene in the pool. Raises InputError."""
    if not isinstance(creature_or_scene, (str, os.PathLike)):
        raise InputError(f"creature_or_scene = {creature_or_scene!r}: must be a name or a path")
    scene = os.fsdecode(creature_or_scene)
    return scene if "/" in scene or scene.endswith(".json") else ELSEWHERE.get(scene, f"pool/{scene}")


def _own_gait(scene, program):
    """The gait in the file of the creature's name, among the program's data, or else a wave."""
    name = (scene["definition"].get("creature") or {}).get("name")
    file = Path(os.path.realpath(simulator_path(program))).parents[1] / f"share/natator/gaits/{GAITS.get(name, name)}.json"
    if not name or not file.is_file():
        return wave_in(scene)
    given = {key: value for key, value in read_json(file).items() if key != "$schema"}
    return Gait(**given) if len(given["amplitude"]) == scene["actuators"] else wave_in(scene)


@dataclass(frozen=True, repr=False)
class Swim:
    """One swim. Its repr is one line; a notebook shows it moving, which needs no other package."""

    scene: str
    gait: Gait
    trajectory: Trajectory
    work: float = None  #: of the muscles, mass length²/s²; None in scheme flex

    @property
    def duration(self):
        """Simulated time, s."""
        return float(self.trajectory.time[-1])

    @property
    def distance(self):
        """Change of the body's mean x over ground, length; negative is backwards."""
        return float(self.trajectory.distance[-1])

    @property
    def speed(self):
        """Mean speed along x, body lengths/s."""
        return self.distance / self.duration / self.trajectory.scene["bodyLength"]

    def __repr__(self):
        return f"{self.scene}: {self.distance:.3f} in {self.duration:.2f} s, {self.speed:.2f} body lengths/s"

    def save(self, file):
        """Draws it: .svg and .html move in a browser; .gif and .png, which shows its end, need Pillow (natator[film]). Raises
        InputError and OSError."""
        kind, drawing = Path(file).suffix.lower(), _Drawing(self)
        if kind in (".svg", ".html"):
            Path(file).write_text("<!DOCTYPE html><meta charset=utf-8>" * (kind == ".html") + drawing.svg(), encoding="utf-8")
        elif kind == ".png":
            drawing.image(-1).save(file, optimize=True)
        elif kind == ".gif":
            first, *others = (drawing.image(k).quantize(32) for k in range(len(self.trajectory.time)))
            first.save(file, save_all=True, append_images=others, duration=1000 * self.duration / len(others), loop=0)
        else:
            raise InputError(f"file = {os.fspath(file)!r}: must end in .svg, .html, .gif or .png")

    def _repr_html_(self):
        return _Drawing(self).svg()


def _outline(body, slices, axis):
    """Corners of the body's outline at each time, T × 2 S × 2, along x and along `axis`: of each slice the mean of the particles that
    are outermost at first, from head to tail on one side and back on the other. body: T × N × 3."""
    sides = [[], []]
    for members in map(np.array, slices):
        across = body[0, members, axis]
        for side, end in zip(sides, (across.min(), across.max())):
            side.append(body[:, members[np.abs(across - end) < 1e-3]].mean(1)[:, [0, axis]])
    return np.stack(sides[0] + sides[1][::-1], axis=1)


class Views:
    """Pictures of a swimmer for SwimmerEnv: from above and, below that, from the side. They go along with it over a grid of half
    body lengths that stays. scene: a SCEN message; start: N × 3, the places of its particles at the start; all: whether the companions,
    too, are to be seen at the start. Needs Pillow."""

    SIZE = (640, 400)  #: width and height, pixels
    ALONG = 3          #: body lengths that are seen from left to right, at least

    def __init__(self, scene, start, all=False):
        self._pillow, self._pen = (package(f"PIL.{name}", "pillow", "a picture") for name in ("Image", "ImageDraw"))
        self._all = all
        self._begin(scene, start)

    def restart(self, stream, at_start):
        """For another episode of a Stream: its frame is a start, or else stands in for that of another body."""
        if at_start or len(self._start) != stream.scene["particles"]:
            self._begin(stream.scene, stream.frame.position)

    def _begin(self, scene, start):
        self._scene, self._start = scene, np.asarray(start, float)
        along, form = self.ALONG * scene["bodyLength"], 2 * self.SIZE[0] / self.SIZE[1]
        for companion in (scene.get("companions") or []) if self._all else []:
            ways = np.abs(self._start[companion["body"]] - self._start[scene["body"]].mean(0)).max(0)
            along = max(along, *(2.1 * ways * [1, form, form]))
        self._scale = self.SIZE[0] / along

    def pixels(self, position, senses, goes_to_target):
        """height × width × 3, bytes. position: N × 3; senses: Senses of the same time; goes_to_target: whether that is drawn, a ring."""
        image = self._pillow.new("RGB", self.SIZE, WATER)
        body, target = np.stack([self._start, position.astype(float)]), None
        if goes_to_target:
            target = senses.target_distance * senses.target @ np.stack([senses.forward, senses.up, senses.right])
        for part, axis in enumerate((2, 1)):
            self._draw(image, part * self.SIZE[1] // 2, body, axis, senses, target)
        return np.array(image)

    def _draw(self, image, top, body, axis, senses, target):
        width, height = self.SIZE[0], self.SIZE[1] // 2
        panel = self._pillow.new("RGB", (width, height), WATER)
        draw, middle = self._pen.Draw(panel), senses.centre[[0, axis]]
        directions = np.array([1, -1 if axis == 1 else 1]) * self._scale

        def pixel(points):
            return [tuple(point) for point in (points - middle) * directions + (width / 2, height / 2)]

        step = self._scene["bodyLength"] / 2
        gone = senses.distance + self._start[self._scene["body"], 0].mean() - middle[0]  # of a moving tank
        reach = np.array([width, height]) / 2 / self._scale
        for at in np.arange(np.ceil((middle[0] + gone - reach[0]) / step), (middle[0] + gone + reach[0]) / step) * step - gone:
            draw.line(pixel(np.array([[at, middle[1] - reach[1]], [at, middle[1] + reach[1]]])), GHOST)
        for at in np.arange(np.ceil((middle[1] - reach[1]) / step), (middle[1] + reach[1]) / step) * step:
            draw.line(pixel(np.array([[middle[0] - reach[0], at], [middle[0] + reach[0], at]])), GHOST)
        for *normal, offset in self._scene["planes"]:
            for k, along in enumerate((0, axis)):
                if abs(normal[along]) > 0.999:
                    ends = np.array([middle - reach, middle + reach])
                    ends[:, k] = -offset / normal[along]
                    draw.line(pixel(ends), INK, 2)
        for companion in self._scene.get("companions") or []:
            draw.polygon(pixel(_outline(body, companion["slices"], axis)[1]), COMPANION)
        draw.polygon(pixel(_outline(body, self._scene["slices"], axis)[1]), BODY)
        if target is not None:
            (x, y), = pixel((middle + target[[0, axis]])[None])
            draw.ellipse((x - 5, y - 5, x + 5, y + 5), outline=PATH, width=2)
        draw.line((0, 0, width, 0), INK)
        image.paste(panel, (0, top))


class _Drawing:
    """The body's outline as it moves, seen from above or, where it moves more up and down, from the side."""

    def __init__(self, swim):
        scene, body = swim.trajectory.scene, swim.trajectory.position.astype(float)
        own = body[:, swim.trajectory.body].mean(1)
        body[:, :, 0] += (own[0, 0] + swim.trajectory.distance - own[:, 0])[:, None]  # a moving tank takes its places along
        own[:, 0] = own[0, 0] + swim.trajectory.distance
        tank = scene.get("definition", {}).get("movingTank") or {}
        if "z" in tank.get("along", "x"):  # by whole steps, each more than the body goes in a frame
            moved = -np.cumsum(np.round(np.diff(own[:, 2], prepend=own[0, 2]) / tank["step"])) * tank["step"]
            body[:, :, 2] += moved[:, None]
            own[:, 2] += moved
        axis = 1 if np.ptp(body - own[:, None], axis=0)[scene["body"], 1:].mean(0).argmax() == 0 else 2
        body[:, :, 1] *= -1
        self.legend, self.duration = f"{swim!r}; the bar is {BAR} body lengths", swim.duration
        outline = _outline(body, scene["slices"], axis)
        path = own[:, [0, axis]] * [1, -1 if axis == 1 else 1]
        low, high = outline.min((0, 1)), outline.max((0, 1))
        scale = (WIDTH - 2 * MARGIN) / (high - low)[0]
        self.outline, self.path = ((part - low) * scale + MARGIN for part in (outline, path))
        self.height = int((high - low)[1] * scale) + 2 * MARGIN + LEGEND
        self.length = BAR * scale * scene["bodyLength"]

    def ghosts(self, until):
        return [self.outline[k] for k in np.linspace(0, len(self.outline) - 1, GHOSTS, endpoint=False).astype(int) if k < until]

    def svg(self):
        def text(points):
            return " ".join(f"{x:.1f},{y:.1f}" for x, y in points)

        ghosts = "".join(f'<polygon points="{text(ghost)}" fill="none" stroke="{GHOST}"/>' for ghost in self.ghosts(len(self.outline)))
        base, right, legend = self.height - 9, WIDTH - MARGIN, html.escape(self.legend)
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {self.height}" width="{WIDTH}" height="{self.height}" '
                f'font-family="sans-serif" font-size="12" fill="{INK}"><title>{legend}</title><rect width="{WIDTH}" height="{self.height}" '
                f'fill="{WATER}"/>{ghosts}<polyline points="{text(self.path)}" fill="none" stroke="{PATH}"/>'
                f'<polygon points="{text(self.outline[-1])}" fill="{BODY}"><animate attributeName="points" dur="{self.duration:.2f}s" '
                f'repeatCount="indefinite" values="{";".join(map(text, self.outline))}"/></polygon>'
                f'<path d="M{right - self.length:.1f} {base}H{right}" stroke="{INK}" stroke-width="2"/>'
                f'<text x="{MARGIN}" y="{base}">{legend}</text></svg>')

    def image(self, k):
        """One frame as an image of Pillow."""
        pillow, pen = package("PIL.Image", "pillow", "a .png or .gif"), package("PIL.ImageDraw", "pillow", "a .png or .gif")
        k %= len(self.outline)
        big = pillow.new("RGB", (2 * WIDTH, 2 * self.height), WATER)
        draw = pen.Draw(big)
        for ghost in self.ghosts(k):
            draw.polygon([tuple(point) for point in 2 * ghost], outline=GHOST, width=2)
        draw.polygon([tuple(point) for point in 2 * self.outline[k]], BODY)
        draw.line([tuple(point) for point in 2 * self.path[:k + 1]], PATH, 2)
        image = big.resize((WIDTH, self.height), pillow.Resampling.LANCZOS)
        draw, base, right = pen.Draw(image), self.height - 9, WIDTH - MARGIN
        draw.line([(right - self.length, base), (right, base)], INK, 2)
        draw.text((MARGIN, base), self.legend, INK, package("PIL.ImageFont", "pillow", "a picture").load_default(12), "ls")
        return image
