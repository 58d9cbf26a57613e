#!/usr/bin/env python3
"""Tables of the water's figures, from water.csv: means over fresh starts with standard errors.

usage: table.py [--write | --check]; prints all tables, writes those of README.md into it, or ends with 1 where README.md differs.
Needs Python alone.
"""
import csv
import math
import pathlib
import statistics
import sys

here = pathlib.Path(__file__).parent
page = here / "README.md"

VISCOSITY, DRAG, PERIOD = "viscosity (length^2/s)", "drag of the walls (of the exact)", "period (s)"
RATIOS = {VISCOSITY, PERIOD}  # shown over what they should be
SPEED, TORQUE = "terminal speed (length/s)", "torque (of Kirchhoff's)"
BUOYANCY, ADDED = "error of buoyancy (of the weight)", "added mass (of the displaced)"
STROUHAL = [f"Strouhal number at viscosity {v}" for v in ("0.003", "0.006", "0.01")]

# quantities of a case, with their names in the tables
VORTEX = {name: name for name in ("amplitude after one turnover", "numerical Reynolds number", "gain of kinetic energy",
                                  "gain of kinetic and potential energy")}
SLOPE = {"slope under 1 degree (degrees)": "slope under 1° (degrees)", "slope afterwards (degrees)": "slope afterwards (degrees)"}
COLUMN = {"pressure (of the hydrostatic)": "pressure over the hydrostatic one", "depth (length)": "depth"}
CHANNEL = {VISCOSITY: "viscosity over the set one", DRAG: "drag of the walls over the exact one"}
FALL, TURN = {SPEED: "terminal speed after 6 to 8 s"}, {TORQUE: "torque over Kirchhoff's"}


def drags(*numbers):
    return {name: name for name in (f"drag coefficient at Re {re}" for re in numbers)}


# case; its quantities; resolutions, each with the finer steps that are shown at it
CASES = [
    ("vortex", VORTEX, {20: "4x4", 40: "4x4"}),
    ("stirred-vortex", VORTEX, {20: "4x4", 40: "4x4"}),
    ("viscous-vortex", {VISCOSITY: "viscosity over set + numerical one"}, {20: "4x4", 40: "4x4"}),
    ("standing-wave", {PERIOD: "period over that of linear theory", "decay (1/s)": "decay (1/s)"}, {20: "4x4", 40: "4x4"}),
    ("tilted-gravity", SLOPE, {20: "4x4", 40: "4x4"}),
    ("still-water", {"bobbing (length/s)": "speed at which it bobs (length/s)"}, {20: "4x4", 40: "8x4", 60: "16x4", 80: "28x4"}),
    ("column", COLUMN, {20: "4x4", 40: "4x4"}),
    ("couette", CHANNEL, {20: "4x4", 40: "4x4"}),
    ("poiseuille", CHANNEL, {20: "4x4", 40: "4x4"}),
    ("neutral-sphere", {BUOYANCY: BUOYANCY}, {20: "4x4", 40: "4x4", 60: "16x4"}),
    ("added-mass", {ADDED: "of a sphere (of the displaced mass)"}, {20: "4x4", 40: "4x4", 60: "16x4", 80: "28x4"}),
    ("heavier-sphere", FALL, {20: "4x4", 40: "8x4"}),
    ("lighter-sphere", FALL, {20: "4x4", 40: "8x4"}),
    ("spinning-sphere", TURN, {20: "4x4", 40: "8x4"}),
    ("slow-sphere", TURN, {20: "4x4"}),
    ("towed-sphere", drags(100, 50, 20, 10), {20: "4x4", 32: "4x4"}),
    ("towed-cylinder", drags(40, 20), {20: "4x4", 32: "4x4"}),
    ("travelling-wave", dict.fromkeys(STROUHAL, "Strouhal number"), {16: "4x4", 20: "4x4", 28: "4x4"}),
    ("shedding-cylinder", {**drags(100), "Strouhal number at Re 100": "Strouhal number at Re 100"}, {14: "4x4", 20: "4x4", 32: "4x4"}),
    ("tall-cylinder", {**drags(100), "Strouhal number at Re 100": "Strouhal number at Re 100"}, {20: "4x4"}),
]
# why the figures of a case that miss their targets do, as the page has it below the table: by how they begin
WHY = {
    "vortex": {"gain": "noise"},
    "stirred-vortex": {"gain": "noise"},
    "viscous-vortex": {"viscosity": "correction"},
    "couette": {"": "low-pressure"},
    "poiseuille": {"viscosity": "low-pressure", "drag": "slip"},
    "added-mass": {"": "numerical-viscosity"},
    "heavier-sphere": {"": "packing"},
    "lighter-sphere": {"": "packing"},
    "slow-sphere": {"": "packing"},
    "towed-sphere": {"": "numerical-viscosity"},
    "travelling-wave": {"": "larva"},
    "shedding-cylinder": {"": "vortex-street"},
    "tall-cylinder": {"": "vortex-street"},
}
PRINTED = ("cases", "deep", "fast", "modified", "modified-deep")  # tables that README.md leaves out
# Student's t at 97.5 %, by how many starts
STUDENT = {2: 12.706, 3: 4.303, 4: 3.182, 5: 2.776, 6: 2.571, 7: 2.447, 8: 2.365}
# how a target is told: in parts of what should be
IN_PARTS = ("drag", "torque", "terminal", "Strouhal", "pressure", "depth", "viscosity", "period")


def setting(row):
    return f"{row['substeps']}x{row['iterations']}" + ("m" if row["modified_pressure"] == "yes" else "")


def in_words(steps):
    return steps.replace("x", " × ").replace("m", " m")


def read():
    with open(here / "water.csv", newline="") as table:
        return [row for row in csv.DictReader(table) if row["support"] in ("", "2.5")]


def pick(rows, **wanted):
    return [row for row in rows if all((setting(row) if key == "setting" else row[key]) == value for key, value in wanted.items())]


def text_of(value, digits):
    text = f"{value:.{digits}f}"
    return text.replace("-", "−") if float(text) else f"{0:.{digits}f}"


def digits_of(value, error):
    """As many as the error allows, and no more than four of the value's."""
    by_error = -math.floor(math.log10(error / 2)) if error else 4
    by_value = 3 - math.floor(math.log10(abs(value))) if value else 3
    return max(0, min(by_error, by_value, 4))


def cell(rows):
    """Mean and standard error; bold where its 95 % interval is within the target, in italics where the mean alone is."""
    if not rows:
        return ""
    if bad := [row["status"] for row in rows if row["status"] != "ok"]:
        return bad[0]
    scales = [float(row["reference"]) if row["quantity"] in RATIOS else 1 for row in rows]
    values = [float(row["value"]) / scale for row, scale in zip(rows, scales)]
    least, greatest = (statistics.mean(float(row[side] or far) / scale for row, scale in zip(rows, scales))
                       for side, far in (("least", -math.inf), ("greatest", math.inf)))
    mean = statistics.mean(values)
    reached = least <= mean <= greatest
    if len(values) == 1:
        text = text_of(mean, digits_of(mean, 0))
        return f"*{text}*" if reached and rows[0]["start"] else f"**{text}**" if reached else text
    error = statistics.stdev(values) / math.sqrt(len(values))
    digits = digits_of(mean, error)
    text, off = text_of(mean, digits), f"{error:.{digits}f}"
    if float(off):
        text += f" ± {off}"
    interval = STUDENT[len(values)] * error
    if least <= mean - interval and mean + interval <= greatest:
        return f"**{text}**"
    return f"*{text}*" if reached else text


def target(row):
    least, greatest = (float(row[side]) if row[side] else None for side in ("least", "greatest"))
    quantity, reference = row["quantity"], float(row["reference"] or 0)
    if greatest is None:
        return f"≥ {least:g}"
    if least is None or quantity.startswith("decay"):
        return f"≤ {greatest:g}"
    if quantity.startswith(IN_PARTS):
        return f"within {100 * (greatest / reference - 1):.0f} %"
    return f"within {greatest - reference:.2g}"


def exact(rows):
    if not rows[0]["reference"]:
        return "∞"
    if rows[0]["quantity"] in RATIOS:
        return "1"
    return f"{statistics.mean(float(row['reference']) for row in rows):.3g}"


def why(case, quantity, cells):
    """A link to the reason for which one of the cells misses the target; empty where all reach it."""
    if all(not text or "*" in text for text in cells):
        return ""
    reason = next((reason for begin, reason in WHY.get(case, {}).items() if quantity.startswith(begin)), None)
    if reason is None:
        sys.exit(f"table.py: {case} misses the target of \"{quantity}\"; expected a reason in WHY")
    return f"[{reason.replace('-', ' ')}](#{'what-it-cant-do' if reason == 'noise' else reason})"


def linked(name, reason):
    """The name with the link of a reason, where there is one."""
    return f"[{name}]{reason[reason.index('('):]}" if reason else name


def of_cases(rows):
    yield "| case, resolution | figure | exact | target | 2 × 4 | smaller steps | reason |"
    yield "|---|---|---:|---|---:|---|---|"
    for case, figures, resolutions in CASES:
        for resolution, finer in resolutions.items():
            at = pick(rows, case=case, resolution=str(resolution))
            for k, (quantity, name) in enumerate(figures.items()):
                some = pick(at, quantity=quantity)
                cpu, gpu = (pick(some, scheme="conserving", backend=backend) for backend in ("cpu", "cuda"))
                shown = [pick(cpu, setting="2x4") or pick(gpu, setting="2x4"), pick(gpu, setting=finer) or pick(cpu, setting=finer)]
                used = [row for cells in shown for row in cells]
                if case == "travelling-wave":
                    speeds = pick(at, quantity=quantity.replace("Strouhal", "Reynolds"), scheme="conserving", setting="2x4")
                    name += f" at Re {statistics.mean(float(row['value']) for row in speeds):.0f}"
                cells = [cell(each) for each in shown]
                if cells[1]:
                    cells[1] += f" ({in_words(finer)})"
                label = f"{case.replace('-', ' ')}, {resolution}" if k == 0 else ""
                cells.append(why(case, quantity, cells))
                yield f"| {label} | {name} | {exact(used)} | {target(used[0])} | " + " | ".join(cells) + " |"


def of_figures(rows):
    """Of each figure what it is at resolution 20, by 2 x 4, and at the finest resolution, by the finest steps there."""
    yield "| case, finest setting | figure | exact | target | 20: 2 × 4 | finest |"
    yield "|---|---|---:|---|---:|---:|"
    for case, figures, resolutions in CASES:
        before = None
        for quantity, name in figures.items():
            measured, finest = pick(rows, case=case, quantity=quantity, scheme="conserving"), str(max(resolutions))
            coarse = pick(measured, resolution="20", setting="2x4")
            coarse = pick(coarse, backend="cpu") or pick(coarse, backend="cuda")
            at_finest = [(steps, pick(measured, resolution=finest, setting=steps, backend="cuda")) for steps in (resolutions[max(resolutions)], "2x4")]
            steps, fine = next((steps, some) for steps, some in at_finest if some)
            labels = [exact(coarse), exact(fine)], [target(coarse[0]), target(fine[0])]
            if case == "travelling-wave":
                speeds = pick(rows, case=case, quantity=quantity.replace("Strouhal", "Reynolds"), scheme="conserving", setting="2x4")
                name += " at Re " + ", ".join(f"{statistics.mean(float(row['value']) for row in pick(speeds, resolution=at)):.0f}"
                                              for at in ("20", finest))
            cells = [cell(coarse), cell(fine)]
            label = f"{case.replace('-', ' ')}, {finest}: {in_words(steps)}"
            yield (f"| {label if label != before else ''} | {linked(name, why(case, quantity, cells))} | "
                   + " | ".join(", ".join(dict.fromkeys(both)) for both in labels) + " | " + " | ".join(cells) + " |")
            before = label


def of_answer(rows):
    """How many targets are reached at resolution 20, with certainty and by the mean, and in how many cases none is missed."""
    figures = [[part.strip() for part in line.split("|")[1:-1]] for line in list(of_figures(rows))[2:]]
    case, missed = "", set()
    for line in figures:
        case = line[0] or case
        missed |= {case} if "*" not in line[4] else set()
    (sure, some), (sure_of_finest, some_of_finest) = ([sum(line[column].startswith(sign) for line in figures) for sign in ("**", "*")] for column in (4, 5))
    yield (f"**In scheme `conserving` {sure} of {len(figures)} targets are reached for sure at resolution 20, {some - sure} more by the mean, at the finest {sure_of_finest} and {some_of_finest - sure_of_finest}; "
           f"{len(missed)} of {len(CASES)} cases miss one at 20.**")


def of_larva(rows):
    """Speeds of the larva beside those that the same viscosity, frequency and tail beat should give, from the least viscous water on."""
    told = []
    for resolution in (16, 20, 28):
        offs = []
        for name in STROUHAL:
            some = pick(rows, case="travelling-wave", resolution=str(resolution), quantity=name.replace("Strouhal", "Reynolds"), scheme="conserving", setting="2x4")
            offs.append(f"{100 * statistics.mean(float(row['value']) / float(row['reference']) - 1 for row in some):+.0f}".replace("-", "−"))
        told.append(f"{', '.join(offs)} % at {resolution}")
    yield "At the same viscosity, frequency and tail beat its speed is off by " + "; ".join(told) + "."


def of_settings(rows, settings):
    """On the CPU at resolution 20, what the first of the settings has there."""
    yield "| | exact | " + " | ".join(map(in_words, settings)) + " |"
    yield "|---|---:|" + "---:|" * len(settings)
    for case, figures, _ in CASES:
        for quantity, name in figures.items():
            shown = [pick(rows, case=case, quantity=quantity, scheme="conserving", backend="cpu", resolution="20", setting=steps)
                     for steps in settings]
            if shown[0]:
                yield f"| {case.replace('-', ' ')}: {name} | {exact(shown[0])} | " + " | ".join(cell(each) for each in shown) + " |"


def of_losses(rows, settings):
    """What some figures are with each of the settings, on the CPU at resolution 20."""
    figures = [("still-water", "bobbing (length/s)"), ("column", "depth (length)"), ("added-mass", ADDED), ("heavier-sphere", SPEED), ("lighter-sphere", SPEED)]
    known = [pick(rows, case=case, quantity=quantity, scheme="conserving", backend="cpu", resolution="20") for case, quantity in figures]
    yield "| setting | still water bobs (length/s) | depth of 2 | added mass | terminal speed of heavier, lighter sphere |"
    yield "|---|---:|---:|---:|---:|"
    yield "| target | " + " | ".join(target(some[0]) for some in known[:2]) + f" | {exact(known[2])} | {exact(known[3])} |"
    for steps in settings:
        *cells, heavier, lighter = (cell(pick(some, setting=steps)) for some in known)
        yield f"| {in_words(steps)} | " + " | ".join(cells) + f" | {heavier}, {lighter} |"


def of_depths(rows, settings, depths):
    """How fast still water bobs on the GPU, by its depth and the steps."""
    yield "| particles deep | " + " | ".join(map(in_words, settings)) + " |"
    yield "|---:|" + "---:|" * len(settings)
    for depth in depths:
        some = pick(rows, case="still-water", backend="cuda", resolution=str(depth))
        yield f"| {depth} | " + " | ".join(cell(pick(some, setting=steps)) for steps in settings) + " |"


def tables(rows):
    """By name."""
    substeps, modified = (4, 8, 12, 16, 24, 28, 32, 40, 48), ("1x2m", "1x4m", "2x2m")
    return {"answer": of_answer(rows),
            "figures": of_figures(rows),
            "larva": of_larva(rows),
            "losses": of_losses(rows, ("2x4", "1x8", "1x6", "1x4", *modified)),
            "cases": of_cases(rows),
            "deep": of_depths(rows, [f"{count}x4" for count in substeps], (40, 48, 60, 80, 100)),
            "modified-deep": of_depths(rows, modified, (28, 40, 60, 80, 100)),
            "fast": of_settings(rows, ("2x4", "1x8", "1x6", "1x4")),
            "modified": of_settings(rows, ("2x4", *modified))}


def main():
    if sys.argv[1:] not in ([], ["--write"], ["--check"]):
        sys.exit(f"table.py: unknown arguments {sys.argv[1:]}; expected none, --write or --check")
    text = page.read_text(encoding="utf-8")
    for name, lines in tables(read()).items():
        new = "".join(line + "\n" for line in lines)
        if not sys.argv[1:]:
            print(new)
            continue
        if name in PRINTED:
            continue
        begin, end = f"<!-- {name}: by table.py -->\n", f"<!-- end of {name} -->\n"
        before, rest = text.split(begin)
        old, after = rest.split(end)
        if sys.argv[1] == "--check" and old != new:
            sys.exit(f"table.py: {page.name} has another table \"{name}\" than water.csv gives; expected what table.py --write writes")
        text = before + begin + new + end + after
    if sys.argv[1:] == ["--write"]:
        page.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
