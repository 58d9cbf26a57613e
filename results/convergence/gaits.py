"""Gaits that nobody chose, at half the spacing: gaits.py NATATOR-SIM [--backend cuda] adds those that gaits.jsonl lacks, four starts each.

Creature 2 in open water under gravity 3 and 10: frequencies, amplitudes that rise in equal steps from a sixth of the last joint's, waves on the body.
"""
import concurrent.futures
import itertools
import json
import pathlib
import subprocess
import sys

FILE = pathlib.Path(__file__).parent / "gaits.jsonl"
ACTUATORS, STARTS = 8, 4


def request(gravity, frequency, last, waves):
    along = [i / (ACTUATORS - 1) for i in range(ACTUATORS)]
    return {"id": 1, "scene": "open-water/creature-2", "duration": 4,
            "gait": {"frequency": frequency, "amplitude": [round(last * (1 + 5 * one) / 6, 6) for one in along], "phase": [round(-waves * one % 1, 6) for one in along]},
            "overrides": {"solver": {"gravity": [0, -gravity, 0]}, "stopping": {"noProgressAfter": 4}}}


def main():
    program, *options = sys.argv[1:] or sys.exit(__doc__)
    known = [json.loads(line)["of"] for line in FILE.read_text().splitlines()] if FILE.exists() else []
    missing = [one for one in map(list, itertools.product((3, 10), (1.5, 2, 2.5), (0.42, 0.6), (0.21, 0.35, 0.56))) if one not in known]

    def row(of):
        done = subprocess.run([program, "converge", json.dumps(request(*of)), f"--starts={STARTS}", "--levels=spacing/2", *options], stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, text=True, check=True)
        return {"of": of, "levels": json.loads(done.stdout)["levels"]}

    with open(FILE, "a") as file, concurrent.futures.ThreadPoolExecutor(4) as pool:
        for one in concurrent.futures.as_completed([pool.submit(row, of) for of in missing]):
            print(json.dumps(one.result()), file=file, flush=True)


main()
