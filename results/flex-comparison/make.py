"""Compares swimming speeds with those of NVIDIA Flex 1.2.0: comparison.csv, the summary of the page and its pictures, of evaluations.jsonl.

Each variant of variants.json swims from the start as stated, and from RUNS starts that differ invisibly.
"""
import hashlib
import json
import math
import os
import pathlib
import platform
import re
import subprocess

import numpy as np
import pandas
import study

HERE = pathlib.Path(__file__).parent
RUNS = 5
SHIFT = 1e-6  # of a starting coordinate, scene units: enough to part the runs in a second
TIMES = {2: "v_0_2", 4: "v_0_4"}  # s from the end of settling: column of the measurements
LOG, PAGE = HERE / "evaluations.jsonl", HERE / "README.md"


def merged(first, second):
    """The merge patch that does what the first and then the second does."""
    both = isinstance(first, dict) and isinstance(second, dict)
    return first | {key: merged(first.get(key), value) for key, value in second.items()} if both else second


def variants(file=HERE / "variants.json"):
    """The variants with their gait, their overrides and the runs of Flex that they are compared with, a table. Raises ValueError."""
    given = json.loads(file.read_text(encoding="utf-8"))
    measured = pandas.read_csv(file.parent / given["measurements"], dtype=str, keep_default_na=False)
    for one in given["variants"]:
        runs = measured[[bool(re.fullmatch(one["flexRuns"], name)) for name in measured.name]]
        if runs.empty or one["gait"] not in given["gaits"]:
            raise ValueError(f"{file}: variant {one['name']}: flexRuns and gait must name some that are there")
        yield one | {"runs": runs, "gait": given["gaits"][one["gait"]], "overrides": merged(given["commonOverrides"], one["overrides"])}


def request(variant, time, seed):
    asked = {"scene": variant["scene"], "gait": variant["gait"], "duration": time, "overrides": variant["overrides"]}
    return asked | ({"perturbation": {"amplitude": SHIFT, "seed": seed}} if seed else {})


def key(asked):
    """What a request asks for, whatever its id and the way in which numbers are written."""
    return json.dumps({name: as_numbers(value) for name, value in asked.items() if name != "id"}, sort_keys=True)


def as_numbers(value):
    if isinstance(value, dict):
        return {name: as_numbers(part) for name, part in value.items()}
    if isinstance(value, list):
        return [as_numbers(part) for part in value]
    return float(value) if isinstance(value, int) and not isinstance(value, bool) else value


def read_log():
    """The rows that were written to their end."""
    return [json.loads(line) for line in LOG.read_text(encoding="utf-8").splitlines(True) if line.endswith("\n")] if LOG.exists() else []


def run():
    """Simulates what the log lacks; drops from it what another program made, or nobody asks for."""
    from natator import Simulator
    from natator.program import simulator_path
    program = simulator_path()
    digest = hashlib.sha256(pathlib.Path(program).read_bytes()).hexdigest()
    wanted = [(variant["name"], request(variant, time, seed)) for variant in variants() for time in TIMES for seed in range(RUNS + 1)]
    asked = {key(one) for _, one in wanted}
    kept = {key(row["request"]): row for row in read_log() if row["simulator"] == digest and key(row["request"]) in asked}
    LOG.write_text("".join(json.dumps(row) + "\n" for row in kept.values()), encoding="utf-8")
    missing = [(name, one) for name, one in wanted if key(one) not in kept]
    with Simulator() as simulator, open(LOG, "a", encoding="utf-8") as log:
        step = 4 * (os.cpu_count() or 1)  # kept together
        for first in range(0, len(missing), step):
            some = missing[first:first + step]
            for (name, one), result in zip(some, simulator.evaluate_all([one for _, one in some]), strict=True):
                log.write(json.dumps({"variant": name, "simulator": digest, "request": one, "result": result}) + "\n")
            log.flush()
            print(f"{first + len(some)} of {len(missing)}", flush=True)
    version = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.strip()
    where = {"simulatorSha256": digest, "version": version, "system": platform.platform(), "processors": os.cpu_count()}
    (HERE / "environment.json").write_text(json.dumps(where, indent=2) + "\n", encoding="utf-8")


def compared():
    """A row for each variant and time that was run: speeds in scene units/s. Where Flex ran once its deviation is taken to be ours."""
    speeds = {key(row["request"]): row["result"]["distance"] / row["result"]["simulated"] for row in read_log() if row["result"]["status"] == "ok"}
    rows = []
    for variant in variants():
        for time, column in TIMES.items():
            flex = variant["runs"][column].astype(float)
            stated, *found = [speeds.get(key(request(variant, time, seed)), math.nan) for seed in range(RUNS + 1)]
            ours = pandas.Series(found).dropna()
            if ours.empty:
                continue
            difference = ours.mean() - flex.mean()
            scatter = flex.std() if len(flex) > 1 else ours.std()
            spread = math.hypot(scatter, ours.std())
            rows.append({
                "variant": variant["name"], "about": variant["about"], "medium": variant["runs"].medium.iloc[0], "flex_runs": " ".join(variant["runs"].name),
                "interval_s": float(time), "flex_n": len(flex), "flex_mean": flex.mean(), "flex_sd": flex.std(), "ours_n": len(ours),
                "ours_mean": ours.mean(), "ours_sd": ours.std(), "ours_as_stated": stated, "difference": difference, "spread": spread,
                "difference_in_spreads": difference / spread, "standard_error": math.hypot(scatter / len(flex)**0.5, ours.std() / len(ours)**0.5),
                "scene": variant["scene"]})
    return pandas.DataFrame(rows)


def csv(table):
    lines = [",".join(table.columns)]
    for row in table.itertuples(index=False):
        cells = [f'"{value}"' if name == "about" else "" if value != value else f"{value:#.5g}" if isinstance(value, float) else str(value)
                 for name, value in zip(table.columns, row, strict=True)]
        lines.append(",".join(cells))
    return "\n".join(lines) + "\n"


def summary(table):
    text = ""
    for medium in ("fluid", "vacuum"):
        for scene, own in table[table.medium == medium].groupby("scene"):
            off, stated, size = own.difference, own.ours_as_stated - own.flex_mean, np.linalg.norm(own.flex_mean)
            within = ", ".join(f"≤ {n} in {(own.difference_in_spreads.abs() <= n).sum()}" for n in (1, 2, 3))
            middle = off.abs().median()
            text += (f"- {scene} in {medium}: {len(own)} comparisons; |Δ| {within}; absolute difference of the speeds: median {middle:.4f}, "
                     f"largest {off.abs().max():.4f}; {100 * np.linalg.norm(off) / size:.1f} % of the speeds, as stated "
                     f"{100 * np.linalg.norm(stated) / size:.1f} %; the run as stated is nearer than the mean in "
                     f"{(stated.abs() < off.abs()).sum()}\n")
    return text


def answer(table):
    def near(medium):
        own = table[table.medium == medium]
        return ["{} of {}".format((own.difference_in_spreads.abs()[some] <= 1).sum(), some.sum()) for some in (own.flex_n > 1, own.flex_n == 1)]
    fluid, vacuum = near("fluid"), near("vacuum")
    return f"**In fluid {fluid[0]} speeds lie within one spread of several runs of Flex, {fluid[1]} of one run, in vacuum {vacuum[0]} and {vacuum[1]}.**\n"


def draw(table, medium, file):
    """Our speeds against those of Flex, with one standard deviation to each side; equal speeds lie on the diagonal."""
    chart = study.Chart(f"Speed in {medium}", "NVIDIA Flex 1.2.0 (units/s)", "Natator (units/s)", size=(7.6, 7.6))
    ends = np.array([table[["flex_mean", "ours_mean"]].min().min(), table[["flex_mean", "ours_mean"]].max().max()])
    chart.axes.plot(ends, ends, color="grey", linewidth=1, label="equal")
    for (time, own), colour in zip(table.groupby("interval_s"), ("#1f77b4", "#d62728"), strict=True):
        chart.axes.errorbar(own.flex_mean, own.ours_mean, xerr=own.flex_sd.fillna(0), yerr=own.ours_sd.fillna(0), fmt="o", color=colour,
                            linewidth=1, label=f"0–{time:.0f} s")
    chart.save(file, legend="upper left")


def make(folder):
    table = compared()
    own = {medium: table[table.medium == medium] for medium in ("fluid", "vacuum")}
    (folder / "comparison.csv").write_text(csv(table.drop(columns="scene")), encoding="utf-8")
    (folder / PAGE.name).write_text(study.filled(PAGE, answer=answer(table), summary=summary(table)), encoding="utf-8")
    for medium, rows in own.items():
        draw(rows, medium, folder / f"comparison-{medium}.png")


if __name__ == "__main__":
    study.main(make, run)
