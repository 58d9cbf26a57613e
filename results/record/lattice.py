#!/usr/bin/env python3
"""The fry in scheme `lattice`, evolved with two widths of cells in the loop: of each gait the slower swim counts.

    pip install cma                                                      # Hansen, Akimoto, Baudis 2019
    lattice.py evolve SEED SECONDS [cuda]                                # lattice/seed-SEED.csv, -best.json
    lattice.py requests [SEED]... | natator-sim serve --backend cuda | lattice.py keep > lattice/fresh.jsonl

A gait is a wave that runs to the tail: frequency, amplitudes of the first and the last actuator, number of waves. Measured is the search's mean at its end, which no swim has chosen, from fresh starts."""
import concurrent.futures
import csv
import json
import pathlib
import statistics
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from lakes import answers, lake  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent / "lattice"
SIDES = (2.85, 1.05, 1.35)
CELLS = (0.025, 0.01875)  # in the loop: 4 and 5 across the trunk behind, which is 0.1 wide
SEEDS, ACTUATORS, POPULATION, SECONDS = (1, 2, 3), 7, 10, 1.5
LOW, HIGH = (0.5, 0, 0, 0.25), (3, 1, 1, 1.25)  # of a gait
# Of fresh swims: width of cells, how many times the steps, starts.
LEVELS = ((0.025, 1, 4), (0.01875, 1, 8), (0.01875, 2, 2), (0.0125, 1, 2))


def gait_of(genes):
    """Of four numbers from 0 to 1."""
    f, first, last, waves = (low + (high - low) * gene for low, high, gene in zip(LOW, HIGH, genes))
    along = [k / (ACTUATORS - 1) for k in range(ACTUATORS)]
    return {"frequency": f, "amplitude": [first + (last - first) * s for s in along], "phase": [-waves * s % 1 for s in along]}


def scene(cell, steps=1, seconds=SECONDS, sides=SIDES):
    """Overrides of lake/fry."""
    return lake(sides, cell, 0.575, steps, seconds, ends_at_walls=True)


def slower(all_genes, start, backend):
    """Of each the least distance at both widths of cells; of one that became unstable 0."""
    def at(cell):
        return answers([{"id": k, "scene": "lake/fry", "overrides": scene(cell), "gait": gait_of(genes), "start": start} for k, genes in enumerate(all_genes)], backend)
    with concurrent.futures.ThreadPoolExecutor() as pool:
        levels = list(pool.map(at, CELLS))
    return [min(level[k]["distance"] if level[k]["status"] == "ok" else 0 for level in levels) for k in range(len(all_genes))]


def evolve(seed, seconds, backend):
    import cma

    began = time.monotonic()
    search = cma.CMAEvolutionStrategy([0.6, 0.1, 0.5, 0.4], 0.2, {"bounds": [0, 1], "seed": seed, "popsize": POPULATION, "verbose": -9, "tolfun": 1e-3})
    HERE.mkdir(exist_ok=True)
    with open(HERE / f"seed-{seed}.csv", "w", encoding="utf-8") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["generation", "evaluations", "best", "mean", "sigma", "seconds"])
        while not search.stop() and time.monotonic() - began < seconds:
            asked = search.ask()
            found = slower(asked, search.countiter + 1, backend)
            search.tell(asked, [-one for one in found])
            rows.writerow([search.countiter, 2 * search.countevals, *(f"{one:.4f}" for one in (max(found), statistics.mean(found), search.sigma)), round(time.monotonic() - began)])
            file.flush()
            mean = search.result.xfavorite
            (HERE / f"seed-{seed}-best.json").write_text(json.dumps({"gait": gait_of(mean), "genes": list(mean)}) + "\n", encoding="utf-8")


def best(seed):
    return json.loads((HERE / f"seed-{seed}-best.json").read_text(encoding="utf-8"))["gait"]


def requests(seeds):
    for seed in seeds:
        for n, (cell, steps, starts) in enumerate(LEVELS):
            for start in range(1, starts + 1):
                yield {"id": 1000 * seed + 100 * n + start, "scene": "lake/fry", "overrides": scene(cell, steps, 4), "gait": best(seed), "start": 1000 + start}
        for n, change in ((901, {"amplitude": [0.0] * ACTUATORS}), (902, {})):  # at rest; in a wider tank
            sides = (2.85, 1.65, 1.95) if n == 902 else SIDES
            yield {"id": 1000 * seed + n, "scene": "lake/fry", "overrides": scene(0.01875, 1, 4, sides), "gait": {**best(seed), **change}, "start": 1001}


def keep():
    for line in sys.stdin:
        one = json.loads(line)
        print(json.dumps({key: one.get(key) for key in ("id", "status", "distance", "hash", "stopped", "simulated", "swimming", "work", "course", "error")}))


if __name__ == "__main__":
    what, *more = sys.argv[1:]
    backend = "cuda" if "cuda" in more else "cpu"
    if what == "evolve":
        evolve(int(more[0]), float(more[1]), backend)
    elif what == "requests":
        for one in requests(list(map(int, more)) or SEEDS):
            print(json.dumps(one))
    elif what == "keep":
        keep()
