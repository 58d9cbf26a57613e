"""The page's tables and pictures, of water.csv: drag coefficients over the laws, and error against run time.

Of error against run time each point is a mean over starts, of the settings that all supports have; the first start's run time counts only where there is
no other, as the others ran side by side on one machine. Settings that no other beats in both are joined and named: support, substeps × iterations.
"""
import pathlib
import subprocess
import sys

import numpy as np
import pandas
import study

HERE = pathlib.Path(__file__).parent
BODIES = {"towed-sphere": "#1668b0", "towed-cylinder": "#b04a16"}
SUPPORTS = {2.0: "#1668b0", 2.5: "#b04a16", 3.0: "#2a8a3a"}


def drag(table, file):
    chart = study.Chart("", "Reynolds number", "drag coefficient", size=(5.8, 3.8), log=True)
    law = np.geomspace(5, 200, 76)
    chart.axes.plot(law, 24 / law * (1 + 0.15 * law**0.687), color=BODIES["towed-sphere"], label="sphere, Schiller and Naumann")
    chart.axes.plot([20, 40], [2.045, 1.522], color=BODIES["towed-cylinder"], label="cylinder, Dennis and Chang")
    measured = table[(table.support == 2.5) & table.quantity.str.contains("drag coefficient at Re ")]
    for body, own in measured.groupby("case", sort=False):
        if body in BODIES:
            reynolds = own.quantity.str.split("at Re ").str[1].astype(float)
            chart.axes.plot(reynolds, own.value, "o", color=BODIES[body], ms=4)
            chart.axes.plot(reynolds, own.reference.astype(float), "_", color=BODIES[body], ms=12, mew=2)
    chart.save(file, legend="upper right")


def pareto(table, file, case="vortex", quantity="numerical Reynolds number", resolution=20, backend="cpu"):
    own = table[(table.case == case) & (table.quantity == quantity) & (table.resolution == resolution) & (table.backend == backend)]
    own = own.assign(error=1 / own.value, setting=own.substeps.astype(str) + "×" + own.iterations.astype(str)
                     + np.where(own.modified_pressure == "yes", " m", ""))
    points = []
    for (setting, support), starts in own.groupby(["setting", "support"]):
        if set(SUPPORTS) <= set(own[own.setting == setting].support):
            others = starts[starts.start != 1]
            points.append(((others if len(others) else starts).run_time.mean(), starts.error.mean(), f"{support:g}, {setting}", support))
    points.sort()
    front = [point for k, point in enumerate(points) if all(point[1] < other[1] for other in points[:k])]
    chart = study.Chart(f"error of: {case}, {quantity}", "run time (s)", "error", size=(6, 4), log=True)
    chart.axes.plot([point[0] for point in front], [point[1] for point in front], color="#bbb")
    for support, colour in SUPPORTS.items():
        dots = [point for point in points if point[3] == support]
        chart.axes.plot([point[0] for point in dots], [point[1] for point in dots], "o", color=colour, ms=4, label=f"support {support:g}")
    for k, (seconds, error, name, _) in enumerate(front):
        chart.axes.annotate(name, (seconds, error), (5, -13 if k % 2 else 5), textcoords="offset points", fontsize=8)
    chart.save(file, legend="upper right")


def make(folder):
    table = pandas.read_csv(HERE / "water.csv", low_memory=False)
    table = table[(table.scheme == "conserving") & (table.status == "ok")]
    drag(table, folder / "drag.png")
    pareto(table, folder / "pareto.png")
    if folder == HERE:
        subprocess.run([sys.executable, HERE / "table.py", "--write"], check=True, stdout=subprocess.DEVNULL)


study.main(make)
