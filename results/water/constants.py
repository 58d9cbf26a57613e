#!/usr/bin/env python3
"""What each constant of scheme conserving changes: halved and doubled, beside the value it has, in small cases of natator-bench.

usage: constants.py --build FOLDER          builds the program there, from this tree, with the constants of dfsph.h read from the environment
       constants.py --run FOLDER            runs it for all that constants.csv lacks
       constants.py                         prints the table of constants.csv

Shares of rest density are moved a third of their way to 1, or as far away from it; determinants by a quarter down, or a half up, so that
ranges stay ranges. Each figure is a mean over three starts, less that of the constants as they are; bold from three standard errors on.
"""
import argparse
import csv
import math
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
HEADER = "sim-native/src/physics/dfsph.h"
TABLE = HERE / "constants.csv"
CASES = {"column": 8, "vortex": 8, "neutral-sphere": 8}  # resolution of each
STARTS = 3
FIGURES = {("column", "pressure (of the hydrostatic)"): "column: pressure", ("column", "depth (length)"): "depth",
           ("column", "speed at rest (length/s)"): "speed at rest", ("vortex", "amplitude after one turnover"): "vortex: amplitude",
           ("vortex", "numerical Reynolds number"): "Reynolds number", ("vortex", "gain of kinetic energy"): "energy gained",
           ("neutral-sphere", "error of buoyancy (of the weight)"): "sphere: buoyancy"}
DECLARED = re.compile(r"inline constexpr (double|int) ([^;(]*);")


def constants():
    """Name -> (type, value), of the header."""
    found = {}
    for kind, declared in DECLARED.findall((ROOT / HEADER).read_text(encoding="utf-8")):
        for one in declared.split(","):
            name, value = (part.strip() for part in one.split("="))
            found[name] = (kind, float(value))
    return found


def variants(name, kind, value):
    if "density" in name:
        low, high = value - (1 - value) / 3, value + (1 - value) / 3
        return [round(low, 4), round(high, 4)]
    if "determinant" in name:
        return [round(value * 0.75, 4), round(value * 1.5, 4)]
    return [max(1, value // 2) if kind == "int" else value / 2, value * 2]


def build(folder):
    files = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\0")
    for file in filter(None, files):
        if not file.startswith(("results/", "ga-java/")) and (ROOT / file).is_file():
            (folder / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / file, folder / file)
    header = folder / HEADER
    text = header.read_text(encoding="utf-8")
    text = DECLARED.sub(lambda match: " ".join(
        f'inline const {match[1]} {name.strip()} = static_cast<{match[1]}>(from_environment("{name.strip()}", {value.strip()}));'
        for name, value in (one.split("=") for one in match[2].split(","))), text)
    header.write_text(text.replace("// The numbers of the method.", """inline double from_environment(const char* name, double value) {
    const char* const text = std::getenv(name);
    return text ? std::atof(text) : value;
}

// The numbers of the method.""").replace('#include "pair.h"', '#include <cstdlib>\n#include "pair.h"'), encoding="utf-8")
    subprocess.run(["cmake", "--preset", "release"], cwd=folder, check=True)
    subprocess.run(["cmake", "--build", "--preset", "release", "--target", "natator-bench"], cwd=folder, check=True)


def rows():
    if not TABLE.exists():
        return []
    with TABLE.open(newline="") as file:
        return list(csv.DictReader(file))


def run(folder):
    known = {(row["constant"], float(row["value"] or "nan")) for row in rows() if row["constant"]}
    known_plain = any(not row["constant"] for row in rows())
    work = [] if known_plain else [("", math.nan)]
    for name, (kind, value) in constants().items():
        work += [(name, other) for other in variants(name, kind, value) if (name, other) not in known]
    fields = ["constant", "value", "case", "resolution", "start", "quantity", "figure"]
    new = not TABLE.exists()
    with TABLE.open("a", newline="") as file:
        table = csv.DictWriter(file, fields, lineterminator="\n")
        if new:
            table.writeheader()
        for name, value in work:
            environment = dict(os.environ, **({name: repr(value)} if name else {}))
            for case, resolution in CASES.items():
                command = [folder / "build/release/bin/natator-bench", "water", "--scheme", "conserving", "--case", case, "--resolution",
                           str(resolution), "--start", *map(str, range(1, STARTS + 1))]
                done = subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout
                for row in csv.DictReader(done.splitlines()):
                    figure = row["value"] if row["status"] == "ok" else row["status"]
                    table.writerow({"constant": name, "value": "" if math.isnan(value) else repr(value), "case": case,
                                    "resolution": resolution, "start": row["start"], "quantity": row["quantity"], "figure": figure})
            file.flush()
            print(name or "as it is", value, file=sys.stderr)


def figures(chosen):
    """(case, quantity) -> figures by start; a run that failed is NaN."""
    by_key = {}
    for row in chosen:
        try:
            figure = float(row["figure"])
        except ValueError:
            figure = math.nan
        by_key.setdefault((row["case"], row["quantity"]), []).append(figure)
    return by_key


def cell(figure, plain):
    if any(math.isnan(one) for one in figure):
        return "unstable"
    spread = max(statistics.stdev(plain), statistics.stdev(figure), 1e-12)
    difference = statistics.mean(figure) - statistics.mean(plain)
    text = f"{difference:+.2g}"
    return f"**{text}**" if abs(difference) > 3 * spread * math.sqrt(2 / STARTS) else text


def table():
    """Lines, of every constant."""
    all_rows = rows()
    plain = figures(row for row in all_rows if not row["constant"])
    yield "| constant | other value | " + " | ".join(FIGURES.values()) + " |"
    yield "|---|---:|" + "---:|" * len(FIGURES)
    yield "| as they are | | " + " | ".join(f"{statistics.mean(plain[key]):.3g}" for key in FIGURES) + " |"
    for name, (kind, value) in constants().items():
        for other in variants(name, kind, value):
            own = figures(row for row in all_rows if row["constant"] == name and float(row["value"]) == other)
            if own:
                yield f"| `{name}` {value:g} | {other:g} | " + " | ".join(cell(own[key], plain[key]) for key in FIGURES) + " |"


parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("--build", type=pathlib.Path)
parser.add_argument("--run", type=pathlib.Path)
if __name__ == "__main__":
    options = parser.parse_args()
    if options.build:
        build(options.build)
    if options.run:
        run(options.run)
    if not options.build and not options.run:
        print(*table(), sep="\n")
