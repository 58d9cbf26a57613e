"""Writes an SVG of the drag coefficients of water.csv, over the laws, to the standard output. Needs Python alone."""
import csv
import math
import pathlib

here = pathlib.Path(__file__).parent
left, top, width, height = 60, 20, 480, 300
reynolds = (5, 200)
drag = (0.8, 8)


def place(re, cd):
    x = math.log(re / reynolds[0]) / math.log(reynolds[1] / reynolds[0])
    y = math.log(cd / drag[0]) / math.log(drag[1] / drag[0])
    return left + x * width, top + (1 - y) * height


def line(points, style):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    return f'<polyline points="{path}" fill="none" {style}/>'


def text(x, y, words, more=""):
    return f'<text x="{x:.1f}" y="{y:.1f}" {more}>{words}</text>'


def sphere(re):
    return 24 / re * (1 + 0.15 * re**0.687)


parts = [f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="#888"/>']
for re in (5, 10, 20, 40, 50, 100, 200):
    x, y = place(re, drag[0])
    parts.append(line([(x, y), (x, top)], 'stroke="#ddd"'))
    parts.append(text(x, y + 16, re, 'text-anchor="middle"'))
for cd in (1, 2, 3, 4, 6, 8):
    x, y = place(reynolds[0], cd)
    parts.append(line([(x, y), (x + width, y)], 'stroke="#ddd"'))
    parts.append(text(x - 6, y + 4, cd, 'text-anchor="end"'))
parts.append(text(left + width / 2, top + height + 36, "Reynolds number", 'text-anchor="middle"'))
parts.append(text(18, top + height / 2, "drag coefficient",
                  f'text-anchor="middle" transform="rotate(-90 18 {top + height / 2})"'))

curve = [place(re, sphere(re)) for re in (5 * 1.05**k for k in range(76))]
parts.append(line(curve, 'stroke="#1668b0"'))
parts.append(text(*place(58, 1.72), "sphere, Schiller and Naumann", 'fill="#1668b0"'))
parts.append(line([place(20, 2.045), place(40, 1.522)], 'stroke="#b04a16"'))
parts.append(text(*place(11, 1.62), "cylinder, Dennis and Chang", 'fill="#b04a16"'))

with open(here / "water.csv", newline="") as table:
    for row in csv.DictReader(table):
        words = row["quantity"].split("drag coefficient at Re ")
        if row["scheme"] != "conserving" or row["support"] != "2.5" or row["status"] != "ok" or len(words) < 2:
            continue
        colour = {"towed-sphere": "#1668b0", "towed-cylinder": "#b04a16"}.get(row["case"])
        if colour is None:
            continue
        x, y = place(float(words[1]), float(row["value"]))
        parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{colour}"/>')
        x, y = place(float(words[1]), float(row["reference"]))
        parts.append(line([(x - 6, y), (x + 6, y)], f'stroke="{colour}" stroke-width="2"'))

svg = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{left + width + 20}" height="{top + height + 50}" '
       'font-family="sans-serif" font-size="12"><rect width="100%" height="100%" fill="white"/>'
       + "\n".join(parts) + "</svg>\n")
print(svg)
