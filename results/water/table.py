#!/usr/bin/env python3
"""The table of the page on water, of water.csv: means over fresh starts with standard errors.

usage: table.py [--write | --check]; prints the table, writes it into README.md, or ends with 1 where README.md has another one.
Needs Python alone.
"""
import csv
import math
import pathlib
import statistics
import sys

here = pathlib.Path(__file__).parent
page = here / "README.md"
begin, end = "<!-- by table.py -->\n", "<!-- to here -->\n"

AMPLITUDE, REYNOLDS = "amplitude after one turnover", "numerical Reynolds number"
KINETIC, BOTH = "gain of kinetic energy", "gain of kinetic and potential energy"
VISCOSITY, DRAG = "viscosity (length^2/s)", "drag of the walls (of the exact)"
SPEED, TORQUE = "terminal speed (length/s)", "torque (of Kirchhoff's)"
OVER_ALL, LATER = (f"added mass {when} (of the displaced)" for when in ("over 0.15 s", "after 0.05 s"))

VORTEX = [(AMPLITUDE, AMPLITUDE), (REYNOLDS, REYNOLDS), (KINETIC, KINETIC), (BOTH, BOTH)]
CHANNEL = [(VISCOSITY, "viscosity over the set one"), (DRAG, "drag of the walls over the exact one")]
RATIOS = {VISCOSITY, "period (s)"}  # shown over what they should be


def drags(*numbers):
    return [(f"drag coefficient at Re {re}", f"drag coefficient at Re {re}") for re in numbers]


# case; (quantity in water.csv, its name in the table)
CASES = [
    ("vortex", VORTEX),
    ("stirred-vortex", VORTEX),
    ("viscous-vortex", [(VISCOSITY, "viscosity over set + numerical one")]),
    ("standing-wave", [("period (s)", "period over that of linear theory"), ("decay (1/s)", "decay (1/s)")]),
    ("tilted-gravity", [("slope under 1 degree (degrees)", "slope under 1° (degrees)"),
                        ("slope afterwards (degrees)", "slope afterwards (degrees)")]),
    ("column", [("pressure (of the hydrostatic)", "pressure over the hydrostatic one"), ("depth (length)", "depth")]),
    ("couette", CHANNEL),
    ("poiseuille", CHANNEL),
    ("neutral-sphere", [("error of buoyancy (of the weight)", "error of buoyancy (of the weight)")]),
    ("added-mass", [(OVER_ALL, "of a sphere (of the displaced mass), over 0.15 s"), (LATER, "the same after 0.05 s")]),
    ("heavier-sphere", [(SPEED, "terminal speed after 6 to 8 s")]),
    ("lighter-sphere", [(SPEED, "terminal speed after 6 to 8 s")]),
    ("spinning-sphere", [(TORQUE, "torque over Kirchhoff's")]),
    ("slow-sphere", [(TORQUE, "torque over Kirchhoff's")]),
    ("towed-sphere", drags(100, 50, 20, 10)),
    ("towed-cylinder", drags(40, 20)),
    ("travelling-wave", [(f"Strouhal number at viscosity {v}", "Strouhal number") for v in ("0.003", "0.006", "0.01")]),
    ("shedding-cylinder", [*drags(100), ("Strouhal number at Re 100", "Strouhal number at Re 100")]),
]
# scheme, backend, setting; with what support does not matter to flex
COLUMNS = [("flex", "cpu", "4x4"), ("conserving", "cpu", "2x4"), ("conserving", "cuda", "2x4"), ("conserving", "cpu", "4x4"),
           ("conserving", "cuda", "4x4"), ("conserving", "cuda", "8x4")]
NAMES = ["`flex` 4 × 4", "`conserving` 2 × 4", "the same, H100", "4 × 4, H100"]


def number(value, error=0.0):
    """To where the error begins, four digits at most."""
    digits = 3 if not error else 1 - math.floor(math.log10(error)) - (1 if error / 10 ** math.floor(math.log10(error)) >= 2 else 0)
    most = 3 - math.floor(math.log10(abs(value))) if value else 3
    digits = max(0, min(digits, most, 4))
    text = f"{value:.{digits}f}"
    return (text.replace("-", "−") if float(text) else f"{0:.{digits}f}"), digits


def cell(rows, quantity):
    if not rows:
        return ""
    if any(row["status"] != "ok" for row in rows):
        return "unstable"
    references = [float(row["reference"] or 0) for row in rows]
    scales = references if quantity in RATIOS else [1] * len(rows)
    values = [float(row["value"]) / scale for row, scale in zip(rows, scales)]
    bounds = [statistics.mean(float(row[side]) / scale if row[side] else far for row, scale in zip(rows, scales))
              for side, far in (("least", -math.inf), ("greatest", math.inf))]
    mean = statistics.mean(values)
    if len(values) == 1:
        text = number(mean)[0]
        return f"*{text}*" if bounds[0] <= mean <= bounds[1] else text
    error = statistics.stdev(values) / math.sqrt(len(values))
    text, digits = number(mean, error)
    off = f"{error:.{digits}f}"
    text += f" ± {off}" if float(off) else ""
    if bounds[0] <= mean - 2 * error and mean + 2 * error <= bounds[1]:
        return f"**{text}**"
    return f"*{text}*" if bounds[0] <= mean <= bounds[1] else text


def target(row, quantity):
    reference = float(row["reference"]) if row["reference"] else None
    least, greatest = (float(row[side]) if row[side] else None for side in ("least", "greatest"))
    if greatest is None:
        return f"≥ {least:g}"
    if least is None or (reference == 0 and quantity == "decay (1/s)"):
        return f"≤ {greatest:g}"
    if reference and (quantity in RATIOS or quantity.split()[0] in ("drag", "torque", "terminal", "Strouhal", "pressure", "depth")):
        return f"within {round(100 * (greatest / reference - 1))} %"
    return f"within {greatest - reference:.2g}"


def exact(rows, quantity):
    if not rows[0]["reference"]:
        return "∞"
    if quantity in RATIOS:
        return "1"
    return f"{statistics.mean(float(row['reference']) for row in rows):.3g}"


def lines():
    with open(here / "water.csv", newline="") as table:
        rows = [row for row in csv.DictReader(table) if row["support"] in ("", "2.5")]
    yield "| case, resolution | figure | exact | target | " + " | ".join(NAMES) + " |"
    yield "| --- | --- | ---: | --- |" + " ---: |" * len(NAMES)
    for case, figures in CASES:
        of_case = [row for row in rows if row["case"] == case]
        for resolution in sorted({int(row["resolution"]) for row in of_case if row["scheme"] == "conserving"}):
            for k, (quantity, name) in enumerate(figures):
                here_rows = [row for row in of_case if row["resolution"] == str(resolution) and row["quantity"] == quantity]

                def of(scheme, backend, setting):
                    return [row for row in here_rows if (row["scheme"], row["backend"]) == (scheme, backend) and
                            f"{row['substeps']}x{row['iterations']}" == setting]

                shown = [of("flex", "cpu", "4x4"), of("conserving", "cpu", "2x4"), of("conserving", "cuda", "2x4"),
                         of("conserving", "cuda", "4x4")]
                used = [row for some in shown[1:] for row in some]
                if not used:
                    continue
                if case == "travelling-wave":
                    speed = quantity.replace("Strouhal", "Reynolds")
                    reynolds = [float(row["value"]) for row in of_case if row["resolution"] == str(resolution) and
                                row["quantity"] == speed and row["status"] == "ok"]
                    name = f"Strouhal number at Re {statistics.mean(reynolds):.0f}"
                label = f"{case.replace('-', ' ')}, {resolution}" if k == 0 else ""
                cells = [cell(some, quantity) for some in shown]
                yield "| " + " | ".join([label, name, exact(used, quantity), target(used[0], quantity), *cells]) + " |"


def main():
    if sys.argv[1:] not in ([], ["--write"], ["--check"]):
        sys.exit(f"table.py: unknown arguments {sys.argv[1:]}; expected none, --write or --check")
    table = "".join(line + "\n" for line in lines())
    if not sys.argv[1:]:
        print(table, end="")
        return
    text = page.read_text(encoding="utf-8")
    before, rest = text.split(begin)
    old, after = rest.split(end)
    if sys.argv[1] == "--write":
        page.write_text(before + begin + table + end + after, encoding="utf-8")
    elif old != table:
        sys.exit(f"table.py: {page.name} has another table than water.csv gives; expected what table.py --write writes")


main()
