"""The page's answer and tables, of gaits.jsonl, creature-2.json and bending.csv."""
import csv
import json
import pathlib

import study

HERE = pathlib.Path(__file__).parent
CHOSEN = [2, 0.42, 0.35]  # as request.json has it, because it converges
WIDER = 1.9  # Standard deviation of the chosen gait from other arrangements of the water (endless/results.jsonl) over that from starts perturbed by 0.001 of the spacing, as here.
SETTINGS = ((4, 8), (4, 64), (8, 8), (16, 8), (32, 8), (8, 32), (32, 32))
BODIES = (("1", "0.6", "0.4", "1"), ("2", "0.6", "0.4", "1"), ("2", "0.6", "0.4", "2"), ("2", "0.9", "1", "1"), ("2", "0.2", "1", "1"))


def rows(name):
    with open(HERE / name, encoding="utf-8", newline="") as lines:
        return list(csv.DictReader(lines))


def sample():
    """What half the spacing does to gaits that nobody chose."""
    told, found = [], [json.loads(line) for line in (HERE / "gaits.jsonl").read_text(encoding="utf-8").splitlines()]
    found = [one for one in found if one["of"][1:] != CHOSEN]
    for gravity in (3, 10):
        changes = [(level["change"]["mean"], WIDER * study.half_interval(level["change"]["error"], level["runs"])) for one in found if one["of"][0] == gravity
                   for level in one["levels"] if level["level"] == "spacing/2"]
        beyond = [mean for mean, error in changes if abs(mean) - error > 0.1]
        least, most = (f"{100 * one:+.0f}".replace("-", "−") for one in (min(beyond), max(beyond)))
        told.append(f"{sum(abs(mean) + error < 0.1 for mean, error in changes)} surely (95 %) change by less than 10 % and {len(beyond)} by more "
                    f"under gravity {gravity} (by {least} to {most} %)")
    return f"**Of the speeds of {len(changes)} gaits that nobody chose, at half the spacing, four starts each, {', '.join(told)}.**\n"


def levels(found):
    names = {"base": "base, spacing 0.1", "time/2": "half the time step", "spacing/2": "half the spacing"}
    def known(one, digits):
        return study.with_error(one["mean"], one["error"], digits)
    return study.table(["level", "substeps", "particles", "distance in 4 s", "speed", "change"], [
        [names[one["level"]], str(one["substeps"]), f"{one['particles']:,}".replace(",", " "), known(one["distance"], 3), known(one["speed"], 3),
         study.with_error(100 * one["change"]["mean"], 100 * one["change"]["error"], 1).replace("-", "− ") + " %" if "change" in one else ""]
        for one in found["levels"]])


def estimate(found):
    one, length = found["estimate"], found["bodyLength"]
    return f"The estimate for time step and spacing 0{'' if one['time']['observed'] and one['spacing']['observed'] else ', by assumed first orders,'} is {study.with_error(one['speed'], one['error'], 3)} (scatter {one['statistical']:.3f}, discretisation " \
           f"{one['discretisation']:.3f}), or {one['speed'] / length:.2f} body lengths/s; at spacing 0.1 it is {found['levels'][0]['speed']['mean'] / length:.2f}.\n"


def bending():
    known = {tuple(row.values())[:6]: float(row["bending_degrees"]) for row in rows("bending.csv")}
    return study.table(["creature", "cluster stiffness", "spring stiffness", *(f"{substeps} × {iterations}" for substeps, iterations in SETTINGS)], [
        [creature + (", half the spacing" if refinement == "2" else ""), cluster, spring,
         *(f"{known[key]:.1f}" if (key := (creature, cluster, spring, refinement, *map(str, setting))) in known else "" for setting in SETTINGS)]
        for creature, cluster, spring, refinement in BODIES])


def make(folder):
    found = json.loads((HERE / "creature-2.json").read_text(encoding="utf-8"))
    (folder / "README.md").write_text(study.filled(HERE / "README.md", answer=sample(), levels=levels(found), estimate=estimate(found), bending=bending()),
                                      encoding="utf-8")


study.main(make)
