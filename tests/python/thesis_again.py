#!/usr/bin/env python3
"""The thesis redone at its smallest, from evolution to page: tests/python/thesis_again.py, after ./setup.sh --readers and mvn verify.

A study of one creature and a few frames is made in a folder of its own, cut as by a kill, gone on with, and damaged; and some of the committed runs are
run again. Exit code 1 where it fails; a minute on two idle cores.
"""
import datetime
import fcntl
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]


def redo(*arguments, code=0):
    """What results/redo.sh thesis prints."""
    done = subprocess.run([ROOT / "results/redo.sh", "thesis", *map(str, arguments)], capture_output=True, text=True, encoding="utf-8")
    expect(done.returncode == code, f"{arguments} ended with {done.returncode}, expected {code}: {done.stderr}")
    return done.stdout + done.stderr


def expect(holds, otherwise):
    if not holds:
        sys.exit(f"thesis_again.py: {otherwise}")


def has(text, *parts):
    for part in parts:
        expect(part in text, f"expected {part!r} in: {text}")


def cut(file, rows):
    """Leaves the file's rows but for the last, and half of one of these."""
    lines = file.read_text(encoding="utf-8").splitlines(keepends=True)
    file.write_text("".join(lines[:-rows]) + lines[-rows][:40], encoding="utf-8")


def small(folder):
    """A study from nothing to the page."""
    study = ["--quick", "--output-dir", folder]
    has(redo(*study, "--dry-run"), "2 evolutions to finish", "0 gaits at half the spacing")
    redo(*study, "--run")
    page, rows = (folder / "README.md").read_text(encoding="utf-8"), {name: (folder / name).read_text(encoding="utf-8") for name in
                                                                      ("measurements.jsonl", "motions.jsonl", "processor.jsonl")}
    has(page, "# The thesis, redone", "**Of the thesis' gaits 0 of 1", "| 1 | 0.23 |", "In flex 1 evolutions of creature 1: 4 chromosomes over 1 ",
        "2 of 2 evolutions are finished", "![creature 1, evolved in open water](figures/swimmer.png)", "creature-1-open-water.png")
    expect("nan" not in page and "None" not in page, "the page has a number that is none")
    has((folder / "tables/speeds-flex.csv").read_text(encoding="utf-8"), "1,thesis' gait,", '1,"evolved, seed 1",')
    run = folder / "runs/creature-1/flex/seed-1"
    expect((run / "finalists.json").exists() and not (run / "evaluations.jsonl").exists(), "the evolution was not made small")
    # A kill leaves half a row; what is done is not done again.
    before = (run / "best.json").stat().st_mtime_ns
    cut(folder / "measurements.jsonl", 5)
    cut(folder / "motions.jsonl", 1)
    has(redo(*study, "--dry-run"), "0 evolutions to finish", " 5 evaluations", "1 motions")
    redo(*study, "--run")
    expect((folder / "README.md").read_text(encoding="utf-8") == page, "a study that was cut and gone on with has another page")
    for name, text in rows.items():
        expect((folder / name).read_text(encoding="utf-8") == text, f"a study that was cut and gone on with has other {name}")
    expect((run / "best.json").stat().st_mtime_ns == before, "a finished evolution was evolved again")
    has(redo(*study, "--check"), " files are what the rows give")
    with open(folder / "measurements.jsonl", encoding="utf-8") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        has(redo(*study, "--run", code=1), "is in use by another run")
    # A row that says something else is seen, and so is a run that ends otherwise.
    (folder / "measurements.jsonl").write_text(re.sub('"distance":-?', '"distance":1', rows["measurements.jsonl"]), encoding="utf-8")
    has(redo(*study, "--check", code=1), "README.md is not what the rows give")
    (folder / "processor.jsonl").write_text(rows["processor.jsonl"].replace('"hash":"', '"hash":"0'), encoding="utf-8")
    has(redo(*study, "--repeat", 2, code=1), "differs: {", "0 of 2 runs end with the same bits")
    (folder / "motions.jsonl").write_text(rows["motions.jsonl"].replace('"fits":', '"fit":', 1), encoding="utf-8")
    has(redo(*study, code=1), "motions.jsonl: line 1: has no fits")


def main():
    folder = pathlib.Path(tempfile.mkdtemp())
    try:
        small(folder / "study")
        (folder / "README.md").write_text("my own", encoding="utf-8")
        has(redo("--quick", "--output-dir", folder, "--run", code=2), "was not made by make.py")
        has(redo("--quick", code=2), "--quick needs --output-dir")
        flags = pathlib.Path("/proc/cpuinfo")
        if flags.exists() and " avx2 " in flags.read_text():  # the others round otherwise
            has(redo("--water", "flex", "--repeat", 3, "--repeat-seed", datetime.date.today().toordinal()), "3 of 3 runs end with the same bits")
    finally:
        shutil.rmtree(folder)
    print("the thesis again, small: done")


if __name__ == "__main__":
    main()
