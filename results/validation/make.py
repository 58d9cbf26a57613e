"""Draws the front of a collapsing column beside the experiment, and density error against run time beside other programs; makes the page's tables."""
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


def tables(folder):
    table = pandas.read_csv(HERE / "validation.csv")
    dam = table[(table.part == "dam-break") & (table.substeps == 4)].sort_values(["case", "scheme"], key=lambda column: column.map(
        {"tall": 0, "square": 1, "tall-thesis": 2, "conserving": 0, "flex": 1}))
    columns = study.table(["column", "scheme, substeps × iterations", "height at rest / a", "Z off (RMS)", "arrival off", "lag of the experiment in T",
                           "Z off after the lag"],
                          [[row.case, f"{row.scheme} {row.substeps:.0f} × {row.iterations:.0f}", *(study.fixed(value, 2) for value in (row.start_height, row.front_error)),
                            f"{100 * row.arrival_error:.1f} %", study.fixed(row.lag, 2), study.fixed(row.front_error_after_lag, 3)] for row in dam.itertuples()], "<<>>>>>")
    off = 100 * dam.arrival_error[dam.case != "tall-thesis"]
    answer = f"**The computed front of a collapsing column is ahead of the experiment's by on average {off.min():.0f} to {off.max():.0f} % in time (one run each); with the thesis' parameters it ends behind.**\n"
    tank = table[(table.part == "tank") & ((table.iterations == 4) | (table.status == "published"))]
    rest = study.table(["", "run time of 4 s", "density error mean / max", "mean of abs(ρ - 1) inside", "million particle-iterations/s"], [
        [row.scheme + (f" {row.substeps:.0f} × {row.iterations:.0f}" if row.status == "ok" else ", another machine"), f"{row.run_time:.1f} s",
         f"{100 * row.density_error_mean:.2g} / {100 * row.density_error_max:.2g} %",
         f"{100 * row.density_deviation:.2g} %" if row.density_deviation == row.density_deviation else "",
         f"{row.particle_iterations:.1f}" if row.particle_iterations == row.particle_iterations else ""] for row in tank.itertuples()])
    (folder / "README.md").write_text(study.filled(HERE / "README.md", columns=columns, answer=answer, rest=rest), encoding="utf-8")


def make(folder):
    tables(folder)
    fronts(folder)
    densities(folder, "mean")
    densities(folder, "max")


study.main(make)
