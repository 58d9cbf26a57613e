"""Gymnasium environments of a swimmer in the closed loop; importing this registers "natator/Swimmer-v0"."""

import contextlib

import gymnasium
import numpy as np
from gymnasium import spaces
from gymnasium.vector import AutoresetMode
from gymnasium.vector.utils import batch_space

from natator.batch import DRIVE, MAX_SWIMS, STEER, UNSTABLE, Batch
from natator.errors import InputError, ProgramError, Unstable
from natator.gait import as_json, number, rows, wave_in, whole
from natator.plain import plain
from natator.stream import SIDES, Senses, Stream, pairs
from natator.swimming import Views


class SwimmerEnv(gymnasium.Env):
    """One swimmer. README.md has the table of observations, actions and rewards.

    scene: name or path, with a creature that has muscles. actions: "drive" (values of the actuators) or "gait" (changes of
    `gait`, by default a wave from head to tail). frames: of the scene that an action takes. duration: of an episode, s.
    starts: how many starts of the scene resets draw from. flow: places of the skin as (slice, side), or a number of
    slices, evenly from head to tail, both sides of each. target: None (the reward is progress along x), a point, or a
    box (low, high) that each reset draws one from (the reward is coming nearer). reached: at this distance, in body lengths,
    an episode with a target ends. work_cost: taken off the reward per unit of work, mass length²/s², in all schemes but flex.
    render_mode: None, or "rgb_array", whose pictures gymnasium.make shows in a window for "human"; needs Pillow.
    options: those of Stream, such as overrides, scheme, arguments, program. swim: one of a Batch of the scene, in place of a
    program of its own.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 20}

    def __init__(self, scene="pool/tadpole", actions="drive", gait=None, frames=3, duration=4.0, starts=16, flow=3,
                 target=None, reached=0.25, work_cost=0.0, render_mode=None, swim=None, **options):
        unknown = options.keys() - (OF_STREAM if swim is None else ())
        if unknown:
            raise InputError(f"{min(unknown)}: is no argument of an environment")
        if actions not in ("drive", "gait"):
            raise InputError(f'actions = {actions!r}: must be "drive" or "gait"')
        if gait is not None and actions == "drive":
            raise InputError('gait: must be left out where actions are "drive", which move the muscles by themselves')
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise InputError(f'render_mode = {render_mode!r}: must be None or "rgb_array"')
        self.render_mode, self._clipped = render_mode, False
        self.frames = _at_most(MAX_FRAMES, "frames", whole("frames", frames, 1))
        self.starts = _at_most(MAX_STARTS, "starts", whole("starts", starts, 1))
        self.duration = _at_least(0, "duration", duration)
        if self.duration == 0:
            raise InputError("duration = 0: must be more than 0 s")
        self.target, self.reached = _box_of(target), _at_least(0, "reached", reached)
        self.work_cost = _at_least(0, "work_cost", work_cost)
        self._stream = swim or Stream(scene, fields=fields_of(render_mode), **options)
        try:
            self._prepare(actions, gait, flow)
        except BaseException:
            self._stream.close()
            raise

    def _prepare(self, actions, gait, flow):
        stream = self._stream
        self.actuators, self.length = stream.actuators, stream.scene["bodyLength"]
        if self.actuators == 0:
            raise InputError(f"scene \"{stream.scene['scene']}\": must have a creature with actuators")
        if self.work_cost > 0 and stream.scene["scheme"] == "flex":
            raise InputError(f"work_cost = {self.work_cost:g}: must be 0 in scheme flex, which knows no work")
        _check_in_tank(self.target, stream.scene)
        self.by_gait = actions == "gait"
        self.gait = None
        if self.by_gait:
            self.gait = as_json(gait if gait is not None else wave_in(stream.scene))
            stream.set_gait(self.gait)
            _check_room(self.gait)
        self._flow = flow
        self._places = places_of(flow, len(stream.scene["slices"]))
        #: slices that the places need of any body
        self.least_slices = int(flow if np.ndim(flow) == 0 else 1 + max((place for place, _ in self._places), default=-1))
        stream.sense(flow=self._places)
        self._senses, self._work, self._action, self._began = None, 0.0, self._rest(), 0.0
        size = 9 + 2 * self.actuators + 3 * len(self._places) + 2 * self.by_gait + 4 * (self.target is not None)
        self.observation_space = spaces.Box(-LARGEST, LARGEST, (size,), np.float32)
        self.action_space = spaces.Box(-1, 1, (self.actuators * (2 if self.by_gait else 1),), np.float32)
        self.metadata = {**self.metadata, "render_fps": 1 / (self.frames * stream.scene["timeStep"])}
        self._views = Views(stream.scene, stream.frame.position) if self.render_mode else None

    @property
    def _bodies(self):
        """What bodies must keep."""
        return [{"actuators": count, "slices": 0 if k else self.least_slices} for k, count in enumerate(self.all_actuators)]

    @property
    def all_actuators(self):
        """How many each swimmer of the scene has: this one, then its companions."""
        return self._stream.all_actuators

    def reset(self, *, seed=None, options=None):
        """As of gymnasium.Env. options: "start", the number of a start; "overrides", a dict merged into the scene from now on (null
        removes a key); "state", of `save`, to begin in its midst. Raises InputError."""
        self.begin_overrides(options)
        self.end_overrides(options)
        self.begin_reset(seed, options)
        return self.end_reset()

    def save(self):
        """The present moment as bytes, for resets to begin at."""
        return self._stream.save()

    def begin_overrides(self, options=None):
        """Begins what `reset` does first, without waiting for the simulator."""
        unknown = set(options or {}) - {"start", "overrides", "state"}
        if unknown:
            raise InputError(f"options: {sorted(unknown)[0]!r} is unknown; must be 'start', 'overrides' or 'state'")
        if (options or {}).get("start") is not None:
            _at_most(MAX_STARTS - 1, "start", whole("start", options["start"], 0))
        self._stream.require_idle()
        if (options or {}).get("overrides") is not None:
            self._stream.send({"do": "overrides", "overrides": plain("overrides", options["overrides"]), "bodies": self._bodies})

    def end_overrides(self, options=None):
        """Waits for it. Raises InputError."""
        if (options or {}).get("overrides") is not None:
            self._stream.receive()
            self._senses = None  # of another scene, until it begins anew
            self.take_body()

    def take_body(self):
        """What overrides or a state may have changed."""
        self.length = self._stream.scene["bodyLength"]
        self._places = places_of(self._flow, len(self._stream.scene["slices"]))

    def begin_reset(self, seed=None, options=None):
        """Begins the rest of a `reset`."""
        options = options or {}
        super().reset(seed=seed)
        self._state = options.get("state")
        if self._state is None:
            start = options.get("start")
            self._stream.begin_reset(int(self.np_random.integers(self.starts)) if start is None else start)
        self._next_point = None
        if self.target is not None:
            self._next_point = self.np_random.uniform(*self.target)
        if self._state is None:
            self._stream.begin_sense(flow=self._places, target=self._next_point)  # overrides may have made it forget

    def end_reset(self):
        """Waits for a reset that was begun; returns observation and info."""
        if self._state is None:
            refusal = None
            try:
                self._stream.receive()
            except InputError as error:
                refusal = error
            senses = self._stream.end_sense()  # its answer comes in any case
            if refusal:
                raise refusal
            self._stream.take_first_frame()
        else:
            self._stream.restore(self._state, self._bodies)
            self.take_body()
            if self.by_gait:
                self._stream.set_gait(self.gait)
            senses = self._stream.sense(flow=self._places, target=self._next_point)
        self._senses, self._point = senses, self._next_point
        if self._views:
            self._views.restart(self._stream, self._state is None)
        self._action = self._rest()
        self._began, self._work = self._senses.time, np.nan_to_num(self._senses.work)
        return self._observation(), self._info()

    def step(self, action):
        """As of gymnasium.Env. Raises InputError for an action of another shape."""
        action = self.checked(action)
        self._stream.require_idle()
        rows = self.rows_to(self._action, action)
        self._action = action
        before, unstable = self._senses, False
        try:
            self._senses = self._stream.step(**({"scale": rows[:, :self.actuators], "offset": rows[:, self.actuators:]} if self.by_gait
                                                else {"drive": rows}))
        except Unstable:
            unstable = True
        now = self._senses
        work, self._work = np.nan_to_num(now.work) - self._work, np.nan_to_num(now.work)
        reward, there = self.outcome(before, now, work, self.length)
        info = self._info() | {"unstable": unstable, "reached": bool(there)}
        late = now.time - self._began >= self.duration - 1e-9
        return self._observation(), float(reward), bool(unstable or there or now.touches_plane), bool(late), info

    # Of one swimmer, or of several: then senses, actions and lengths have a row for each.

    def rows_to(self, before, action):
        """What the muscles get in each frame of a step from one action to the next: drives, or scales and offsets."""
        parts = np.arange(1, self.frames + 1)[:, None] / self.frames
        rows = before[..., None, :] + parts * (action - before)[..., None, :]
        if not self.by_gait:
            return rows
        scale, offset = np.split(rows, 2, axis=-1)
        return np.concatenate([(1 + scale) / 2, LARGEST_OFFSET * offset], axis=-1)

    def outcome(self, before, now, work, length):
        """The reward of a step, and whether the target is reached."""
        way = before.target_distance - now.target_distance if self.target is not None else now.distance - before.distance
        there = self.target is not None and now.target_distance <= self.reached * length
        return way / length - self.work_cost * work, there

    def observed(self, senses, length):
        """The observation."""
        length = np.asarray(length)[..., None]
        flow = (senses.flow / length[..., None]).reshape(*senses.flow.shape[:-2], -1)
        vertical = np.stack([senses.forward[..., 1], senses.up[..., 1], senses.right[..., 1]], axis=-1)
        parts = [senses.velocity / length, senses.turn_rate, vertical, senses.drive, senses.bend, flow]
        if self.by_gait:
            turns = 2 * np.pi * self.gait["frequency"] * np.asarray(senses.time)[..., None]
            parts += [np.sin(turns), np.cos(turns)]
        if self.target is not None:
            parts += [senses.target, np.asarray(senses.target_distance)[..., None] / length]
        return np.clip(np.concatenate(parts, axis=-1), -LARGEST, LARGEST).astype(np.float32)


    def checked(self, action):
        """An action that can be taken: what is beyond [-1, 1] is clipped, with a warning the first time. Raises InputError."""
        if self._senses is None:
            raise gymnasium.error.ResetNeeded("step before the first reset")
        action = rows("action", action)
        if action.shape != self.action_space.shape or not np.all(np.isfinite(action)):
            raise InputError(f"action {action.tolist()}: must be {self.action_space.shape[0]} numbers in [-1, 1]")
        within = np.clip(action, -1, 1)
        if not self._clipped and np.any(within != action):
            self._clipped = True
            gymnasium.logger.warn(f"action {action.tolist()} is clipped to [-1, 1], as all are from now on")
        return within

    def render(self):
        """The body from above and from the side, and the target: height × width × 3 bytes; None without a render_mode."""
        if self._views is None:
            return None
        if self._senses is None:
            raise gymnasium.error.ResetNeeded("render before the first reset")
        return self._views.pixels(self._stream.frame.position, self._senses, self._point is not None)

    def close(self):
        """Ends its program."""
        self._stream.close()

    def _rest(self):
        """The action at the start: muscles at rest, or the gait as it is."""
        rest = np.zeros(self.actuators)
        return np.concatenate([rest + 1, rest]) if self.by_gait else rest

    def _slack(self):
        """The action that leaves the muscles at rest."""
        return np.concatenate([np.full(self.actuators, -1.0), np.zeros(self.actuators)]) if self.by_gait else np.zeros(self.actuators)

    def _observation(self):
        return self.observed(self._senses, self.length)

    def _info(self):
        senses = self._senses
        return {"time": senses.time, "distance": senses.distance, "work": float(np.nan_to_num(senses.work)),
                "centre": senses.centre}


class SwimmerVectorEnv(gymnasium.vector.VectorEnv):
    """Swimmers side by side in one program. Arguments are those of SwimmerEnv, and the bits are those of so many of these. threads:
    how many swim at a time, by default as many as there are processors. autoreset_mode: when an environment whose
    episode has ended begins anew, one of gymnasium.vector.AutoresetMode: with the next step, with the same one (its last
    observation and info are infos["final_obs"] and infos["final_info"]), or by reset(options={"reset_mask": …}) alone."""

    metadata = {"render_modes": ["rgb_array"], "autoreset_mode": AutoresetMode.NEXT_STEP}

    def __init__(self, num_envs=1, autoreset_mode=AutoresetMode.NEXT_STEP, threads=None, scene="pool/tadpole", render_mode=None,
                 **arguments):
        _at_most(MAX_SWIMS, "num_envs", whole("num_envs", num_envs, 1))
        try:
            self.autoreset_mode = AutoresetMode(autoreset_mode)
        except ValueError:
            raise InputError(f"autoreset_mode = {autoreset_mode!r}: must be one of "
                             f"{', '.join(mode.value for mode in AutoresetMode)}") from None
        own = {key: arguments.pop(key) for key in list(arguments) if key in OF_STREAM}

        def start():
            batch = Batch(scene, num_envs, threads, fields=fields_of(render_mode), **own)
            try:
                return batch, [SwimmerEnv(scene, render_mode=render_mode, swim=swim, **arguments) for swim in batch.swims]
            except BaseException:
                batch.close()
                raise

        self._start = start
        self._batch, self.envs = start()
        self.num_envs, first = num_envs, self.envs[0]
        self.render_mode = first.render_mode
        self.metadata = {**first.metadata, "autoreset_mode": self.autoreset_mode}
        self.single_observation_space, self.single_action_space = first.observation_space, first.action_space
        self.observation_space = batch_space(first.observation_space, num_envs)
        self.action_space = batch_space(first.action_space, num_envs)
        self._over, self._observations, self._clipped = np.zeros(num_envs, bool), None, False
        # Of each swim: its senses and action, when its episode began, work before, and length of its body.
        self._now = self._action = self._began = self._work = self._length = None

    def reset(self, *, seed=None, options=None):
        """seed: one for each, or an int, which gives them seed, seed + 1 … options: those of SwimmerEnv, each for all or a list with
        one for each; and "reset_mask", booleans: which of them begin anew. Starts another program where theirs has ended, without the
        overrides of earlier resets. Raises InputError and ProgramError."""
        seeds = [None if one is None else whole("seed", one, 0) for one in seed] if isinstance(seed, (list, tuple)) else [
            None if seed is None else whole("seed", seed, 0) + i for i in range(self.num_envs)]
        if len(seeds) != self.num_envs:
            raise InputError(f"{len(seeds)} seeds: must be {self.num_envs}, one for each environment")
        if self._batch.is_lost():
            self._start_again()
        options = dict(options or {})
        mask = np.asarray(options.pop("reset_mask", np.ones(self.num_envs, bool)))
        if mask.shape != (self.num_envs,) or mask.dtype != bool or self._observations is None and not mask.all():
            raise InputError(f"options: reset_mask = {mask.tolist()}: must be {self.num_envs} booleans, all true the first time, and when the program has ended")
        chosen = np.flatnonzero(mask)
        for key, value in options.items():
            if isinstance(value, list) and len(value) != self.num_envs:
                raise InputError(f"options: {key} has {len(value)} values: must be {self.num_envs}, one for each environment")
        own = [{key: value[i] if isinstance(value, list) else value for key, value in options.items()} for i in range(self.num_envs)]
        with self._named():
            taken, errors = self._each(chosen, lambda i: self.envs[i].begin_overrides(own[i]), lambda i: self.envs[i].end_overrides(own[i]))
            first = self._observations is None
            infos, refused = self._reset(taken, lambda i: self.envs[i].begin_reset(seeds[i], own[i]), {})
        errors |= refused
        if errors and first:
            self._observations = None  # all are to be reset
        self._refuse(errors)
        return self._observations.copy(), infos

    def _start_again(self):
        """Another program for all environments, whose generators of random numbers stay."""
        generators, lost = [env.np_random for env in self.envs], self._batch
        self._batch, self.envs = self._start()
        lost.close()
        for env, generator in zip(self.envs, generators):
            env.np_random = generator
        self._over[:], self._observations = False, None

    @contextlib.contextmanager
    def _named(self):
        """Says whose program has ended."""
        try:
            yield
        except ProgramError as error:
            raise ProgramError(f"environments 0 to {self.num_envs - 1}: {error}") from error

    def _each(self, chosen, begin, end):
        """Begins something for all of these, then ends it. Returns what `end` gave, and errors, by environment."""
        begun, ended, errors = [], {}, {}
        for work, over in ((begin, chosen), (end, begun)):
            for i in over:
                try:
                    ended[i] = work(i)
                    if work is begin:
                        begun.append(i)
                except (InputError, Unstable) as error:
                    errors[i] = error
        return {i: told for i, told in ended.items() if i not in errors}, errors

    @staticmethod
    def _refuse(errors):
        for i, error in sorted(errors.items()):
            raise InputError(f"environment {i}: {error}") from None

    def _reset(self, chosen, begin, infos):
        """Resets these, which `begin` begins. Returns infos with theirs, and errors of those that must begin anew."""
        told, errors = self._each(chosen, begin, lambda i: self.envs[i].end_reset())
        self._over[list(told)], self._over[list(errors)] = False, True
        if self._observations is None:
            self._observations = np.zeros(self.observation_space.shape, np.float32)
        for i, (observation, info) in told.items():
            env, self._observations[i] = self.envs[i], observation
            now = env._senses.numbers()
            if self._now is None:
                self._now, self._action = np.zeros((self.num_envs, len(now))), np.zeros(self.action_space.shape)
                self._began, self._work, self._length = np.zeros((3, self.num_envs))
            self._now[i], self._action[i], self._began[i], self._work[i], self._length[i] = now, env._action, env._began, env._work, env.length
            infos = self._add_info(infos, info, i)
        return infos, errors

    def _begin_anew(self, over, infos):
        """Resets those that are over. Returns infos with theirs, and which have an unstable start. Raises InputError for others."""
        infos, errors = self._reset(np.flatnonzero(over), lambda i: self.envs[i].begin_reset(), infos)
        self._refuse({i: error for i, error in errors.items() if not isinstance(error, Unstable)})
        return infos, np.isin(np.arange(self.num_envs), list(errors))

    def step(self, actions):
        """As of gymnasium.vector.VectorEnv: a row of actions for each environment. One whose new start is unstable has ended again, and tries
        another with the next step. Raises InputError."""
        if not hasattr(actions, "__len__") or getattr(actions, "ndim", 1) == 0:
            raise InputError(f"actions = {actions}: must be {self.num_envs}, one for each environment")
        if len(actions) != self.num_envs:
            raise InputError(f"{len(actions)} actions: must be {self.num_envs}, one for each environment")
        if self.autoreset_mode == AutoresetMode.DISABLED and np.any(self._over):
            raise gymnasium.error.ResetNeeded(f"environment {np.flatnonzero(self._over)[0]} has ended: reset it by a reset_mask")
        actions = self._checked(actions)  # all, before anything is begun
        going, first = ~self._over, self.envs[0]
        with self._named():
            infos, failed = self._begin_anew(self._over, {})
            values = first.rows_to(self._action, actions)
            self._action[going] = actions[going]
            before, unstable = self._now, self._simulate(values, going)
        old, now = (Senses.from_numbers(senses, first.all_actuators) for senses in (before, self._now))
        work, self._work = np.nan_to_num(now.work) - self._work, np.nan_to_num(now.work)
        rewards, there = first.outcome(old, now, work, self._length)
        terminated, truncated = unstable | there | now.touches_plane, now.time - self._began >= first.duration - 1e-9
        self._observations[going] = first.observed(now, self._length)[going]
        for told in (rewards, terminated, truncated):
            told[~going] = 0
        terminated, unstable = terminated | failed, unstable | failed
        told = {"time": now.time, "distance": now.distance, "work": self._work, "centre": now.centre, "unstable": unstable,
                "reached": np.broadcast_to(there, unstable.shape)}
        self._over = terminated | truncated
        again = self._over & ~failed if self.autoreset_mode == AutoresetMode.SAME_STEP else np.zeros(self.num_envs, bool)
        now_told = (going | failed) & ~again
        for key, value in told.items():
            infos[key] = np.where(now_told.reshape(-1, *[1] * (value.ndim - 1)), value, infos.get(key, np.zeros_like(value)))
            infos[f"_{key}"] = now_told | infos.get(f"_{key}", False)
        for i in np.flatnonzero(again):
            last = {key: value[i].item() if value.ndim == 1 else value[i] for key, value in told.items()}
            infos = self._add_info(infos, {"final_obs": self._observations[i].copy(), "final_info": last}, i)
        with self._named():
            infos, _ = self._begin_anew(again, infos)
        return self._observations.copy(), rewards, terminated, truncated, infos

    def _simulate(self, values, going):
        """Takes those that go on to their next senses; returns which of them became unstable, whose senses stay."""
        try:
            status, now = self._batch.step(values, going, STEER if self.envs[0].by_gait else DRIVE)
        except InputError as error:
            raise InputError(str(error).replace("swim ", "environment ", 1)) from None
        unstable = status == UNSTABLE
        self._now = np.where((going & ~unstable)[:, None], now, self._now)
        return unstable

    def _checked(self, actions):
        """Clipped to what can be taken; those of environments that begin anew don't matter."""
        if self._observations is None:
            raise gymnasium.error.ResetNeeded("step before the first reset")
        try:
            given = np.asarray(actions)
            if given.dtype.kind not in "iuf":
                raise TypeError
            given = np.where(self._over[:, None], 0, given)
            wrong = np.flatnonzero(~np.all(np.isfinite(given), axis=1)) if given.shape == self.action_space.shape else [0]
        except (RuntimeError, TypeError, ValueError):  # RuntimeError: of tensors
            wrong, given = range(self.num_envs), list(actions)
        for i in wrong:
            try:
                given[i] = self.envs[i].checked(given[i])
            except InputError as error:
                raise InputError(f"environment {i}: {error}") from None
        actions = np.asarray(given, float)
        within = np.clip(actions, -1, 1)
        if not self._clipped and np.any(within != actions):
            self._clipped = True
            row = actions[np.flatnonzero(np.any(within != actions, axis=1))[0]]
            gymnasium.logger.warn(f"action {row.tolist()} is clipped to [-1, 1], as all are from now on")
        return within

    def render(self):
        """One picture for each environment; None without a render_mode."""
        for env, now in zip(self.envs, self._now if self._now is not None else ()):
            env._senses = Senses.from_numbers(now, env.all_actuators)
        return None if self.render_mode is None else tuple(env.render() for env in self.envs)

    def close_extras(self, **_):
        """Ends their program."""
        self._batch.close()


def fields_of(render_mode):
    """What frames have to hold for pictures."""
    return ("position",) if render_mode else ()


def places_of(flow, slices):
    """Places of the skin: as they are given, or both sides of so many slices, evenly from head to tail."""
    if not np.ndim(flow) == 0:
        return pairs("flow", flow)
    count = whole("flow", flow, 0)
    if count > slices:
        raise InputError(f"flow = {count}: must be at most the body's {slices} slices")
    along = np.linspace(0, slices - 1, count + 2)[1:-1] if count > 0 else []
    return [(int(round(at)), side) for at in along for side in SIDES[:2]]


def _at_least(least, name, value):
    if number(name, value) < least:
        raise InputError(f"{name} = {value}: must be at least {least}")
    return float(value)


def _at_most(most, name, value):
    if value > most:
        raise InputError(f"{name} = {value}: must be at most {most}")
    return value


def _check_room(gait):
    """Refuses a gait that some action would drive beyond what muscles can do: each action is to be one that can be taken."""
    offsets = gait.get("offset", [0.0] * len(gait["amplitude"]))
    for i, (amplitude, offset) in enumerate(zip(gait["amplitude"], offsets)):
        if amplitude + abs(offset) + LARGEST_OFFSET > LARGEST_DRIVE:
            raise InputError(f"gait: amplitude[{i}] and the size of its offset are {amplitude + abs(offset):g} together: must be at "
                             f"most {LARGEST_DRIVE - LARGEST_OFFSET:g}, as actions add up to {LARGEST_OFFSET:g}")


def _box_of(target):
    """A point, or (low, high), as (low, high)."""
    if target is None:
        return None
    corners = rows("target", target)
    if corners.shape not in ((3,), (2, 3)):
        raise InputError(f"target = {target}: must be a point of 3 numbers, or two corners of a box")
    if corners.ndim == 2 and np.any(corners[0] > corners[1]):
        raise InputError(f"target = {target}: the first corner must be the lower one along each axis")
    return (corners, corners) if corners.shape == (3,) else (corners[0], corners[1])


def _check_in_tank(box, scene):
    """Refuses a box of targets that lies beyond a wall across an axis, unless the wall goes along with the swimmer."""
    if box is None:
        return
    tank = scene["definition"].get("movingTank")
    moving = "" if tank is None else tank.get("along", "x")
    low, high = np.full(3, -np.inf), np.full(3, np.inf)
    for *normal, offset in scene["planes"]:
        across = np.flatnonzero(normal)
        if len(across) == 1 and "xyz"[across[0]] not in moving:
            axis, at = across[0], 0.0 - offset / normal[across[0]]
            ends, bound = (low, max) if normal[axis] > 0 else (high, min)
            ends[axis] = bound(ends[axis], at)
    for corner in box:
        if np.any(corner < low) or np.any(corner > high):
            limits = [name + (f" from {least:g}" if np.isfinite(least) else "") + (f" to {most:g}" if np.isfinite(most) else "")
                      for name, least, most in zip("xyz", low, high) if np.isfinite(least) or np.isfinite(most)]
            raise InputError(f"target = {corner.tolist()}: must be in the tank, {', '.join(limits)}")


OF_STREAM = {"overrides", "scheme", "start", "arguments", "program", "backend"}
LARGEST = 1000.0      # of an observation, beyond which it is cut
LARGEST_OFFSET = 0.5  # of a change of the gait
LARGEST_DRIVE = 2.0   # of an actuator, as the simulator has it
MAX_FRAMES = 1000    # of a step, as the simulator has it
MAX_STARTS = 2**31   # which the simulator counts from 0

gymnasium.register("natator/Swimmer-v0", entry_point="natator.gym:SwimmerEnv",
                   vector_entry_point="natator.gym:SwimmerVectorEnv")
