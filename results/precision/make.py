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
    """Of the distances of two rows of swims, and half its 95 % interval (Student's t)."""
    error = np.hypot(*(row.standard_deviation * row.starts**-0.5 for row in (one, other)))
    return one.distance - other.distance, error * stats.t.ppf(0.975, one.starts + other.starts - 2)


def swims():
    """What the answer says, and a row for each time step of a whole swim: distance, how far that is from the finest step's, both with half the 95 % interval (Student's t), and the time."""
    rows, answers = [], []
    for (scheme, scene), own in pandas.read_csv(HERE / "swims.csv").query("precision == 'float'").groupby(["scheme", "scene"], sort=False):
        interval = study.half_interval(own.standard_deviation * own.starts**-0.5, own.starts)
        finest, differ, widest = own.index[-1], 0, 0
        for k in own.index:
            off, both = difference(own.loc[k], own.loc[finest])
            differ += abs(off) > both
            widest = max(widest, both / abs(own.distance[finest]) if k != finest else 0)
            off = "" if k == finest else study.with_error(off, both, 3)
            rows.append([f"`{scheme}`, {scene}" if k == own.index[0] else "", str(own.substeps[k]), study.with_error(own.distance[k], interval[k], 3), off, f"{own.seconds[k]:.2g}"])
        answers.append(f"in `{scheme}` {differ} of {len(own) - 1} (± {100 * widest:.0f} % at most)")
    return f"Time steps by which a whole swim goes another distance than by the smallest: {', '.join(answers)}.", study.table(["swim", "substeps", "distance in 4 s", "off the finest", "processor s"], rows)


def in_double():
    """How much further whole swims go, with half the 95 % interval (Student's t)."""
    told, rows = [], pandas.read_csv(HERE / "swims.csv")
    for scheme, own in rows.groupby("scheme", sort=False):
        double = own[own.precision == "double"].iloc[0]
        single = own[(own.precision == "float") & (own.substeps == double.substeps)].iloc[0]
        told.append(f"{study.with_error(*difference(double, single), 3)} units in `{scheme}`".replace("-", "−"))
    return f"- *In double* they go further by {', '.join(told)} (at 4, 4 and 24 substeps).\n"


def make(folder):
    table = pandas.read_csv(HERE / "precision.csv")
    (answer, falls), (of_swims, whole) = scenes(table), swims()
    (folder / "README.md").write_text(study.filled(HERE / "README.md", answer=answer.rstrip() + f" {of_swims}\n", scenes=falls, settings=settings(table), momentum=momentum(table), laws=laws(table), float=float_beside_double(table), swims=whole, double=in_double()),
                                      encoding="utf-8")
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
