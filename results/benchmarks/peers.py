#!/usr/bin/env python3
"""Natator beside other programs, by turns: results/benchmarks/peers.py PYTHON GENESIS [ROUNDS] adds rounds (3) to peers.csv.

Each computes 4 s of the thesis' tank without a swimmer, by one thread. PYTHON is one with `pip install taichi==1.7.4 pysplishsplash==2.19.0`, GENESIS one
with `pip install torch genesis-world==1.4.5`. natator-sim and natator-bench are those of build/release/bin. Rows: round, program, seconds of the processor, mean of max(ρ − 1, 0) by each program's own kernel, version.
"""
import csv
import json
import pathlib
import resource
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "water"))
import peers as water  # noqa: E402

BIN = HERE.parent.parent / "build/release/bin"


def natator(setting):
    begin, used = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
    row, since = water.natator_run(BIN, "tank", setting), resource.getrusage(resource.RUSAGE_CHILDREN)
    share = (since.ru_utime + since.ru_stime - used.ru_utime - used.ru_stime) / (time.perf_counter() - begin)  # of a core, on a busy machine
    return share * row["run_time"], row["values"]["density error, mean"], row["version"]


def taichi(python):
    row = json.loads(water.output_of([python, HERE.parent.parent / "sim-native/bench/taichi_pbf.py"]).splitlines()[-1])
    return row["seconds"], row["mean_density_error"], "1.7.4"


def splishsplash(python):
    row = water.splishsplash_run(python, "tank", "adaptive")
    return row["run_time"], row["values"]["density error, mean"], row["version"]


def genesis(python):
    row = json.loads(water.output_of([python, HERE.parent.parent / "sim-native/bench/genesis_water.py", "--solver", "dfsph"]).splitlines()[-1])
    return row["seconds"], row["mean_density_error"], row["version"]


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    _, python, world, *rounds = sys.argv
    file = HERE / "peers.csv"
    programs = {"Natator `flex` 4 × 4": lambda: natator("flex 4x4"), "Natator `conserving` 2 × 4": lambda: natator("conserving 2x4"),
                "Natator `conserving` 4 × 4": lambda: natator("conserving 4x4"), "Taichi, position based, 4 × 4": lambda: taichi(python),
                "SPlisHSPlasH, DFSPH": lambda: splishsplash(python), "Genesis, DFSPH": lambda: genesis(world)}
    done = max((int(row["round"]) for row in csv.DictReader(open(file, encoding="utf-8"))), default=0) if file.exists() else 0
    for number in range(done + 1, done + 1 + int(rounds[0] if rounds else 3)):
        rows = [[number, name, *run()] for name, run in programs.items()]
        with open(file, "a", encoding="utf-8", newline="") as output:
            csv.writer(output, lineterminator="\n").writerows(([] if file.stat().st_size else [["round", "program", "seconds", "density_error", "version"]]) + rows)


if __name__ == "__main__":
    main()
