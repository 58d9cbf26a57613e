#!/usr/bin/env python3
"""Checks who includes whom in sim-native. Its folders stand on floors, each on those below it: no file includes one of a higher floor, and no
two folders of src/ include each other, unless one lies in the other. Prints one line per offence; exit code 1 if there is any."""
import re
import sys
from pathlib import Path

FLOORS = ["base", "physics", "model", "scene", "solver", "run", "protocol", "bench", "cli"]
# Of folders of src/, of public headers, and of what stands beside src/.
FLOOR_OF = {f"src/{floor}": floor for floor in FLOORS[:6]} | {"src/io": "protocol", "bench": "bench", "cli": "cli"}
PUBLIC = {
    "base": "error limits version",
    "model": "actuate gait goal model model_builder parameters scene state steering water_box wave_gait",
    "scene": "load_scene",
    "solver": "execution gpu_solver instruction_set plan solver stop_reason",
    "run": "batch cost course evaluate laws live measure momentum moving_tank pose sense settled_state_cache snapshot swimming trajectory",
    "protocol": "natator",
}
# What is known, and to become less: "LOWER > HIGHER" folder, or the folders that include each other.
KNOWN = {}


def folder_of(file):
    return next((str(up) for up in file.parents if str(up) in FLOOR_OF or str(up) == "include/natator"), "")


def floor_of(file):
    folder = folder_of(file)
    floor = FLOOR_OF.get(folder) or next((floor for floor, names in PUBLIC.items() if file.stem in names.split()), None)
    return FLOORS.index(floor) if floor else None


def included(root):
    """Pairs of files, those of a build left out: who includes whom, from where it stands or from a folder that compilers are given."""
    for path in sorted(file for top in ("include", "src", "bench", "cli") for file in (root / top).rglob("*")):
        if path.suffix not in (".h", ".cpp", ".cu", ".cuh"):
            continue
        for name in re.findall(r'^\s*#\s*include\s+["<]([^">]+)[">]', path.read_text(), re.MULTILINE):
            for where in (path.parent, root / "include", root / "src", root / "bench", root / "cli"):
                if (where / name).is_file():
                    yield path.relative_to(root), (where / name).resolve().relative_to(root)
                    break
            else:
                if name == "natator/version.h":
                    yield path.relative_to(root), Path("include") / name


def rings(edges):
    """The sets of folders that include each other, by others too."""
    def reached(folder):
        found, ahead = set(), [folder]
        while ahead:
            new = edges.get(ahead.pop(), set()) - found
            found |= new
            ahead += new
        return found

    of = {folder: reached(folder) for folder in edges}
    return {frozenset(other for other in of[folder] if folder in of.get(other, ())) for folder in edges if folder in of[folder]}


def offences(root):
    """What is wrong, as a name of its kind that KNOWN may hold, and a line that tells it."""
    edges = {}
    for file, other in included(root):
        if floor_of(file) is None or floor_of(other) is None:
            yield "", f"{file if floor_of(file) is None else other}: has no floor; name it in tests/{Path(__file__).name}"
        elif floor_of(other) > floor_of(file):
            yield (f"{folder_of(file)} > {folder_of(other)}",
                   f"{file}: includes {other}: {FLOORS[floor_of(other)]} is above {FLOORS[floor_of(file)]}")
        one, two = file.parent, other.parent
        if one.parts[0] == two.parts[0] == "src" and one not in (two, *two.parents) and two not in one.parents:
            edges.setdefault(str(one), set()).add(str(two))
    for ring in rings(edges):
        names = ", ".join(sorted(ring))
        yield names, f"{names}: include each other"


def main(root):
    found = sorted(line for kind, line in offences(root.resolve()) if kind not in KNOWN)
    for line in found:
        print(line)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1] / "sim-native"))
