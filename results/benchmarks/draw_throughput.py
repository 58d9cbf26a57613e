"""Writes an SVG of throughput over the size of a scene, a line for each size of a batch, from throughput.csv to the standard output.

usage: draw_throughput.py [SCHEME [PRECISION [DEVICE]]]; default: conserving float and the first device that throughput.csv has of
them. Rings are scenes that have blocks of threads of their own, discs those of the whole GPU, with lists. Needs Python alone.
"""
import csv
import pathlib
import sys

here = pathlib.Path(__file__).parent
sys.path.append(str(here.parent))
from log_chart import LogChart, around, decades

scheme, precision, device = [*sys.argv[1:4], *("conserving", "float", "")[len(sys.argv[1:4]):]]
colours = ["#1668b0", "#b04a16", "#2a8a3a", "#7a3aa0", "#a08a16", "#555"]
quantity = "million_particle_iterations_per_second"


def read():
    """Points (particles, throughput, path) by batch."""
    lines = {}
    with open(here / "throughput.csv", newline="") as table:
        rows = [row for row in csv.DictReader(table)
                if (row["scheme"], row["precision"]) == (scheme, precision) and "without lists" not in row["path"]]
    wanted = device or (rows[0]["device"] if rows else "")
    for row in rows:
        if row["device"] == wanted:
            lines.setdefault(int(row["evaluations"]), []).append(
                (int(row["fluid_particles"]), float(row[quantity]), row["path"]))
    return wanted, {batch: sorted(points) for batch, points in sorted(lines.items())}


device, lines = read()
points = [point for line in lines.values() for point in line]
if not points:
    sys.exit(f"draw_throughput.py: throughput.csv has no rows of {scheme} in {precision}" + (f" on {device}" if device else ""))
chart = LogChart(around([p[0] for p in points], 1.3), around([p[1] for p in points], 1.3), top=24, right=120)
chart.name_x("fluid particles of a scene")
chart.text((chart.left, chart.top - 8), f"million particle-iterations per second: {scheme}, {precision}, {device}")
for size in decades(*chart.x):
    chart.mark_x(size, f"{size:,.0f}".replace(",", "\u2009"), grid="#eee")
for rate in decades(*chart.y):
    chart.mark_y(rate, f"{rate:g}", grid="#eee")
for k, (batch, line) in enumerate(lines.items()):
    colour = colours[k % len(colours)]
    chart.line([chart.place(size, rate) for size, rate, _ in line], f'stroke="{colour}"')
    for size, rate, path in line:
        chart.dot(chart.place(size, rate), colour, radius=3.5, inside="white" if path == "block" else colour)
    chart.key(k, colour, f"{batch} at a time")
print(chart.svg())
