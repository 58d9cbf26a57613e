"""Draws run time against path error, a picture for each scene of precision.csv, with the Pareto front of each scheme, and makes the page's answer and tables."""
import pathlib

import numpy as np
import pandas
from scipy import optimize, stats
import study

HERE = pathlib.Path(__file__).parent
TIME, ERROR = "run_time", "path_error_0.25"
MARKERS = {"float": "o", "double": "D"}
REFERENCE = 1024  # substeps
FALLS = 5  # from 1 to 32 substeps, which order 1/2 gives
NEAR = 0.1  # what a whole swim may be off the finest
USES = (("as in the thesis", "flex", 4, 4), ("many swims", "conserving", 2, 4), ("the scenes' own", "conserving", 4, 4),
        ("checking a winner", "conserving", 8, 8), ("accurate", "conserving", 32, 16))


def front(runs):
    """The settings worth choosing, cheapest first: no other one is both as fast and as accurate."""
    by_cost = runs.sort_values([TIME, ERROR])
    return by_cost[by_cost[ERROR] < by_cost[ERROR].cummin().shift(fill_value=float("inf"))]


def order(substeps, errors):
    """Order p and error of the reference, C / REFERENCE^p, of errors C (1/n^p - 1/REFERENCE^p) by least squares of their logarithms."""
    def miss(guess):
        return np.log(np.exp(guess[0]) * np.abs(substeps**-guess[1] - REFERENCE**-guess[1]) + 1e-300) - np.log(errors)
    c, p = optimize.least_squares(miss, [np.log(errors[0]), 1.0]).x
    return p, np.exp(c) * REFERENCE**-p


def told(falls):
    return " and ".join(f"in `{scheme}` in {sum(known)} of {len(known)}" for scheme, known in falls.items())


def short(value):
    """Two digits: 0.00002"""
    return np.format_float_positional(value, precision=2, fractional=False, trim="-")


def scenes(table):
    """A row for each scene: how far errors at 0.25 s fall in float at 4 iterations, by which order, and the reference's own error."""
    rows, falls = [], {"conserving": [], "flex": []}
    for scene, of_scene in table.groupby("scene", sort=False):
        row = [scene]
        for scheme, known in falls.items():
            own = of_scene[(of_scene.scheme == scheme) & (of_scene.precision == "float") & (of_scene.iterations == 4)].sort_values("substeps")
            errors = own[ERROR].to_numpy()
            known.append(errors[0] > FALLS * errors[-1])
            p, reference = order(own.substeps.to_numpy(float), errors)
            row += [f"{short(errors[0])}, {short(errors[-1])}", f"{p:.1f}, {short(reference)}" if known[-1] else "–"]
        rows.append(row)
    head = ["scene", *(name for scheme in falls for name in (f"`{scheme}`: at 1, 32 substeps", "order, error of the reference"))]
    answer = f"**From 1 to 32 substeps the error falls to less than a fifth {told(falls)} scenes.**\n"
    return answer, study.table(head, rows)


def settings(table):
    moved = pandas.read_csv(HERE / "displacement.csv").set_index(["scheme", "seconds"]).displacement
    rows = []
    for use, scheme, substeps, iterations in USES:
        one, = table[(table.scene == "tank-creature-1") & (table.scheme == scheme) & (table.precision == "float") & (table.substeps == substeps)
                     & (table.iterations == iterations)].itertuples(index=False)
        early, late = one[table.columns.get_loc("path_error_0.1")], one[table.columns.get_loc(ERROR)]
        rows.append([use, f"{scheme} {substeps} × {iterations}", f"{one.run_time:.2g} s", *(f"{error:.3f}, {100 * error / moved[scheme, seconds]:.0f} %"
                     for error, seconds in ((early, 0.1), (late, 0.25))), f"{short(100 * one.density_error_mean)} / {short(100 * one.density_error_max)} %"])
    return study.table(["use", "scheme, substeps × iterations", "run time of 0.25 s", "path error at 0.1 s", "at 0.25 s", "density error mean / max"], rows,
                       "<<>>>>")


def momentum(table):
    """Of the one scene without walls whose momentum is measured."""
    own = table[table.linear_momentum_error.notna()]
    return "".join(f"- `{scheme}`, {precision}: linear {rows.linear_momentum_error.max():.1g}, angular {rows.angular_momentum_error.max():.1g}\n"
                   for (scheme, precision), rows in own.groupby(["scheme", "precision"], sort=False))


def laws(table):
    """What the scenes' own steps leave of each law, in float."""
    own = table[(table.precision == "float") & (table.substeps == 4) & (table.iterations == 4)]
    return study.table(["scene", "scheme", "energy", "density, mean / largest", "springs", "clusters"], [
        [row.scene, f"`{row.scheme}`", f"{100 * row.energy_change:+.0f} %".replace("-", "−"),
         f"{short(100 * row.density_error_mean)} / {short(100 * row.density_error_max)} %" if row.density_error_max else "",
         f"{short(row.spring_residual)}" if row.spring_residual else "", f"{short(row.cluster_residual)}" if row.cluster_residual else ""]
        for row in own.itertuples()], "<<>>>>")


def float_beside_double(table):
    """How far errors in float are from those in double."""
    one, other = (table[table.precision == name].set_index(["scene", "scheme", "substeps", "iterations"]) for name in ("float", "double"))
    off = (one[ERROR] / other[ERROR] - 1).abs()[one[ERROR] > 1e-3]
    far = off.groupby(["scene", "scheme"]).max()
    return (f"- *Float* errors above 0.001 differ from double's by {off.median():.1g} of them in the median; by more than a tenth in some of "
            + ", ".join(f"{scene} ({scheme}, up to {short(most)})" for (scene, scheme), most in far[far > 0.1].items())
            + ".\n")


def difference(one, other):
    """Of the distances of two rows of swims, and half its 95 % interval (Welch's t)."""
    parts = [row.standard_deviation**2 / row.starts for row in (one, other)]
    freedom = sum(parts)**2 / sum(part**2 / (row.starts - 1) for part, row in zip(parts, (one, other), strict=True))
    return one.distance - other.distance, np.sqrt(sum(parts)) * stats.t.ppf(0.975, freedom)


def whole_swims():
    """Of each scheme its name, and rows of a setting, its distances by seconds, and how far the last is from that of the costliest setting, as parts of it, with half the 95 % interval."""
    table = pandas.read_csv(HERE / "swims.csv").query("precision == 'float'")
    for (scheme, scene), own in table.groupby(["scheme", "scene"], sort=False):
        last = own[own.seconds == own.seconds.max()].dropna()
        finest = last.loc[last.processor_seconds.idxmax()]
        yield scheme, scene, [(setting, rows, None if (one := next(rows[rows.index.isin(last.index)].itertuples(), None)) is None else
                               (one, *(part / abs(finest.distance) for part in difference(one, finest)))) for setting, rows in own.groupby(["finer", "substeps"], sort=False)], finest


def swims():
    """What the answer says, and a row for each setting of a whole swim."""
    rows, answers = [], []
    for scheme, scene, settings, finest in whole_swims():
        least = None  # the time from which on all settings are near
        for one, off, both in sorted((known for *_, known in settings if known), key=lambda known: -known[0].processor_seconds):
            if abs(off) + both > NEAR and one.Index != finest.name:
                break
            least = one.processor_seconds if one.Index != finest.name else None
        answers.append(f"in `{scheme}` " + (f"by all settings from {least:.2g} s of a core on ({finest.seconds:.0f} s swum)" if least else f"by none that was tried ({finest.seconds:.0f} s)"))
        for k, ((n, substeps), own, known) in enumerate(settings):
            distances = ", ".join(study.with_error(row.distance, study.half_interval(row.standard_deviation * row.starts**-0.5, row.starts), 3) if row.starts > 1 else "–" for row in own.itertuples())
            off = "" if known is None or known[0].Index == finest.name else f"{study.with_error(100 * known[1], 100 * known[2], 0)} %".replace("-", "−")
            seconds = ", ".join(f"{value:.0f}" for value in own.seconds)
            rows.append([f"`{scheme}`, {scene}, after {seconds} s" if k == 0 else "", "1" if n == 1 else f"1/{n}", str(substeps), distances, off, f"{own.processor_seconds.iloc[-1]:{'.0f' if own.processor_seconds.iloc[-1] >= 10 else '.2g'}}"])
    return (f"Whole swims are surely (95 %) within {100 * NEAR:.0f} % of what the finest step and spacing that were tried give {', '.join(answers)}.",
            study.table(["swim", "spacing", "substeps", "distances", "last, off the finest", "processor s"], rows, "<<>>>>"))


def draw_swims(file):
    """How far whole swims are from the finest, with half the 95 % interval, over the time of a core."""
    chart = study.Chart("whole swims: distance off that at the finest step and spacing", "seconds of a core", "part of the distance", log=True)
    for scheme, _, settings, finest in whole_swims():
        for mark, n in zip("os^", sorted({setting[0] for setting, *_ in settings}), strict=False):
            shown = [known for (finer, _), _, known in settings if known and finer == n and known[0].Index != finest.name]
            if shown:
                times, offs, both = zip(*((one.processor_seconds, abs(off), half) for one, off, half in shown), strict=True)
                chart.axes.errorbar(times, offs, both, fmt=mark, color=study.COLOURS.get(scheme, "#2a8a3a"), label=f"{scheme}, spacing {'1' if n == 1 else f'1/{n}'}", capsize=3, linewidth=1)
    chart.save(file)


def in_double():
    """How much further whole swims go, with half the 95 % interval (Welch's t)."""
    told, rows = [], pandas.read_csv(HERE / "swims.csv")
    for scheme, own in rows.groupby("scheme", sort=False):
        double = own[own.precision == "double"].iloc[0]
        single = own.query("precision == 'float' and finer == 1 and substeps == @double.substeps and seconds == @double.seconds").iloc[0]
        told.append(f"{study.with_error(*difference(double, single), 3)} units in `{scheme}`".replace("-", "−"))
    return f"- *In double* they go further by {', '.join(told)} (at 4, 4 and 24 substeps).\n"


def make(folder):
    table = pandas.read_csv(HERE / "precision.csv")
    (answer, falls), (of_swims, whole) = scenes(table), swims()
    (folder / "README.md").write_text(study.filled(HERE / "README.md", answer=answer.rstrip() + f" {of_swims}\n", scenes=falls, settings=settings(table), momentum=momentum(table), laws=laws(table), float=float_beside_double(table), swims=whole, double=in_double()),
                                      encoding="utf-8")
    draw_swims(folder / "precision-swims.png")
    # a setting that equals the reference has no error, and no place on a logarithmic axis
    table = table[(table.status == "ok") & (table[TIME] > 0) & (table[ERROR] > 0)]
    for scene, runs in table.groupby("scene", sort=False):
        chart = study.Chart(f"{scene}: run time of 0.25 s against path error", "run time (s)", "path error at 0.25 s (scene units)", log=True)
        for scheme, own in runs.groupby("scheme", sort=False):
            colour = study.COLOURS[scheme]
            for precision, points in own.groupby("precision", sort=False):
                chart.axes.plot(points[TIME], points[ERROR], MARKERS[precision], color=colour, label=f"{scheme} {precision}")
            best = front(own)
            chart.axes.plot(best[TIME], best[ERROR], color=colour, label=f"{scheme}, Pareto front")
        chart.save(folder / f"precision-{scene}.png")


study.main(make)
