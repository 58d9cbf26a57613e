"""The page's table of bodies around control points, of what `natator check` and `natator converge` found of their evolved gaits."""
import json
import pathlib

import study

HERE = pathlib.Path(__file__).parent
BODIES = {"jellyfish": "jellyfish", "torus": "torus", "turtle": "turtle", "fine-turtle": "turtle, at half the spacing"}


def row(folder, name):
    check, converge = (json.loads((HERE / "bodies" / folder / f"{kind}.json").read_text()) for kind in ("check", "converge"))

    def way(condition):
        own = check[condition]
        error = study.half_interval(own["distance"]["sd"] / own["runs"] ** 0.5, own["runs"])
        return study.with_error(own["distance"]["mean"], error, 3).replace("-", "−")

    base, *finer = converge["levels"]
    half = next(level["change"] for level in finer if level["level"] == "spacing/2")
    return [name, ", ".join(f"{count} {end}" for end, count in check["water"]["stopped"].items()), *map(way, ("water", "halfStep", "mirrored", "resting")),
            f"{base['speed']['mean'] / converge['bodyLength']:.3f}", f"{100 * half['mean']:+.0f} ± {100 * half['error']:.0f} %".replace("-", "−")]


def make(folder):
    table = study.table(["body", "runs", "distance", "half the time step", "mirrored", "at rest", "body lengths/s", "at half the spacing"],
                        [row(*one) for one in BODIES.items()], "<<>>>>>>")
    (folder / "README.md").write_text(study.filled(HERE / "README.md", bodies=table), encoding="utf-8")


study.main(make)
