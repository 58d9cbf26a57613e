"""Writes an SVG of the maps of stability.csv in one precision (default float) to the standard output. Needs Python alone.

A cell's colour is how much of what a law allows its run has used, on a logarithmic scale from 1 % to 100 %, and the number says it in
per cent; the letter names the law of which it is most. Red: a law is broken. Of reach only what is beyond the body's length at rest
counts, a third of what is allowed.
"""
import csv
import math
import pathlib
import sys

LETTERS = {"particle_energy": "p", "energy": "e", "depth": "d", "reach": "r", "compression": "c"}
LAWS = {"particle-energy": "p", "energy": "e", "tank": "d", "shape": "r", "compression": "c", "finite": "!"}
AT_REST = 1 / 3  # of the reach that is allowed
LEAST, WIDTH, HEIGHT, LEFT, TOP = 0.01, 46, 24, 70, 50
SCHEMES = ("flex", "conserving")


def used_of(row):
    """Law: what is used of it."""
    used = {name: float(row[name]) for name in LETTERS}
    used["reach"] = max(0.0, (used["reach"] - AT_REST) / (1 - AT_REST))
    return used


def colour(used):
    """From a pale to a dark blue."""
    share = min(max(math.log(max(used, LEAST) / LEAST) / math.log(1 / LEAST), 0), 1)
    return "rgb(%d,%d,%d)" % tuple(round(a + share * (b - a)) for a, b in zip((240, 246, 252), (24, 72, 132))), share


def cell(x, y, row):
    """A run's rectangle and what stands in it."""
    if row["status"] == "ok":
        used = used_of(row)
        law = max(used, key=used.get)
        fill, share = colour(used[law])
        words, ink = f"{100 * used[law]:.0f} {LETTERS[law]}", "white" if share > 0.5 else "black"
    else:
        fill, words, ink = "#d62728", LAWS[row["law"]], "white"
    return (f'<rect x="{x}" y="{y}" width="{WIDTH}" height="{HEIGHT}" fill="{fill}" stroke="white"/>'
            f'<text x="{x + WIDTH / 2}" y="{y + HEIGHT / 2 + 4}" fill="{ink}" text-anchor="middle">{words}</text>')


def chart(left, top, title, runs):
    """One map, its lower values first."""
    axes = [sorted({float(row[column]) for row in runs}) for column in ("value", "second_value")]
    first, second = runs[0]["axis"], runs[0]["second_axis"]
    parts = [f'<text x="{left}" y="{top - 10}" font-weight="bold">{title}</text>']
    bottom = top + HEIGHT * len(axes[1])
    for row in runs:
        across, up = axes[0].index(float(row["value"])), axes[1].index(float(row["second_value"]))
        parts.append(cell(left + WIDTH * across, bottom - HEIGHT * (up + 1), row))
    for k, value in enumerate(axes[0]):
        parts.append(f'<text x="{left + WIDTH * (k + 0.5)}" y="{bottom + 14}" text-anchor="middle">{value:g}</text>')
    for k, value in enumerate(axes[1]):
        parts.append(f'<text x="{left - 5}" y="{bottom - HEIGHT * (k + 0.5) + 4}" text-anchor="end">{value:g}</text>')
    parts.append(f'<text x="{left + WIDTH * len(axes[0]) / 2}" y="{bottom + 30}" text-anchor="middle">{first}</text>')
    middle = (top + bottom) / 2
    parts.append(f'<text x="{left - 46}" y="{middle}" text-anchor="middle" transform="rotate(-90 {left - 46} {middle})">{second}</text>')
    return parts


def main():
    precision = (sys.argv[1:] + ["float"])[0]
    with open(pathlib.Path(__file__).parent / "stability.csv", newline="") as table:
        rows = [row for row in csv.DictReader(table)
                if row["second_axis"] and (row["precision"], row["backend"], row["scene"]) == (precision, "cpu", "small-tank")]
    if not rows:
        sys.exit(f"draw.py: stability.csv has no map in {precision}; must be float or double")
    maps = list(dict.fromkeys((row["axis"], row["second_axis"]) for row in rows))
    column = LEFT + 8 * WIDTH + 30
    parts, top = [], TOP
    for first, second in maps:
        tall = 0
        for k, scheme in enumerate(SCHEMES):
            runs = [row for row in rows if (row["scheme"], row["axis"], row["second_axis"]) == (scheme, first, second)]
            if not runs:
                continue
            parts += chart(LEFT + k * column, top, f"{scheme}: {first} × {second}", runs)
            tall = max(tall, len({row["second_value"] for row in runs}))
        top += HEIGHT * tall + 76
    key = "% used of: p particle's energy, e energy of all, d depth behind a wall, r reach of the body, c compression; red: broken, by ! = not finite"
    parts.append(f'<text x="{LEFT}" y="18">{key}</text>')
    print(f'<svg xmlns="http://www.w3.org/2000/svg" width="{2 * column + 20}" height="{top - 20}" font-family="sans-serif" font-size="12">'
          '<rect width="100%" height="100%" fill="white"/>' + "\n".join(parts) + "</svg>")


main()
