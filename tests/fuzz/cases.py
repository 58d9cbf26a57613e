"""What is mutated, by kind: a generator of texts, and the program that each text is given to."""
import json
import pathlib

from mutate import NUMBERS, cheap, dump, mutate, mutate_arguments, mutate_text
from programs import Once, Run, Serve, Stream

ROOT = pathlib.Path(__file__).resolve().parents[2]
GAIT = {"frequency": 1.861, "amplitude": [0.973, 0.69], "phase": [0, 0.648], "power": 1}
TANK = json.loads((ROOT / "sim-native/scenes/bench/small-tank.json").read_text())
SETTLING = {"updates": 2}
SOLVER = [("substeps", 2), ("numIterations", 2), ("gravity", [0, -9.81, 0]), ("radius", 0.1), ("solidRestDistance", 0.1),
          ("fluidRestDistance", 0.05), ("dynamicFriction", 0.1), ("staticFriction", 0.1), ("particleFriction", 0.1),
          ("restitution", 0.5), ("adhesion", 1), ("sleepThreshold", 0.1), ("maxSpeed", 10), ("maxAcceleration", 100),
          ("shockPropagation", 1), ("dissipation", 0.1), ("damping", 0.1), ("cohesion", 0.1), ("surfaceTension", 1),
          ("viscosity", 1), ("kinematicViscosity", 0.001), ("kernelSupport", 2.5), ("vorticityConfinement", 1), ("solidPressure", 1), ("freeSurfaceDrag", 0.1), ("buoyancy", 1),
          ("collisionDistance", 0.05), ("particleCollisionMargin", 0.01), ("shapeCollisionMargin", 0.01),
          ("relaxationFactor", 1), ("relaxationMode", "local"), ("maxNeighborsPerParticle", 96)]
SCENE = [("$schema", "scene.schema.json"), ("scheme", "conserving"), ("base", "thesis/tank"), ("duration", 0.02), ("timeStep", 1 / 60), ("fluid", None),
         ("planes", [[0, 1, 0, 0]]), ("settling", {"updates": 1}), ("stopping", {"planeContact": False}),
         ("solver", {"substeps": 2}), ("creature", None), ("count", [5, 5, 5]), ("joints", [2])]
REQUEST = [("duration", 0.02), ("scheme", "flex"), ("precision", "double"), ("backend", "cpu"), ("gait", GAIT),
           ("perturbation", {"amplitude": 0.001, "seed": 3}), ("power", 2)]


def overrides(random):
    """A patch of the small tank's scene, with some solver settings that its mutation can reach."""
    patch = {"settling": dict(SETTLING), "solver": dict(random.sample(SOLVER, random.randrange(4)))}
    if random.random() < 0.3:
        patch["fluid"] = {"count": [7, 5, 5]}
    if random.random() < 0.3:
        patch["scheme"] = "conserving"
    return patch


def text_of(random, document, keys):
    document = cheap(mutate(random, document, keys)) if random.random() < 0.95 else document
    text = dump(document)
    return mutate_text(random, text) if random.random() < 0.1 else text


def one_line(text):
    return text.replace("\n", " ")


def request(random):
    document = {"id": random.randrange(1000), "scene": "bench/small-tank", "duration": 0.034, "gait": dict(GAIT),
                "overrides": overrides(random)}
    return one_line(text_of(random, document, SCENE + SOLVER + REQUEST))


def gait(random):
    text = text_of(random, GAIT, [("power", 1), ("frequency", 1), ("amplitude", [1, 1]), ("phase", [0, 0])])
    return one_line('{"id":1,"scene":"bench/small-tank","duration":0.034,"overrides":{"settling":{"updates":2},'
                    f'"fluid":{{"count":[7,5,5]}}}},"gait":{text}}}')


def scene(random):
    return text_of(random, TANK | {"settling": SETTLING, "duration": 0.034} | ({"solver": dict(random.sample(SOLVER, 3))}),
                   SCENE + SOLVER)


def stream(random):
    commands = []
    for _ in range(random.randrange(1, 5)):
        command = random.choice([
            {"do": "credit", "frames": 2}, {"do": "run"}, {"do": "pause"}, {"do": "step", "frames": 1},
            {"do": "step", "frames": 2}, {"do": "rate", "value": 0}, {"do": "water"}, {"do": "reset"}, {"do": "gait", "gait": GAIT},
            {"do": "drive", "drive": [0.5, -1]}, {"do": "steer", "scale": [1, 0.5], "offset": [0.1, 0]},
            {"do": "step", "drive": [[0.5, 1], [1, 0]], "sense": True},
            {"do": "sense", "flow": [{"slice": 2, "side": "left"}], "within": 0.3, "target": [1, 0.5, 0.5], "each": True},
            {"do": "reset", "start": 3},
            {"do": "save"}, {"do": "restore"}, {"do": "restore", "sense": True}, {"do": "run", "swim": 0},
            {"do": "step", "scale": [[1, 0.5], [0, 1]], "offset": [[0.1, 0], [0, 0.2]]},
            {"do": "overrides", "overrides": {"solver": dict(random.sample(SOLVER, 2))}},
            {"do": "overrides", "overrides": overrides(random)},
            {"do": "scene", "scene": "bench/small-tank", "overrides": overrides(random), "gait": GAIT}])
        if random.random() < 0.5:
            command = command | {"id": random.randrange(100)}
        commands.append(one_line(text_of(random, command, [("do", "run"), ("frames", 1), ("id", 1)] + SCENE + SOLVER)))
    return "\n".join(commands)


def experiments():
    """The smallest measured experiments of each file, a few of each."""
    found = []
    for path in sorted((ROOT / "tests/conformance/micro").glob("*.json")):
        all_of = sorted(json.loads(path.read_text()), key=lambda one: len(json.dumps(one)))
        found += all_of[:3]
    return [one for one in found if len(json.dumps(one)) < 20000]


EXPERIMENTS = []


def particles(random):
    if not EXPERIMENTS:
        EXPERIMENTS.extend(experiments())
    return text_of(random, [random.choice(EXPERIMENTS)], SOLVER + [("dt", 0.01), ("substeps", 1), ("params", {})])


def info_scene(random):
    return scene(random)


RUN = [("duration", 0.02), ("scheme", "conserving"), ("precision", "double"), ("trajectory", "path.csv"), ("particles", True),
       ("snapshot", "fluid.csv"), ("at", 0.017), ("perturbation", 0.001), ("perturbation-seed", 3), ("backend", "auto"),
       ("device", 0), ("threads", 2), ("whole-gpu", True), ("no-cache", True), ("no-skip", True), ("gait", GAIT)]
PLACES = ["path.csv", "fluid.csv", "", ".", "no/such/folder.csv", "/dev/full", "é\U0001f600 .csv", "-"]
NO_NUMBERS = ["nan", "inf", "-inf", "1e999", "0x1p-4", " 1", "1 ", "1,5", "+1", "1e-320"]


def run(random):
    """Arguments of a run that writes files, and the file of its scene, as JSON; see programs.Run."""
    options = {"duration": 0.034, "gait": dict(GAIT), "overrides": overrides(random)}
    options |= dict(random.sample(RUN, random.randrange(1, 6)))
    options = cheap(mutate(random, options, RUN + SCENE + SOLVER)) if random.random() < 0.9 else options
    for name in ("trajectory", "snapshot"):
        if name in options and (random.random() < 0.2 or options[name] not in PLACES):
            options[name] = random.choice(PLACES)
    if random.random() < 0.1:
        options[random.choice(["duration", "at", "perturbation", "threads", "perturbation-seed", "device"])] = random.choice(NO_NUMBERS)
    files, arguments = {}, ["run", "bench/small-tank"]
    if random.random() < 0.2:
        files["scene.json"], arguments[1] = scene(random), "scene.json"
    for name, value in options.items():
        arguments.append(f"--{name}")
        if value is not True:
            text = value if isinstance(value, str) else dump(value)
            arguments.append(mutate_text(random, text) if random.random() < 0.03 else text)
    if random.random() < 0.1:
        arguments = mutate_arguments(random, arguments)
    return json.dumps({"files": files, "arguments": arguments})


L_SHAPE = [(0, 0), (2, 0), (2, 0.4), (0.8, 0.4), (0.8, 0.8), (0, 0.8)]
L_TRIANGLES = [(0, 1, 2), (0, 2, 3), (0, 3, 5), (3, 4, 5)]
STATEMENTS = ["v 9 9 9", "f 1 1 2", "f 1 2 1 2", "f -1 -2 -3", "f 1 2 3 4 5 6 7 8", "f 8 \\", "l 1 2", "# \\", "vp 1", "endsolid", "facet",
              "end facet", "vertex 0 0 0", "solid", "\r", "\udcff\udcfe", "v 0 0 1e9", "v 1e-9 0 0", "f 1/1 2//2 3/3/3"]


def mesh_file(random):
    """Name and lines of a slab: an .obj whose outlines are hollow, or an .stl."""
    places = [(x, y, z) for z in (0, 0.4) for x, y in L_SHAPE]
    sides = [(i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6)]
    if random.random() < 0.7:
        lines = ["v %g %g %g" % place for place in places]
        for face in [(5, 4, 3, 2, 1, 0), (6, 7, 8, 9, 10, 11), *sides]:
            first = random.randrange(len(face))
            lines.append("f " + " ".join(str(i + 1) for i in face[first:] + face[:first]))
        return "mesh.obj", lines
    lines = ["solid slab"]
    for a, b, c, d in sides + [(a, b, c, None) for a, b, c in L_TRIANGLES]:
        for corners in ((a, b, c), (a, c, d)) if d is not None else ((c, b, a), (a + 6, b + 6, c + 6)):
            lines += ["facet normal 0 0 0", "outer loop"] + ["vertex %g %g %g" % places[i] for i in corners] + ["endloop", "endfacet"]
    return "mesh.stl", lines + ["endsolid slab"]


def mesh(random):
    """Arguments of an info about a body of a mesh, and the mesh's file, as JSON; see programs.Run."""
    name, lines = mesh_file(random)
    for _ in range(random.choice([0, 1, 1, 2, 4])):
        at, way = random.randrange(len(lines)), random.randrange(4)
        if way == 0:
            lines.insert(at, random.choice(STATEMENTS))
        elif way == 1:
            lines[at] = lines[random.randrange(len(lines))]
        elif way == 2:
            words = lines[at].split(" ")
            words[random.randrange(len(words))] = str(random.choice(NUMBERS) if random.random() < 0.3 else random.randrange(-9, 10))
            lines[at] = " ".join(words)
        else:
            del lines[at]
    text = "\n".join(lines)
    if random.random() < 0.3:
        text = mutate_text(random, text)
    body = {"mesh": {"file": name, "joints": [0.3, 0.6], "length": 1.2}, "spacing": 0.05}
    return json.dumps({"files": {name: text}, "arguments": ["info", "pool/water", "--overrides", dump({"creature": body})]})


# How often a kind comes, its texts, and what runs them: (program, limit) -> runner.
KINDS = {
    "request": (40, request, lambda program, limit: Serve(program, limit)),
    "gait": (15, gait, lambda program, limit: Serve(program, limit)),
    "stream": (20, stream, lambda program, limit: Stream(program, limit)),
    "evaluate": (5, request, lambda program, limit: Once(program, ["evaluate"], limit)),
    "scene": (10, info_scene, lambda program, limit: Once(program, ["info", "--definition"], limit, as_file=True,
                                                         nulls=("fluid", "creature", "base"))),
    "particles": (10, particles, lambda program, limit: Once(program, ["particles"], limit, as_file=True,
                                                            nulls=("w", "result", "hash"), echoes=True)),
    "run": (8, run, lambda program, limit: Run(program, limit)),
    "mesh": (8, mesh, lambda program, limit: Run(program, limit)),
}
