"""Makes the answer and the table of peers, draws the rooflines, how near the solver's stages come to what the processor can do, and throughput over the size of a scene.

Rooflines: operations per second over operations per byte, under the measured roofs (Williams, Waterman, Patterson: Roofline, 2009). Throughput: a line for
each size of a batch; rings are scenes that have blocks of threads of their own, discs those of the whole GPU, with lists.
"""
import pathlib

import numpy as np
import pandas
import study

HERE = pathlib.Path(__file__).parent
INTENSITY = np.geomspace(0.1, 10, 200)
MARKERS = "oDs^x"
COLOURS = ["#1668b0", "#b04a16", "#2a8a3a", "#7a3aa0", "#a08a16", "#555"]


def throughput(table, scheme, file):
    rows = table[(table.scheme == scheme) & (table.precision == "float") & ~table.path.str.contains("without lists")]
    rows = rows[rows.device == rows.device.iloc[0]].sort_values("fluid_particles")
    chart = study.Chart(f"million particle-iterations per second: {scheme}, float, {rows.device.iloc[0]}", "fluid particles of a scene", "", log=True)
    for colour, (batch, own) in zip(COLOURS, rows.groupby("evaluations"), strict=False):
        rate = own.million_particle_iterations_per_second
        chart.axes.plot(own.fluid_particles, rate, color=colour, label=f"{batch} at a time")
        chart.axes.scatter(own.fluid_particles, rate, s=25, color=colour, facecolors=["white" if path == "block" else colour for path in own.path], zorder=2)
    chart.save(file)


def peers():
    """Means over the rounds, and how many times the seconds of the same round's first program, both ± standard error."""
    rounds = pandas.read_csv(HERE / "peers.csv").pivot(index="round", columns="program", values="seconds")
    names = list(dict.fromkeys(pandas.read_csv(HERE / "peers.csv").program))
    errors = pandas.read_csv(HERE / "peers.csv").groupby("program").density_error.mean()
    def known(values, digits):
        return study.with_error(values.mean(), values.sem(), digits)
    flex, conserving, finer, taichi, dfsph, _ = names
    answer = (f"**For the thesis' tank a plain position based fluid in Taichi takes {known(rounds[taichi] / rounds[flex], 1)} times the time of `flex`, SPlisHSPlasH's DFSPH "
              f"{known(rounds[dfsph] / rounds[conserving], 1)} times that of `conserving` 2 × 4, "
              f"{known(rounds[dfsph] / rounds[finer], 1)} times that of 4 × 4, on one core (± standard errors of four rounds).**\n")
    return answer, study.table(["program", "seconds", "times that of `flex`", "density error, mean"], [
        [name, known(rounds[name], 2 if name == flex else 1), known(rounds[name] / rounds[flex], 1) if name != flex else "", f"{100 * errors[name]:.2g} %"]
        for name in names])


def make(folder):
    answer, table = peers()
    lattice = pandas.read_csv(HERE / "lattice.csv").pivot(index="cells", columns="swims", values="updates_per_s")
    lattice.insert(0, "a core", pandas.read_csv(HERE / "lattice-core.csv").set_index("cells").updates_per_s)
    cells = study.table(["cells", "one swim, a core", *("one swim" if swims == 1 else f"{swims} swims" for swims in lattice.columns[1:])],
                        [[f"{number:,}".replace(",", " "), *("" if np.isnan(rate) else f"{rate / 1e9:.3g}" for rate in rates)] for number, *rates in lattice.itertuples()])
    (folder / "README.md").write_text(study.filled(HERE / "README.md", answer=answer, peers=table, lattice=cells), encoding="utf-8")
    table = pandas.read_csv(HERE / "throughput.csv")
    for scheme in ("flex", "conserving"):
        throughput(table, scheme, folder / f"throughput-{scheme}.png")
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
