"""How a recorded body moves: its spine, how it lies, and which fish it is like (thesis 2.8, eqs. 2.12 to 2.16); the water's vorticity about it.

Frames come first in every array. x points forwards, y up, z right; lengths are scene units, times seconds, angles radians."""
import math

import numpy as np

WAVE_NUMBERS = (9.8, 7.0, 5.7)  # of an eel, a mackerel and a tuna
PLACES = 1001  # along the spine
CELL, REACH = 0.09, 0.15  # of the grid on which velocities are; how far a particle counts, and how thick the layer is to either side


def amplitude(fish, x, length, frequency):
    """a(x), the envelope of a real fish."""
    s = x / length
    return length * (0.1 * np.exp(s - 1), frequency * (0.004 - 0.02 * s + 0.04 * s * s), 0.02 - 0.12 * s + 0.2 * s * s)[fish]


def lateral(fish, x, time, length, frequency):
    """z(x, t), the spine of a real fish."""
    return amplitude(fish, x, length, frequency) * np.sin(WAVE_NUMBERS[fish] * x / length - 2 * np.pi * frequency * time)


def slices(particles):
    """Centres of a body's slices: particles that have the same x, to half the spacing, in the settled start."""
    x = particles[0, :, 0]
    ends = np.flatnonzero(np.abs(np.diff(x)) > (x[0] - x[-1]) / len(x)) + 1
    return np.stack([one.mean(axis=1) for one in np.split(particles, ends, axis=1)], axis=1)


def attitude(particles):
    """Roll, yaw and pitch of every frame against the first: by θ about x, ρ about y and ω about z, by least squares (Kabsch 1976)."""
    start = particles[0] - particles[0].mean(axis=0)
    angles = []
    for now in particles:
        u, _, vt = np.linalg.svd((now - now.mean(axis=0)).T @ start)
        r = u @ np.diag([1, 1, np.sign(np.linalg.det(u) * np.linalg.det(vt))]) @ vt
        angles.append((math.atan2(r[2, 1], r[2, 2]), -math.asin(max(-1, min(1, r[2, 0]))), math.atan2(r[1, 0], r[0, 0])))
    return np.array(angles)


def unrolled(spine, roll):
    """Each frame turned back about x: sideways is then the body's own side, also where it has tipped over."""
    c, s = np.cos(roll)[:, None], np.sin(roll)[:, None]
    return np.stack([spine[..., 0], c * spine[..., 1] + s * spine[..., 2], c * spine[..., 2] - s * spine[..., 1]], axis=-1)


class Swimming:
    """The sideways motion z(x, t) of a spine, free of its travel and heading: each frame's line of best fit is parallel to x, the head at x = 0."""

    def __init__(self, spine):
        self.length = float(np.linalg.norm(np.diff(spine[0], axis=0), axis=1).sum())
        x, z = -spine[..., 0], spine[..., 2]
        x, z = x - x.mean(axis=1, keepdims=True), z - z.mean(axis=1, keepdims=True)
        angle = 0.5 * np.arctan2(2 * (x * z).sum(axis=1), (x * x - z * z).sum(axis=1))
        angle += np.pi * ((x[:, -1] - x[:, 0]) * np.cos(angle) + (z[:, -1] - z[:, 0]) * np.sin(angle) < 0)
        c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
        self.x, self.z = x * c + z * s, z * c - x * s
        self.x = self.x - self.x[:, :1]
        # The shortest that the bent spine gets: its motion is known at all times up to there.
        self.measured = max(float(self.x[:, -1].min()), self.length / 10)

    def at(self, places):
        """z of every frame by linear interpolation; where the spine folds back, the part nearest the head counts."""
        found = np.empty((len(self.x), len(places)))
        for frame, (x, z) in enumerate(zip(self.x, self.z)):
            after = np.searchsorted(np.maximum.accumulate(x), places)
            i = np.clip(after, 1, len(x) - 1)
            share = (places - x[i - 1]) / (x[i] - x[i - 1])
            found[frame] = np.where(places <= x[0], z[0], np.where(after >= len(x), z[-1], z[i - 1] + (z[i] - z[i - 1]) * share))
        return found

    def envelope(self, places):
        """The largest size of z at each of the places, length."""
        return np.abs(self.at(places)).max(axis=0)


def fit(swimming, times, fish, frequency):
    """The best fit to a fish, a dict: error e = mean over t and x of √(x/L) ((z_r(x, t) − α z_s(x, t + β)) / a_r(x))², least over α ≥ 0 and β by
    steps of 0.01; none, the e of a spine that does not move."""
    places, length, swim = np.linspace(0, swimming.measured, PLACES), swimming.length, None
    swim = swimming.at(places)
    weight = np.sqrt(places / length) / amplitude(fish, places, length, frequency) ** 2
    # With the real spine now and a quarter of a beat later all sums over t and x are taken once: e(α, β) = A(β) − 2 α B(β) + α² C.
    sine, cosine = (lateral(fish, places, times[:, None] - shift, length, frequency) for shift in (0, 0.25 / frequency))
    ss, sc, cc, sz, cz, zz = ((weight * a * b).sum() for a, b in ((sine, sine), (sine, cosine), (cosine, cosine), (sine, swim), (cosine, swim),
                                                                  (swim, swim)))
    beta = np.arange(0, math.ceil(100 / frequency - 1e-9)) * 0.01
    c, s = np.cos(2 * np.pi * frequency * beta), np.sin(2 * np.pi * frequency * beta)
    product = c * sz + s * cz
    alpha = np.maximum(0, np.floor(product / zz / 0.01 + 0.5) * 0.01) if zz else np.zeros_like(beta)
    errors = (c * c * ss + 2 * c * s * sc + s * s * cc - 2 * alpha * product + alpha * alpha * zz) / swim.size
    best = int(np.argmin(errors))
    return {"error": max(float(errors[best]), 0.0), "alpha": float(alpha[best]), "beta": float(beta[best]), "none": float((ss + cc) / 2 / swim.size)}


def moved(times, particles, frequency, under_water):
    """What a row of motions.jsonl has of a recorded run; under_water: of the body, halfway, or None."""
    spine, angles, centre = slices(particles), attitude(particles), particles.mean(axis=1)
    swimming, upright = Swimming(spine), Swimming(unrolled(spine, angles[:, 0]))
    time, names = float(times[-1] - times[0]), ("ANGUILLIFORM", "CARANGIFORM", "THUNNIFORM")
    fits, of_body = ([{"mode": name, **fit(one, times, fish, frequency)} for fish, name in enumerate(names)] for one in (swimming, upright))
    row = {"simulated": time, "speed": float(centre[-1, 0] - centre[0, 0]) / time, "bodyLength": swimming.length,
           "tailSwing": float(upright.envelope(np.array([upright.measured]))[0]) / swimming.length, "fits": fits, "fitsOfBody": of_body,
           "end": dict(zip(("roll", "yaw", "pitch"), map(float, angles[-1]))), "largestYaw": float(np.abs(angles[:, 1]).max()),
           "heights": [float(centre[0, 1]), float(centre[-1, 1])], "measuredPart": upright.measured / swimming.length}
    return row if under_water is None else {**row, "underWater": under_water}


def share_below(fluid, body):
    """Share of the body's particles below the water's level, the median of the uppermost particles of all columns; None without water."""
    if not len(fluid):
        return None
    width = 2 * np.cbrt(np.prod(np.maximum(np.ptp(fluid, axis=0), 1e-6)) / len(fluid))
    tops = {}
    for column, height in zip(map(tuple, np.floor(fluid[:, [0, 2]] / width).astype(int)), fluid[:, 1]):
        tops[column] = max(tops.get(column, height), height)
    level = sorted(tops.values())[len(tops) // 2]
    return float((body[:, 1] < level).mean())


def flow(time, fluid, velocity, body, view):
    """Velocity of the water in a plane through the swimmer, from "ABOVE" or the "SIDE", on a grid: in each cell the mean of particles near it."""
    axes, depth = ((0, 2), 1) if view == "ABOVE" else ((0, 1), 2)
    near = np.abs(fluid[:, depth] - body[:, depth].mean()) <= REACH
    place, speed = fluid[near][:, axes], velocity[near][:, axes]
    low = place.min(axis=0)
    size = 1 + np.floor((place.max(axis=0) - low) / CELL + 0.5).astype(int)
    total = np.zeros((*size, 3))
    cell, around = np.floor((place - low) / CELL + 0.5).astype(int), range(-math.ceil(REACH / CELL), math.ceil(REACH / CELL) + 1)
    for step in ((i, k) for i in around for k in around):
        at = cell + step
        distance = np.linalg.norm(place - low - at * CELL, axis=1)
        counts = ((at >= 0) & (at < size)).all(axis=1) & (distance < REACH)
        weight = (1 - distance[counts] / REACH) ** 2
        np.add.at(total, tuple(at[counts].T), np.column_stack([weight[:, None] * speed[counts], weight]))
    cells = [[[float(a / w), float(b / w)] if w > 0 else None for a, b, w in column] for column in total]
    return {"view": view, "time": time, "origin": low.tolist(), "velocity": cells, "body": body[:, axes].tolist()}


def velocity(field):
    """Of a flow, an array with NaN where there is no water."""
    return np.array([[[math.nan] * 2 if one is None else one for one in column] for column in field["velocity"]], dtype=float)


def vorticity(field):
    """About the axis that points at the viewer, positive against the clock as the picture is seen, in 1/s, by central differences (one-sided at
    the water's edge); NaN where a neighbour that it takes is missing."""
    v = velocity(field)

    def slope(of, axis):
        of = np.moveaxis(of, axis, 0)
        edge = np.full_like(of[:1], math.nan)
        after, before = np.concatenate([of[1:], edge]), np.concatenate([edge, of[:-1]])
        count = 2.0 - np.isnan(after) - np.isnan(before)
        ends = np.where(np.isnan(after), of, after) - np.where(np.isnan(before), of, before)
        return np.moveaxis(np.where((count == 0) | np.isnan(of), math.nan, ends / (CELL * np.maximum(count, 1))), 0, axis)

    turns = slope(v[..., 1], 0) - slope(v[..., 0], 1)
    return -turns if field["view"] == "ABOVE" else turns


def wake(field):
    """Mean magnitude of the vorticity about a swimmer that faces +x, seen from above: within a quarter of a body length of its foremost point and
    of its rearmost, and from half a length to a whole one behind that (NaN without water there)."""
    body, turns = np.array(field["body"]), np.abs(vorticity(field))
    rear, front, side = body[:, 0].min(), body[:, 0].max(), body[:, 1].mean()
    length = front - rear
    x, z = (field["origin"][axis] + CELL * np.arange(turns.shape[axis]) for axis in (0, 1))
    beside = np.abs(z - side) <= length / 4

    def mean(low, high):
        there = turns[np.ix_((x >= low) & (x <= high), beside)]
        return float(np.nanmean(there)) if np.isfinite(there).any() else math.nan

    return mean(front - length / 4, front + length / 4), mean(rear - length / 4, rear + length / 4), mean(rear - length, rear - length / 2)
