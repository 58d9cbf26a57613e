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
WIDTH = 4.0  # of the tank of streets
WAVE = SPEED / GAIT["frequency"]  # of the swimmer's path, from one beat to the next
LEVELS = {(1, 1): "the scene's", (1, 2): "half the step", (2, 1): "half the cells and step"}
ASIDE, TOUCHES = 0.39, 0.1  # of a body length, what tails swing, beyond which a follower has left the wake; units
SHOWN = ("0.5", "1", "2", "4", "6", "8", "10")  # of the places behind a tail


def rows(kind):
    file = HERE / f"{kind}.jsonl"
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()] if file.exists() else []


def mean_turn(turns):
    """Mean of parts of a turn, which go on from 1 to 0, and its 95 %, of their distances from their direction's mean."""
    middle = np.angle(np.mean(np.exp(2j * np.pi * np.array(turns)))) / (2 * np.pi)
    value, error = study.interval([middle + (turn - middle + 0.5) % 1 - 0.5 for turn in turns])
    return value, error


def by_chance(gaps, phases):
    """The probability of gaps plus phases, parts of a turn, as near to each other, if the same phases were dealt to the same gaps at random."""
    random, turn = np.random.default_rng(1), np.exp(2j * np.pi * np.array(gaps))
    dealt = [phases, *(random.permutation(phases) for _ in range(20_000))]
    lengths = np.abs(np.exp(2j * np.pi * np.array(dealt)) @ turn)
    return float(np.mean(lengths >= lengths[0] * (1 - 1e-9)))


def at(turns):
    return study.with_error(*mean_turn(turns), 2).replace("-", "−")


def percent(value, error):
    return f"{study.fixed(100 * value, 0).replace('-', '−')} ± {study.fixed(100 * error, 0)} %"


def grouped(all_rows, *keys):
    groups = {}
    for row in all_rows:
        groups.setdefault(tuple(row[key] for key in keys), []).append(row)
    return dict(sorted(groups.items()))


def aside(own):
    """The mean distance of swims from the axis, units."""
    return statistics.fmean(abs(row["z"] - WIDTH / 2) for row in own)


def streets():
    """The table, and by place, of those that were held at all levels, by level (work over that without a cylinder less 1, its 95 %, swims that held it, how far they are aside)."""
    groups = grouped(rows("street"), "diameter", "behind", "n", "steps")
    held = {key: [row for row in own if "power" in row and "unstable" not in row] for key, own in groups.items()}
    made, found = [], {}
    for (diameter, behind, *level), own in held.items():
        if len(own) < 2:
            continue
        power, error = study.interval([row["power"] for row in own])
        base, base_error = study.interval([row["power"] for row in held[0, 1.5, *level]])
        ratio = power / base
        spread = ratio * ((error / power) ** 2 + (base_error / base) ** 2) ** 0.5
        of = len(groups[diameter, behind, *level])
        if diameter:
            found.setdefault((diameter, behind), {})[tuple(level)] = ratio - 1, spread, len(own), aside(own)
        made.append([f"{diameter} wide, {behind} behind" if diameter else "none", LEVELS[tuple(level)], f"{len(own)} of {of}", f"{study.fixed(power, 0)} ± {study.fixed(error, 0)}",
                     percent(ratio - 1, spread) if diameter else "", study.fixed(statistics.fmean(row["scale"] for row in own), 2),
                     study.fixed(aside(own), 2)])
    return study.table(["cylinder", "cells and steps", "swims that break no law", "work/s", "against none", "amplitudes", "aside"], made, "<<>>>>>"), found


def of_streets(found):
    """The answer's sentence, of the place where less work is surest, with the scene's cells and steps."""
    (diameter, behind), levels = min(found.items(), key=lambda one: sum(one[1][1, 1][:2]))
    numbers = ", ".join(f"{words}{percent(-levels[level][0], levels[level][1])} ({levels[level][2]} swims)"
                        for level, words in (((1, 1), ""), ((1, 2), "at half the step "), ((2, 1), "in half the cells ")) if level in levels)
    sure = all(change + error < 0 for change, error, _, _ in levels.values())
    asides = [one[3] for one in levels.values()]
    return f"A loach that holds station {behind} units behind a cylinder {diameter} wide, {min(asides):.1f} to {max(asides):.1f} aside of its axis, works less than in free water by {numbers}{'' if sure else ': open'} (the surest of {len(found)} places)."


def end_of(row):
    """The gap, units, and how far the follower is aside, body lengths: means of the last 2 s."""
    before, aside = np.mean(row["apart"][-5:], axis=0)[1:]
    return before - LENGTH, abs(aside) / LENGTH


def is_steady(row):
    """Whether the gap has come to rest: in the last 2 s it changes by less than half a wavelength."""
    gaps = [before for _, before, _ in row["apart"][-5:]]
    return max(gaps) - min(gaps) < WAVE / 2


def pairs():
    """The table and by level (gaps over the wavelength plus phase of followers that stay in the wake, their phases, all swims)."""
    made, found = [], {}
    for level, own in grouped(rows("pair"), "n", "steps").items():
        stay, gaps = [], []
        for row in own:
            gap, aside = end_of(row)
            if "unstable" not in row and aside < ASIDE and gap > TOUCHES and is_steady(row):
                stay.append(row)
                gaps.append(gap / WAVE)
        costs = [row["power"] / (SPEED + row["speed"]) / (row["leader"]["power"] / (SPEED + row["leader"]["speed"])) - 1 for row in stay]
        phases = [row["phase"] for row in stay]
        turns, chance = [(gap + phase) % 1 for gap, phase in zip(gaps, phases)], by_chance(gaps, phases)
        found[level] = turns, phases, len(own), chance
        made.append([LEVELS[level], f"{len(stay)} of {len(own)}", *([at(turns), f"{chance:.1g}" if chance > 1e-4 else "below 0.0001", study.with_error(*study.interval([row["speed"] for row in stay]), 2),
                                                                     percent(*study.interval(costs))] if len(stay) > 2 else [""] * 4)])
    return study.table(["cells and steps", "followers that stay", "gap/λ + phase", "p if none", "speed over ground", "cost of transport against the leader's"], made), found


def drawn_pairs(folder):
    """Where followers are at the end."""
    figure, axes = pyplot.subplots(figsize=(7, 3.6), dpi=90)
    phases = np.array([-0.1, 0.85])
    for turns in range(4):
        axes.plot(phases, turns - phases, color="#bbb", linewidth=1)
    for colour, (level, own) in zip(("#1668b0", "#b04a16", "#2a8a3a"), grouped(rows("pair"), "n", "steps").items()):
        places = [(row["phase"], *end_of(row)) for row in own if "unstable" not in row]
        for inside, marker in ((True, "o"), (False, "x")):
            some = [(phase + 0.02 * (list(LEVELS).index(level) - 1), gap / WAVE) for phase, gap, aside in places if (aside < ASIDE) == inside]
            if some:
                axes.plot(*zip(*some), marker, color=colour, label=LEVELS[level] if inside else None)
    axes.set(xlabel="beats by which the leader is later", ylabel="gap / λ at the end", xlim=phases, ylim=(-0.5, 3))
    axes.legend(loc="upper right")
    figure.tight_layout()
    figure.savefig(folder / "pairs.png", metadata={"Software": None}, pil_kwargs={"optimize": True})
    pyplot.close(figure)


def sides():
    groups = grouped(rows("row"), "kind", "width")

    def cost(row):
        return np.mean(row["powers"]) / (SPEED + np.mean(row["speeds"]))
    far = max(width for _, width in groups)
    base = statistics.fmean(cost(row) for (_, width), own in groups.items() if width == far for row in own)
    made = []
    for (kind, width), own in groups.items():
        swum = [row for row in own if "speeds" in row]
        if not swum:
            continue
        speeds, costs = (np.array(values) for values in ([np.mean(row["speeds"]) for row in swum], [cost(row) / base - 1 for row in swum]))
        made.append([f"{width}, {kind}", study.with_error(speeds.mean(), np.ptp(speeds) / 2, 3), percent(costs.mean(), np.ptp(costs) / 2)])
    return study.table(["distance, beat of neighbours", "speed over ground", f"cost of transport against {far} apart"], made)


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
        made.append([LEVELS[n, steps],
                     *(study.with_error(np.mean(row["speeds"]), stats.sem(row["speeds"]), 2) for row in sorted(own, key=lambda row: row["current"]))])
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
    street, held = streets()
    pair, turns = pairs()
    wake, left = wakes()
    locked = {level: f"{at(own)} ({len(own)} of {count} swims, {phases.count(statistics.mode(phases))} with phase {statistics.mode(phases)}{'' if chance < 0.05 else f'; open: p = {chance:.1g}'})" if len(own) > 2 else f"open ({len(own)} of {count} stay)" for level, (own, phases, count, chance) in turns.items()}
    answer = (f"**{of_streets(held)} A follower that stays in a leader's wake settles at a gap that a phase moves by a wavelength a beat, as for foils and fish: gap over wavelength plus phase is {locked[1, 1]}; at half the step "
              f"{locked[1, 2]}, in half the cells {locked[2, 1]}.** Ten body lengths behind, {study.fixed(100 * left[0], 0)} % of the vorticity one behind are left (two swims).\n")
    (folder / "README.md").write_text(study.filled(HERE / "README.md", answer=answer, street=street, pair=pair, side=sides(), wake=wake, frame=frames()), encoding="utf-8")
    drawn_pairs(folder)
    for file in sorted(HERE.glob("*.npz")):
        drawn(folder, file.stem)


study.main(make)
