"""The report of a run folder: its answer, its pictures and numbers on one page. Needs matplotlib (pip install 'natator[report]') and the program
natator, from $NATATOR, the PATH or the checkout."""

import base64
import csv
import html
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

import numpy as np

from natator import motion, picture
from natator.errors import InputError, NatatorError, ProgramError
from natator.program import simulator_path

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")  # told apart also by the colour blind
FISH = ("anguilliform", "carangiform", "thunniform")
ALONG, SIDEWAYS = "from the head (body lengths)", "sideways (body lengths)"
LIKE, MIN_ALPHA = 0.8, 0.1  # like a fish is what has at most this share of no motion's e, and is not scaled to less than that
SIGNS = {"holds": ("holds", "✔"), "does not": ("fails", "✘"), "not measured": ("unknown", "–")}
ROUNDING = 1e-5  # of a recorded distance, scene units
UNSTABLE = 3  # exit code of a run that has an answer nevertheless
PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>{title}</title><meta name="viewport" content="width=device-width">
<style>body{{font:16px/1.45 sans-serif;max-width:64em;margin:1em auto;padding:0 1em;overflow-wrap:anywhere}}
table{{border-collapse:collapse;margin:1em 0;font-size:14px}}td,th{{border:1px solid #bbb;padding:.2em .5em;text-align:left}}
td.holds{{color:#1a7f37}}td.fails{{color:#c62828}}td.unknown{{color:#6e6e6e}}img{{max-width:100%}}summary{{cursor:pointer}}
pre{{background:#f4f4f4;padding:.6em;overflow:auto}}</style></head><body>
{body}
</body></html>
"""


def write(run, folder=None):
    """Writes the report of a run folder into a folder, by default RUN/report; returns the path of report.html. Raises InputError for what is no run
    folder or has no best gait, and ProgramError."""
    run = pathlib.Path(run)
    folder = pathlib.Path(folder or run / "report")
    words = json.loads(call([natator_path(), "show", "--json", run]))
    try:
        from matplotlib import figure as _  # noqa: F401
    except ImportError as error:
        raise ProgramError("reports are drawn by matplotlib; install it by: pip install 'natator[report]'") from error
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"output folder {folder} cannot be made: {error.strerror}") from error
    swim = Recorded(words["request"])
    page = Page(words["title"], folder)
    if words["unfinished"]:
        page.text(words["unfinished"])
    page.text(" ".join([*words["answer"], *difference(run, swim)]))
    if portrait(words["request"], folder / "swimmer.png"):
        page.picture("swimmer", "the swimmer in its tank")
    page.table(["measure", "value", "of a swimmer", "outcome"], words["measures"])
    page.text("After ± stands a standard deviation.")
    page.heading("Course of the run")
    course(page, words)
    page.heading("Motion")
    fits = moved(page, swim, words["request"]["scene"])
    page.heading("Beside real fish")
    page.text(likeness(fits) + f" The simulated curves end at {swim.swimming.measured / swim.swimming.length:.2f} of the length: bent, the spine is so "
              "much shorter along its line, and beyond that its motion is not known at all times (thesis 2.8).")
    page.picture("envelopes", "envelope against real fish")
    if nearest(fits) is not None:
        page.picture("scaled", "scaled against the nearest real fish")
    if swim.flow:
        page.heading("Water")
        page.picture("flow", "velocity and vorticity of the fluid")
    page.heading("Numbers")
    turned = " ".join(f"{angle:.1f}" for angle in np.degrees(swim.angles[-1]))
    page.table(["", "value"], [*words["numbers"], *([f"e against {name} fish (α, β)", f"{fit['error']:.4f} ({fit['alpha']:.2f}, {fit['beta']:.2f} s)"]
                                                    for name, fit in zip(FISH, fits, strict=True)), ["turned at the end, θ ρ ω (degrees)", turned]])
    page.heading("Command")
    page.parts.append(f"<pre>python -m natator report {html.escape(str(run))}</pre>")
    return page.write()


def natator_path():
    """Path of the program natator. Raises ProgramError where there is none."""
    found = os.environ.get("NATATOR") or shutil.which("natator")
    built = pathlib.Path(__file__).resolve().parents[3] / "build/release/bin/natator"
    if not found and not os.access(built, os.X_OK):
        raise ProgramError("no natator: put the folder of the program, build/release/bin, on the PATH, or name it by NATATOR")
    return found or str(built)


def call(command, accepted=(0,)):
    """Standard output of a program; raises InputError where that has exit code 2, ProgramError for other failures, with its last line."""
    try:
        done = subprocess.run(list(map(str, command)), capture_output=True, text=True, encoding="utf-8", check=False)
    except OSError as error:
        raise ProgramError(f"{command[0]}: cannot be started: {error.strerror}") from error
    if done.returncode not in accepted:
        lines = done.stderr.strip().splitlines() or [f"{command[0]} {command[1]} ended with {done.returncode}"]
        raise (InputError if done.returncode == 2 else ProgramError)(lines[-1])
    return done.stdout


class Recorded:
    """A request's run on the processor, once more and to its end: times; particles of the body [frame, particle, axis]; angles of roll, yaw and pitch;
    the water halfway from above and from the side, where there is any."""

    def __init__(self, request):
        self.frequency = request["gait"]["frequency"]
        options = [part for name in ("scheme", "overrides", "duration") if (value := request.get(name))
                   for part in (f"--{name}", json.dumps(value) if name == "overrides" else value)]
        with tempfile.TemporaryDirectory() as folder:
            path, water = pathlib.Path(folder, "path.csv"), pathlib.Path(folder, "water.csv")
            asked = [simulator_path(), "run", request["scene"], "--gait", json.dumps(request["gait"]), *options]
            call([*asked, "--trajectory", path, "--particles"], (0, UNSTABLE))
            frames = np.loadtxt(path, delimiter=",", skiprows=1)
            count = int((frames[:, 0] == frames[0, 0]).sum())
            self.times, self.particles = frames[::count, 1], frames[:, 3:].reshape(-1, count, 3)
            half = self.times[len(self.times) // 2]
            call([*asked, "--snapshot", water, "--at", half], (0, UNSTABLE))
            with open(water, newline="", encoding="utf-8") as lines:
                rows = [(row["kind"] == "fluid", [float(row[name]) for name in ("x", "y", "z", "vx", "vy", "vz")]) for row in csv.DictReader(lines)]
        fluid, body = (np.array([values for is_fluid, values in rows if is_fluid == wet]).reshape(-1, 6) for wet in (True, False))
        self.angles = motion.attitude(self.particles)
        self.swimming = motion.Swimming(motion.unrolled(motion.slices(self.particles), self.angles[:, 0]))
        self.flow = [motion.flow(float(half), fluid[:, :3], fluid[:, 3:], body[:, :3], view) for view in ("ABOVE", "SIDE")] if len(fluid) else []


def portrait(request, file):
    """Draws the swimmer in its tank; returns whether the packages for that are installed."""
    try:
        picture.picture(request["scene"], str(file), request["gait"], view="three-quarter", size=(900, 400), duration=request.get("duration"),
                        overrides=request.get("overrides"), scheme=request.get("scheme"))
    except (ImportError, NatatorError):
        return False
    return True


def difference(run, swim):
    """How the present program's result differs from the stored one: a list of one sentence, or an empty list."""
    stored = json.loads((run / "best.json").read_text(encoding="utf-8"))["result"]
    frame = stored.get("frames", 0)
    if stored["status"] != "ok" or stored.get("distance") is None or not 0 < frame < len(swim.particles):
        return []
    found = swim.particles[frame, :, 0].mean() - swim.particles[0, :, 0].mean()
    return [] if abs(found - stored["distance"]) <= ROUNDING else [f"Stored {stored['distance']:.4f}, today's program {found:.4f}."]


def nearest(fits):
    """Index of the fish whose motion is most alike, or None."""
    like = [(fit["error"], fish) for fish, fit in enumerate(fits) if fit["error"] <= LIKE * fit["none"] and fit["alpha"] >= MIN_ALPHA]
    return min(like)[1] if like else None


def likeness(fits):
    told = ", ".join(f"{name} e {fit['error']:.4f} (α {fit['alpha']:.2f})" for name, fit in zip(FISH, fits, strict=True))
    fish = nearest(fits)
    return (f"It moves like {'none of the three kinds of' if fish is None else FISH[fish]} fish: of {told}. e is how far the motion is from the fish's: 0 is "
            f"the same motion, {fits[0]['none']:.4f} is no motion at all; like a fish is what has at most four fifths of that and needs not be scaled to less "
            "than a tenth. α scales the simulated spine; the body's roll is taken out.")


def course(page, words):
    axis = page.axes("generation", words["worth"])
    for name, colour, marker in zip(("best", "mean", "median"), COLOURS, "os^", strict=False):
        axis.plot([one["generation"] for one in words["generations"]], [one[name] for one in words["generations"]], marker + "-", color=colour, ms=4,
                  label=name)
    page.picture("fitness", "fitness over generations")
    for other in range(1, len(words.get("objectives", ()))):
        axis = page.axes(*(f"{words['objectives'][k]} (more is better)" for k in (0, other)))
        for name, rows, colour in (("all", words["population"], "0.6"), ("not dominated", words["front"], COLOURS[1])):
            axis.plot([row[0] for row in rows], [row[other] for row in rows], "o", color=colour, label=name)
        page.picture(f"front-{other}", "all gaits and those that no other is better than, in two objectives")
    if elites := words.get("elites"):
        axis = page.axes("beats per body length, from", "cost of transport (mass · length/s²), from")
        dots = axis.scatter([one["beats"] for one in elites], [one["cost"] for one in elites], c=[one["worth"] for one in elites], marker="s", s=200,
                            cmap="Blues", edgecolors="0.5")
        axis.set(xscale="log", yscale="log")
        axis.figure.colorbar(dots, label="worth of the best gait of each kind")
        page.picture("elites", "worth of the best gait of each kind, by beats per body length and cost of transport")


def moved(page, swim, title):
    """The thesis' figures 3.1 to 3.6; returns the fits to each fish."""
    swimming, times, frequency, length = swim.swimming, swim.times, swim.frequency, swim.swimming.length
    centres = swim.particles.mean(axis=1)
    for name, values, labels, about in (("position", centres - centres[0], ("x (forwards)", "y (up)", "z (right)"), "from the start (scene units)"),
                                        ("rotation", np.degrees(swim.angles), ("θ about x", "ρ about y", "ω about z"), "turned by (degrees)")):
        axis = page.axes("time (s)", about, title)
        for number, label in enumerate(labels):
            axis.plot(times, values[:, number], color=COLOURS[number], label=label)
        page.picture(name, f"{name} over time")
    known, whole = np.linspace(0, swimming.measured, 49), np.linspace(0, length, 49)
    phases = [int(np.argmin(np.abs(times - max(0, times[-1] - (4 - phase) / (4 * frequency))))) for phase in range(4)]
    envelope, curves = swimming.envelope(known), swimming.at(known)
    axis = page.axes(ALONG, SIDEWAYS, title)
    for number, frame in enumerate(phases):
        axis.plot(swimming.x[frame] / length, swimming.z[frame] / length, color=COLOURS[number], label=f"{number}/4, {times[frame]:.2f} s")
    for sign in (1, -1):
        axis.plot(known / length, sign * envelope / length, color="0.6", lw=1, label="envelope" if sign == 1 else None)
    axis.set_aspect("equal")
    page.picture("spines", "spine in four phases with its envelope")
    axis = page.axes(ALONG, "amplitude (body lengths), stretched", title)
    axis.plot(known / length, envelope / length, color="black", lw=3, label="simulated")
    for fish, name in enumerate(FISH):
        axis.plot(whole / length, np.abs(motion.amplitude(fish, whole, length, frequency)) / length, color=COLOURS[fish], label=name)
    page.save("envelopes")
    fits = [motion.fit(swimming, times, fish, frequency) for fish in range(len(FISH))]
    if (fish := nearest(fits)) is not None:
        axis = page.axes(ALONG, SIDEWAYS, f"{title}, scaled by {fits[fish]['alpha']:.2f}, and {FISH[fish]} fish (thin): e = {fits[fish]['error']:.4f}")
        for number, frame in enumerate(phases):
            axis.plot(known / length, fits[fish]["alpha"] * curves[frame] / length, color=COLOURS[number], lw=2.5)
            axis.plot(whole / length, motion.lateral(fish, whole, times[frame] - fits[fish]["beta"], length, frequency) / length, color=COLOURS[number], lw=1)
        axis.set_aspect("equal")
        page.save("scaled")
    if swim.flow:
        for axis, field in zip(page.panels(len(swim.flow)), swim.flow, strict=True):
            draw_flow(axis, field)
        page.save("flow")
    return fits


def draw_flow(axis, field):
    """Velocity as arrows over vorticity (red against the clock), with the swimmer in grey."""
    velocity, turns, body = motion.velocity(field), motion.vorticity(field), np.array(field["body"])
    x, y = (field["origin"][axis] + motion.CELL * np.arange(turns.shape[axis]) for axis in (0, 1))
    strongest, fastest = (float(np.nanmax(np.abs(values))) if np.isfinite(values).any() else 0.0
                          for values in (turns, np.hypot(velocity[..., 0], velocity[..., 1])))
    axis.pcolormesh(x, y, turns.T, cmap="bwr", vmin=-strongest, vmax=strongest, shading="nearest")
    axis.plot(*body.T, ".", color="0.5", ms=3)
    axis.quiver(x, y, velocity[..., 0].T, velocity[..., 1].T, angles="xy", scale_units="xy", scale=fastest / (1.8 * motion.CELL) or 1, width=0.002)
    above = field["view"] == "ABOVE"
    if above:
        axis.invert_yaxis()
    axis.set(aspect="equal", title=f"from {'above' if above else 'the side'} at {field['time']:.2f} s; longest arrow {fastest:.2f} units/s, darkest "
             f"{strongest:.1f} 1/s")
    axis.title.set_size("small")


class Page:
    """A page with its pictures, and the pictures as files."""

    def __init__(self, title, folder):
        self.title, self.folder, self.figure, self.parts = title, folder, None, [f"<h1>{html.escape(title)}</h1>"]

    def axes(self, x, y, title=""):
        """Axes of a new picture."""
        axis, = self.panels(1)
        axis.set(xlabel=x, ylabel=y, title=title)
        axis.grid(linewidth=0.5, alpha=0.5)
        return axis

    def panels(self, rows):
        from matplotlib.figure import Figure
        self.figure = Figure(figsize=(8, 4.8 * rows), dpi=100, layout="constrained")
        return self.figure.subplots(rows, squeeze=False).ravel()

    def save(self, name):
        """Saves the present picture to a file."""
        for axis in self.figure.axes:
            if axis.get_legend_handles_labels()[0]:
                axis.legend(fontsize="small")
        self.figure.savefig(self.folder / f"{name}.png", bbox_inches="tight", metadata={"Software": None})
        self.figure = None

    def picture(self, name, about):
        if self.figure is not None:
            self.save(name)
        data = base64.b64encode((self.folder / f"{name}.png").read_bytes()).decode()
        self.parts.append(f'<p><img alt="{html.escape(about)}" src="data:image/png;base64,{data}"></p>')

    def heading(self, words):
        self.parts.append(f'<h2 id="{words.lower().replace(" ", "-")}">{html.escape(words)}</h2>')

    def text(self, words):
        self.parts.append(f"<p>{html.escape(words)}</p>")

    def table(self, head, rows):
        def cell(value):
            kind, sign = SIGNS.get(value, ("", ""))
            return f'<td class="{kind}">{sign} {html.escape(value)}</td>' if kind else f"<td>{html.escape(value)}</td>"

        lines = ["".join(f"<th>{html.escape(name)}</th>" for name in head), *("".join(map(cell, row)) for row in rows)]
        self.parts.append("<table>" + "".join(f"<tr>{line}</tr>\n" for line in lines) + "</table>")

    def write(self):
        file = self.folder / "report.html"
        file.write_text(PAGE.format(title=html.escape(self.title), body="\n".join(self.parts)), encoding="utf-8")
        return file
