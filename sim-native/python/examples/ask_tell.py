"""An optimizer outside of natator, here pycma. The same command goes on with an interrupted run. Other options are those of natator evolve, which a run keeps."""

import argparse
import json
import os
import subprocess
import sys

import cma

parser = argparse.ArgumentParser(description=__doc__, allow_abbrev=False)
parser.add_argument("run", help="its folder")
arguments, options = parser.parse_known_args()
run = arguments.run
command = ["resume", run] if os.path.exists(f"{run}/config.json") else ["evolve", "--optimizer", "external", "--output-dir", run, *options]
with subprocess.Popen([os.environ.get("NATATOR", "natator"), *command], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as natator:
    for line in natator.stdout:
        message = json.loads(line)
        if message["do"] == "begin":
            lower, upper = ([gene[end] for gene in message["genes"]] for end in ("lower", "upper"))
            middle, widths = ([(a + b) / 2 for a, b in zip(lower, upper)], [b - a for a, b in zip(lower, upper)])
            search = cma.CMAEvolutionStrategy(middle, 0.25, {"bounds": [lower, upper], "CMA_stds": widths, "popsize": message["population"],
                                                             "seed": message["seed"], "verbose": -9})
        elif message["do"] == "ask":
            print(json.dumps({"candidates": [list(genes) for genes in search.ask()]}), file=natator.stdin, flush=True)
        elif message["do"] == "tell":
            worths = [one["fitness"] for one in message["candidates"]]
            worst = min((worth for worth in worths if worth is not None), default=0)  # what failed is worth no more
            search.tell([one["genes"] for one in message["candidates"]], [-(worst if worth is None else worth) for worth in worths])
sys.exit(natator.returncode)
