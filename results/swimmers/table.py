#!/usr/bin/env python3
"""Prints the tables of README.md: python3 results/swimmers/table.py [swimmers.csv]"""
import csv
import pathlib
import sys

FILE = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).with_name("swimmers.csv"))


def rows(file, picked, header):
    print(f"| {' | '.join(header)} |\n|{'|'.join('---' for _ in header)}|")
    with open(file, encoding="utf-8") as lines:
        for row in csv.DictReader(lines):
            print(f"| {' | '.join(picked(row))} |")
    print()


def short(text, digits=3):
    return f"{float(text):.{digits}g}" if text else ""


def setting(row):
    if row["scheme"] == "lattice":
        return f"lattice, Ma {row['mach']}"
    return f"{row['substeps']} × {row['iterations']}" + (f", p = {row['pressure']}" if row["pressure"] != "2.5" else "")


def within(row):
    both = [short(row[key]) for key in ("least", "greatest") if row[key]]
    return " to ".join(both) + ("" if len(both) == 2 else " or more" if row["least"] else " or less")


rows(FILE.with_name(FILE.stem + "-targets.csv"),
     lambda row: [row["case"], row["variant"], row["resolution"], setting(row), row["quantity"] + (f" as a power of {row['over']}" if row["over"] else "") +
                  (f" at {row['zero_of']} 0" if row["zero_of"] else ""), short(row["value"]) or "none", within(row), row["met"], row["confirmed"]],
     ["case", "variant", "along it", "setting", "target", "value", "met from", "met", "figure confirmed"])
rows(FILE, lambda row: [row["case"], row["variant"], row["resolution"], short(row["across"], 2), setting(row)] +
     ([f"{float(row['speed']):.3f} ± {float(row['spread']):.3f}"] + [short(row[key], 2) for key in ("lateral", "slip", "strouhal", "reynolds", "force", "power")]
      if row["status"] == "ok" else [row["status"]] + [""] * 6) + [row["particles"], short(row["run_time"])],
     ["case", "variant", "along it", "across", "setting", "speed, L/T", "to the side", "slip", "St", "Re", "force", "power", "particles or cells", "s"])
