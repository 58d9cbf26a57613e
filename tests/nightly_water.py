#!/usr/bin/env python3
"""The water's figures at resolution 20 beside those that results/water tells: what has changed by more than chance.

Runs `natator-bench water --resolution 20 --setting 2x4` in scheme conserving and compares each figure's mean over the starts with the
mean in results/water/water.csv, of the CPU in float. Allowed are 3 standard errors of the difference, by the deviation of the starts of
both about their means. One line a figure that is further off; a figure that was measured once has no deviation and is left out.

Exit codes: 0 all as told, 1 some are not, 2 bad usage or input. Needs Python alone. All cases take hours; those of held bodies
(from column on) the most.
"""
import argparse
import csv
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent
RESOLUTION, SUBSTEPS, ITERATIONS = "20", "2", "4"
FLAT = 1e-4  # of a mean: figures are written with six digits, and rounding is no change


def fail(message):
    print(f"nightly_water.py: {message}", file=sys.stderr)
    sys.exit(2)


def read(path):
    """Rows by case and quantity."""
    wanted = {"resolution": RESOLUTION, "scheme": "conserving", "precision": "float", "backend": "cpu", "substeps": SUBSTEPS,
              "iterations": ITERATIONS, "modified_pressure": "no", "support": "2.5"}
    figures = {}
    try:
        with open(path, newline="", encoding="utf-8") as table:
            for row in csv.DictReader(table):
                if all(row[key] == value for key, value in wanted.items()):
                    figures.setdefault((row["case"], row["quantity"]), []).append(row)
    except OSError as error:
        fail(f"{path}: {error.strerror}; expected a table of natator-bench water")
    except KeyError as error:
        fail(f"{path}: has no column {error}; expected a table of natator-bench water")
    return figures


def values_of(rows):
    """Over their references where these differ from start to start, as of the set and the numerical viscosity."""
    references = {row["reference"] for row in rows}
    return [float(row["value"]) / (float(row["reference"]) if len(references) > 1 else 1) for row in rows]


def compared(stored, measured):
    """None where the measured rows have the stored ones' mean, or where nobody knows; else what is wrong."""
    if bad := [row["status"] for row in measured if row["status"] != "ok"]:
        return f"is {bad[0]}; expected ok"
    before = [row for row in stored if row["status"] == "ok"]
    if len(before) < 2:
        return None
    together = values_of(before + measured)
    old, new = together[:len(before)], together[len(before):]
    squares = sum((value - statistics.mean(some)) ** 2 for some in (old, new) for value in some)
    deviation = math.sqrt(squares / (len(old) + len(new) - 2))
    error = deviation * math.sqrt(1 / len(old) + 1 / len(new))
    mean, stands = statistics.mean(new), statistics.mean(old)
    if abs(mean - stands) <= 3 * error + FLAT * abs(stands):
        return None
    return f"is {mean:.5g} in the mean of {len(new)}; expected {stands:.5g} ± {3 * error:.2g}, 3 standard errors"


def main():
    stored = read(root / "results" / "water" / "water.csv")
    cases = sorted({case for case, _ in stored})
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--case", nargs="+", choices=cases, default=cases, metavar="CASE", help="only these: " + ", ".join(cases))
    parser.add_argument("--starts", type=int, default=3, metavar="N", help="fresh starts a case (default 3)")
    parser.add_argument("--bench", type=pathlib.Path, default=root / "build" / "release" / "bin" / "natator-bench", metavar="PROGRAM",
                        help="natator-bench (default: that of the release build)")
    parser.add_argument("--output", type=pathlib.Path, metavar="FILE", help="keep the rows there; those that it holds are not run again")
    options = parser.parse_args()
    if options.starts < 1:
        fail(f"--starts = {options.starts}: expected 1 or more")
    if not options.bench.is_file():
        fail(f"{options.bench}: no such program; expected natator-bench, built by: cmake --build --preset release --target natator-bench")
    with tempfile.TemporaryDirectory() as folder:
        output = options.output or pathlib.Path(folder) / "water.csv"
        starts = [str(1001 + k) for k in range(options.starts)]  # not those of the table, whose chance would be counted twice
        command = [options.bench, "water", "--scheme", "conserving", "--resolution", RESOLUTION, "--setting", f"{SUBSTEPS}x{ITERATIONS}",
                   "--start", *starts, "--output", output, "--case", *options.case]
        done = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode:
            fail(f"natator-bench ended with {done.returncode}: {done.stderr.strip().splitlines()[-1:]}")
        measured = read(output)
    failing, untold = 0, []
    for (case, quantity), rows in sorted(stored.items()):
        if case not in options.case:
            continue
        if sum(row["status"] == "ok" for row in rows) < 2:
            untold.append(f"{case}: {quantity}")
        new = [row for row in measured.get((case, quantity), []) if row["start"] in starts]
        if problem := compared(rows, new) if new else "was not measured":
            print(f"{case}: {quantity} {problem}")
            failing += 1
    if untold:
        print(f"measured once, not compared: {'; '.join(untold)}", file=sys.stderr)
    return 1 if failing else 0


if __name__ == "__main__":
    sys.exit(main())
