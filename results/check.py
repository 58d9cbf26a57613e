#!/usr/bin/env python3
"""Checks what results/ holds: python3 results/check.py [--prune]

Every file must be of a known kind, every link of a page must lead to a file, every picture must be on a page, every page must
name at its head the commit that made its rows and have an answer, README.md must have each answer, all JSON must be whole, and all of it
must stay below 25 MB. --prune deletes files of other kinds and pictures that no page shows. Exit status 1 if anything is wrong
that --prune did not mend.
"""
import collections
import csv
import gzip
import json
import pathlib
import re
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
KINDS = {".md", ".csv", ".json", ".jsonl", ".gz", ".html", ".npz", ".png", ".py", ".sh", ".txt"}
LIMIT = 25_000_000
MADE, HEAD = re.compile(r"commits? (up to )?[0-9a-f]{8}"), 1800
ANSWER = re.compile(r"<!-- answer[^>]*-->\n\*\*(.*?)\*\*")
LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")


def listed():
    """Files in results/ that are committed or would be."""
    names = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard", "results"], cwd=ROOT,
                           check=True, capture_output=True, text=True).stdout.split("\0")
    return [ROOT / name for name in names if name and (ROOT / name).is_file()]


def links(page):
    """Files that a page links to, but for addresses."""
    targets = LINK.findall(page.read_text(encoding="utf-8"))
    return [(page.parent / target).resolve() for target in targets if "://" not in target]


def damage(file):
    """What is wrong with a file of JSON, or of a JSON value a line; None if nothing is."""
    text = file.read_text(encoding="utf-8")
    lines = text.splitlines() if file.suffix == ".jsonl" else [text]
    for number, line in enumerate(lines, 1):
        try:
            json.loads(line)
        except ValueError as error:
            return f"{f'line {number}: ' if len(lines) > 1 else ''}{error}"
    return None


def lake():
    """(evolution, seed) of tables/lake.csv whose ✔ the rows do not give, or whose rows give one that is not there: further than at rest by a twentieth of a body
    length, more than twice as fast as in vacuum, within half of it at half the step, at half the cells and mirrored, clear of walls (in a wider lake, where it swam in one, as fast), and nothing unstable."""
    page, runs, wrong = ROOT / "results/thesis", collections.defaultdict(list), []
    for row in map(json.loads, gzip.open(page / "lake/swims.jsonl.gz", "rt", encoding="utf-8")):
        runs[row["evolution"], row["seed"], row["condition"]].append(row)
    lengths = {row["evolution"]: row["bodyLength"] for row in map(json.loads, open(page / "lake/motions.jsonl", encoding="utf-8"))}
    for entry in csv.DictReader(open(page / "tables/lake.csv", encoding="utf-8", newline="")):
        name, seed = entry["evolution"], int(entry["seed"])
        found = {condition: rows for (one, number, condition), rows in runs.items() if (one, number) == (name, seed)}
        swims = all(row["status"] == "ok" for rows in found.values() for row in rows)
        own, wide = ([row["stopped"] == "touched-plane" for row in found.get(condition, [])] for condition in ("until walls", "wider"))
        if swims:
            alone = 2 * sum(wide or own) <= len(wide or own)
            found["water"] = found["water"] + (found.get("until walls", []) if 2 * sum(own) <= len(own) else [])
            speed = {condition: [row["distance"] / row["simulated"] for row in rows] for condition, rows in found.items()}
            mean = {condition: statistics.mean(values) for condition, values in speed.items()}
            net = mean["water"] - mean["resting"]
            sure = net - 2 * statistics.stdev(speed["water"]) / len(speed["water"]) ** 0.5
            swims = alone and sure >= 0.05 * lengths[name[:10]] / statistics.mean(row["simulated"] for row in found["water"]) \
                and 2 * abs(mean["vacuum"]) < net and all(0.5 < mean[finer] / mean["water"] < 1.5 for finer in ("half step", "half cells", "mirrored", "wider") if finer in mean)
        if swims != (entry["verdict"] == "✔"):
            wrong.append(f"results/thesis/tables/lake.csv: {name}, seed {seed} has {entry['verdict']}; expected {'✔' if swims else 'none'}, by its rows")
    return wrong


def main():
    prune = sys.argv[1:] == ["--prune"]
    if sys.argv[1:] and not prune:
        sys.exit(f"check.py: unknown arguments {sys.argv[1:]}; expected none or --prune")
    files = listed()
    pages = [file for file in files if file.suffix == ".md"] + [ROOT / "README.md"]
    linked = {target for page in pages for target in links(page)}
    superfluous = [(file, "is of a kind that is not kept") for file in files if file.suffix not in KINDS]
    superfluous += [(file, "is a picture on no page") for file in files if file.suffix == ".png" and file not in linked]
    wrong = [f"{page.relative_to(ROOT)}: links to {target}, which is not there"
             for page in pages for target in links(page) if not target.exists()]
    index = (ROOT / "results/README.md").read_text(encoding="utf-8")
    for page in (ROOT / "results").glob("*/README.md"):
        if page.parent.name != "pictures" and not MADE.search(page.read_text(encoding="utf-8")[:HEAD]):
            wrong.append(f"{page.relative_to(ROOT)}: names no program; expected in its first {HEAD} characters: commit, and 8 digits or more")
        answer = ANSWER.search(page.read_text(encoding="utf-8"))
        if page.parent.name != "pictures" and not answer:
            wrong.append(f"{page.relative_to(ROOT)}: has no answer; expected, by its make.py, <!-- answer --> and a bold sentence")
        if answer and not any(f"]({page.parent.name}/README.md){colon} {answer[1]}" in index for colon in ("", ":")):
            wrong.append(f"results/README.md: does not have the answer of {page.parent.name}; expected: {answer[1]}")
    wrong += lake()
    for file in files:
        fault = damage(file) if file.suffix in {".json", ".jsonl"} else None
        if fault:
            wrong.append(f"{file.relative_to(ROOT)}: {fault}")
    for file, why in superfluous:
        if prune:
            file.unlink()
            print(f"deleted {file.relative_to(ROOT)}: {why}")
        else:
            wrong.append(f"{file.relative_to(ROOT)}: {why}")
    size = sum(file.stat().st_size for file in listed())
    if size > LIMIT:
        wrong.append(f"results/ has {size / 1e6:.1f} MB; expected at most {LIMIT / 1e6:.0f}")
    for line in wrong:
        print(line, file=sys.stderr)
    print(f"results/: {len(listed())} files, {size / 1e6:.1f} MB, {len(wrong)} faults")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
