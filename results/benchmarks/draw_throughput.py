"""Writes an SVG of throughput over the size of a scene, a line for each size of a batch, from throughput.csv to the standard output.

usage: draw_throughput.py [SCHEME [PRECISION [DEVICE]]]; default: conserving float and the first device that throughput.csv has of
them. Both axes are logarithmic. Rings are scenes that have blocks of threads of their own, discs those of the whole GPU. Needs Python alone.
"""
import csv
import math
import pathlib
import sys

scheme, precision, device = [*sys.argv[1:4], *("conserving", "float", "")[len(sys.argv[1:4]):]]
left, top, width, height = 80, 24, 480, 300
colours = ["#1668b0", "#b04a16", "#2a8a3a", "#7a3aa0", "#a08a16", "#555"]
quantity = "million_particle_iterations_per_second"


def read():
    """Points (particles, throughput, path) by batch."""
    lines = {}
    with open(pathlib.Path(__file__).parent / "throughput.csv", newline="") as table:
        rows = [row for row in csv.DictReader(table) if (row["scheme"], row["precision"]) == (scheme, precision)]
    wanted = device or (rows[0]["device"] if rows else "")
    for row in rows:
        if row["device"] == wanted:
            lines.setdefault(int(row["evaluations"]), []).append(
                (int(row["fluid_particles"]), float(row[quantity]), row["path"]))
    return wanted, {batch: sorted(points) for batch, points in sorted(lines.items())}


def limits(values):
    return min(values) / 1.3, max(values) * 1.3


def decades(low, high):
    """1, 2 and 5 times the powers of ten between two values, or the powers alone where these are many."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    steps = (1,) if last - first > 3 else (1, 2, 5)
    return [step * 10.0**power for power in range(first, last + 1) for step in steps if low <= step * 10.0**power <= high]


device, lines = read()
points = [point for line in lines.values() for point in line]
if not points:
    sys.exit(f"draw_throughput.py: throughput.csv has no rows of {scheme} in {precision}" + (f" on {device}" if device else ""))
sizes, rates = limits([p[0] for p in points]), limits([p[1] for p in points])


def place(size, rate):
    x = math.log(size / sizes[0]) / math.log(sizes[1] / sizes[0])
    y = math.log(rate / rates[0]) / math.log(rates[1] / rates[0])
    return left + x * width, top + (1 - y) * height


def text(x, y, words, more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" {more}>{words}</text>'


parts = [f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#888"/>',
         text(left + width / 2, top + height + 36, "fluid particles of a scene", 'text-anchor="middle"'),
         text(left, top - 8, f"million particle-iterations per second: {scheme}, {precision}, {device}")]
for size in decades(*sizes):
    x = place(size, rates[0])[0]
    parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{top}" y2="{top + height}" stroke="#eee"/>')
    parts.append(text(x, top + height + 16, f"{size:,.0f}".replace(",", "\u2009"), 'text-anchor="middle"'))
for rate in decades(*rates):
    y = place(sizes[0], rate)[1]
    parts.append(f'<line x1="{left}" x2="{left + width}" y1="{y:.1f}" y2="{y:.1f}" stroke="#eee"/>')
    parts.append(text(left - 6, y + 4, f"{rate:g}", 'text-anchor="end"'))
for k, (batch, line) in enumerate(lines.items()):
    colour = colours[k % len(colours)]
    places = [(*place(size, rate), path) for size, rate, path in line]
    parts.append('<polyline points="{}" fill="none" stroke="{}"/>'.format(
        " ".join(f"{x:.1f},{y:.1f}" for x, y, _ in places), colour))
    for x, y, path in places:
        inside = "white" if path == "block" else colour
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5" fill="{inside}" stroke="{colour}"/>')
    y = top + 18 + 16 * k
    parts.append(f'<circle cx="{left + width + 16}" cy="{y}" r="4" fill="{colour}"/>')
    parts.append(text(left + width + 26, y + 4, f"{batch} at a time"))
print(f'<svg xmlns="http://www.w3.org/2000/svg" width="{left + width + 120}" height="{top + height + 50}" '
      'font-family="sans-serif" font-size="12"><rect width="100%" height="100%" fill="white"/>' + "\n".join(parts) + "</svg>")
