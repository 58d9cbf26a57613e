"""The page's answer and tables, of the rows of measure.py, and its pictures, of the fields that it kept (*.npz)."""
import json
import pathlib
import statistics

import numpy as np
import study
from matplotlib import pyplot
from scipy import stats

HERE = pathlib.Path(__file__).parent
GAIT = json.loads((HERE / "gait.json").read_text())
LENGTH, SPEED = 0.98, 1.0
WAVE = SPEED / GAIT["frequency"]  # of the swimmer's path, from one beat to the next
NAMES = {(1, 1): "", (1, 2): ", half the step", (2, 1): ", half the cells and step"}
ASIDE = 0.6  # of a body length, beyond which a follower has left the wake
SHOWN = ("0.5", "1", "2", "4", "6", "8", "10")  # of the places behind a tail


def rows(kind):
    file = HERE / f"{kind}.jsonl"
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()] if file.exists() else []


def mean(values):
    """Mean and its 95 % by Student's t."""
    half = stats.t.ppf(0.975, len(values) - 1) * statistics.stdev(values) / len(values) ** 0.5 if len(values) > 1 else float("nan")
    return statistics.fmean(values), half


def mean_turn(turns):
    """Mean of parts of a turn, which go on from 1 to 0, and its 95 %, of their distances from their direction's mean."""
    middle = np.angle(np.mean(np.exp(2j * np.pi * np.array(turns)))) / (2 * np.pi)
    value, error = mean([middle + (turn - middle + 0.5) % 1 - 0.5 for turn in turns])
    return value, error


def percent(value, error):
    return f"{study.fixed(100 * value, 0).replace('-', '−')} ± {study.fixed(100 * error, 0)} %"


def grouped(all_rows, *keys):
    groups = {}
    for row in all_rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(row)
    return dict(sorted(groups.items()))


def streets():
    groups = grouped(rows("street"), "n", "steps", "diameter", "behind")
    free = {key[:2]: mean([row["power"] for row in own if "power" in row and "unstable" not in row]) for key, own in groups.items() if key[2] == 0}
    made, saved = [], {}
    for (n, steps, diameter, behind), own in groups.items():
        held = [row for row in own if "power" in row and "unstable" not in row]
        name = (f"{diameter} wide, {behind} behind" if diameter else "none") + NAMES[n, steps]
        if not held:
            continue
        power, error = mean([row["power"] for row in held])
        base, base_error = free[n, steps]
        ratio = power / base
        spread = ratio * ((error / power) ** 2 + (np.nan_to_num(base_error) / base) ** 2) ** 0.5
        if (diameter, behind, n) == (0.3, 1.5, 1):
            saved[steps] = percent(1 - ratio, spread) if error == error else f"{study.fixed(100 * (1 - ratio), 0)} %"
            saved[steps] += f" less ({len(held)} of {len(own)} swims)"
        made.append([name, str(len(held)), f"{study.fixed(power, 0)} ± {study.fixed(error, 0)}" if error == error else study.fixed(power, 0),
                     percent(ratio - 1, spread) if diameter and error == error else "", study.fixed(statistics.fmean(row["scale"] for row in held), 2),
                     study.fixed(statistics.fmean(row["sd_z"] for row in held), 2)])
    return study.table(["cylinder", "swims", "work/s", "against none", "amplitudes", "s.d. across"], made), saved


def cost_alone():
    """Work for a length of way, in free water."""
    return statistics.fmean(row["power"] / (SPEED + row["speed"]) for row in rows("street") if row["diameter"] == 0 and (row["n"], row["steps"]) == (1, 1))


def pairs():
    solo = cost_alone()
    made, locked, finer = [], [], 0
    for row in sorted(rows("pair"), key=lambda row: (row["n"], row["steps"], row["gap"] or 0, row["phase"])):
        if row["role"] != "follower" or "apart" not in row:
            continue
        gap = -np.array(row["apart"])[-5:] - LENGTH
        aside = abs(row["its_z"][-1] - row["z"]) / LENGTH
        stayed = aside < ASIDE and gap.mean() > 0.1
        turn = (gap.mean() / WAVE + row["phase"]) % 1
        if stayed:
            if (row["n"], row["steps"]) == (1, 1):
                locked.append(turn)
            else:
                finer += 1
        speeds, powers = np.array(row["speeds"]), np.array(row["powers"])
        change = np.mean(powers) / (SPEED + speeds.mean()) / solo - 1
        if aside >= ASIDE:
            continue
        made.append([f"{row['gap']}, {row['phase']}{NAMES[row['n'], row['steps']]}", study.with_error(gap.mean(), gap.std(), 2), study.fixed(turn, 2) if stayed else "",
                     study.with_error(speeds.mean(), speeds.std(ddof=1) / len(speeds) ** 0.5, 2), percent(change, np.std(powers / (SPEED + speeds), ddof=1) / len(speeds) ** 0.5 / solo)])
    return study.table(["gap at the start, phase", "gap at the end", "gap/λ + phase", "speed over ground", "its cost of transport"], made), locked, finer


def sides():
    solo = cost_alone()
    made = []
    for (kind, width), own in grouped(rows("row"), "kind", "width").items():
        swum = [row for row in own if "speeds" in row]
        if not swum:
            made.append([f"{width}, {kind}", "all break a law", ""])
            continue
        speeds = np.array([np.mean(row["speeds"]) for row in swum])
        costs = np.array([np.mean(row["powers"]) for row in swum]) / (SPEED + speeds) / solo - 1
        made.append([f"{width}, {kind}", study.with_error(speeds.mean(), np.ptp(speeds) / 2, 3), percent(costs.mean(), np.ptp(costs) / 2)])
    return study.table(["distance, beat of neighbours", "speed over ground", "cost of transport"], made)


def wakes():
    own = [row for row in rows("wake") if "behind" in row]
    if not own:
        return "", None
    base = {key: statistics.fmean(row["behind"]["1"][key] for row in own) for key in ("curl", "across")}
    made, left = [], None
    for place in own[0]["behind"]:
        values = {key: statistics.fmean(row["behind"][place][key] for row in own) for key in base}
        if place in SHOWN:
            made.append([place, *(study.fixed(values[key], decimals) for key, decimals in (("curl", 2), ("across", 3))), study.fixed(values["curl"] / base["curl"], 2)])
        if place == "10":
            left = values["curl"] / base["curl"], values["across"]
    return study.table(["body lengths behind the tail", "vorticity, 1/s", "velocity across", "vorticity over that at 1"], made), left


def frames():
    made = []
    for (n, steps), own in grouped(rows("frame"), "n", "steps").items():
        made.append([("cells and steps of the scene" + NAMES[n, steps]).replace("cells and steps of the scene, ", ""),
                     *(study.with_error(*(lambda s: (s.mean(), s.std(ddof=1) / len(s) ** 0.5))(np.array(row["speeds"])), 2) for row in sorted(own, key=lambda row: row["current"]))])
    currents = sorted({row["current"] for row in rows("frame")})
    return study.table(["speed through the water, in a current of", *(f"{current:g}" for current in currents)], made) if made else ""


def drawn(folder, name):
    """A field of vorticity from above: red turns to the left; x to the right, z downwards."""
    field = np.load(HERE / f"{name}.npz")
    curl, cell = field["curl"].astype(float).T, float(field["cell"])
    high, wide = curl.shape
    figure = pyplot.figure(figsize=(9, 9 * high / wide), dpi=90)
    axes = figure.add_axes([0, 0, 1, 1])
    axes.imshow(np.tanh(curl / 12), cmap="coolwarm", vmin=-1, vmax=1, extent=[0, wide * cell, high * cell, 0], interpolation="nearest")
    for body in field["bodies"]:
        axes.scatter(body[:, 0], body[:, 1], s=2, color="#3c2814")
    axes.set_axis_off()
    figure.savefig(folder / f"{name}.png", metadata={"Software": None}, pil_kwargs={"optimize": True})
    pyplot.close(figure)


def make(folder):
    street, saved = streets()
    pair, turns, finer = pairs()
    wake, left = wakes()
    turn, error = mean_turn(turns)
    swum = [(row["n"], row["steps"]) == (1, 1) for row in rows("pair") if row["role"] == "follower"]
    answer = (f"**Whether a swimmer holds station behind a cylinder with less work than in free water is open: {saved[1]} at the scene's time step, {saved[2]} at half of it. A follower that stays "
              f"in the wake settles where its gap over the wavelength plus its phase is {study.fixed(turn, 2)} ± {study.fixed(error, 2)}, as for foils and fish ({len(turns)} of {sum(swum)} swims; {finer} of {len(swum) - sum(swum)} stay at half the time step). Ten body lengths behind, "
              f"{study.fixed(100 * left[0], 0)} % of the vorticity one behind are left (one swim).**\n")
    (folder / "README.md").write_text(study.filled(HERE / "README.md", answer=answer, street=street, pair=pair, side=sides(), wake=wake, frame=frames()), encoding="utf-8")
    for file in sorted(HERE.glob("*.npz")):
        drawn(folder, file.stem)


study.main(make)
