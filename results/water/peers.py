"""Natator's water beside that of SPlisHSPlasH's DFSPH (Bender, Koschier 2017): the same cases with the same number of
particles, on one thread each. Writes peers.csv, where rows that it holds are kept, and prints its table.

    python3 results/water/peers.py                                          # the table alone
    python3 results/water/peers.py --natator build/release/bin              # what is missing of Natator
    python3 results/water/peers.py --splishsplash ~/splish/bin/python       # and of SPlisHSPlasH
    python3 results/water/peers.py --redo natator --natator build/release/bin

The Python of --splishsplash is one with `pip install pysplishsplash`. Run times are of the measured part, without the
settling before it: wall times, of SPlisHSPlasH processor seconds (since commit 2e7b4476); run nothing beside them. "load" is how many programs were running, 1 if nothing else. Exit codes: 0 ok, 1 a program failed, 2 bad usage.
"""
import argparse
import csv
import json
import os
import pathlib
import platform
import subprocess
import sys
import tempfile

here = pathlib.Path(__file__).resolve().parent
columns = ("case", "program", "setting", "quantity", "value", "reference", "run_time", "threads", "particles", "version",
           "processor", "load")
references = {
    "amplitude after one turnover": "1",
    "numerical Reynolds number": "",
    "gain of kinetic energy": "0",
    "pressure (of the hydrostatic)": "1",
    "depth (length)": "2",
    "speed at rest (length/s)": "0",
    "density error, mean": "0",
    "density error, largest": "0",
    "density deviation in the deep": "0",
}
quantities = {
    "vortex": list(references)[:3],
    "column": list(references)[3:6],
    "tank": list(references)[6:],
}
# Schemes of Natator with their substeps and iterations in a frame of 1/60 s, SPlisHSPlasH's time steps (see splishsplash.py).
settings = {
    "natator": {"vortex": ("conserving 2x4", "flex 4x4"), "column": ("conserving 2x4",),
                "tank": ("conserving 2x4", "flex 4x4")},
    "splishsplash": {case: ("adaptive", "1/120 s") for case in quantities},
}


def processor():
    try:
        with open("/proc/cpuinfo") as lines:
            return next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.machine()


def output_of(command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        last = (done.stderr.strip().splitlines() or ["no message"])[-1]
        raise RuntimeError(f"{command[0]} ended with {done.returncode}: {last}")
    return done.stdout


def natator_run(programs, case, setting):
    scheme, steps = setting.split()
    with tempfile.TemporaryDirectory() as folder:
        output = os.path.join(folder, "out.csv")
        study = ["validation", "--part", "tank"] if case == "tank" else ["water", "--case", case, "--resolution", "20"]
        output_of([os.path.join(programs, "natator-bench"), *study, "--scheme", scheme, "--precision", "float",
                   "--setting", steps, "--output", output])
        with open(output, newline="") as table:
            rows = [row for row in csv.DictReader(table) if row["scheme"] == scheme]
    if any(row["status"] != "ok" for row in rows):
        raise RuntimeError(f"natator-bench: {case} with {setting} is unstable")
    if case == "tank":
        names = ("density_error_mean", "density_error_max", "density_deviation")
        values = {quantity: float(rows[0][name]) for quantity, name in zip(quantities[case], names)}
    else:
        values = {row["quantity"]: float(row["value"]) for row in rows}
    info = json.loads(output_of([os.path.join(programs, "natator-sim"), "info", "--json"]))
    return {"version": f'{info["version"]} {info["commit"]} {info["instructionSet"]}', "particles": rows[0]["particles"],
            "run_time": float(rows[0]["run_time"]), "values": values}


def splishsplash_run(python, case, setting):
    step = setting if setting == "adaptive" else str(1 / 120)
    return json.loads(output_of([python, str(here / "splishsplash.py"), case, step]))


def read(path):
    if not path.exists():
        return []
    with open(path, newline="") as table:
        rows = list(csv.DictReader(table))
    if rows and tuple(rows[0]) != columns:
        sys.exit(f"peers.py: {path}: expected the columns {','.join(columns)}")
    return rows


def write(path, rows):
    part = path.with_suffix(".part")
    order = {case: place for place, case in enumerate(quantities)}
    with open(part, "w", newline="") as table:
        writer = csv.DictWriter(table, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted(rows, key=lambda row: (order[row["case"]], row["program"], row["setting"])))
    os.replace(part, path)


def add_missing(path, program, run, redo, cases):
    """Runs what the table lacks of a program, or all of it; each run is kept at once, in the place of an earlier one."""
    rows = read(path)
    for case in cases:
        for setting in settings[program][case]:
            held = {row["quantity"] for row in rows if (row["case"], row["program"], row["setting"]) == (case, program, setting)}
            if held >= set(quantities[case]) and not redo:
                continue
            print(f"{program} {setting}: {case}", file=sys.stderr)
            result = run(case, setting)
            rows = [row for row in rows if (row["case"], row["program"], row["setting"]) != (case, program, setting)]
            for quantity in quantities[case]:
                rows.append({"case": case, "program": program, "setting": setting, "quantity": quantity,
                             "value": f'{result["values"][quantity]:.4g}', "reference": references[quantity],
                             "run_time": f'{result["run_time"]:.3g}', "threads": "1", "particles": str(result["particles"]),
                             "version": result["version"], "processor": processor(), "load": f"{os.getloadavg()[0]:.1f}"})
            write(path, rows)


def print_table(rows):
    for case, names in quantities.items():
        runs = {}
        for row in rows:
            if row["case"] == case:
                runs.setdefault((row["program"], row["setting"], row["particles"], row["run_time"]), {})[row["quantity"]] = row["value"]
        if not runs:
            continue
        print(f"| {case} | {' | '.join(names)} | run time (s) | particles |")
        print("|---|" + "---:|" * (len(names) + 2))
        for (program, setting, particles, run_time), values in runs.items():
            print(f"| {program} {setting} | {' | '.join(values[name] for name in names)} | {run_time} | {particles} |")
        print()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--natator", metavar="FOLDER", help="with natator-bench and natator-sim")
    parser.add_argument("--splishsplash", metavar="PYTHON", help="that has pysplishsplash")
    parser.add_argument("--redo", choices=sorted(settings), action="append", default=[],
                        help="run a program again; its rows are replaced one by one")
    parser.add_argument("--case", choices=list(quantities), action="append", help="default: all")
    parser.add_argument("--output", type=pathlib.Path, default=here / "peers.csv", help="default: peers.csv beside this script")
    options = parser.parse_args()
    options.case = options.case or list(quantities)
    runs = {"natator": (options.natator, natator_run), "splishsplash": (options.splishsplash, splishsplash_run)}
    for program in options.redo:
        if not runs[program][0]:
            parser.error(f"--redo {program} needs --{program}")
    for program, (where, run) in runs.items():
        if where:
            try:
                add_missing(options.output, program, lambda case, setting: run(where, case, setting),
                            program in options.redo, options.case)
            except (RuntimeError, OSError) as failure:
                sys.exit(f"peers.py: {failure}")
    print_table(read(options.output))


if __name__ == "__main__":
    main()
