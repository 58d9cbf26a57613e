"""What the pages' make.py share: their command line, numbers in words, statistics, tables and charts."""
import argparse
import filecmp
import pathlib
import sys
import tempfile
from decimal import ROUND_HALF_UP, Decimal

import matplotlib
import numpy as np

matplotlib.use("Agg")
from matplotlib import pyplot, ticker  # noqa: E402  (after the choice of what draws)

ROOT = pathlib.Path(__file__).resolve().parent.parent
COLOURS = {"flex": "#d62728", "conserving": "#1f77b4"}
OTHER = "#404040"
DIFFERENT = 0.002  # share of a picture's values: libraries of other versions smooth edges otherwise


def main(make, run=None):
    """The command line of a page: make(folder) writes what is made of the page's data into a folder; run(), where there is one, simulates what
    the data lack."""
    page = pathlib.Path(sys.argv[0]).resolve().parent
    parser = argparse.ArgumentParser(prog=f"results/redo.sh {page.name}", description=sys.modules["__main__"].__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    way = parser.add_mutually_exclusive_group()
    way.add_argument("--check", action="store_true", help="write nothing; exit code 1 if the committed files are other ones")
    if run:
        way.add_argument("--run", action="store_true", help="simulate first what the data lack")
    options = parser.parse_args()
    try:
        if options.check:
            with tempfile.TemporaryDirectory() as folder:
                make(pathlib.Path(folder))
                made = sorted(pathlib.Path(folder).iterdir())
                others = [file.name for file in made if not same(file, page / file.name)]
            for name in others:
                print(f"{page.relative_to(ROOT)}/{name}: is not what make.py makes of the data; run: results/redo.sh {page.name}", file=sys.stderr)
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


def table(head, rows, aligned=None):
    """Rows of texts as a table of Markdown. aligned: a sign for each column, > to the right; by default the first to the left."""
    marks = ["---:" if sign == ">" else "---" for sign in aligned or "<" + ">" * (len(head) - 1)]
    return "".join("| " + " | ".join(row) + " |\n" for row in [head, marks, *rows])


def filled(page, **parts):
    """The text of a page with other parts, each between <!-- NAME --> and <!-- /NAME --> on lines of their own."""
    text = page.read_text(encoding="utf-8")
    for name, part in parts.items():
        begin, end = f"<!-- {name} -->\n", f"<!-- /{name} -->\n"
        if text.count(begin) != 1 or text.count(end) != 1:
            raise ValueError(f"{page}: must have the lines {begin.strip()} and {end.strip()} once")
        text = text[:text.index(begin)] + begin + part + text[text.index(end):]
    return text


class Chart:
    """A picture with one pair of axes: draw on `axes`, then save."""

    def __init__(self, title, x, y, size=(9, 6), log=False):
        self.figure, self.axes = pyplot.subplots(figsize=size, dpi=100, layout="constrained")
        self.axes.set(title=title, xlabel=x, ylabel=y, **({"xscale": "log", "yscale": "log"} if log else {}))
        self.axes.grid(linewidth=0.5, alpha=0.5, which="both" if log else "major")
        for axis in (self.axes.xaxis, self.axes.yaxis) if log else ():
            axis.set_major_formatter(lambda value, _: f"{value:g}")
            axis.set_minor_formatter(ticker.LogFormatter(minor_thresholds=(2, 0.4)))

    def save(self, file, legend="beside"):
        """legend: beside the axes, below them, or where matplotlib has it inside."""
        places = {"beside": {"loc": "outside right center"}, "below": {"loc": "outside lower center"}}
        if legend in places:
            self.figure.legend(fontsize=9, **places[legend])
        else:
            self.axes.legend(fontsize=9, loc=legend)
        self.figure.savefig(file, metadata={"Software": None})
        pyplot.close(self.figure)
