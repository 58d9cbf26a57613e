#!/usr/bin/env python3
"""The version is that of project() in CMakeLists.txt; every other place must agree with it.

    tests/versions.py --show                 prints it
    tests/versions.py                        the check; exit code 1, and a line for each place that disagrees
    tests/versions.py v0.2.0                 the same, of the commit that this tag names: a release, dated in CHANGELOG.md
    tests/versions.py --set 0.2.0            writes a release into all places, dated today
    tests/versions.py --set 0.3.0-SNAPSHOT   writes the version to come
--root DIR: of another checkout. Between releases CITATION.cff names the newest one.
"""

import argparse
import datetime
import re
import sys
from pathlib import Path

SOURCE = ("CMakeLists.txt", r"(?m)^project\(natator VERSION (\S+)")
HEADS = ("CHANGELOG.md", r"(?m)^## \[([^]]+)\](?: - (\d{4}-\d\d-\d\d))?$")
MODULE = r"(?:<groupId>io\.natator</groupId>\s*<artifactId>[^<]+</artifactId>\s*<version>|<revision>)([^<$]+)</(?:version|revision)>"
CLIENT = ("sim-native/python/natator/__init__.py", r'(?m)^__version__ = "(.*)"$')
CITATION = ("CITATION.cff", r"(?m)^version: (.*)$")
RECIPE = (".github/packaging/conda/recipe.yaml", r"(?m)^  version: (\S+)$")


def modules(root):
    """The parent, the modules that name its version, and the page that tells how to depend on one."""
    files = [file for file in sorted(root.glob("ga-java/**/pom.xml")) if re.search(MODULE, file.read_text())]
    return [(str(file.relative_to(root)), MODULE) for file in [root / "pom.xml", *files, root / "ga-java/docs/embedding.md"]]


def source(root):
    version, = re.findall(SOURCE[1], (root / SOURCE[0]).read_text())
    return version


def check(root, tag=None):
    """Yields a line for each disagreement."""
    version = source(root)
    heads = re.findall(HEADS[1], (root / HEADS[0]).read_text())
    coming = heads[0][0] == "Unreleased"
    released, date = heads[1 if coming else 0]
    if coming and number(version) <= number(released):
        yield f"{SOURCE[0]}: {version}; must be above {released}, the newest in {HEADS[0]}"
    if not coming and released != version:
        yield f"{HEADS[0]}: {released}; must be {version}"
    if not date:
        yield f"{HEADS[0]}: {released} has no date; must be [{released}] - YYYY-MM-DD"
    if tag and (coming or tag != f"v{version}"):
        yield f"tag {tag}: {SOURCE[0]} has {version}, {HEADS[0]} begins with [{heads[0][0]}]; must be a release of the tag's version"
    for places, expected in ((modules(root), version + "-SNAPSHOT" * coming), ([CLIENT, RECIPE], version), ([CITATION], released)):
        for file, pattern in places:
            found = re.findall(pattern, (root / file).read_text())
            if found != [expected]:
                yield f"{file}: {', '.join(found) or 'no version'}; must be {expected}"


def number(version):
    return tuple(map(int, version.split(".")))


def write(root, version):
    plain, coming = version.removesuffix("-SNAPSHOT"), version.endswith("-SNAPSHOT")
    changes = [(SOURCE, plain), (CLIENT, plain), (RECIPE, plain)] + [(place, version) for place in modules(root)] + [(CITATION, plain)] * (not coming)
    for (file, pattern), new in changes:
        text = (root / file).read_text()
        begin, end = re.search(pattern, text).span(1)
        (root / file).write_text(text[:begin] + new + text[end:])
    text = (root / HEADS[0]).read_text()
    head = re.search(HEADS[1], text)
    new = "## [Unreleased]" if coming else f"## [{plain}] - {datetime.date.today()}"
    if head[1] == "Unreleased":
        text = text[:head.start()] + new + text[head.end():]
    elif head[1] != plain:
        text = text[:head.start()] + new + "\n\n" + text[head.start():]
    (root / HEADS[0]).write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tag", nargs="?")
    parser.add_argument("--set", metavar="VERSION")
    parser.add_argument("--show", action="store_true")
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parents[1])
    given = parser.parse_args()
    if given.show:
        print(source(given.root))
        return 0
    if given.set:
        if not re.fullmatch(r"\d+\.\d+\.\d+(-SNAPSHOT)?", given.set):
            parser.exit(2, f"versions.py: --set {given.set}: must be as 1.2.3 or 1.2.3-SNAPSHOT\n")
        write(given.root, given.set)
    wrong = list(check(given.root, given.tag))
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
