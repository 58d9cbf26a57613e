#!/usr/bin/env python3
"""What settings cost: processor time of the same swim with one setting changed, as a multiple of that without a change.

usage: setting_costs.py NATATOR_SIM [--rounds N] > settings.csv

Each round runs all variants one after another, so that a busy machine slows all of them; the least time of all rounds counts. The
time is that of a swim of LONG seconds less that of one of SHORT, which takes starting and settling out of it. Needs Python alone.
"""
import argparse
import csv
import json
import os
import resource
import subprocess
import sys
import tempfile

SCENE = "pool/creature-1"
GAIT = {"frequency": 1.861, "amplitude": [0.973, 0.69], "phase": [0, 0.648]}
SHORT, LONG = 0.1, 0.5  # s


def solver(**settings):
    return {"overrides": {"solver": settings}}


# name -> what is changed of the request, of the command, of the environment
VARIANTS = {
    "as the scene has it": ({}, [], {}),
    "substeps 2 instead of 4": (solver(substeps=2), [], {}),
    "substeps 8": (solver(substeps=8), [], {}),
    "numIterations 2 instead of 4": (solver(numIterations=2), [], {}),
    "numIterations 8": (solver(numIterations=8), [], {}),
    "solidIterations 4 instead of 16": (solver(solidIterations=4), [], {}),
    "solidIterations 64": (solver(solidIterations=64), [], {}),
    "kernelSupport 2 instead of 2.5": (solver(kernelSupport=2), [], {}),
    "kernelSupport 3": (solver(kernelSupport=3), [], {}),
    "kinematicViscosity 0": (solver(kinematicViscosity=0), [], {}),
    "surfaceTension 1": (solver(surfaceTension=1), [], {}),
    "vorticityConfinement 1": (solver(vorticityConfinement=1), [], {}),
    "cohesion 0.01": (solver(cohesion=0.01), [], {}),
    "double precision": ({"precision": "double"}, [], {}),
    "AVX2": ({}, [], {"NATATOR_ISA": "avx2"}),
    "portable": ({}, [], {"NATATOR_ISA": "portable"}),
    "nothing skipped": ({}, ["--no-skip"], {}),
}


def processor_seconds(program, duration, change, options, environment):
    request = {"id": 1, "scene": SCENE, "gait": GAIT, "duration": duration, **change}
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([program, "evaluate", *options], input=json.dumps(request), text=True, capture_output=True,
                          env={**os.environ, **environment})
    if done.returncode != 0:
        sys.exit(f"setting_costs.py: {' '.join(options)} {json.dumps(change)}: {done.stderr.strip()}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program")
    parser.add_argument("--rounds", type=int, default=3)
    arguments = parser.parse_args()
    least = {}
    with tempfile.TemporaryDirectory() as settled:
        os.environ["NATATOR_CACHE"] = settled
        for name, variant in VARIANTS.items():
            processor_seconds(arguments.program, SHORT, *variant)  # settles
        for _ in range(arguments.rounds):
            for name, variant in VARIANTS.items():
                for duration in (SHORT, LONG):
                    seconds = processor_seconds(arguments.program, duration, *variant)
                    least[name, duration] = min(seconds, least.get((name, duration), seconds))
    own = {name: least[name, LONG] - least[name, SHORT] for name in VARIANTS}
    base = own["as the scene has it"]
    table = csv.writer(sys.stdout, lineterminator="\n")
    table.writerow(["setting", "processor_seconds_per_simulated_second", "times"])
    for name, seconds in own.items():
        table.writerow([name, f"{seconds / (LONG - SHORT):.3f}", f"{seconds / base:.2f}"])


if __name__ == "__main__":
    main()
