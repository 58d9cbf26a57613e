#!/usr/bin/env python3
"""The thesis in finer water: creatures 1 to 4 evolve in lakes of scheme `lattice`, and what is best swims again from starts that chose nothing.

    cd results/thesis; export PYTHONPATH=..:../../sim-native/python NATATOR_MOST_WORK=1e16      # after ./setup.sh --readers, with its Python
    python3 lake.py evolve | sh                             # run folders lake/EVOLUTION/seed-S
    python3 lake.py requests | natator-sim serve --backend cuda | python3 lake.py keep | gzip > lake/swims.jsonl.gz
    for one in 1 2 3 4; do python3 lake.py record creature-$one; done > lake/motions.jsonl
    ../redo.sh thesis                                       # tables/lake.csv, tables/lake-motions.csv and the page

So were the rows made on an H200, of seeds 1 to 3 by a build of commit 795659c5 that computes several lakes in one launch and rounds otherwise; their runs in vacuum,
`until walls` and mirrored, and recorded ones on a CPU; of creature 4's seed 6 and in wider lakes by version 0.2.0 on an H200."""
import csv
import gzip
import json
import pathlib
import statistics
import sys

import numpy as np

import lakes
import measured
import plan
from measured import Sample

HERE = pathlib.Path(__file__).resolve().parent
CELL = 0.025
LENGTH, HEIGHT = 2.85, 1.2  # of the tank, which goes along with its swimmer
# Of each evolution: the tank's width, where the body's rear is in it, whether touching a wall ends a run, and by which first seed how many evolved at once, for how long, s.
LAKES = {"creature-1": (1.2, 0.8, False, ((1, 3, 360), (4, 2, 200))), "creature-2": (1.8, 0.72, True, ((1, 3, 190), (4, 2, 200))),
         "creature-3": (1.2, 0.575, False, ((1, 3, 360), (4, 2, 200))), "creature-4": (1.2, 0.645, False, ((1, 3, 360), (4, 2, 200), (6, 1, 760))),
         "creature-2-between-walls": (1.2, 0.72, False, ((1, 3, 360),))}
# Of each condition: cells and steps so many times as fine, seconds, starts.
SWIMS = {"water": (1, 1, 2, range(101, 105)), "half step": (1, 2, 2, (101, 102)), "half cells": (2, 1, 2, (101, 102)), "mirrored": (1, 1, 2, (101, 102)), "resting": (1, 1, 2, (101,)), "longer": (1, 1, 4, (101,)),
         "vacuum": (1, 2, 2, (101,)), "until walls": (1, 1, 2, range(105, 109))}
UNTIL_WALLS = {"water": (1, 1, 4, range(1001, 1009)), "half step": (1, 2, 4, range(1001, 1009)), "half cells": (2, 1, 4, range(1001, 1005)), "mirrored": (1, 1, 4, (1001, 1002)),
               "resting": (1, 1, 4, (1001,)), "vacuum": (1, 2, 2, (101,))}
# All but those between walls swim in a lake half as wide again, too, till they touch a wall.
WIDER, WIDER_STARTS = 1.5, range(109, 113)
# Who mostly touches the walls of its lake within 2 s, though walls end no run of its evolution, is recorded in a wider one.
TOUCHES = {("creature-3", 5)}
# In words, conditions in which a speed has to last.
CONTROLS = {"half step": "at half the step", "half cells": "at half the cells and steps", "mirrored": "mirrored", "wider": "in a wider lake"}


def tank(evolution, finer=1, steps=1, seconds=2, until_walls=None, length=LENGTH, width=None):
    """Overrides of an evolution's scene. A longer tank is longer behind its swimmer."""
    own, rear, touching, _ = LAKES[evolution]
    return lakes.lake((length, HEIGHT, width or own), CELL / finer, round(rear + length - LENGTH, 6), steps, seconds, touching if until_walls is None else until_walls)


def scene(evolution):
    return "lake/" + evolution.removesuffix("-between-walls")


def gait(evolution, seed):
    return json.loads((HERE / f"lake/{evolution}/seed-{seed}/best.json").read_text(encoding="utf-8"))["gait"]


def swims():
    """(evolution, seed, condition, start) of each run, by its id."""
    return [(one, seed, condition, start) for one in LAKES for seed in seeds(one) for condition, (*_, starts) in asked_of(one).items() for start in starts]


def seeds(evolution):
    return [seed for first, count, _ in LAKES[evolution][3] for seed in range(first, first + count)]


def asked_of(evolution):
    asked = UNTIL_WALLS if LAKES[evolution][2] else SWIMS
    return asked | ({"wider": (*asked["water"][:3], WIDER_STARTS)} if not evolution.endswith("-between-walls") else {})


def requests():
    for number, (evolution, seed, condition, start) in enumerate(swims()):
        own, ends = gait(evolution, seed), condition in ("until walls", "wider")
        changes = tank(evolution, *asked_of(evolution)[condition][:3], until_walls=ends or None, width=round(WIDER * LAKES[evolution][0], 6) if condition == "wider" else None)
        if condition == "vacuum":
            changes |= {"fluid": None, "planes": [], "movingTank": None}
        own = {"resting": plan.resting, "mirrored": plan.mirrored}.get(condition, dict)(own)
        yield {"id": number, "scene": scene(evolution), "overrides": changes, "gait": own, "start": start}


def row(evolution, seed, condition, start, result):
    """What is kept of a run."""
    swim = {key: result["swimming"][key] for key in ("reynolds", "strouhal", "across") if key in (result.get("swimming") or {})}
    return {"evolution": evolution, "seed": seed, "condition": condition, "start": start, **{key: result[key] for key in ("status", "distance", "simulated", "stopped")},
            "swimming": swim}


def evolve(evolutions):
    """Commands, one a line."""
    for one in evolutions:
        for seed, count, seconds in LAKES[one][3]:
            yield (f"natator evolve --preset thesis --scene {scene(one)} --seed {seed} --seeds {count} --runs-at-once {count} --population 60 --generations 100 --starts 1 "
                   f"--simulator batch --backend cuda --stop-after {seconds} --output-dir lake/{one} --overrides '{json.dumps(tank(one))}'")


def record(evolution, seed):
    """How the body moves in 3 s, in a tank with room behind it, and beside it where walls are near: as natator.motion.moved has it, with how many body lengths the tail has gone, and the vorticity about
    the vertical in the body's plane, 1/s: the mean of its magnitude up to a quarter of a body length to each side, over the last beat, in the places of
    natator.motion.wake: about the foremost point, about the rearmost, and from half a length to a whole one behind that."""
    import natator
    from natator import motion
    own, times, bodies, wakes = gait(evolution, seed), [], [], []
    width = 2.4 if LAKES[evolution][2] or (evolution, seed) in TOUCHES else LAKES[evolution][0]
    overrides = tank(evolution, seconds=3, until_walls=False, length=LENGTH + 0.9, width=width)
    with natator.Stream(scene(evolution), gait=own, start=101, fields=("position",), overrides=overrides) as stream:
        for frame in range(181):
            senses = stream.step(1) if frame else stream.sense()
            body = stream.frame.position[stream.scene["body"]].astype(float)
            gone = 0.15 * round((senses.centre[0] - body[:, 0].mean()) / 0.15)  # by the tank
            times.append(frame / 60)
            bodies.append(body + [gone, 0, 0])
            if times[-1] > 3 - 1 / own["frequency"] and frame % 3 == 0:
                wakes.append(wake(stream.water(), body))
    moved = motion.moved(np.array(times), np.array(bodies), own["frequency"], None)
    tails = [one[:, 0].min() for one in bodies]
    nearest = min(float(min(one[:, 2].min(), width - one[:, 2].max())) for one in bodies)
    return {"evolution": evolution, "seed": seed, "passed": float(tails[-1] - tails[0]) / moved["bodyLength"], "nearestWall": nearest, **moved,
            "wake": dict(zip(("head", "tail", "behind"), np.mean(wakes, axis=0).round(4).tolist()))}


def wake(water, body):
    rear, front, (height, side) = body[:, 0].min(), body[:, 0].max(), body[:, 1:].mean(axis=0)
    x, y, z = map(water.centres, range(3))
    turns, quarter = np.abs(water.vorticity()[:, np.abs(y - height).argmin(), :, 1]), (front - rear) / 4
    return [turns[np.ix_((x >= low) & (x <= high), np.abs(z - side) <= quarter)].mean() for low, high in
            ((front - quarter, front + quarter), (rear - quarter, rear + quarter), (rear - 4 * quarter, rear - 2 * quarter))]


def keep():
    """Prints what is kept of the answers to `requests`, a row each."""
    asked = swims()
    for line in sys.stdin:
        result = json.loads(line)
        print(json.dumps(row(*asked[result["id"]], result)))


# What the page has of them: all by rows of lake/swims.jsonl.gz and lake/motions.jsonl.

class Lake:
    """Rows of a study's folder, none where it has none."""

    def __init__(self, folder):
        def lines(name, opened):
            file = folder / "lake" / name
            return [json.loads(line) for line in opened(file, "rt", encoding="utf-8")] if file.exists() else []
        self.motions = {one["evolution"]: one for one in lines("motions.jsonl", open)}
        self.runs = {}
        for one in lines("swims.jsonl.gz", gzip.open):
            self.runs.setdefault((one["evolution"], one["seed"]), {}).setdefault(one["condition"], []).append(one)

    def seeds(self, evolution):
        return sorted(seed for one, seed in self.runs if one == evolution)

    def walls(self, swimmer, condition="until walls"):
        """Whether the runs that a wall may end mostly end at one."""
        ends = [one["stopped"] == "touched-plane" for one in self.runs[swimmer].get(condition, [])]
        return 2 * sum(ends) > len(ends)

    def speeds(self, swimmer, condition="water"):
        """Units/s of the runs that stayed stable, while they lasted: in water also of those that a wall might have ended."""
        runs = self.runs[swimmer]
        found = runs.get(condition, []) + (runs.get("until walls", []) if condition == "water" and not self.walls(swimmer) else [])
        return Sample.of(one["distance"] / one["simulated"] for one in found if one["status"] == "ok")

    def change(self, swimmer, condition):
        return self.speeds(swimmer, condition).mean / self.speeds(swimmer).mean - 1

    def best(self, evolution):
        """The seed whose speed is highest at the slowest of its three levels."""
        return max(((evolution, seed) for seed in self.seeds(evolution)), default=None,
                   key=lambda one: min(self.speeds(one, condition).mean for condition in ("water", "half step", "half cells")))

    def lasts(self, swimmer):
        return statistics.fmean(one["simulated"] for one in self.runs[swimmer]["water"])

    def numbers(self, swimmer):
        """Reynolds and Strouhal number."""
        return [statistics.fmean(one["swimming"][name] for one in self.runs[swimmer]["water"]) for name in ("reynolds", "strouhal")]

    def verdict(self, swimmer):
        """(✔ ✘ or –, why): it swims if it gets further than a resting body by a twentieth of its length, on its own and not in vacuum, and has more than half
        of its speed and less than one and a half at half the step, at half the cells, mirrored, and in a wider lake; who evolved where touching a wall ends no run does not touch that lake's."""
        length, speed, rest = self.motions[swimmer[0].removesuffix("-between-walls")]["bodyLength"], self.speeds(swimmer), self.speeds(swimmer, "resting").mean
        least = 0.05 * length / self.lasts(swimmer)
        if speed.mean - rest < least or abs(self.speeds(swimmer, "vacuum").mean) > (speed.mean - rest) / 2:
            return "✘", "no further than at rest, or in vacuum"
        wider, ended = "wider" in self.runs[swimmer], LAKES[swimmer[0]][2]
        doubts = [f"{measured.percent(1 + change)} of its speed {words}" for condition, words in CONTROLS.items()
                  if (condition != "wider" or wider) and not abs(change := self.change(swimmer, condition)) < 0.5]
        doubts += ["starts differ too much"] * (speed.mean - rest - 2 * speed.error < least) + ["it touches walls"] * (not ended and self.walls(swimmer, "wider" if wider else "until walls"))
        broken = sum(one["status"] != "ok" for runs in self.runs[swimmer].values() for one in runs)
        return ("–", "; ".join(doubts + [f"{broken} unstable"] * (broken > 0))) if doubts or broken else ("✔", "swims by every control")

    def table(self):
        """Every seed, CSV."""
        made = [["evolution", "seed", "units/s ± interval", "starts", "lasts (s)", "over 4 s", "half step", "half cells", "mirrored", "in a wider lake", "at rest", "in vacuum", "Re", "St", "verdict", "why"]]
        for one in sorted(self.runs):
            speed, (re, st) = self.speeds(one), self.numbers(one)
            made.append([one[0], str(one[1]), measured.with_error(speed.mean, speed.interval, 3), str(speed.count), measured.fixed(self.lasts(one), 1),
                         measured.fixed(self.speeds(one, "longer").mean), *(f"{100 * self.change(one, condition):+.0f} %" if condition in self.runs[one] else "–" for condition in CONTROLS),
                         *(measured.fixed(self.speeds(one, condition).mean, 3) for condition in ("resting", "vacuum")), measured.fixed(re, 0), measured.fixed(st), *self.verdict(one)])
        return made

    def recorded(self):
        """How the best of each creature moved, and its wake, CSV."""
        made = [["evolution", "seed", *(f"e {fish}, α" for fish in measured.FISH), "none", "like", "by our rule", "yaw (degrees)", "rise", "swing (body lengths)", "passed (body lengths)",
                 "vorticity at head", "at tail", "behind (1/s)"]]
        for name, one in sorted(self.motions.items()):
            made.append([name, str(one["seed"]), *(f"{measured.fixed(fit['error'], 3)}, {measured.fixed(fit['alpha'])}" for fit in one["fits"]),
                         measured.fixed(one["fits"][0]["none"], 3), *self.like(one), f"{np.degrees(one['largestYaw']):.0f}",
                         measured.fixed(one["heights"][1] - one["heights"][0], 3), measured.fixed(one["tailSwing"]),
                         measured.fixed(one["passed"]), *(measured.fixed(one["wake"][place], 1) for place in ("head", "tail", "behind"))])
        return made

    def like(self, motion):
        own = measured.like([motion], "fitsOfBody")
        return measured.FISH[measured.nearest([motion], "fits")], "none" if own is None else measured.FISH[own]

    def answer(self):
        """A sentence, or none."""
        bests = [self.best(name) for name in sorted(self.motions)]
        swim = [one for one in bests if self.verdict(one)[0] == "✔"]
        if not swim:
            return ""
        one = max(swim, key=lambda swimmer: self.speeds(swimmer).mean)
        speed, finer = self.speeds(one), ", ".join(f"{100 * self.change(one, condition):+.0f} % {CONTROLS[condition]}".replace("-", "−") for condition in ("half step", "half cells"))
        return f" In finer water (`lattice`) the best gaits of {len(swim)} of {len(bests)} creatures do, by fewer controls, {one[0].replace('-', ' ')} at " \
               f"{measured.with_error(speed.mean, speed.interval)} units/s in {self.lasts(one):.1f} s (± over starts; {finer})."

    def cost(self, folder):
        """Evaluations of all evolutions, generations of each, seconds of a GPU, and by what they were."""
        folders = [folder / f"lake/{one}/seed-{seed}" for one, seed in self.runs]
        rows = [list(csv.DictReader((one / "timings.csv").read_text(encoding="utf-8").splitlines())) for one in folders]
        made = [json.loads((one / "environment.json").read_text(encoding="utf-8")) for one in folders]
        return (sum(int(one["evaluations"]) for found in rows for one in found), [len(found) - 1 for found in rows],
                sum(seconds for one, (*_, groups) in LAKES.items() for first, _, seconds in groups if (one, first) in self.runs),
                ", ".join(sorted({one["commit"] for one in made})), ", ".join(sorted({one["gpu"].split(": ", 1)[1].split(",")[0] for one in made})))


if __name__ == "__main__":
    work, named = sys.argv[1:2], sys.argv[2:]
    if work == ["evolve"]:
        print("\n".join(evolve(named or LAKES)))
    elif work == ["requests"] and not named:
        for one in sorted(requests(), key=lambda one: -one["overrides"]["solver"]["substeps"]):
            print(json.dumps(one))
    elif work == ["keep"] and not named:
        keep()
    elif work == ["record"] and len(named) == 1 and named[0] in LAKES:
        print(json.dumps(record(*Lake(HERE).best(named[0]))))
    else:
        sys.exit("usage: lake.py evolve [EVOLUTION]... | lake.py requests | lake.py keep | lake.py record EVOLUTION")
