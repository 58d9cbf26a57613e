"""What the pages' make.py share: their command line, numbers in words, statistics, tables and charts."""
import argparse
import csv
import filecmp
import functools
import itertools
import math
import pathlib
import statistics
import sys
import tempfile
from decimal import ROUND_HALF_UP, Decimal

import matplotlib
import numpy as np
from scipy import stats

matplotlib.use("Agg")
from matplotlib import pyplot, ticker  # noqa: E402  (after the choice of what draws)

ROOT = pathlib.Path(__file__).resolve().parent.parent
COLOURS = {"flex": "#d62728", "conserving": "#1f77b4"}
OTHER = "#404040"
DIFFERENT = 0.002  # share of a picture's values: libraries of other versions smooth edges otherwise


def main(make, run=None, any_folder=False):
    """The command line of a page: make(folder) writes what is made of the page's data into a folder; run(), where there is one, simulates what
    the data lack. With any_folder these are make(folder, data) and run(data), of the data of any folder."""
    page = pathlib.Path(sys.argv[0]).resolve().parent
    parser = argparse.ArgumentParser(prog=f"results/redo.sh {page.name}", description=sys.modules["__main__"].__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    way = parser.add_mutually_exclusive_group()
    way.add_argument("--check", action="store_true", help="write nothing; exit code 1 if the committed files are other ones")
    if run:
        way.add_argument("--run", action="store_true", help="simulate first what the data lack")
    if any_folder:
        parser.add_argument("folder", nargs="?", type=pathlib.Path, default=page, help="of another study's data; default: the page's own")
        page = parser.parse_args().folder.resolve()
        make, run = functools.partial(make, data=page), functools.partial(run, page)
    options = parser.parse_args()
    try:
        if options.check:
            with tempfile.TemporaryDirectory() as folder:
                make(pathlib.Path(folder))
                made = sorted(pathlib.Path(folder).iterdir())
                others = [file.name for file in made if not same(file, page / file.name)]
            for name in others:
                print(f"{page / name}: is not what make.py makes of the data; run: results/redo.sh {page.name}", file=sys.stderr)
            print(f"{page.name}: {len(made)} files made again, {len(others)} differ")
            sys.exit(bool(others))
        if run and options.run:
            run()
        make(page)
    except (OSError, ValueError, KeyError) as error:
        parser.exit(1, f"{parser.prog}: {type(error).__name__}: {error}\n")


def same(made, committed):
    """Whether two files hold the same: texts byte by byte, pictures but for their edges."""
    if not committed.exists():
        return False
    if made.suffix != ".png":
        return filecmp.cmp(made, committed, shallow=False)
    one, other = pyplot.imread(made), pyplot.imread(committed)
    return one.shape == other.shape and np.mean(np.abs(one - other) > 0.1) <= DIFFERENT


def fixed(value, decimals):
    """A number with so many decimals, halves away from 0; what rounds to nothing has no sign."""
    text = f"{Decimal(repr(float(value))).quantize(Decimal(1).scaleb(-decimals), ROUND_HALF_UP):f}"
    return text if float(text) else text.lstrip("-")


def with_error(value, error, decimals):
    """A number ± its error, with up to two more decimals where the error would round to nothing."""
    shown = next((d for d in range(decimals, decimals + 3) if abs(error) >= 0.5 * 10**-d), decimals)
    return f"{fixed(value, shown)} ± {fixed(error, shown)}"


def water_viscosity(given, resolution=20):
    """Of water of scheme conserving at 4 × 4 and a spacing of 2 / resolution, length²/s: the one that was set, as it comes out, and the water's own;
    by the vortices of results/water, of Re U L / ν with U L = 1 and a set viscosity of 0.02."""
    with open(ROOT / "results/water/water.csv", encoding="utf-8", newline="") as lines:
        rows = [row for row in csv.DictReader(lines) if (row["scheme"], row["resolution"], row["substeps"], row["iterations"], row["support"],
                                                         row["modified_pressure"]) == ("conserving", str(resolution), "4", "4", "2.5", "no")]
    own, total = (statistics.fmean(float(row["value"]) for row in rows if (row["case"], row["quantity"]) == key)
                  for key in (("vortex", "numerical Reynolds number"), ("viscous-vortex", "viscosity (length^2/s)")))
    return given * (total - 1 / own) / 0.02 + 1 / own


def larva(reynolds):
    """Strouhal number of a fish larva: a power of Re through 2.5 at 60 and 0.72 at 1400 (van Leeuwen, Voesenek, Müller 2015)."""
    return 2.5 * (reynolds / 60) ** (math.log(0.72 / 2.5) / math.log(1400 / 60))


class Random:
    """The numbers of java.util.Random with the same seed, by which earlier versions drew."""

    def __init__(self, seed):
        self.state = (seed ^ 0x5DEECE66D) & (2**48 - 1)

    def next(self, count):
        """So many of its states, 48 bits each."""
        factor, summand, states = 0x5DEECE66D, 11, np.array([self.state], np.uint64)
        while len(states) <= count:  # the second half by the step over the first
            states = np.concatenate([states, states * np.uint64(factor) + np.uint64(summand)])
            factor, summand = factor * factor % 2**48, summand * (factor + 1) % 2**48
        states &= np.uint64(2**48 - 1)
        self.state = int(states[count])
        return states[1:count + 1]

    def double(self):
        """One from 0 to below 1."""
        high, low = self.next(2)
        return float((int(high) >> 22 << 27) + (int(low) >> 21)) * 2.0**-53

    def ints(self, count, bound):
        """So many from 0 to below a bound."""
        states = self.next(count)
        return ((states >> np.uint64(16)) & np.uint64(bound - 1) if bound & (bound - 1) == 0 else (states >> np.uint64(17)) % np.uint64(bound)).astype(int)


def half_interval(error, count):
    """Half the 95 % interval by Student's t of a mean of so many values, of its standard error."""
    return stats.t.ppf(0.975, count - 1) * error


def interval(values):
    """A mean and half its 95 % interval by Student's t; NaN of a single value."""
    half = half_interval(statistics.stdev(values) / len(values) ** 0.5, len(values)) if len(values) > 1 else math.nan
    return statistics.fmean(values), half


def median_interval(*samples):
    """A median, or the difference of two, with its 95 % bootstrap interval: percentiles of the medians of 10 000 samples that are drawn from the
    sorted sample with replacement (Efron 1979). NaN where a sample has a single value. Returns (median, low, high)."""
    samples = [np.sort(np.asarray(sample, float)) for sample in samples]
    sizes = [len(sample) for sample in samples]
    if min(sizes) > 1:
        if len(set(sizes)) == 1:
            draws = Random(20190101).ints(10_000 * sum(sizes), sizes[0])
        else:
            states = Random(20190101)
            draws = np.concatenate([states.ints(size, size) for _ in range(10_000) for size in sizes])
        parts = np.split(draws.reshape(10_000, -1), np.cumsum(sizes)[:-1], axis=1)
        medians = [np.median(sample[part], axis=1) for sample, part in zip(samples, parts, strict=True)]
        low, high = np.quantile(medians[0] - (medians[1] if len(medians) > 1 else 0), [0.025, 0.975], method="median_unbiased")
    else:
        low = high = math.nan
    centre = [float(np.median(sample)) for sample in samples]
    return centre[0] - sum(centre[1:]), float(low), float(high)


def interval_text(interval, decimals, factor=1):
    """0.81 [0.70, 0.93]"""
    median, low, high = (fixed(factor * value, decimals) if value == value else None for value in interval)
    return median if low is None else f"{median} [{low}, {high}]"


def pairs(samples):
    """All pairs of samples by name: a row (dict) each with the difference of medians, Mann and Whitney's p (1947), that corrected by Holm (1979)
    for all pairs, Vargha and Delaney's A (2000), Cliff's delta (1993) and a verdict in words, no more than test and interval support."""
    rows = []
    for (first, one), (second, other) in itertools.combinations([(name, sample) for name, sample in samples.items() if len(sample)], 2):
        exact = len(set(one) | set(other)) == len(one) + len(other) and max(len(one), len(other)) <= 50
        u, p = stats.mannwhitneyu(one, other, method="exact" if exact else "asymptotic")
        difference, low, high = median_interval(one, other)
        a = float(u) / (len(one) * len(other))
        rows.append({"first": first, "second": second, "difference": difference, "low": low, "high": high, "p": 1.0 if p != p else min(1.0, float(p)),
                     "a": a, "cliffs_delta": 2 * a - 1, "least": min(1, 2 / math.comb(len(one) + len(other), len(one)))})
    greatest = 0
    for rank, row in enumerate(sorted(rows, key=lambda row: row["p"])):
        row["p_holm"] = greatest = max(greatest, min(1.0, (len(rows) - rank) * row["p"]))
    for row in rows:
        why = f" (p {chance(row['p_holm'])}, A = {fixed(row['a'], 2)})"
        names = (row["first"], row["second"]) if row["difference"] > 0 else (row["second"], row["first"])
        seen = row["p_holm"] < 0.05 and (row["low"] > 0 or row["high"] < 0)
        row["verdict"] = (f"{names[0]} further than {names[1]}{why}" if seen
                          else "no difference seen" + why if len(rows) * row["least"] < 0.05 else "too few to tell")
    return rows


def chance(p):
    """With its sign of relation: = 0.03, < 0.001."""
    return "< 0.001" if p < 0.001 else "= " + fixed(p, 3 if p < 0.1 else 2)


def table(head, rows, aligned=None):
    """Rows of texts as a table of Markdown. aligned: a sign for each column, > to the right; by default the first to the left."""
    marks = ["---:" if sign == ">" else "---" for sign in aligned or "<" + ">" * (len(head) - 1)]
    lines = ["| " + " | ".join(row) + " |\n" for row in [head, *rows]]
    return "".join([lines[0], "|" + "|".join(marks) + "|\n", *lines[1:]])


def filled(page, **parts):
    """The text of a page with other parts, each between <!-- NAME --> and <!-- /NAME --> on lines of their own."""
    text = page.read_text(encoding="utf-8")
    for name, part in parts.items():
        begin, end = f"<!-- {name} -->\n", f"<!-- /{name} -->\n"
        if text.count(begin) != 1 or text.count(end) != 1:
            raise ValueError(f"{page}: must have the lines {begin.strip()} and {end.strip()} once")
        text = text[:text.index(begin)] + begin + part + text[text.index(end):]
    return text


def plain(value):
    """A number of an axis: 0.001, 10 000."""
    return f"{value:,.0f}".replace(",", "\u2009") if value >= 10 else f"{value:g}"


class MinorLabels(ticker.LogFormatter):
    """Says which minor ticks of a short logarithmic axis have labels; these are plain numbers."""

    def __call__(self, value, pos=None):
        return super().__call__(value, pos) and plain(value)


class Chart:
    """A picture with one pair of axes: draw on `axes`, then save."""

    def __init__(self, title, x, y, size=(9, 6), log=False):
        self.figure, self.axes = pyplot.subplots(figsize=size, dpi=100, layout="constrained")
        self.axes.set(title=title, xlabel=x, ylabel=y, **({"xscale": "log", "yscale": "log"} if log else {}))
        self.axes.grid(linewidth=0.5, alpha=0.5, which="both" if log else "major")
        for axis in (self.axes.xaxis, self.axes.yaxis) if log else ():
            axis.set_major_formatter(lambda value, _: plain(value))
            axis.set_minor_formatter(MinorLabels(minor_thresholds=(2, 0.4)))

    def save(self, file, legend="beside"):
        """legend: beside the axes, below them, or where matplotlib has it inside."""
        places = {"beside": {"loc": "outside right center"}, "below": {"loc": "outside lower center"}}
        if legend in places:
            self.figure.legend(fontsize=9, **places[legend])
        else:
            self.axes.legend(fontsize=9, loc=legend)
        self.figure.savefig(file, metadata={"Software": None})
        pyplot.close(self.figure)
