"""What the study asks: which evolutions, and which swims, each as a request of natator-sim (sim-native/protocol/request.schema.json).

A swim that is measured in several runs is an Experiment: a request, and which starts it is run from. Lengths are scene units, times seconds."""
import dataclasses
import json
import pathlib

HERE = pathlib.Path(__file__).resolve().parent
THESIS = json.loads((HERE / "thesis.json").read_text(encoding="utf-8"))
GAITS = THESIS["gaits"]
WATERS = ("flex", "open-water")
SCHEME = {"flex": "flex", "open-water": "conserving"}
SECONDS, SUBSTEPS = 4.0, 4  # of a run, and of a frame
LUCKY, FRESH = 1001, 1  # first starts: those by which a winner is chosen are not those by which it is judged
FEW = 4  # runs of what is not a gait in its water, at most
# What may be special about a swim; clamp and masses that the thesis may have meant are flex' alone.
CONDITIONS = {"flex": ("water", "resting", "vacuum", "no-clamp", "half-step", "mirrored", "other-water", "inverse-mass"),
              "open-water": ("water", "resting", "vacuum", "half-step", "mirrored", "other-water")}
CHANGES = {"no-clamp": {"solver": {"maxAcceleration": 3.4028234663852886e38}}, "half-step": {"solver": {"substeps": 2 * SUBSTEPS}},
           "inverse-mass": {"fluid": {"mass": {"gradient": "inverse-mass-linear"}}}}
POWERS, PHASE_STEPS = (0.5, 1.0, 2.0, 4.0), (0.25, 0.75)  # of potentiated activation (thesis 4.2)
STUDIED = "2-step-0.862"  # the published gait that swims: parameters are studied with it and with what evolved
# Thesis 4.1: name, how it is set, and by water its own value and those that are tried.
PARAMETERS = {
    "substeps": ("solver.substeps", {"flex": (4, (1, 2, 3, 4, 6, 8, 16)), "open-water": (4, (1, 2, 4, 8))}),
    "iterations": ("solver.numIterations", {"flex": (4, (1, 2, 3, 4, 6, 8, 16)), "open-water": (4, (1, 2, 4, 8))}),
    "iterations of the body": ("solver.solidIterations", {"open-water": (16, (4, 8, 16, 32))}),
    "body mass": ("creature.particleMass", {"flex": (1, (0.05, 0.1, 0.25, 0.5, 1, 2, 4, 10)),
                                            "open-water": (0.421875, (0.2109375, 0.31640625, 0.421875, 0.5625, 0.84375))}),
    "cohesion": ("solver.cohesion", {"flex": (0, (0, 0.005, 0.01, 0.02, 0.05, 0.1)), "open-water": (0, (0, 0.02, 0.1))}),
    "surface tension": ("solver.surfaceTension", {"flex": (0, (0, 0.1, 0.5, 1, 5, 20)), "open-water": (0, (0, 1, 5))}),
    "viscosity": ("solver.viscosity", {"flex": (8, (0, 2, 4, 8, 16, 32, 64, 128))}),
    "kinematic viscosity": ("solver.kinematicViscosity", {"open-water": (0.002, (0.0005, 0.001, 0.002, 0.004, 0.008, 0.032))}),
    "vorticity confinement": ("solver.vorticityConfinement", {"flex": (0, (0, 1, 5, 20, 80)), "open-water": (0, (0, 1, 5))}),
    "radius": ("solver.radius", {"flex": (0.15, (0.15, 0.16, 0.17, 0.18, 0.2, 0.225))}),
    # Below the distance that the fluid keeps from a body, which follows it down.
    "small radius": ("solver.radius solver.solidRestDistance", {"flex": (0.15, (0.105, 0.11, 0.12, 0.13, 0.14, 0.15))}),
    "kernel support": ("solver.kernelSupport", {"open-water": (2.5, (2, 2.25, 2.5, 3))}),
    "damping": ("solver.damping", {"flex": (1, (0, 0.5, 1, 2, 4, 8)), "open-water": (0, (0, 0.5, 1, 2, 4, 8))}),
    "friction": ("solver.particleFriction solver.dynamicFriction", {"flex": (0.2, (0, 0.05, 0.1, 0.2, 0.4, 0.8))}),
    "acceleration clamp": ("solver.maxAcceleration", {"flex": (100, (25, 50, 100, 200, 400, 1e30))}),
}
IN_VACUUM_TOO = ("damping", "acceleration clamp")  # in flex, where something moves there


@dataclasses.dataclass(frozen=True)
class Size:
    """How large a study is. None: the water's own."""
    creatures: tuple = (1, 2, 3, 4)
    seeds: int = 5
    generations: int = 100
    population: int | None = None
    duration: float | None = None  # of all runs, those of evolutions too
    runs: int = 8  # of a gait in its water
    recorded: int = 3
    parameters: tuple = tuple(PARAMETERS)
    finer: tuple = WATERS  # in which what evolved is run at half the spacing


# Small enough for a test: everything happens, nothing is learned.
QUICK = Size(creatures=(1,), seeds=1, generations=1, population=4, duration=0.05, runs=2, recorded=1, parameters=("damping",),
             finer=("flex",))


@dataclasses.dataclass(frozen=True)
class Subject:
    """A gait that swims: published (seed 0) or evolved."""
    creature: int
    water: str
    gait: dict
    about: str
    seed: int = 0

    @property
    def label(self):
        if self.seed:
            return f"evolved, seed {self.seed}"
        return "thesis' gait" + ("" if self.about.startswith("as published") else f", {self.about}")


@dataclasses.dataclass(frozen=True)
class Experiment:
    request: dict
    first: int
    starts: int

    def runs(self):
        return [{**self.request, "start": start} for start in range(self.first, self.first + self.starts)]

    def recordings(self, count):
        """Runs to be recorded, which nothing ends early; the recorder of paths takes a tiny shift of the start, no number."""
        return [{**merged(self.request, stopping(False)), "perturbation": {"amplitude": 1e-6, "seed": seed}} for seed in range(1, count + 1)]


def patch(into, change):
    """A JSON merge patch, with its nulls, on another."""
    return {**into, **{key: patch(into[key], one) if isinstance(one, dict) and isinstance(into.get(key), dict) else one
                       for key, one in change.items()}}


def merged(request, change):
    return {**request, "overrides": patch(request["overrides"], change)}


def stopping(at_walls):
    return {"stopping": {"planeContact": at_walls, "noProgressAfter": 0}}


def scene(creature, water):
    return f"{'thesis' if water == 'flex' else water}/creature-{creature}"


def request(name, gait, water, overrides, duration):
    asked = {"id": 0, "scene": name, "gait": gait, "duration": duration, "scheme": SCHEME[water], "overrides": overrides}
    return asked if duration is not None else {key: one for key, one in asked.items() if key != "duration"}


def in_vacuum(asked):
    return merged(asked, {"fluid": None, "planes": [], "solver": {"gravity": [0, 0, 0]}, **stopping(False)})


def resting(gait):
    return {**gait, "amplitude": [0.0] * len(gait["amplitude"])}


def mirrored(gait):
    """Half a period later: left and right exchanged."""
    return {**gait, "phase": [one + 0.5 if one < 0.5 else one - 0.5 for one in gait["phase"]]}


def other(water):
    return WATERS[1 - WATERS.index(water)]


def set_to(parameter, value):
    """The change of a scene that sets a parameter."""
    change = {}
    for place in PARAMETERS[parameter][0].split():
        section, key = place.split(".")
        change.setdefault(section, {})[key] = value
    return change


def subject_of(published, water):
    return Subject(published["creature"], water, published["gait"], published["about"])


def search(length, height, width):
    """A scene that costs less than that in which gaits are judged: an eighth of the passes over the water, and a shorter, shallower tank under
    so much more gravity that the pressure at the swimmer is the same. Gaits come in the same order there (search_steps.py)."""
    return {"solver": {"substeps": 2, "numIterations": 1, "solidIterations": 128, "gravity": [0, -4.8 / height, 0]},
            "planes": [[0, 1, 0, 0], [1, 0, 0, 0], [-1, 0, 0, length], [0, 0, 1, 0], [0, 0, -1, width]],
            "fluid": {"count": [round(side / 0.1) for side in (length, height, width)]},
            "creature": {"rearCentre": [0.5, height / 2, width / 2]}}


@dataclasses.dataclass(frozen=True)
class Evolution:
    creature: int
    water: str
    seed: int
    size: Size

    def folder(self, study):
        return study / "runs" / f"creature-{self.creature}" / self.water / f"seed-{self.seed}"

    def arguments(self):
        """Of natator evolve, with all seeds. Creature 2 swims furthest and swings widest: its tank is narrower, so that what touches no wall there keeps clear of
        them in the scene as it is. In open water a second costs some twenty times as much as in the thesis' tank; so evolutions are smaller."""
        population, duration, overrides = (150, None, None) if self.water == "flex" else \
            (60, 2.5, search(4.5, 1, 1.2)) if self.creature == 2 else (60, 1.75, search(4, 1, 1.6))
        duration = self.size.duration or duration
        return ["--preset", "thesis", "--scene", scene(self.creature, self.water), "--scheme", SCHEME[self.water], "--seed", "1",
                "--seeds", str(self.size.seeds), "--starts", "2", "--population", str(self.size.population or population), "--generations", str(self.size.generations),
                *(["--duration", str(duration)] if duration else []), *(["--overrides", json.dumps(overrides)] if overrides else [])]


class Plan:
    """All of a study's questions that follow from no answer; of gaits that are found it says what is asked of them."""

    def __init__(self, size):
        self.size = size
        self.few = min(size.runs, FEW)
        self.evolutions = [Evolution(creature, water, seed, size) for seed in range(1, size.seeds + 1) for water in WATERS
                           for creature in size.creatures]

    def published(self, water):
        return [subject_of(one, water) for one in GAITS if one["creature"] in self.size.creatures]

    def experiment(self, asked, starts=None, first=FRESH):
        return Experiment(asked, first, starts or self.few)

    def of(self, subject, condition, first=FRESH):
        """A gait under a condition. One that evolved ends where it touches a plane, as when it evolved; a published one runs on, as with Flex."""
        gait, water = subject.gait, other(subject.water) if condition == "other-water" else subject.water
        gait = resting(gait) if condition == "resting" else mirrored(gait) if condition == "mirrored" else gait
        asked = request(scene(subject.creature, water), gait, water, stopping(subject.seed > 0), self.size.duration)
        if condition == "vacuum":
            asked = in_vacuum(asked)
        change = CHANGES.get(condition, {})
        central = condition in ("water", "half-step") and first == FRESH
        return self.experiment(merged(asked, change), self.size.runs if central else None, first)

    def finalist(self, subject):
        return self.of(subject, "water", LUCKY)

    def all_of(self, subject):
        return [self.of(subject, condition) for condition in CONDITIONS[subject.water]]

    def parameter(self, subject, name, value, vacuum=False):
        own, _ = PARAMETERS[name][1][subject.water]
        asked = self.of(subject, "water").request
        asked = asked if value == own else merged(asked, set_to(name, value))
        return self.experiment(in_vacuum(asked) if vacuum else asked)

    def weaker(self, subject):
        """A gait of half the amplitudes."""
        asked = self.of(subject, "water").request
        return self.experiment({**asked, "gait": {**asked["gait"], "amplitude": [one / 2 for one in asked["gait"]["amplitude"]]}})

    def parameters(self, water):
        """(name, own value, values, whether in vacuum too) of those that mean anything in a water."""
        for name in self.size.parameters:
            if water in PARAMETERS[name][1]:
                yield name, *PARAMETERS[name][1][water], water == "flex" and name in IN_VACUUM_TOO

    def studies(self, subject):
        return [self.parameter(subject, name, value, vacuum) for name, _, values, too in self.parameters(subject.water) for value in values
                for vacuum in ((False, True) if too else (False,))]

    def potent(self):
        """Creatures whose activation is raised to a power, and of which the best that evolved is one with which parameters are studied."""
        return [creature for creature in (1, 2) if creature in self.size.creatures]

    def potentiated(self, creature, power, step, water, vacuum):
        """Thesis 4.2: activation raised to a power."""
        count = 2 if creature == 1 else 8
        gait = {"frequency": 2.0, "amplitude": [0.8] * count, "phase": [i * step % 1 for i in range(count)], "power": power}
        asked = request(scene(creature, water), gait, water, stopping(False), self.size.duration)
        return self.experiment(in_vacuum(asked) if vacuum else asked)

    @staticmethod
    def gaits_of_two_clusters():
        return [{"frequency": f, "amplitude": [a], "phase": [0.0]} for f in (0.5, 1.0, 1.5, 2.0) for a in (0.5, 1.0)]

    def two_clusters(self, gait, water, setting):
        """Thesis 4.3: a body of two clusters and one joint."""
        name, change = ("thesis/two-clusters", {}) if water == "flex" else (scene(1, water), {"creature": {"name": "two-clusters"}})
        gait = resting(gait) if setting == "resting" else mirrored(gait) if setting == "mirrored" else gait
        asked = merged(request(name, gait, water, {**stopping(False), **change}, self.size.duration), CHANGES.get(setting, {}))
        return self.experiment(in_vacuum(asked) if setting == "vacuum" else asked, first=LUCKY if setting == "again" else FRESH)

    def controls_of_two_clusters(self, gait, water):
        """What tells whether it swims, by starts that did not choose it."""
        names = ("again", "resting", "vacuum", "half-step", "mirrored") + (("no-clamp",) if water == "flex" else ())
        return {"water" if name == "again" else name: self.two_clusters(gait, water, name) for name in names}

    def sinking(self, creature):
        """The thesis' tank and bodies as they are, in scheme conserving."""
        gait = next(one["gait"] for one in GAITS if one["creature"] == creature)
        return self.experiment({**request(scene(creature, "flex"), gait, "flex", stopping(True), self.size.duration), "scheme": "conserving"})

    def independent(self):
        """What depends on no evolution."""
        every = [experiment for water in WATERS for subject in self.published(water) for experiment in self.all_of(subject)]
        every += [self.potentiated(creature, power, step, water, vacuum) for water in WATERS for creature in self.potent() for power in POWERS
                  for step in PHASE_STEPS for vacuum in (False, True)]
        for water in WATERS:
            every += [self.two_clusters(gait, water, setting) for gait in self.gaits_of_two_clusters() for setting in ("water", "vacuum")]
            every.append(self.two_clusters(self.gaits_of_two_clusters()[0], water, "resting"))
        return every + [self.sinking(creature) for creature in self.size.creatures]
