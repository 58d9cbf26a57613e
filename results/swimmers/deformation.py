#!/usr/bin/env python3
"""All that a soft body does in a beat, as `deformation` of a file of references/swimmers: `deformation.py BEAT SPACING NAME=TRAJECTORY …` reads what
`natator-sim run SCENE --trajectory FILE --particles` wrote, takes the body's rigid motion off, and fits the last two beats (BEAT, s; SPACING of the body's particles) by
Chebyshev polynomials of x and powers of y and z of the place at rest times 1, cos and sin of once and twice a beat. Writes the variants as JSON, and to standard error how far off the fit is."""
import json
import sys

import numpy as np

POWERS = [(i, j, k) for i in range(9) for j in range(3) for k in range(2)]


def read(path):
    rows = np.loadtxt(path, delimiter=",", skiprows=1, usecols=(0, 1, 3, 4, 5))
    frames = np.unique(rows[:, 0])
    rows = rows.reshape(len(frames), -1, 5)
    return rows[:, 0, 1], rows[:, :, 2:]


def without_rigid_motion(places, rest):
    """By Kabsch's fit of the rest positions, each frame."""
    result = []
    for x in places:
        u, _, v = np.linalg.svd((x - x.mean(0)).T @ (rest - rest.mean(0)))
        turn = v.T @ np.diag([1, 1, np.linalg.det(v.T @ u.T)]) @ u.T
        result.append((x - x.mean(0)) @ turn.T + rest.mean(0))
    return np.array(result)


def fit(path, beat, spacing):
    times, places = read(path)
    rest = places[0]
    length = np.ptp(rest[:, 0]) + spacing
    middle = (rest.max(0) + rest.min(0)) / 2
    nose = np.array([rest[:, 0].max() + spacing / 2, middle[1], middle[2]])
    size = np.ptp(rest, axis=0) + spacing
    last = times > times[-1] - 2 * beat + 1e-9
    moved = without_rigid_motion(places[last], rest) - rest
    phase = 2 * np.pi * times[last] / beat
    in_time = np.array([np.ones_like(phase), np.cos(phase), np.sin(phase), np.cos(2 * phase), np.sin(2 * phase)]).T
    at = (rest - nose) / length
    along = np.polynomial.chebyshev.chebvander(1 + 2 * at[:, 0], 8)
    in_place = np.array([along[:, i] * at[:, 1] ** j * at[:, 2] ** k for i, j, k in POWERS]).T
    # moved[t, p, a] = sum in_time[t, n] in_place[p, m] by[n, m, a]
    by = np.einsum("nt,tpa->npa", np.linalg.pinv(in_time), moved / length)
    by = np.einsum("mp,npa->nma", np.linalg.pinv(in_place, rcond=1e-12), by)
    off = moved / length - np.einsum("tn,pm,nma->tpa", in_time, in_place, by)
    moving = moved / length - moved.mean(0) / length
    print(f"{path}: {size.round(4)}, moves by {moving.std():.4f}, off by {off.std():.4f} lengths", file=sys.stderr)
    return [[*power, *by[:, m].ravel().round(5)] for m, power in enumerate(POWERS)]


if __name__ == "__main__":
    beat, spacing = map(float, sys.argv[1:3])
    print(json.dumps({name: {"deformation": fit(path, beat, spacing)} for name, path in (one.split("=", 1) for one in sys.argv[3:])}))
