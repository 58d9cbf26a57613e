#!/usr/bin/env python3
"""Two swimmers of one water: the first bends to the left and to the right in turns, the second follows it by what it sees."""

import argparse

import natator
import numpy as np
from natator import script

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.ArgumentDefaultsHelpFormatter)
parser.add_argument("--scene", default="company/pair")
parser.add_argument("--duration", type=float, default=2.0, help="s, above 0")


def swim(options):
    script.package("pettingzoo", "pettingzoo", "an environment of several swimmers")
    from natator.zoo import SwimmersEnv
    water = SwimmersEnv(options.scene, actions="gait", target={"swimmer-1": "swimmer-0"}, duration=options.duration, frames=6)
    observations, info = water.reset(seed=1)
    gained, seen = 0.0, observations["swimmer-1"][-9:-6]  # place of the other, along own axes: forward, up, right
    while water.agents:
        actions = {agent: np.zeros(water.action_space(agent).shape) for agent in water.agents}
        for agent, action in actions.items():
            scale, offset = np.split(action, 2)
            scale[:] = 1  # the gait as it is
            if agent == "swimmer-0":
                offset[:] = 0.5 if info[agent]["time"] % 1 < 0.5 else -0.5
            else:
                to_right = seen[2] / np.linalg.norm(seen)
                offset[:] = np.clip(-2 * to_right, -1, 1)  # a positive one bends to the left
        observations, rewards, _, _, info = water.step(actions)
        if "swimmer-1" in rewards:
            gained, seen = gained + rewards["swimmer-1"], observations["swimmer-1"][-9:-6]
            print(f"{info['swimmer-1']['time']:5.2f} s  {np.linalg.norm(seen):.3f} body lengths behind, {gained:+.3f} gained", flush=True)
    water.close()


script.run(parser, swim)
