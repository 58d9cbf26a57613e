#!/usr/bin/env python3
"""Checks who includes whom in this checkout, or in the folder FOLDER. Folders of sim-native/ stand on floors: no file includes one of a
higher floor. No two folders of src/ include each other, be it by others, unless one lies in the other; nor do two Java packages of a module
need each other. Prints one line per offence, and ends with exit code 1 if there is any. usage: layers.py [FOLDER]"""
import re
import sys
from pathlib import Path

FLOORS = ["base", "physics", "model", "scene", "solver", "run", "protocol", "bench", "cli"]  # from below; the last two are beside src/
# Of the public headers, which lie in one folder. natator.h is all of them.
PUBLIC = {
    "base": "error limits version",
    "model": "gait model scene",
    "scene": "load_scene",
    "solver": "instruction_set solver",
    "run": "batch cost evaluate measure natator record settled_state_cache simulation",
}
MADE = "include/natator/version.h"  # by CMake


def floor_of(file):
    """The number of a file's floor; none if nobody has said it."""
    floor = file.parts[1] if file.parts[0] == "src" else file.parts[0]
    if floor == "include":
        floor = next((floor for floor, names in PUBLIC.items() if file.stem in names.split()), None)
    return FLOORS.index(floor) if floor in FLOORS else None


def inclusions(root):
    """Pairs of files: who includes whom, as compilers find it."""
    searched = [root / folder for folder in ("include", "src", "bench", "cli")]
    for path in sorted(file for folder in searched for file in folder.rglob("*")):
        if path.suffix not in (".h", ".cpp", ".cu", ".cuh"):
            continue
        for name in re.findall(r'^\s*#\s*include\s+["<]([^">]+)[">]', path.read_text(), re.MULTILINE):
            found = next((folder / name for folder in [path.parent, *searched]
                          if (folder / name).is_file() or folder / name == root / MADE), None)
            if found:
                yield path.relative_to(root), found.resolve().relative_to(root)


def rings(edges):
    """The sets of folders that include each other."""
    def reached(folder):
        found, ahead = set(), [folder]
        while ahead:
            new = edges.get(ahead.pop(), set()) - found
            found |= new
            ahead += new
        return found

    by = {folder: reached(folder) for folder in edges}
    return {frozenset(other for other in by[folder] if folder in by.get(other, ())) for folder in by if folder in by[folder]}


def offences(root):
    edges = {}
    for file, other in inclusions(root):
        floors = floor_of(file), floor_of(other)
        if None in floors:
            yield f"{[file, other][floors.index(None)]}: is on no floor; its folder must be one of src/, or tests/layers.py name it"
        elif floors[0] < floors[1]:
            yield f"{file}: includes {other}; must include nothing of {FLOORS[floors[1]]}, which is above {FLOORS[floors[0]]}"
        one, two = file.parent, other.parent
        if one.parts[0] == two.parts[0] == "src" and one not in (two, *two.parents) and two not in one.parents:
            edges.setdefault(str(one), set()).add(str(two))
    yield from (", ".join(sorted(ring)) + ": include each other" for ring in rings(edges))


def java_offences(module):
    """The packages of a module that need each other, by the names that their sources import or write out; comments do not count."""
    edges, sources = {}, module / "src/main/java"
    for file in sources.rglob("*.java"):
        code = re.sub(r"/\*.*?\*/|//[^\n]*", " ", file.read_text(), flags=re.DOTALL)
        own = str(file.parent.relative_to(sources)).replace("/", ".")
        edges.setdefault(own, set()).update(set(re.findall(r"\b(io\.natator(?:\.[a-z]\w*)*)\.[A-Z]\w*", code)) - {own})
    yield from (", ".join(sorted(ring)) + ": need each other" for ring in rings(edges))


def main(root):
    found = sorted({*offences((root / "sim-native").resolve()),
                    *(offence for module in (root / "ga-java").iterdir() for offence in java_offences(module))})
    print("\n".join(found), end="\n" if found else "")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1]))
