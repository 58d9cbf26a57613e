"""Draws the rooflines: how near the solver's stages come to what the processor can do, a picture for each instruction set.

Operations per second over operations per byte, under the measured roofs (Williams, Waterman, Patterson: Roofline, 2009).
"""
import pathlib

import numpy as np
import pandas
import study

HERE = pathlib.Path(__file__).parent
INTENSITY = np.geomspace(0.1, 10, 200)
MARKERS = "oDs^x"


def make(folder):
    for instructions, rows in pandas.read_csv(HERE / "roofline.csv").groupby("instruction_set", sort=False):
        chart = study.Chart(f"Roofline, one thread, {instructions}", "operations per byte", "10⁹ operations per second", log=True)
        kinds = dict(list(rows.groupby("kind", sort=False)))
        peak = kinds["compute"].gflops.iloc[0]
        for shade, roof in enumerate(kinds["bandwidth"].itertuples()):
            chart.axes.plot(INTENSITY, np.minimum(peak, INTENSITY * roof.gbytes_per_second), color=str(0.2 + 0.15 * shade), label=roof.name)
        for k, stage in enumerate(kinds["stage"].itertuples()):
            chart.axes.plot(stage.intensity, stage.gflops, MARKERS[k % len(MARKERS)], color=study.COLOURS[stage.scheme],
                            label=f"{stage.scheme}: {stage.name}")
        chart.axes.set_ylim(bottom=1)
        chart.save(folder / f"roofline-{instructions}.png")


study.main(make)
