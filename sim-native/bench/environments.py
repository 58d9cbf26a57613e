#!/usr/bin/env python3
"""Steps a second of vector environments, what a step costs in processor time, and the program's memory, by environments and threads.
Runs take turns, since others use the machine; figures are medians over rounds."""

import argparse
import re
import statistics
import time
from pathlib import Path

import natator.gym
import numpy as np
from natator import script

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
parser.add_argument("--scene", default="pool/tadpole")
parser.add_argument("--sizes", type=int, nargs="+", default=[1, 1, 2, 1, 2, 2], metavar="N", help="environments and threads, in pairs")
parser.add_argument("--backend", default="cpu", help="cpu, cuda or auto")
parser.add_argument("--rounds", type=int, default=9)
parser.add_argument("--steps", type=int, default=10, help="of each environment in a round")


def processor_time(env):
    """s of all threads of its program."""
    fields = Path(f"/proc/{env._batch._program._process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / 100


def memory(env):
    """MB of its program."""
    status = Path(f"/proc/{env._batch._program._process.pid}/status").read_text()
    return int(re.search(r"VmRSS:\s*(\d+) kB", status)[1]) / 1000


def measure(options):
    pairs = list(zip(options.sizes[::2], options.sizes[1::2]))
    envs = [natator.gym.SwimmerVectorEnv(count, threads=threads, scene=options.scene, backend=options.backend, duration=1e9) for count, threads in pairs]
    seen = [[] for _ in pairs]
    for env in envs:
        env.reset(seed=1)
        env.action_space.seed(1)
    for _ in range(options.rounds):
        for env, own in zip(envs, seen):
            actions = [0.5 * env.action_space.sample() for _ in range(options.steps)]
            begun, used, here = time.perf_counter(), processor_time(env), time.process_time()
            for action in actions:
                env.step(action)
            count = options.steps * env.num_envs
            own.append((count / (time.perf_counter() - begun), 1e3 * (processor_time(env) - used) / count,
                        1e3 * (time.process_time() - here) / count))
    print("| environments | threads | steps/s | program, ms a step | Python, ms a step | MB |\n|---:|---:|---:|---:|---:|---:|")
    for (count, threads), own, env in zip(pairs, seen, envs):
        rate, program, python = np.apply_along_axis(statistics.median, 0, own)
        print(f"| {count} | {threads} | {rate:.1f} | {program:.1f} | {python:.2f} | {memory(env):.0f} |")


script.run(parser, measure)
