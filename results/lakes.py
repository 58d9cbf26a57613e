"""What pages that swim in scheme `lattice` share: a lake that goes along with its swimmer, bundled gaits, and programs' answers. Needs no package."""
import json
import os
import pathlib
import subprocess

GAITS = pathlib.Path(__file__).resolve().parent.parent / "sim-native/examples/gaits"


def gait(name):
    """A bundled one."""
    return {key: value for key, value in json.loads((GAITS / f"{name}.json").read_text(encoding="utf-8")).items() if key != "$schema"}


def lake(sides, cell, rear, steps=1, seconds=2, ends_at_walls=False):
    """Overrides of a scene lake/BODY: its sides along x, y and z and the width of its cells, units; where along x the body's rear is; so many times the steps at which the Mach number is the same for all cells."""
    length, height, width = sides
    return {"duration": seconds, "stopping": {"noProgressAfter": 0, "planeContact": ends_at_walls}, "solver": {"substeps": round(0.9 / cell) * steps},
            "movingTank": {"along": "x", "step": 0.15}, "creature": {"rearCentre": [rear, height / 2, width / 2]},
            "planes": [[0, 1, 0, 0], [1, 0, 0, 0], [-1, 0, 0, length], [0, 0, 1, 0], [0, 0, -1, width]],
            "fluid": {"count": [round(side / cell) for side in sides], "spacing": cell, "origin": [cell / 2] * 3, "mass": {"bottom": 1000 * cell ** 3}}}


def answers(requests, backend="cpu"):
    """Of natator-sim serve ($NATATOR_SIM, else that on the PATH), by id."""
    done = subprocess.run([os.environ.get("NATATOR_SIM", "natator-sim"), "serve", "--backend", backend], input="".join(json.dumps(one) + "\n" for one in requests), capture_output=True, text=True, check=True)
    return {one["id"]: one for one in map(json.loads, done.stdout.splitlines())}
