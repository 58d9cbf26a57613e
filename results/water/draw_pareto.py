"""Writes an SVG of error against run time, of one figure of a case in water.csv under all settings, to the standard output.

usage: draw_pareto.py [CASE [QUANTITY [RESOLUTION [BACKEND]]]]; default: vortex "numerical Reynolds number" 20 cpu, whose error is
taken as 1 / Re. Settings that no other beats in both are joined and named: support, substeps x iterations. Needs Python alone.
"""
import csv
import math
import pathlib
import sys

case, quantity, resolution, backend = [
    *sys.argv[1:5], *("vortex", "numerical Reynolds number", "20", "cpu")[len(sys.argv[1:5]):]]
left, top, width, height = 80, 20, 480, 300
colours = {"2": "#1668b0", "2.5": "#b04a16", "3": "#2a8a3a"}


def error(row):
    value, reference = float(row["value"]), row["reference"]
    if not reference:  # none: the figure should be as large as can be
        return 1 / value
    return abs(value - float(reference)) / (abs(float(reference)) or 1)


def read():
    with open(pathlib.Path(__file__).parent / "water.csv", newline="") as table:
        for row in csv.DictReader(table):
            key = row["case"], row["quantity"], row["resolution"], row["backend"], row["scheme"]
            if key == (case, quantity, resolution, backend, "conserving") and row["status"] == "ok":
                name = f'{row["support"]}, {row["substeps"]}×{row["iterations"]}'
                yield float(row["run_time"]), error(row), name, row["support"]


def front(points):
    best = []
    for point in sorted(points):
        if not best or point[1] < best[-1][1]:
            best.append(point)
    return best


def limits(values):
    return min(values) / 1.5, max(values) * 1.5


points = list(read())
if not points:
    sys.exit(f"draw_pareto.py: water.csv has no {quantity!r} of {case} at resolution {resolution} on {backend}")
times, errors = limits([p[0] for p in points]), limits([max(p[1], 1e-9) for p in points])


def place(seconds, off):
    x = math.log(seconds / times[0]) / math.log(times[1] / times[0])
    y = math.log(max(off, 1e-9) / errors[0]) / math.log(errors[1] / errors[0])
    return left + x * width, top + (1 - y) * height


def text(x, y, words, more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" {more}>{words}</text>'


parts = [f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#888"/>',
         text(left + width / 2, top + height + 36, "run time (s)", 'text-anchor="middle"'),
         text(left, top - 6, f"error of: {case}, {quantity}")]
for seconds in times[0] * 1.5, times[1] / 1.5:
    parts.append(text(place(seconds, errors[0])[0], top + height + 16, f"{seconds:.3g}", 'text-anchor="middle"'))
for off in errors[0] * 1.5, errors[1] / 1.5:
    parts.append(text(left - 6, place(times[0], off)[1] + 4, f"{off:.2g}", 'text-anchor="end"'))
path = " ".join("{:.1f},{:.1f}".format(*place(*p[:2])) for p in front(points))
parts.append(f'<polyline points="{path}" fill="none" stroke="#bbb"/>')
for seconds, off, name, support in points:
    x, y = place(seconds, off)
    parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{colours.get(support, "#555")}"/>')
for seconds, off, name, _ in front(points):
    x, y = place(seconds, off)
    parts.append(text(x + 6, y - 6, name))
for k, (support, colour) in enumerate(colours.items()):
    parts.append(f'<circle cx="{left + width - 110}" cy="{top + 18 + 16 * k}" r="4" fill="{colour}"/>')
    parts.append(text(left + width - 100, top + 22 + 16 * k, f"support {support}"))
print(f'<svg xmlns="http://www.w3.org/2000/svg" width="{left + width + 40}" height="{top + height + 50}" '
      'font-family="sans-serif" font-size="12"><rect width="100%" height="100%" fill="white"/>' + "\n".join(parts) + "</svg>")
