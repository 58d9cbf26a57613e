"""Which of the thesis' conclusions hold, by rules that the page states. Speeds are along the body's own heading, while a run lasts."""
import dataclasses
import math
import statistics

from scipy import stats

import measured
from measured import STILL, fixed
from plan import PARAMETERS, POWERS

HOLDS, FAILS, OPEN, VOID = "✔ holds", "✘ does not hold", "– open", "– no such thing"
# What this study cannot test, and why.
UNTESTED = (("more substeps, iterations and a larger radius cost more", "see [benchmarks](../benchmarks/README.md); a study's runs share their machine"),
            ("a body sampled from a triangle mesh does not swim", "that mesh is not published"),
            ("bodies of equal boxes work best", "their dimensions are not published"),
            ("potentiated activation swims far faster", "its gaits evolved power, frequency, amplitude and phase step together"),
            ("less viscosity and damping do not save the vortices", "no flow was recorded at other values"),
            ("backwards in vacuum, forwards in water: so water is pushed", "the acceleration clamp moves bodies in vacuum"),
            ("the head moves too much", "no measure is given; `fish.csv` compares whole midlines"),
            ("shapes could evolve, towards goals", "they [do](../../../ga-java/docs/bodies.md) here, to [these](../../../sim-native/protocol/goals.md)"))


@dataclasses.dataclass(frozen=True)
class Claim:
    says: str
    water: str
    measured: str
    outcome: str
    ours: bool = False  # found here, not the thesis'


def told(holds):
    return HOLDS if holds else FAILS


def agreed(outcomes, none=OPEN):
    """What several tests agree on."""
    return outcomes[0] if outcomes and len(set(outcomes)) == 1 else OPEN if outcomes else none


def value_text(value):
    """A parameter's value: no limit where it is as good as none."""
    return "none" if value >= 1e20 else f"{value:.12g}"


def name(subject):
    return f"creature {subject.creature}" + (" evolved" if subject.seed else "")


def chance(one, other):
    """How far two means are apart by chance, but for 5 %, by Student's t."""
    return stats.t.ppf(0.975, max(one.count + other.count - 2, 1)) * math.hypot(one.error, other.error)


class Trend:
    """How a speed goes as a parameter moves away from its own value; the farthest is last. What differs, differs by chance of 5 % and a tenth. `other`: on the other side of it."""

    def __init__(self, usual, changed, other=()):
        self.usual, self.changed, self.last, self.other = usual, changed, changed[-1] if changed else None, [one for one in other if one.count]
        self.is_known = usual.count > 1 and bool(changed) and all(one.count for one in changed)
        self.swims = usual.mean > (usual.interval if usual.count > 1 else 0)

    def differs(self, one, direction):
        difference = direction * (one.mean - self.usual.mean)
        return difference > chance(one, self.usual) and difference > 0.1 * self.usual.mean

    def hinders(self):
        if not self.differs(self.last, -1):
            return FAILS
        return OPEN if any(self.differs(one, 1) for one in self.changed) else HOLDS

    def makes_no_difference(self):
        """Open where chance alone is larger than a tenth."""
        if any(self.differs(one, -1) or self.differs(one, 1) for one in self.changed):
            return FAILS
        return HOLDS if all(chance(one, self.usual) <= 0.1 * self.usual.mean for one in self.changed) else OPEN

    def stops(self):
        return told(abs(self.last.mean) < 0.1 * self.usual.mean)

    def slows_a_little(self):
        return told(self.differs(self.last, -1) and self.last.mean > self.usual.mean / 2)

    def is_unstable(self):
        """Little is left of the swimming; open where nothing is sure, or where as little is left on the other side, so that the gait fits its own value alone."""
        if self.last.mean < 0.1 * self.usual.mean:
            return OPEN if any(one.mean < 0.1 * self.usual.mean for one in self.other) else HOLDS
        return OPEN if self.last.mean < self.last.interval else FAILS

    def text(self):
        return f"{fixed(self.usual.mean)}: " + ", ".join(f"{100 * one.mean / self.usual.mean:.0f}" for one in self.changed) + " %"


def every(study, vorticity):
    """All claims that can be tested. vorticity: by recording, the water's at the head, the tail and behind a swimmer."""
    for water in ("flex", "open-water"):
        yield from motion(study, water, vorticity)
        yield from parameters(study, water)
        yield from activation(study, water)


def kept(claims, water):
    """How many of the thesis' own hold, in words; None if none could be tested."""
    tested = [one.outcome for one in claims if one.water == water and not one.ours and one.outcome != VOID]
    return f"{tested.count(HOLDS)} of {len(tested)} hold and {tested.count(FAILS)} do not" if tested else None


def motion(study, water, vorticity):
    """Chapter 3, by the best that evolved."""
    best = study.bests(water)
    moved = [(one, rows) for one in study.evolved(water) if (rows := study.moves(one))]
    if moved:
        ways = [straightness(rows) for _, rows in moved]
        yield Claim("swimming is stable and straight", water, "largest yaw, largest roll at the end, rise over the way — " + "; ".join(
            f"{creature}: {max(way[0] for way in own):.0f}°, {max(way[1] for way in own):.0f}°, {fixed(max(way[2] for way in own))}"
            for creature in study.size.creatures if (own := [way for way, (one, _) in zip(ways, moved) if one.creature == creature])),
            agreed([told(yaw < 30 and roll < 30) if rise < 0.1 or max(yaw, roll) >= 30 else OPEN for yaw, roll, rise in ways]))
        swings = [(one.creature, statistics.fmean(row["tailSwing"] for row in rows)) for one, rows in moved]
        yield Claim("amplitudes are wider than real fish'", water, "swing at the rearmost place that is measured at all times, in body lengths, an "
                    "eel's tail has 0.1 — " + "; ".join(f"{creature}: {fixed(min(own))} to {fixed(max(own))}" for creature in study.size.creatures
                                                        if (own := [swing for one, swing in swings if one == creature])),
                    agreed([told(swing > 0.1) for _, swing in swings]))
        pitches = [math.degrees(statistics.fmean(row["end"]["pitch"] for row in rows)) for one, rows in moved if one.creature == 4]
        if pitches:
            yield Claim("creature 4 swims pitched", water, "pitch at the end, by seeds — " + ", ".join(f"{pitch:.0f}°" for pitch in pitches),
                        agreed([told(abs(pitch) > 10) for pitch in pitches]))
    vacuum = [study.means(one, "vacuum").mean for one in study.plan.published(water) if one.about.startswith("as published")]
    backwards = sum(speed < -STILL for speed in vacuum)
    yield Claim("most bodies move backwards in vacuum", water, "units/s, thesis' gaits — " + ", ".join(map(fixed, vacuum)),
                VOID if all(abs(speed) < STILL for speed in vacuum) else HOLDS if 2 * backwards > len(vacuum) else told(False) if 2 * backwards < len(vacuum)
                else OPEN)
    if f"creature-2-{water}" in vorticity:
        head, tail, behind = vorticity[f"creature-2-{water}"]
        yield Claim("vortices appear at the tail", water, f"one recording: mean vorticity at the tail {fixed(tail)}, at the head {fixed(head)} 1/s",
                    surely(tail, 2 * head))
        yield Claim("and die out quickly", water, f"one moment: at the tail {fixed(tail)}, half a length to a length behind it {fixed(behind)} 1/s", OPEN)
    speeds = {one.creature: study.speed(one) for one in best}
    others = [speed for creature, speed in speeds.items() if creature != 1]
    if 1 in speeds and others:
        one, fastest = speeds[1], max(others, key=lambda speed: speed.mean)
        yield Claim("creature 1 is the fastest", water, "units/s — " + "; ".join(
            f"{creature}: {measured.with_error(speed.mean, speed.error)}" for creature, speed in speeds.items()),
            told(one.mean > fastest.mean) if abs(one.mean - fastest.mean) > math.hypot(one.error, fastest.error) else OPEN)
    eels = [rows for one, rows in moved if one.creature == 2]
    if eels:
        least = [measured.nearest(rows, "fits") for rows in eels]
        ours = [measured.like(rows, "fitsOfBody") for rows in eels]
        yield Claim("creature 2 swims like an eel (e 0.0402, 0.12 of no motion's)", water, "by seeds the fish of the least e, e, and as a share of no motion's — " + ", ".join(
            f"{measured.FISH[fish]} {fixed(measured.error(rows, fish, 'fits').mean, 4)}, {fixed(measured.relative(rows, fish, 'fits'))}"
            for rows, fish in zip(eels, least)) + "; where α must be 0.1 — " + ", ".join("none" if fish is None else measured.FISH[fish] for fish in ours),
            agreed([told(fish == 0) for fish in least + ours]))


def straightness(rows):
    """Largest yaw and roll at the end, degrees; rise over the way, none without a way."""
    rise, way = (abs(statistics.fmean(values)) for values in ([row["heights"][1] - row["heights"][0] for row in rows],
                                                              [row["speed"] * row["simulated"] for row in rows]))
    yaw, roll = (math.degrees(max(values)) for values in ([row["largestYaw"] for row in rows], [abs(row["end"]["roll"]) for row in rows]))
    return yaw, roll, rise / way if way else math.inf


def surely(value, limit):
    """Of one recording, whose error is not known, a quarter is not sure."""
    return HOLDS if value > 1.25 * limit else FAILS if value < limit / 1.25 else OPEN


def parameters(study, water):
    """4.1, by all values and all gaits that swim."""
    forward = {}

    def speed(subject, parameter, value, vacuum=False):
        key = (name(subject), parameter, value, vacuum)
        if key not in forward:
            forward[key] = study.forward(study.plan.parameter(subject, parameter, value, vacuum))
        return forward[key]

    def by_trend(says, parameter, above, rule, own=None, to=None):
        """From `own` on, by default the scene's value, up or down, to the extreme or `to`."""
        if parameter not in study.size.parameters or water not in PARAMETERS[parameter][1]:
            return
        usual, values = PARAMETERS[parameter][1][water]
        own = usual if own is None else own
        up, down = [one for one in values if own < one <= (to or math.inf)], [one for one in reversed(values) if one < own]
        values, others = (up, down) if above else (down, up)
        trends = [(one, Trend(speed(one, parameter, own), *([speed(one, parameter, value) for value in side] for side in (values, others)))) for one in study.studied(water)]
        trends = [(one, trend) for one, trend in trends if trend.is_known and trend.swims]
        if trends:
            yield Claim(says, water, f"{parameter} {', '.join(map(value_text, values))} — "
                        + "; ".join(f"{name(one)} {trend.text()}" for one, trend in trends), agreed([rule(trend) for _, trend in trends]))

    def in_vacuum(says, parameter, ours=False):
        """Whether the greatest value leaves a third of the motion or less, of gaits that move there."""
        if parameter in study.size.parameters and water == "flex":
            own, values = PARAMETERS[parameter][1][water]
            pairs = [(one, speed(one, parameter, own, True), speed(one, parameter, values[-1], True)) for one in study.studied(water)]
            pairs = [pair for pair in pairs if pair[1].count and pair[2].count and abs(pair[1].mean) > STILL]
            shown = "; ".join(f"{name(one)} {fixed(usual.mean)} → {fixed(changed.mean)}" for one, usual, changed in pairs)
            yield Claim(says, water, f"{parameter} {value_text(values[-1])} — {shown}" if pairs else "nothing moves",
                        agreed([told(abs(changed.mean) < abs(usual.mean) / 3) for _, usual, changed in pairs], VOID), ours)

    viscosity, radius = ("viscosity", "radius") if water == "flex" else ("kinematic viscosity", "kernel support")
    yield from by_trend("cohesion hinders", "cohesion", True, Trend.hinders)
    yield from by_trend("surface tension hinders", "surface tension", True, Trend.hinders)
    yield from by_trend("viscosity helps: with less it swims worse", viscosity, False, Trend.hinders)
    yield from by_trend("too much viscosity hinders", viscosity, True, Trend.hinders)
    yield from by_trend("vorticity confinement makes no visible difference", "vorticity confinement", True, Trend.makes_no_difference)
    yield from by_trend("a body much lighter than the fluid cannot move", "body mass", False, Trend.stops)
    yield from by_trend("a larger radius hinders", radius, True, Trend.hinders)
    yield from by_trend("damping (its 1) slows a little in fluid", "damping", True, Trend.slows_a_little, 0, 1)
    yield from by_trend("a small radius is unstable", "small radius", False, Trend.is_unstable)
    yield from by_trend("few substeps are unstable", "substeps", False, Trend.is_unstable)
    yield from by_trend("few iterations are unstable", "iterations", False, Trend.is_unstable)
    yield from in_vacuum("damping strongly suppresses the motion in vacuum", "damping")
    yield from in_vacuum("(found here) the motion in vacuum is the acceleration clamp", "acceleration clamp", True)


def activation(study, water):
    """4.2 and 4.3, and half the amplitudes."""
    plan = study.plan
    weak = [(one, study.forward(plan.of(one, "water")), study.forward(plan.weaker(one))) for one in study.studied(water)]
    weak = [(one, usual, half) for one, usual, half in weak if half.count and Trend(usual, []).swims]
    if weak:
        yield Claim("reduced amplitudes lose most of the thrust", water, "with half of them — " + "; ".join(
            f"{name(one)} {Trend(usual, [half]).text()}" for one, usual, half in weak),
            agreed([told(half.mean < usual.mean / 2) if abs(half.mean - usual.mean / 2) > half.interval else OPEN
                    for _, usual, half in weak]))

    def by_creatures(says, pair, rule, ours=False):
        outcomes, texts = [], []
        for creature in plan.potent():
            first, second = (study.forward(plan.potentiated(creature, power, step, water, vacuum)) for power, step, vacuum in pair)
            holds = rule(first, second)
            if holds is not None and first.count and second.count:
                outcomes.append(told(holds))
                texts.append(f"creature {creature}: {fixed(first.mean)} and {fixed(second.mean)}")
        return Claim(says, water, "; ".join(texts) or "nothing moves", agreed(outcomes, VOID), ours)

    def sure(one):
        return abs(one.mean) > one.interval

    def turns(ahead, back):
        return ahead.mean > 0 > back.mean and sure(ahead) and sure(back)

    yield by_creatures("potentiation (p = 4) with 1 − Δφ swims backwards", ((POWERS[-1], 0.25, False), (POWERS[-1], 0.75, False)), turns)
    yield by_creatures("potentiation (p = 4) also accelerates in vacuum", ((1.0, 0.25, True), (POWERS[-1], 0.25, True)),
                       lambda sine, powered: abs(powered.mean) > STILL if max(abs(sine.mean), abs(powered.mean)) > STILL else None)
    yield by_creatures("(found here) there the sine (p = 1) moves further", ((1.0, 0.25, True), (POWERS[-1], 0.25, True)),
                       lambda sine, powered: abs(sine.mean) > abs(powered.mean) if abs(sine.mean) > STILL else None, True)
    yield by_creatures("and in vacuum backwards with 1 − Δφ", ((POWERS[-1], 0.25, True), (POWERS[-1], 0.75, True)),
                       lambda ahead, back: turns(ahead, back) if max(abs(ahead.mean), abs(back.mean)) >= STILL else None)
    rest = study.forward(plan.two_clusters(plan.gaits_of_two_clusters()[0], water, "resting"))
    swims = [one.mean for gait in plan.gaits_of_two_clusters() if (one := study.forward(plan.two_clusters(gait, water, "water"))).count]
    if rest.count and swims:
        gait, length = study.two_clusters_that_move(water), study.length(1)  # a body as long as creature 1
        runs = {name: found for name, one in plan.controls_of_two_clusters(gait, water).items() if (found := study.results(one))} if gait else {}
        sign, said = measured.judged(runs, length, study.duration, None, math.nan) if len(runs) > 4 else (OPEN if gait else FAILS, "")
        yield Claim("a body of two clusters does not swim", water, f"at most {fixed(max(swims) - rest.mean, 4)} more than at rest, by the best of {len(swims)} "
                    f"gaits" + (f"; from other starts {said}" if said else ""), {"✘": HOLDS, "✔": FAILS}.get(sign[0], OPEN))
