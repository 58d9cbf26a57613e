"""Draws run time against path error, a picture for each scene of precision.csv, with the Pareto front of each scheme."""
import pathlib

import pandas
import study

HERE = pathlib.Path(__file__).parent
TIME, ERROR = "run_time", "path_error_0.25"
MARKERS = {"float": "o", "double": "D"}


def front(runs):
    """The settings worth choosing, cheapest first: no other one is both as fast and as accurate."""
    by_cost = runs.sort_values([TIME, ERROR])
    return by_cost[by_cost[ERROR] < by_cost[ERROR].cummin().shift(fill_value=float("inf"))]


def make(folder):
    table = pandas.read_csv(HERE / "precision.csv")
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
