#!/usr/bin/env python3
"""What do bodies do in the thesis' tank in scheme conserving, where they weigh 1.7 times the water that they displace?

    for seed in 1 2 3 4 5; do for creature in 1 2 3 4; do
        natator evolve --preset thesis --creature $creature --scheme conserving --overrides '{"solver":{"substeps":2}}' --starts 2 --seed $seed \\
            --backend cuda --simulator batch --no-cache --output-dir results/thesis/sinking/creature-$creature-seed-$seed
    done; done
    python3 results/thesis/sinking.py > requests.jsonl
    natator-sim serve < requests.jsonl > results.jsonl
    python3 results/thesis/sinking.py --spacing | while read -r request; do
        natator-sim converge --starts 2 --levels spacing/2 <<< "$request"
    done > spacing.jsonl
    python3 results/thesis/sinking.py results.jsonl spacing.jsonl       # tables/sinking.csv, then tables/crawling.csv

The best gait of each evolution, from starts of its own, until it touches a plane, as runs in the thesis' tank end: with the scene's four
substeps, with eight, at half the spacing, and with resting muscles. And the published gaits for the whole 4 s, on the floor, with four,
eight and sixteen.
"""
import json
import pathlib
import statistics
import sys

import recompute
import swims

HERE = pathlib.Path(__file__).resolve().parent
STARTS = [1, 2, 3, 4]
SUBSTEPS = [4, 8, 16]
SECONDS = 4


def winners():
    """(number, creature, gait) of each evolution, the number its creature's and its seed's."""
    for folder in sorted((HERE / "sinking").glob("creature-*-seed-*")):
        creature, seed = (int(part) for part in folder.name.split("-")[1::2])
        yield 10 * creature + seed, creature, swims.best_gait(folder)


def request(creature, gait, substeps, ends):
    return {"scene": f"thesis/creature-{creature}", "scheme": "conserving", "duration": SECONDS, "gait": gait,
            "overrides": {"stopping": {"planeContact": ends, "noProgressAfter": 0}, "solver": {"substeps": substeps}}}


def asked(published):
    """((what, creature or gait, evolution), request) of each group of runs from all starts."""
    for number, creature, gait in winners():
        yield ("moving", creature, number), request(creature, gait, 4, True)
        yield ("half step", creature, number), request(creature, gait, 8, True)
        yield ("resting", creature, number), request(creature, swims.resting(gait), 4, True)
    for gait in published:
        for substeps in SUBSTEPS:
            yield (substeps, gait["name"], None), request(gait["creature"], gait["gait"], substeps, False)


def spacing(file):
    """Mean way at half the spacing, by evolution."""
    with open(file, encoding="utf-8") as lines:
        answers = [json.loads(line) for line in lines]
    return {answer["id"]: level["distance"]["mean"] for answer in answers for level in answer["levels"] if level["level"] == "spacing/2"}


def falls(found, finer, length):
    swims.row("creature", "lies on the floor after", "way until then", "at half the time step", "at half the spacing", "resting")
    for creature in sorted({name for what, name, _ in found if what == "moving"}):
        def each(what, key):
            return [[one[key] for one in runs] for (kind, name, _), runs in found.items() if (kind, name) == (what, creature)]

        def means(what):
            return [statistics.mean(ways) for ways in each(what, "distance")]
        ends = sum(each("moving", "simulated"), [])
        half_spacing = [finer[number] for what, name, number in found if (what, name) == ("moving", creature)]
        ways = [swims.spread([way / length[f"creature-{creature}"] for way in kind], 3)
                for kind in (means("moving"), means("half step"), half_spacing, means("resting"))]
        swims.row(creature, swims.spread(ends, 2, " s"), *ways)


def crawls(found, published):
    print()
    swims.row("gait", "published", *(f"{substeps} substeps" for substeps in SUBSTEPS))
    for gait in published:
        speeds = [swims.with_error([one["distance"] / SECONDS for one in found[substeps, gait["name"], None]], 2) for substeps in SUBSTEPS]
        swims.row(f"{gait['creature']}, {gait['about']}", gait.get("published", {}).get("speed", "–"), *speeds)


def main():
    if sys.argv[1:] == ["--spacing"]:
        for number, creature, gait in winners():
            print(json.dumps({"id": number, **request(creature, gait, 4, True)}))
        return
    study = recompute.Study()
    groups = list(asked(study.published))
    runs = [(name, {"id": number, "start": start, **one})
            for number, (name, one, start) in enumerate((name, one, start) for name, one in groups for start in STARTS)]
    results = swims.results(run for _, run in runs)
    found = {}
    for name, run in runs:
        found.setdefault(name, []).append(results[run["id"]])
    falls(found, spacing(sys.argv[2]), study.length)
    crawls(found, study.published)


if __name__ == "__main__":
    main()
