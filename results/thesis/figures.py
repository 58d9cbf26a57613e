"""The pictures of the study, figures/*.png."""
import csv

import matplotlib
import numpy as np

import claims
from natator import motion
import plan
from page import WORDS
from plan import WATERS

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402

COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")  # told apart also by the colour blind
SIDEWAYS, ALONG = "sideways (body lengths)", "from the head (body lengths)"


def save(figure, folder, name):
    figure.savefig(folder / f"{name}.png", dpi=80, metadata={"Software": None})
    pyplot.close(figure)


def panels(columns, rows, width=4.6, height=3.2):
    figure, axes = pyplot.subplots(rows, columns, figsize=(width * columns, height * rows), layout="constrained", squeeze=False)
    return figure, axes.ravel()


def speeds(study, folder):
    """Of each creature the thesis' gait and the best that evolved, if it may swim, with error bars."""
    figure, (axis,) = panels(1, 1, 7, 4)
    number = 0
    for water in WATERS:
        for name, subjects in ((f"thesis' gait, {WORDS[water]}", study.plan.published(water)), (f"evolved, {WORDS[water]}", study.bests(water))):
            known = [(one.creature + 0.12 * (number - 1.5), speed) for one in subjects if study.may_swim(one) and (speed := study.speed(one))]
            if known:
                axis.errorbar([x for x, _ in known], [one.mean for _, one in known], [one.error for _, one in known], fmt="osD^"[number],
                              color=COLOURS[number], capsize=3, label=name)
            number += 1
    axis.set(title="Speed in water, of what may swim", xlabel="creature", ylabel="scene units/s", xticks=study.size.creatures)
    if axis.containers:
        axis.legend(fontsize="small")
    save(figure, folder, "speeds")


def fitness(study, folder):
    """Best of each generation, as the evolution judged it, and the population's mean (thin)."""
    figure, axes = panels(2, (len(study.size.creatures) + 1) // 2)
    for axis, creature in zip(axes, study.size.creatures):
        axis.set(title=f"creature {creature}", xlabel="generation", ylabel="way (scene units)")
        for one in (one for one in study.finished() if one.creature == creature):
            with open(one.folder(study.folder) / "generations.csv", encoding="utf-8") as lines:
                rows = list(csv.DictReader(lines))
            steps, style = [int(row["generation"]) for row in rows], {"color": COLOURS[(one.seed - 1) % 6], "ls": "-" if one.water == "flex" else "--"}
            axis.plot(steps, [float(row["best"]) for row in rows], lw=1.5, label=f"{WORDS[one.water]}, seed {one.seed}", **style)
            axis.plot(steps, [float(row["mean"]) for row in rows], lw=0.5, **style)
    axes[0].legend(fontsize="xx-small", ncols=2)
    save(figure, folder, "fitness")


def parameters(study, water, folder):
    """Speed along the own heading by that at the scene's own value, where a gait swims there; values are equally spaced."""
    asked = list(study.plan.parameters(water))
    figure, axes = panels(3, -(-len(asked) // 3), 4.2, 2.8)
    for axis, (name, own, values, _) in zip(axes, asked):
        axis.set(title=f"{name} (own: {claims.value_text(own)})", xticks=range(len(values)), xticklabels=map(claims.value_text, values))
        axis.axhline(0, color="0.8", lw=0.8)
        for number, subject in enumerate(study.studied(water)):
            usual, found = (study.forward(study.plan.parameter(subject, name, own)),
                            [study.forward(study.plan.parameter(subject, name, value)) for value in values])
            if claims.Trend(usual, []).swims:
                points = [(i, one) for i, one in enumerate(found) if one.count]
                axis.errorbar([i for i, _ in points], [one.mean / usual.mean for _, one in points],
                              [one.sd / usual.mean if one.count > 1 else 0 for _, one in points], color=COLOURS[number], marker="osD"[number], ms=4,
                              capsize=2, label=claims.name(subject))
    for axis in axes[len(asked):]:
        axis.set_axis_off()
    if axes[0].lines[1:]:
        axes[0].legend(fontsize="x-small")
    figure.suptitle(f"Share of the speed at the own value, {WORDS[water]}")
    save(figure, folder, f"parameters-{water}")


def phases(times, frequency):
    """Frames of four phases of the last whole beat."""
    return [int(np.argmin(np.abs(times - max(0, times[-1] - (4 - phase) / (4 * frequency))))) for phase in range(4)]


def swim(title, recording, folder, name):
    """The thesis' figures 3.1 to 3.6 of a recording: place, rotation, spine, envelope, of creature 2 beside an eel, and its water. Sideways is the
    body's own side. Curves end where the shortest spine does."""
    times, angles = np.array(recording["spine"]["times"]), np.array([[one[key] for key in ("roll", "yaw", "pitch")] for one in recording["attitude"]])
    swimming = motion.Swimming(motion.unrolled(np.array(recording["spine"]["centres"]), angles[:, 0]))
    frequency, length = recording["request"]["gait"]["frequency"], swimming.length
    whole, known, frames = np.linspace(0, length, 49), np.linspace(0, swimming.measured, 49), phases(times, frequency)
    envelope = swimming.envelope(known)
    is_second = recording["request"]["scene"].endswith("creature-2")
    layout, heights = [["place", "rotation"], ["spine", "envelope"]], [1, 1]
    if is_second and recording["flow"]:
        layout, heights = [*layout, ["scaled"] * 2, ["above", "side"]], [1, 1, 0.65, 0.65]
    figure, axes = pyplot.subplot_mosaic(layout, figsize=(9.2, 3.2 * sum(heights)), height_ratios=heights, layout="constrained")
    centres = np.array(recording["centres"])
    for axis, values, labels, about in ((axes["place"], centres - centres[0], ("x (forwards)", "y (up)", "z (right)"), "from the start (scene units)"),
                                        (axes["rotation"], np.degrees(angles), ("θ about x", "ρ about y", "ω about z"), "turned by (degrees)")):
        for number, label in enumerate(labels):
            axis.plot(times, values[:, number], color=COLOURS[number], label=label)
        axis.set(xlabel="time (s)", ylabel=about)
    for number, frame in enumerate(frames):
        axes["spine"].plot(swimming.x[frame] / length, swimming.z[frame] / length, color=COLOURS[number], label=f"{times[frame]:.2f} s")
    for sign in (1, -1):
        axes["spine"].plot(known / length, sign * envelope / length, color="0.6", lw=1, label="envelope" if sign == 1 else None)
    axes["spine"].set(xlabel=ALONG, ylabel=SIDEWAYS, aspect="equal")
    axes["envelope"].plot(known / length, envelope / length, color="k", lw=2.5, label="simulated")
    for fish, label in enumerate(("anguilliform", "carangiform", "thunniform")):
        axes["envelope"].plot(whole / length, np.abs(motion.amplitude(fish, whole, length, frequency)) / length, color=COLOURS[fish], label=label)
    axes["envelope"].set(xlabel=ALONG, ylabel="envelope (body lengths)")
    if "scaled" in axes:
        scaled(axes["scaled"], swimming, times, frequency, frames)
        for view, field in zip(("above", "side"), recording["flow"]):
            draw_flow(axes[view], field)
    for axis in axes.values():
        if axis.get_legend_handles_labels()[0]:
            axis.legend(fontsize="x-small")
    figure.suptitle(title)
    save(figure, folder, name)


def scaled(axis, swimming, times, frequency, frames):
    """The spine scaled by α against an eel that it fits (thin)."""
    fit, length = motion.fit(swimming, times, 0, frequency), swimming.length
    known, whole = np.linspace(0, swimming.measured, 49), np.linspace(0, length, 49)
    for number, (frame, z) in enumerate(zip(frames, swimming.at(known)[frames])):
        axis.plot(known / length, fit["alpha"] * z / length, color=COLOURS[number], lw=2.5)
        axis.plot(whole / length, motion.lateral(0, whole, times[frame] - fit["beta"], length, frequency) / length, color=COLOURS[number], lw=1)
    axis.set(title=f"scaled by {fit['alpha']:.2f}, anguilliform fish thin: e = {fit['error']:.4f}", xlabel=ALONG, ylabel=SIDEWAYS, aspect="equal")
    axis.title.set_size("small")


def draw_flow(axis, field):
    """Velocity as arrows over vorticity, with the swimmer in grey."""
    velocity, turns, body = motion.velocity(field), motion.vorticity(field), np.array(field["body"])
    x, y = (field["origin"][axis] + motion.CELL * np.arange(turns.shape[axis]) for axis in (0, 1))
    strongest = np.nanmax(np.abs(turns))
    axis.pcolormesh(x, y, turns.T, cmap="bwr", vmin=-strongest, vmax=strongest, shading="nearest")
    axis.plot(*body.T, ".", color="0.5", ms=3)
    above = field["view"] == "ABOVE"
    axis.quiver(x, y, velocity[..., 0].T, velocity[..., 1].T, angles="xy", width=0.002)
    if above:
        axis.invert_yaxis()
    fastest = np.nanmax(np.hypot(velocity[..., 0], velocity[..., 1]))
    axis.set(title=f"from {'above' if above else 'the side'} at {field['time']:.2f} s; longest arrow {fastest:.2f} units/s, darkest {strongest:.1f} 1/s",
             aspect="equal")
    axis.title.set_size("x-small")


def title(name):
    return f"Gait {name[7:]} of the thesis, flex" if name.startswith("thesis-") else \
        f"Best evolved, {name.replace('-flex', ', flex').replace('-open-water', ', open water')}"


def draw(study, found, anew):
    """All pictures, drawn anew or as they are; what README.md shows of them by name."""
    folder = study.folder / "figures"
    drawings = {"speeds": ("speeds in water with error bars", lambda: speeds(study, folder)),
                **{name: (title(name), lambda name=name, one=one: swim(title(name), one, folder, name)) for name, one in found.items()},
                "fitness": ("Evolution", lambda: fitness(study, folder)),
                **{f"parameters-{water}": (f"Parameters, {WORDS[water]} (4.1)", lambda water=water: parameters(study, water, folder))
                   for water in WATERS}}
    if anew:
        folder.mkdir(parents=True, exist_ok=True)
        for _, picture in drawings.values():
            picture()
    shown = {name: f"![{about}](figures/{name}.png)" for name, (about, _) in drawings.items()}
    gallery = ",\n".join(f"[{name}](figures/{name}.png)" for name in shown if name != "speeds") + "."
    return {"speeds_drawn": shown["speeds"], "gallery": gallery}
