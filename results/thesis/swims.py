"""What search_steps.py, wider_tank.py, without_end.py, population.py, sinking.py and rise.py share. All but the last print requests, and make a table of
their results, CSV."""
import csv
import json
import pathlib
import statistics
import sys

import recompute


def tank(length, height, width, rear):
    """Overrides: a tank of water, the swimmer in its middle, its rear so far from the wall behind."""
    return {"planes": [[0, 1, 0, 0], [1, 0, 0, 0], [-1, 0, 0, length], [0, 0, 1, 0], [0, 0, -1, width]],
            "fluid": {"count": [round(side / 0.1) for side in (length, height, width)]},
            "creature": {"rearCentre": [rear, height / 2, width / 2]}}


def best_gait(folder):
    """That of an evolution."""
    return json.loads((folder / "best.json").read_text(encoding="utf-8"))["gait"]


def resting(gait):
    """With muscles that do nothing."""
    return {**gait, "amplitude": [0] * len(gait["amplitude"])}


def standard_error(values):
    return statistics.stdev(values) / len(values) ** 0.5


def with_error(values, digits):
    """Mean ± standard error."""
    return recompute.with_error(statistics.mean(values), standard_error(values), digits)


def spread(values, digits, unit=""):
    """Least to largest."""
    least, most = (f"{value:.{digits}f}" for value in (min(values), max(values)))
    return (least if least == most else f"{least} to {most}") + unit


def row(*cells):
    """Prints a row of a table."""
    csv.writer(sys.stdout, lineterminator="\n").writerow(cells)


def results(requests):
    """Of the file that the command line names, by id. Without one, prints the requests and ends the program."""
    requests = list(requests)
    if len(sys.argv) == 1:
        for request in requests:
            print(json.dumps(request))
        sys.exit()
    with open(sys.argv[1], encoding="utf-8") as lines:
        found = {result["id"]: result for result in map(json.loads, lines)}
    wrong = [number for number, result in found.items() if result["status"] != "ok"]
    if wrong or len(found) != len(requests):
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {len(found)} results, without success: {wrong}; must be all, ok")
    return found
