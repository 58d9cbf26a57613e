#!/usr/bin/env python3
"""Steps a second of vector environments, what a step costs in processor time, the program's memory, and the GPU's, by environments and threads.
Runs take turns, since others use the machine; figures are medians over rounds. Nobody else may use the GPU."""

import argparse
import re
import statistics
import subprocess
import time
from pathlib import Path

import natator.gym
import numpy as np
from natator import script

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
parser.add_argument("--scene", default="pool/tadpole")
parser.add_argument("--sizes", type=int, nargs="+", default=[1, 1, 2, 1, 2, 2], metavar="N", help="environments and threads, in pairs")
parser.add_argument("--backend", default="cpu", help="cpu, cuda or auto")
parser.add_argument("--tensors", metavar="DEVICE", help="where natator.torch has actions and observations, and what they cost there; default: arrays")
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


def memory_of_gpu():
    """MB in use; none of it without nvidia-smi."""
    try:
        said = subprocess.run(["nvidia-smi", "--query-gpu=memory.used", "--format=csv,noheader,nounits"], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return 0
    return 1.048576 * sum(map(int, said.stdout.split()))


class Timed(natator.gym.SwimmerVectorEnv):
    """Knows how long its last step took, s."""

    def step(self, actions):
        begun = time.perf_counter()
        told = super().step(actions)
        self.took = time.perf_counter() - begun
        return told


def measure(options):
    pairs, envs, on_gpu = list(zip(options.sizes[::2], options.sizes[1::2])), [], []
    wrap, given = lambda env: env, lambda action: action
    if options.tensors:
        import torch
        from natator.torch import TensorVectorEnv
        wrap, given = lambda env: TensorVectorEnv(env, options.tensors), lambda action: torch.as_tensor(action, device=options.tensors)
    for count, threads in pairs:
        before, env = memory_of_gpu(), Timed(count, threads=threads, scene=options.scene, backend=options.backend, duration=1e9)
        envs.append(wrap(env))
        env.reset(seed=1)
        env.action_space.seed(1)
        env.step(0 * env.action_space.sample())
        on_gpu.append(memory_of_gpu() - before)
    seen = [[] for _ in pairs]
    for _ in range(options.rounds):
        for env, own in zip(envs, seen):
            inner = env.unwrapped
            actions = [given(0.5 * env.action_space.sample()) for _ in range(options.steps)]
            begun, used, here, beside = time.perf_counter(), processor_time(inner), time.process_time(), 0
            for action in actions:
                start = time.perf_counter()
                env.step(action)
                beside += time.perf_counter() - start - inner.took
            count = options.steps * env.num_envs
            own.append((count / (time.perf_counter() - begun), 1e3 * (processor_time(inner) - used) / count,
                        1e3 * (time.process_time() - here) / count, 1e3 * beside / options.steps))
    print("| environments | threads | steps/s | program, ms a step | Python, ms a step | MB | MB of the GPU | tensors, ms for all |\n|---:|---:|---:|---:|---:|---:|---:|---:|")
    for (count, threads), own, env, gpu in zip(pairs, seen, envs, on_gpu):
        rate, program, python, beside = np.apply_along_axis(statistics.median, 0, own)
        print(f"| {count} | {threads} | {rate:.1f} | {program:.1f} | {python:.2f} | {memory(env.unwrapped):.0f} | {gpu:.0f} | {beside:.2f} |")


script.run(parser, measure)
