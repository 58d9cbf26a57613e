"""A PettingZoo environment of several swimmers of one water: the scene's creature and its companions."""

import inspect
from collections.abc import Mapping
from dataclasses import replace

import gymnasium
import numpy as np
from gymnasium import spaces
from pettingzoo import ParallelEnv

from natator.errors import InputError, Unstable
from natator.gait import Gait, as_json, whole
from natator.gym import LARGEST, SwimmerEnv, fields_of
from natator.plain import plain
from natator.stream import Stream
from natator.swimming import Views


class SwimmersEnv(ParallelEnv):
    """Agents "swimmer-0", the scene's creature, "swimmer-1" and so on, its companions. Each has the action of a natator.gym.SwimmerEnv, and
    its observation with, behind it, what it sees of others: place from it, velocity relative to its own, and heading, along own axes,
    of the nearest first. README.md has the table.

    scene: name or path, with companions; all have muscles. others: how many each sees, by default all. target: as SwimmerEnv's, or the name of
    another agent to follow; or a dict of these by agent. actions, gait, flow, reached, work_cost: those of SwimmerEnv, one for all
    or a dict by agent. frames, duration, starts, render_mode, options: those of SwimmerEnv, of the water.

    An agent's episode ends (terminated) when it touches a plane, reaches a target that stays, or the water becomes unstable; that of all
    (truncated) after `duration`. Muscles of one that has ended go slack. Raises InputError.
    """

    metadata = {"name": "natator_swimmers_v0", "render_modes": ["rgb_array"], "render_fps": 20, "is_parallelizable": True}

    def __init__(self, scene="plane/pair", others=None, target=None, frames=3, duration=4.0, starts=16, render_mode=None, actions="drive",
                 gait=None, flow=3, reached=0.25, work_cost=0.0, **options):
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise InputError(f'render_mode = {render_mode!r}: must be None or "rgb_array"')
        self.render_mode, self.np_random, self._senses = render_mode, None, None
        self._stream = Stream(scene, fields=fields_of(render_mode), **options)
        try:
            self._all = self._stream.all_actuators
            self.possible_agents = [f"swimmer-{k}" for k in range(len(self._all))]
            self.agents = []
            own = {name: self._by_agent(name, value) for name, value in (("actions", actions), ("gait", gait), ("flow", flow),
                   ("reached", reached), ("work_cost", work_cost), ("target", target))}
            self._leader = [self._leader_of(k, goal) for k, goal in enumerate(own["target"])]
            self._envs = [self._env(k, frames=frames, duration=duration, starts=starts, **{name: values[k] for name, values in own.items()})
                          for k in range(len(self._all))]
            self._seen = self._count(others)
            senses = self._stream.sense()
            self._take(senses)
            self._spaces = {agent: spaces.Box(-LARGEST, LARGEST, self._observation(k).shape, np.float32)
                            for k, agent in enumerate(self.possible_agents)}
            self.metadata = {**self.metadata, "render_fps": self._envs[0].metadata["render_fps"]}
            self._views = Views(self._stream.scene, self._stream.frame.position, all=True) if render_mode else None
        except BaseException:
            self._stream.close()
            raise
        self._senses = None

    def _by_agent(self, name, value):
        """A list with what each has of a value for all, or of a dict by agent."""
        if not isinstance(value, Mapping) or "frequency" in value:  # a gait
            return [value] * len(self.possible_agents)
        for agent in value:
            if agent not in self.possible_agents:
                raise InputError(f"{name}: {agent!r} is no agent; must be one of {', '.join(self.possible_agents)}")
        rest = inspect.signature(SwimmerEnv).parameters[name].default
        return [value.get(agent, rest) for agent in self.possible_agents]

    def _leader_of(self, k, goal):
        """The number of the one that swimmer k follows; None if it follows nobody."""
        if not isinstance(goal, str):
            return None
        if goal not in self.possible_agents or goal == self.possible_agents[k]:
            raise InputError(f"target of {self.possible_agents[k]} = {goal!r}: must be another agent, a point or a box")
        return self.possible_agents.index(goal)

    def _env(self, k, target, gait, actions, **arguments):
        """What is swimmer k's own, as a SwimmerEnv on its part of the stream."""
        swimmer = _Swimmer(self._stream, k)
        try:
            env = SwimmerEnv(swim=swimmer, target=None if self._leader[k] is not None else target, gait=gait, actions=actions, **arguments)
        except InputError as error:
            raise InputError(f"{self.possible_agents[k]}: {str(error).removeprefix(f'swimmer {k}: ')}") from None
        if self._leader[k] is not None:
            env.target = target
        if not env.by_gait:
            rest = np.zeros(env.actuators).tolist()
            swimmer.set_gait(Gait(1.0, rest, rest))
        return env

    def _count(self, others):
        most = len(self._all) - 1
        count = most if others is None else whole("others", others, 0)
        if count > most:
            raise InputError(f"others = {count}: must be at most {most}, as there are {most + 1} swimmers")
        return count

    def observation_space(self, agent):
        """Of an agent, always the same object."""
        return self._spaces[agent]

    def action_space(self, agent):
        """Likewise."""
        return self._envs[self.possible_agents.index(agent)].action_space

    def reset(self, seed=None, options=None):
        """As of pettingzoo.ParallelEnv. options: "start", the number of a start; "overrides", a dict merged into the scene from now on; "state",
        of `save`, to begin in its midst. Raises InputError."""
        options, first = options or {}, self._envs[0]
        unknown = set(options) - {"start", "overrides", "state", "options"}  # the last is what PettingZoo's test gives
        if unknown:
            raise InputError(f"options: {sorted(unknown)[0]!r} is unknown; must be 'start', 'overrides' or 'state'")
        bodies = [{"actuators": count, "slices": env.least_slices} for count, env in zip(self._all, self._envs)]
        if options.get("overrides") is not None:
            self._stream.ask({"do": "overrides", "overrides": plain("overrides", options["overrides"]), "bodies": bodies})
            self._senses = None  # of another scene, until it begins anew
        if seed is not None or self.np_random is None:
            self.np_random, _ = gymnasium.utils.seeding.np_random(seed)
        start = int(self.np_random.integers(first.starts))
        if options.get("start") is not None:
            start = options["start"]
        if options.get("state") is not None:
            self._stream.restore(options["state"], bodies)
        else:
            self._stream.reset(start)
        for k, env in enumerate(self._envs):
            env.take_body()
            if env.by_gait:
                self._stream.set_gait(env.gait, swimmer=k)
            env._point = None if env.target is None or self._leader[k] is not None else self.np_random.uniform(*env.target)
            senses = self._stream.sense(flow=env._places, target=env._point, swimmer=k)
        self._take(senses)
        if self._views:
            self._views.restart(self._stream, options.get("state") is None)
        self._began, self.agents = senses.time, list(self.possible_agents)
        self._work, self._action = [np.nan_to_num(one.work) for one in self._senses], [env._rest() for env in self._envs]
        return {agent: self._observation(k) for k, agent in enumerate(self.agents)}, {agent: env._info() for agent, env in self._of(self.agents)}

    def save(self):
        """The present moment as bytes, for resets to begin at."""
        return self._stream.save()

    def step(self, actions):
        """As of pettingzoo.ParallelEnv: an action for each of `agents`. Raises InputError, and nothing was simulated."""
        if self._senses is None:
            raise gymnasium.error.ResetNeeded("step before the first reset")
        if not isinstance(actions, Mapping):
            raise InputError(f"actions = {actions!r}: must be a dict, by agent")
        if set(actions) != set(self.agents):
            wrong = sorted(set(actions) ^ set(self.agents), key=str)[0]
            raise InputError(f"actions: {wrong} {'is missing' if wrong in self.agents else 'swims no more, or never did'}: must be of "
                             f"{', '.join(self.agents) or 'nobody, before the next reset'}")
        if not self.agents:
            return {}, {}, {}, {}, {}
        after = []
        for agent, env in self._of(self.possible_agents):
            try:
                after.append(env.checked(actions[agent]) if agent in actions else env._slack())
            except InputError as error:
                raise InputError(f"{agent}: {error}") from None
        before, unstable, steps = self._senses, False, []
        for env, old, new in zip(self._envs, self._action, after):
            steps.append(env.rows_to(old, new))
        try:
            self._take(self._stream.step(**self._driven(steps)))
        except Unstable:
            unstable = True
        self._action = after
        told = {}
        for agent, env in self._of(self.agents):
            k = self.possible_agents.index(agent)
            told[agent] = self._outcome(k, before[k], self._senses[k], unstable)
        self.agents = [agent for agent in self.agents if not (told[agent][2] or told[agent][3])]
        return tuple({agent: one[i] for agent, one in told.items()} for i in range(5))

    def _driven(self, steps):
        """What drives all in each frame: drives where all are driven, else scales and offsets of their gaits."""
        if not any(env.by_gait for env in self._envs):
            return {"drive": np.hstack(steps)}
        halves = [np.split(rows, 2, axis=1) if env.by_gait else (np.zeros_like(rows), rows) for env, rows in zip(self._envs, steps)]
        return dict(zip(("scale", "offset"), map(np.hstack, zip(*halves))))

    def _outcome(self, k, before, now, unstable):
        """Observation, reward, whether it is terminated or truncated, and info of a step."""
        env = self._envs[k]
        work, self._work[k] = np.nan_to_num(now.work) - self._work[k], np.nan_to_num(now.work)
        reward, there = env.outcome(before, now, work, env.length)
        there = bool(there) and self._leader[k] is None
        late = now.time - self._began >= env.duration - 1e-9
        info = env._info() | {"unstable": unstable, "reached": there}
        return self._observation(k), float(reward), bool(unstable or there or now.touches_plane), bool(late), info

    def _take(self, senses):
        """Keeps what each senses now, with the way to the one that it follows."""
        self._senses = all_ = [replace(senses, companions=()), *senses.companions]
        for k, leader in enumerate(self._leader):
            if leader is not None:
                way = all_[leader].centre - all_[k].centre
                size = float(np.linalg.norm(way))
                all_[k] = replace(all_[k], target=_along(all_[k], way / size), target_distance=size)
        for env, own in zip(self._envs, self._senses):
            env._senses = own

    def _observation(self, k):
        """That of a SwimmerEnv; then place, velocity and heading of others, 3 each, in body lengths and s."""
        own, length = self._senses[k], self._envs[k].length
        seen = sorted((float(np.linalg.norm(other.centre - own.centre)), i) for i, other in enumerate(self._senses) if i != k)
        parts = [self._envs[k].observed(own, length)]
        for _, i in seen[:self._seen]:
            other = self._senses[i]
            parts += [_along(own, other.centre - own.centre) / length,
                      (_along(own, _over_ground(other)) - own.velocity) / length, _along(own, other.forward)]
        return np.clip(np.concatenate(parts), -LARGEST, LARGEST).astype(np.float32)

    def _of(self, agents):
        return [(agent, env) for agent, env in zip(self.possible_agents, self._envs) if agent in agents]

    def render(self):
        """The swimmers from above and from the side, swimmer-0 in the middle: height × width × 3 bytes; None without a render_mode."""
        if self._views is None:
            return None
        if self._senses is None:
            raise gymnasium.error.ResetNeeded("render before the first reset")
        return self._views.pixels(self._stream.frame.position, self._senses[0], self._envs[0].target is not None)

    def close(self):
        """Ends its program."""
        self._stream.close()


def _along(senses, vector):
    """A vector along a swimmer's own axes."""
    return np.stack([senses.forward, senses.up, senses.right]) @ vector


def _over_ground(senses):
    """Its velocity, along the scene's axes."""
    return senses.velocity @ np.stack([senses.forward, senses.up, senses.right])


class _Swimmer:
    """One of a stream's swimmers, in place of a Stream of its own."""

    def __init__(self, stream, number):
        self._stream, self._number = stream, number

    @property
    def scene(self):
        return {**self._stream.scene, **self._stream.swimmers[self._number]}

    @property
    def actuators(self):
        return self._stream.all_actuators[self._number]

    def set_gait(self, gait):
        self._stream.set_gait(as_json(gait), swimmer=self._number)

    def sense(self, **what):
        return self._stream.sense(**what, swimmer=self._number)

    def close(self):
        """Does nothing: the stream is the environment's."""
