#!/usr/bin/env python3
"""Recomputes the speeds of results/thesis/tables from the raw files: python3 results/thesis/recompute.py [--entries N] [--seed S]

Draws N entries (50; 0 for all) by chance from tables/speeds-*.csv, works each out anew from measurements.jsonl.gz,
convergence.jsonl, motions.jsonl and finalists.json, with nothing of what made the tables, and compares what they have. Exit status 1 if any differs.
"""
import argparse
import collections
import csv
import gzip
import json
import math
import pathlib
import random
import re
import statistics
import sys

HERE = pathlib.Path(__file__).resolve().parent
SECONDS = 4.0
# Student's t at 97.5 %, by degrees of freedom.
STUDENT = {1: 12.7062, 2: 4.30265, 3: 3.18245, 4: 2.77645, 5: 2.57058, 6: 2.44691, 7: 2.36462, 8: 2.30600, 9: 2.26216}
STOPPING = {"flex": "thesis", "open-water": "open-water"}


def lines(name):
    """Rows of a file of JSON lines and of its compressed one."""
    files = [(HERE / name, open), (HERE / f"{name}.gz", gzip.open)]
    return [json.loads(line) for path, opened in files if path.exists() for line in opened(path, "rt", encoding="utf-8")]


def canonical(value):
    """Numbers as numbers: 8 and 8.0 are the same."""
    if isinstance(value, dict):
        return tuple(sorted((key, canonical(one)) for key, one in value.items()))
    if isinstance(value, list):
        return tuple(canonical(one) for one in value)
    return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else value


class Study:
    """All rows, found by what was asked for and by start."""

    def __init__(self):
        self.rows = collections.defaultdict(dict)
        for row in lines("measurements.jsonl"):
            request = row["request"]
            self.rows[self.key(request)][request.get("start")] = row["result"]
        self.change = {self.key(row["request"]): row["answer"]["levels"] for row in lines("convergence.jsonl")}
        self.length = {}
        for row in lines("motions.jsonl"):
            self.length.setdefault(row["request"]["scene"].split("/")[1], row["bodyLength"])
        data = json.loads((HERE / "thesis.json").read_text(encoding="utf-8"))
        self.published = data["gaits"]

    @staticmethod
    def key(request):
        return canonical([request["scene"], request["gait"], request["scheme"], request.get("overrides", {})])

    def ask(self, water, creature, gait, ends, change=None):
        overrides = {"stopping": {"planeContact": ends, "noProgressAfter": 0}}
        for name, part in (change or {}).items():
            overrides[name] = {**overrides.get(name, {}), **part}
        return self.key({"scene": f"{STOPPING[water]}/creature-{creature}", "gait": gait,
                         "scheme": "flex" if water == "flex" else "conserving", "overrides": overrides})

    def results(self, key, first=1, last=1000):
        return [result for start, result in sorted(self.rows[key].items(), key=lambda one: one[0]) if first <= start <= last]

    def subjects(self, water):
        """(creature, label, gait, whether a plane ends its runs) in the order of the tables."""
        for gait in self.published:
            label = "thesis' gait" + ("" if gait["about"].startswith("as published") else ", " + gait["about"])
            yield gait["creature"], label, gait["gait"], False
        for folder in sorted((HERE / "runs").glob(f"creature-*/{water}/seed-*")):
            creature, seed = int(folder.parts[-3][-1]), folder.name[5:]
            gaits = [one["gait"] for one in json.loads((folder / "finalists.json").read_text(encoding="utf-8"))["gaits"]]
            yield creature, f"evolved, seed {seed}", max(gaits, key=lambda gait: self.sure(water, creature, gait)), True

    def sure(self, water, creature, gait):
        ways = [way(one) for one in self.results(self.ask(water, creature, gait, True), 1001, 2000)]
        return statistics.mean(ways) - statistics.stdev(ways) / math.sqrt(len(ways))


def way(result):
    return result["distance"] if result["status"] == "ok" else 0.0


def speed(result, water):
    """Open water stands for water without walls: where a run ends at one, its speed is that until then."""
    return result["distance"] / (SECONDS if water == "flex" else result["simulated"])


def shown(value, digits=2, sign=False):
    text = f"{value:+.{digits}f}" if sign else f"{value:.{digits}f}"
    return text if sign or float(text) != 0 else text.lstrip("-")


def decimals(error, digits=2):
    """How many an error bar needs: up to two more than these where it would be rounded to nothing."""
    return next((enough for enough in range(digits, digits + 3) if error >= 0.5 * 10 ** -enough), digits)


def with_error(value, error, digits=2):
    return f"{shown(value, decimals(error, digits))} ± {shown(error, decimals(error, digits))}"


def speeds(study):
    """(where, what it should be) of the tables of speeds."""
    for water in STOPPING:
        for creature, label, gait, ends in study.subjects(water):
            length = study.length[f"creature-{creature}"]
            key = study.ask(water, creature, gait, ends)
            water_speeds = [speed(one, water) for one in study.results(key) if one["status"] == "ok"]
            half = [speed(one, water) for one in study.results(study.ask(water, creature, gait, ends, {"solver": {"substeps": 8}}))
                    if one["status"] == "ok"]
            mean = statistics.mean(water_speeds)
            scatter = STUDENT[len(water_speeds) - 1] * statistics.stdev(water_speeds) / math.sqrt(len(water_speeds))
            step = statistics.mean(half) - mean
            levels = {one["level"]: one["speed"]["mean"] for one in study.change.get(key, []) if "speed" in one}
            spacing = levels["spacing/2"] - levels["base"] if "spacing/2" in levels else None
            error = max(scatter, abs(step), abs(spacing or 0))
            where = (water, str(creature), label)
            yield where + (2,), with_error(mean / length, error / length)
            yield where + (3,), f"± {shown(scatter / length, decimals(scatter / length))}"
            yield where + (4,), shown(step / length, sign=True)
            yield where + (5,), "–" if spacing is None else shown(spacing / length, sign=True)
            yield where + (6,), shown(mean / length / gait["frequency"])


def table_speeds():
    """The same as the tables have them."""
    for water in STOPPING:
        with open(HERE / "tables" / f"speeds-{water}.csv", encoding="utf-8", newline="") as lines:
            for fields in list(csv.reader(lines))[1:]:
                for column in range(2, 7):
                    yield (water, fields[0], fields[1], column), fields[column]


def count(text):
    """A whole number from 0."""
    if not re.fullmatch("[0-9]+", text):
        raise argparse.ArgumentTypeError(f"{text} is not a whole number from 0")
    return int(text)


class Options(argparse.ArgumentParser):
    """Says in one line what is wrong."""

    def error(self, message):
        self.exit(2, f"{self.prog}: {message}\n")


def main():
    options = Options(description=__doc__.splitlines()[0])
    options.add_argument("--entries", type=count, default=50)
    options.add_argument("--seed", type=int, default=None)
    asked = options.parse_args()
    printed = dict(table_speeds())
    computed = dict(speeds(Study()))
    wrong = [f"{where}: computed, but not in the tables" for where in computed.keys() - printed.keys()]
    wrong += [f"{where}: in the tables, but not in the data" for where in printed.keys() - computed.keys()]
    both = sorted(computed.keys() & printed.keys())
    drawn = both if asked.entries == 0 else random.Random(asked.seed).sample(both, min(asked.entries, len(both)))
    wrong += [f"{where}: the table has {printed[where]}, the data give {computed[where]}" for where in drawn if printed[where] != computed[where]]
    for line in wrong:
        print(line, file=sys.stderr)
    print(f"{len(drawn)} of {len(both)} entries recomputed, {len(wrong)} differ")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
