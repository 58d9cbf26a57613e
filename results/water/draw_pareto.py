"""Writes an SVG of error against run time, of one figure of a case in water.csv under all settings, to the standard output.

usage: draw_pareto.py [CASE [QUANTITY [RESOLUTION [BACKEND]]]]; default: vortex "numerical Reynolds number" 20 cpu, whose error is
taken as 1 / Re. Shown are the settings that all supports have. Each point is a mean over starts; the first start's run time counts only where there is no other, as the others ran side by side
on one machine. Settings that no other beats in both are joined and named: support, substeps x iterations. Needs Python alone.
"""
import csv
import pathlib
import statistics
import sys

here = pathlib.Path(__file__).parent
sys.path.append(str(here.parent))
from log_chart import LogChart, around

case, quantity, resolution, backend = [
    *sys.argv[1:5], *("vortex", "numerical Reynolds number", "20", "cpu")[len(sys.argv[1:5]):]]
colours = {"2": "#1668b0", "2.5": "#b04a16", "3": "#2a8a3a"}
least_error = 1e-9  # that is drawn: 0 has no logarithm


def error(row):
    value, reference = float(row["value"]), row["reference"]
    if not reference:  # none: the figure should be as large as can be
        return 1 / value
    return abs(value - float(reference)) / (abs(float(reference)) or 1)


def read():
    rows = {}
    with open(here / "water.csv", newline="") as table:
        for row in csv.DictReader(table):
            key = row["case"], row["quantity"], row["resolution"], row["backend"], row["scheme"]
            if key == (case, quantity, resolution, backend, "conserving") and row["status"] == "ok":
                rows.setdefault((row["support"], f'{row["substeps"]}×{row["iterations"]}' + (" m" if row["modified_pressure"] == "yes" else "")), []).append(row)
    for (support, setting), starts in rows.items():
        if not all((other, setting) in rows for other in colours):
            continue
        timed = [row for row in starts if row["start"] != "1"] or starts
        yield (statistics.mean(float(row["run_time"]) for row in timed),
               max(statistics.mean(map(error, starts)), least_error), f"{support}, {setting}", support)


def front(points):
    best = []
    for point in sorted(points):
        if not best or point[1] < best[-1][1]:
            best.append(point)
    return best


points = list(read())
if not points:
    sys.exit(f"draw_pareto.py: water.csv has no {quantity!r} of {case} at resolution {resolution} on {backend}")
times, errors = [p[0] for p in points], [p[1] for p in points]
chart = LogChart(around(times, 1.5), around(errors, 1.5))
chart.name_x("run time (s)")
chart.text((chart.left, chart.top - 6), f"error of: {case}, {quantity}")
for seconds in min(times), max(times):
    chart.mark_x(seconds, f"{seconds:.3g}")
for off in min(errors), max(errors):
    chart.mark_y(off, f"{off:.2g}")
chart.line([chart.place(*p[:2]) for p in front(points)], 'stroke="#bbb"')
for seconds, off, name, support in points:
    chart.dot(chart.place(seconds, off), colours.get(support, "#555"))
for k, (seconds, off, name, _) in enumerate(front(points)):
    x, y = chart.place(seconds, off)
    chart.text((x + 6, y + (18 if k % 2 else -6)), name)
for k, (support, colour) in enumerate(colours.items()):
    chart.key(k, colour, f"support {support}", x=chart.left + chart.width - 110)
print(chart.svg())
