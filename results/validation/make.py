"""Draws the front of a collapsing column beside the experiment, and density error against run time beside other programs."""
import pathlib

import pandas
import study

HERE = pathlib.Path(__file__).parent
SHADES = (0.43, 1, 0.7)  # of the settings of a scheme in turn
PEERS = "s^Dvx"


def fronts(folder):
    table = pandas.read_csv(HERE / "validation-fronts.csv")
    for case, rows in table.groupby("case", sort=False):
        chart = study.Chart(f"front of the collapsing column, {case}", "T = t √(n² g / a)", "Z = x / a")
        measured = rows[rows.scheme == "experiment"]
        chart.axes.plot(measured.time, measured.position, "o", color="black", label="Martin and Moyce (1952)")
        for scheme, own in rows[rows.scheme != "experiment"].groupby("scheme", sort=False):
            settings = own.groupby(["substeps", "iterations", "precision", "width"], sort=False)
            for shade, ((substeps, iterations, precision, width), line) in zip(SHADES, settings, strict=False):
                chart.axes.plot(line.time, line.position, color=study.COLOURS[scheme], alpha=shade,
                                label=f"{scheme} {substeps:.0f} × {iterations:.0f} {precision}, {width:.0f} wide")
        chart.save(folder / f"validation-front-{case}.png", legend="upper left")


def densities(folder, figure):
    table = pandas.read_csv(HERE / "validation.csv")
    tank = table[table.part == "tank"].assign(error=100 * table[f"density_error_{figure}"])
    chart = study.Chart(f"density error of the thesis' tank at rest, {figure}", "wall time of 4 s (s)", f"max(ρ - 1, 0), {figure} (%)", log=True)
    for scheme, own in tank[tank.status == "ok"].sort_values("run_time").groupby("scheme", sort=False):
        chart.axes.plot(own.run_time, own.error, "o-", color=study.COLOURS[scheme], label=scheme)
    for marker, (peer, own) in zip(PEERS, tank[tank.status == "published"].groupby("scheme", sort=False), strict=False):
        chart.axes.plot(own.run_time, own.error, marker, color=study.OTHER, label=peer)
    chart.save(folder / f"validation-density-{figure}.png")


def make(folder):
    fronts(folder)
    densities(folder, "mean")
    densities(folder, "max")


study.main(make)
