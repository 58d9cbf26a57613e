#!/usr/bin/env python3
"""How long a stream takes to save its moment and to go back to it, over the pipe and with what Python does: medians."""

import argparse
import statistics
import time

import natator
from natator import script

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
parser.add_argument("scenes", nargs="*", default=["pool/tadpole", "lake/tadpole"])
parser.add_argument("--rounds", type=int, default=40)


def measure(options):
    print("| scene | particles | kB | save, ms | restore, ms | sent too, ms |\n|---|---:|---:|---:|---:|---:|")
    for scene in options.scenes:
        with natator.Stream(scene) as stream:
            stream.step(2)
            other, seen = stream.save(), [[], [], []]
            stream.step(1)
            for _ in range(options.rounds):
                moments = [time.perf_counter()]
                state = stream.save()
                moments.append(time.perf_counter())
                for one in (state, other):  # which the simulator has, and has not
                    stream.restore(one)
                    moments.append(time.perf_counter())
                for times, begun, ended in zip(seen, moments, moments[1:]):
                    times.append(1e3 * (ended - begun))
            save, back, sent = map(statistics.median, seen)
            print(f"| `{scene}` | {stream.scene['particles']} | {len(other) / 1000:.0f} | {save:.2f} | {back:.2f} | {sent:.2f} |")


script.run(parser, measure)
