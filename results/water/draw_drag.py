"""Writes an SVG of the drag coefficients of water.csv, over the laws, to the standard output. Needs Python alone."""
import csv
import pathlib
import sys

here = pathlib.Path(__file__).parent
sys.path.append(str(here.parent))
from log_chart import LogChart

colours = {"towed-sphere": "#1668b0", "towed-cylinder": "#b04a16"}


def sphere(re):
    return 24 / re * (1 + 0.15 * re**0.687)


chart = LogChart((5, 200), (0.8, 8), left=60, right=20)
for re in (5, 10, 20, 40, 50, 100, 200):
    chart.mark_x(re, re, grid="#ddd")
for cd in (1, 2, 3, 4, 6, 8):
    chart.mark_y(cd, cd, grid="#ddd")
chart.name_x("Reynolds number")
middle = chart.top + chart.height / 2
chart.text((18, middle), "drag coefficient", f'text-anchor="middle" transform="rotate(-90 18 {middle})"')

chart.line([chart.place(re, sphere(re)) for re in (5 * 1.05**k for k in range(76))], f'stroke="{colours["towed-sphere"]}"')
chart.text(chart.place(11.5, 5.2), "sphere, Schiller and Naumann", f'fill="{colours["towed-sphere"]}"')
chart.line([chart.place(20, 2.045), chart.place(40, 1.522)], f'stroke="{colours["towed-cylinder"]}"')
chart.text(chart.place(9.5, 1.35), "cylinder, Dennis and Chang", f'fill="{colours["towed-cylinder"]}"')

with open(here / "water.csv", newline="") as table:
    for row in csv.DictReader(table):
        words = row["quantity"].split("drag coefficient at Re ")
        if row["scheme"] != "conserving" or row["support"] != "2.5" or row["status"] != "ok" or len(words) < 2:
            continue
        colour = colours.get(row["case"])
        if colour is None:
            continue
        chart.dot(chart.place(float(words[1]), float(row["value"])), colour)
        x, y = chart.place(float(words[1]), float(row["reference"]))
        chart.line([(x - 6, y), (x + 6, y)], f'stroke="{colour}" stroke-width="2"')
print(chart.svg())
