#!/usr/bin/env python3
"""The thesis done again: results/redo.sh thesis [--run] [--check | --repeat N] [--quick] [--output-dir DIR]

Makes page, tables and pictures from the rows of DIR, results/thesis itself by default. With --run it first evolves and measures what is missing there;
killed, the same command goes on. --quick is a study so small that it takes a minute and finds nothing, in a DIR of its own.

Exit codes: 0 done, 1 something failed or differs, 2 bad usage."""
import argparse
import dataclasses
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent), str(HERE.parent.parent / "sim-native" / "python")]

import figures  # noqa: E402
import measured  # noqa: E402
from natator import motion  # noqa: E402
import page  # noqa: E402
import plan  # noqa: E402
import run  # noqa: E402


class Options(argparse.ArgumentParser):
    """Says in one line what is wrong."""

    def error(self, message):
        self.exit(2, f"{self.prog}: {message}\n")


def count(text):
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text} is not a whole number from 1")
    return int(text)


def options(arguments):
    given = Options(description=__doc__.splitlines()[0])
    given.add_argument("--run", action="store_true", help="first evolve and measure what is missing")
    given.add_argument("--check", action="store_true", help="write nothing; compare page and tables with what the rows give")
    given.add_argument("--repeat", type=count, metavar="N", help="only run N rows of processor.jsonl again and compare the bits")
    given.add_argument("--repeat-seed", type=int, default=1, help="by which chance they are drawn; default 1")
    given.add_argument("--water", choices=plan.WATERS, help="of which water; default both")
    given.add_argument("--dry-run", action="store_true", help="say what is missing, and do nothing")
    given.add_argument("--seeds", type=count, metavar="N", help="evolutions of each creature in each water; default 5")
    given.add_argument("--generations", type=count, metavar="N", help="of each evolution; one of fewer goes on; default 100")
    given.add_argument("--quick", action="store_true", help="a tiny study; needs --output-dir")
    given.add_argument("--output-dir", type=pathlib.Path, default=HERE, metavar="DIR")
    given.add_argument("--backend", choices=("cpu", "cuda"), default="cpu")
    given.add_argument("--workers", type=count, metavar="N", help="evaluations at the same time; default all processors")
    asked = given.parse_args(arguments)
    if asked.quick and asked.output_dir == HERE:
        given.error("--quick needs --output-dir; expected a folder of its own")
    readme = asked.output_dir / "README.md"
    if readme.exists() and page.MARK not in readme.read_text(encoding="utf-8"):
        given.error(f"{readme} was not made by make.py; expected another --output-dir")
    return asked


def report(study, check):
    """Writes page, tables and pictures; or names the files that would differ (pictures are not compared)."""
    found = {name: one for name, request in study.drawn().items() if (one := study.recording(name, request))}
    made = page.Page(study, {name: motion.wake(one["flow"][0]) for name, one in found.items() if one["flow"]})
    files = {study.folder / "tables" / f"{name}.csv": page.csv_text(rows) for name, rows in made.tables().items()}
    swimmer, portrayed = study.folder / "figures" / "swimmer.png", study.portrayed()
    pictures = {"portrait": f"![creature {portrayed.creature}, evolved in {page.WORDS[portrayed.water]}](figures/swimmer.png)"
                if portrayed and swimmer.exists() else "", **figures.draw(study, found, not check)}
    files[study.folder / "README.md"] = made.write(pictures)
    if check:
        differ = [file for file, text in files.items() if not file.exists() or file.read_text(encoding="utf-8") != text]
        for file in differ:
            print(f"make.py: {file} is not what the rows give; expected the output of make.py", file=sys.stderr)
        print(f"{len(files) - len(differ)} of {len(files)} files are what the rows give")
        return 1 if differ else 0
    for file, text in files.items():
        file.parent.mkdir(exist_ok=True)
        file.write_text(text, encoding="utf-8")
    print(study.folder / "README.md")
    return 0


def main(arguments=None):
    asked = options(arguments)
    try:
        extent = {name: value for name in ("seeds", "generations") if (value := getattr(asked, name))}
        return made(asked, measured.Study(asked.output_dir, dataclasses.replace(plan.QUICK if asked.quick else plan.Size(), **extent)))
    except (OSError, ValueError, KeyError, run.Failure, run.natator.ProgramError) as error:
        print(f"make.py: {type(error).__name__ + ': ' if isinstance(error, KeyError) else ''}{error}", file=sys.stderr)
        return 1


def made(asked, found):
    if asked.run or asked.repeat or asked.dry_run:
        work = run.Work(found, asked.backend, asked.workers)
        if asked.repeat:
            return work.repeat(asked.repeat, asked.repeat_seed, asked.water)
        if asked.dry_run:
            print(work.missing())
            return 0
        work.all()
    return report(found, asked.check)


if __name__ == "__main__":
    sys.exit(main())
