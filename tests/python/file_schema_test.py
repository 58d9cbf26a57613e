"""scene, creature and gait.schema.json against natator-sim, which reads such files: the same keys, words, types and limits.

What is tried is taken from the schemas: every limit that they state is tried at a place of one of the specimens below."""

import copy
import json
import math
import re
import subprocess
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from natator.program import simulator_path
from schemas import FILES, ROOT, validator

NAMES = ["scene.schema.json", "creature.schema.json", "gait.schema.json"]
LIMITS = ["minimum", "maximum", "exclusiveMinimum", "minItems", "maxItems", "enum", "const", "pattern", "type"]

HOOP = str(ROOT / "sim-native/creatures/hoop.obj")
GAIT = {"$schema": "gait.schema.json", "frequency": 1, "amplitude": [0.5, 0.5], "phase": [0, 0.5], "offset": [0.1, 0],
        "power": 1}
BODY = {"name": "short", "description": "Short.", "slices": [{"height": 3, "width": 3, "count": 9}], "joints": [2, 4, 6],
        "spacing": 0.075, "particleMass": 1, "springsPerParticle": 4, "rearCentre": [0.4, 0.5, 0.5], "refinement": 1,
        "muscleSlices": [2, 4, 6], "joint": "line", "bend": "both", "clusterStiffness": 0.2, "springStiffness": 1}
SOLVER = {"substeps": 4, "numIterations": 4, "densityTolerance": 0, "maxIterations": 100, "solidIterations": 1, "gravity": [0, -10, 0], "radius": 0.15,
          "solidRestDistance": 0.15, "fluidRestDistance": 0.1, "dynamicFriction": 0.2, "staticFriction": 0,
          "particleFriction": 0.2, "restitution": 0, "adhesion": 0, "sleepThreshold": 0, "maxSpeed": 1e38,
          "maxAcceleration": 100, "shockPropagation": 0, "dissipation": 0, "damping": 1, "cohesion": 0, "surfaceTension": 0,
          "viscosity": 8, "kernelSupport": 2.5, "modifiedPressure": False, "kinematicViscosity": 0, "vorticityConfinement": 0, "solidPressure": 0.1,
          "freeSurfaceDrag": 0, "buoyancy": 1, "collisionDistance": 0.05, "particleCollisionMargin": 0,
          "shapeCollisionMargin": 0, "relaxationMode": "local", "relaxationFactor": 1, "maxNeighborsPerParticle": 96,
          "wind": [0, 0, 0], "drag": 0, "lift": 0, "plasticThreshold": 0, "plasticCreep": 0}
FLUID = {"count": [10, 5, 5], "spacing": 0.1, "origin": [0.05, 0.05, 0.05], "clearance": 0.1, "disorder": 3, "current": [0.2, 0, -0.1], "smagorinsky": 0.1,
         "mass": {"gradient": "uniform", "bottom": 1, "top": 1}}
SCENES = {
    "all of slices, goals and company": {
        "$schema": "scene.schema.json", "description": "All.", "scheme": "flex", "duration": 1, "timeStep": 0.02,
        "solver": SOLVER, "planes": [[0, 1, 0, 0], [0, 0, 1, 0]], "fluid": FLUID, "creature": BODY,
        "settling": {"updates": 1, "timeStep": 1e-4, "substeps": 1}, "stopping": {"planeContact": True, "noProgressAfter": 2},
        "goals": [{"measure": "economy", "weight": 2}, {"measure": "turn", "target": 90, "within": 5, "stop": False},
                  {"measure": "depth", "target": -0.3, "within": 0.1, "stop": True, "weight": 1},
                  {"measure": "reach", "target": [1, 0, 0], "weight": 1}],
        "companions": [{"creature": {"name": "eel"}, "gait": {"frequency": 1, "amplitude": [1], "phase": [0]}}],
        "obstacles": [{"shape": "sphere", "centre": [2, 1, 1], "radius": 0.1, "spacing": 0.05},
                      {"shape": "box", "centre": [3, 1, 1], "size": [0.1, 0.1, 0.2], "spacing": 0.05},
                      {"shape": "mesh", "centre": [4, 1, 1], "file": HOOP, "unit": 0.5, "forward": "x", "up": "y",
                       "digest": "DIGEST"},
                      {"shape": "mesh", "centre": [5, 1, 1], "file": HOOP, "length": 0.3}]},
    "a profile of numbers in a moving tank": {
        "base": "pool/water", "periodic": ["x"], "movingTank": {"along": "xz", "step": 0.4, "current": [0.1, 0, -0.1]},
        "creature": {"profile": {"length": 1.2, "height": 0.3, "width": 0.2, "joints": [0.3, 0.5]}, "bend": ["sideways"]}},
    "a profile of curves": {
        "base": "pool/water", "creature": {
            "profile": {"length": 1.5, "height": [[0, 0.3], [1, 0.2]], "width": [[0, 0.3], [1, 0.2]], "joints": [0.3, 0.5],
                        "fin": {"height": [[0.9, 0.3], [1, 0.4]], "thickness": 0.075}},
            "clusterStiffness": [[0, 0.3], [1, 0.2]], "springStiffness": [[0, 0.3], [1, 0.2]]}},
    "a mesh by its unit": {
        "base": "pool/water", "creature": {
            "mesh": {"file": "ray.obj", "unit": 0.04, "forward": "x", "up": "y", "joints": [0.3, 0.5],
                     "digest": "DIGEST"}}},
    "a mesh by its length": {
        "base": "pool/water", "creature": {"mesh": {"file": "ray.obj", "length": 1.2, "joints": [0.3, 0.5]}}},
    "a mesh around points": {
        "base": "pool/water", "creature": {"mesh": {"file": "ray.obj", "length": 1.2, "points": [[-5, 0, 0], [-20, 0, 0]]}, "bend": "contract"}},
    "a mesh around sampled points": {"base": "pool/water", "creature": {"mesh": {"file": "ray.obj", "length": 1.2, "points": 4}}},
    "nothing": {"base": "pool/eel", "fluid": None, "creature": None, "movingTank": None, "periodic": None},
}


def simulate(arguments, text=""):
    done = subprocess.run([simulator_path(), *arguments], input=text, capture_output=True, text=True)
    return None if done.returncode == 0 else done.stderr.strip().removeprefix("natator-sim: ")


def definition(scene):
    """A bundled scene with all that it is built on."""
    return json.loads(subprocess.run([simulator_path(), "info", scene, "--definition"], capture_output=True, check=True).stdout)


def read_scene(document):
    """What natator-sim has against a scene's file; None: nothing."""
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(document, file)
        file.flush()
        return simulate(["info", file.name, "--definition"])


def read_creature(document):
    """The same of a creature's file, which a scene names."""
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(document, file)
        file.flush()
        return read_scene({"base": "pool/water", "creature": {"name": file.name}})


def read_gait(document):
    """The same of a gait, which swims for one frame."""
    return simulate(["evaluate", "--plain"], json.dumps(
        {"id": 0, "scene": "thesis/creature-1-vacuum", "duration": 0.01, "gait": document}))


def follow(name, reference):
    """The file, the pointer in it and the schema that a $ref means."""
    file, _, pointer = reference.partition("#")
    schema = FILES[file or name]
    for key in filter(None, pointer.split("/")):
        schema = schema[key]
    return file or name, pointer, schema


def applied(name, pointer, schema, value, path=()):
    """Every part of a schema that says something about a part of a document: file, pointer, part, place, value."""
    if isinstance(schema, bool):
        return
    yield name, pointer, schema, path, value
    if "$ref" in schema:
        yield from applied(*follow(name, schema["$ref"]), value, path)
    for key in ("allOf", "anyOf", "oneOf"):
        for i, branch in enumerate(schema.get(key, [])):
            at = f"{pointer}/{key}/{i}"
            if validator(f"{name}#{at}").is_valid(value):
                yield from applied(name, at, branch, value, path)
    if isinstance(value, dict):
        for key in schema.get("properties", {}).keys() & value.keys():
            yield from applied(name, f"{pointer}/properties/{key}", schema["properties"][key], value[key], (*path, key))
    if isinstance(value, list):
        first = schema.get("prefixItems", [])
        for i, item in enumerate(value):
            if i < len(first):
                yield from applied(name, f"{pointer}/prefixItems/{i}", first[i], item, (*path, i))
            elif "items" in schema:
                yield from applied(name, f"{pointer}/items", schema["items"], item, (*path, i))


def tried(keyword, part, value):
    """A value at a limit, or None, and values beyond it."""
    limit, whole = part[keyword], part.get("type") == "integer"
    if keyword == "minimum":
        return limit, [limit - 1 if whole else math.nextafter(limit, -math.inf)]
    if keyword == "maximum":
        return limit, [limit + 1 if whole else math.nextafter(limit, math.inf)]
    if keyword == "exclusiveMinimum":
        return math.nextafter(limit, math.inf), [limit]
    if keyword == "minItems":
        return value[:limit], [value[:limit - 1]]
    if keyword == "maxItems":
        many = value * (limit + 1)
        return many[:limit], [many[:limit + 1]]
    if keyword == "type":
        return None, [3 if "object" in limit else {}] + [4.5] * whole
    return None, ["other" if limit != 0 else 0.5]


def changed(document, path, value):
    if not path:
        return value
    document = copy.deepcopy(document)
    holder = document
    for key in path[:-1]:
        holder = holder[key]
    holder[path[-1]] = value
    return document


def written(path):
    """A place as messages have it: goals[0].target."""
    return re.sub(r"^\.", "", "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in path))


def complaint(message):
    """Where a message finds something wrong, and what must be there, without the file and the value."""
    return re.sub(r" = .*?: must be ", ": must be ", re.sub(r'^scene "[^"]*": ', "", message))


class FileSchemaTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenes = copy.deepcopy(SCENES)
        cls.scenes["a mesh by its unit"]["creature"]["mesh"]["digest"] = definition("pool/ray")["creature"]["mesh"]["digest"]
        cls.scenes["all of slices, goals and company"]["obstacles"][2]["digest"] = definition("company/hoop")["obstacles"][0]["digest"]
        cls.specimens = [(NAMES[0], document, read_scene, "") for document in cls.scenes.values()]
        cls.specimens.append((NAMES[1], {"$schema": "creature.schema.json", "slices": BODY["slices"], "joints": [4]},
                              read_creature, "creature."))
        cls.specimens.append((NAMES[2], GAIT, read_gait, "gait."))

    def parts(self):
        """All that is said of the specimens. A gait within a scene is left to the gait by itself."""
        for name, document, reader, prefix in self.specimens:
            for file, pointer, part, path, value in applied(name, "", FILES[name], document):
                if path[-1:] != ("gait",) and (file != NAMES[2] or name == file):
                    yield (name, document, reader, prefix), (file, pointer), part, path, value

    def each(self, cases, check):
        """Checks cases some at a time: nearly all of the time is that of starting programs."""
        with ThreadPoolExecutor(4) as pool:
            for case, found in [(case, pool.submit(check, *case)) for case in cases]:
                with self.subTest(case[2:]):
                    self.assertIsNone(found.result())

    def test_specimens_fit_and_leave_nothing_out(self):
        for name, document, reader, _ in self.specimens:
            validator(name).validate(document)
            self.assertIsNone(reader(document))
        seen = {pointer for _, pointer, _, _, _ in self.parts()}
        for name in NAMES:
            self.assertEqual(sorted(stated(name, "", FILES[name]) - seen), [])

    def test_limits_words_and_types(self):
        cases, once = [], set()
        for specimen, pointer, part, path, value in self.parts():
            for keyword in LIMITS:
                if keyword in part and path and (pointer, keyword) not in once and not unlike(part, path):
                    once.add((pointer, keyword))
                    cases.append((specimen, value, pointer, path, keyword, part))
        self.assertGreater(len(cases), 250)
        self.each(cases, disagreement)

    def test_keys(self):
        """The reader tells the keys that it knows where it meets one that it does not."""
        objects = {}
        for specimen, _, part, path, value in self.parts():
            if isinstance(value, dict):
                keys = objects.setdefault((id(specimen[1]), path), (specimen, path, set()))[2]
                keys.update(key for key, schema in part.get("properties", {}).items() if schema is not False)
        self.assertGreater(len(objects), 30)

        def check(specimen, path, keys):
            name, document, reader, _ = specimen
            known = set() if path else {NAMES[0]: {"$schema", "base"}, NAMES[1]: {"$schema"}, NAMES[2]: set()}[name]
            holder = document
            for key in path:
                holder = holder[key]
            extended = changed(document, path, holder | {"zzzzzzzzzzzz": 1})
            allowed = re.search(r"unknown key \(= 1\); allowed: (.*)", reader(extended) or "")
            if not allowed or set(allowed[1].split(", ")) | known != keys or validator(name).is_valid(extended):
                return f"{written(path)}: {sorted(keys)}, reader: {allowed and allowed[1]}"
            return None

        self.each(objects.values(), check)

    def test_every_bundled_file_fits(self):
        folder = ROOT / "sim-native"
        for name, files in zip(NAMES, [folder.glob("scenes/**/*.json"), folder.glob("creatures/*.json"),
                                       folder.glob("examples/gaits/*.json")]):
            found = list(files)
            self.assertGreaterEqual(len(found), 3)
            for file in found:
                with self.subTest(file.name):
                    document = json.loads(file.read_text())
                    validator(name).validate(document)
                    self.assertEqual((file.parent / document["$schema"]).resolve(), folder / "protocol" / name)

    def test_creature_files(self):
        """What must be there, and what excludes what, is the same for schema and reader."""
        slices = {"slices": BODY["slices"], "joints": [2, 4, 6]}
        profile = {"profile": {"length": 1.2, "height": 0.3, "width": 0.2, "joints": [0.3, 0.5]}}
        mesh = {"mesh": {"file": str(ROOT / "sim-native/creatures/ray.obj"), "joints": [0.3, 0.5], "unit": 0.04}}
        points = {"mesh": {key: value for key, value in mesh["mesh"].items() if key != "joints"} | {"points": 4}, "bend": "contract"}
        good = [slices, profile, mesh, points, slices | {"$schema": "x", "description": "y", "name": "z"}]
        bad = [{}, {"slices": BODY["slices"]}, {"joints": [2]}, slices | profile, profile | mesh, slices | mesh,
               mesh | {"mesh": mesh["mesh"] | {"points": 4}}, profile | {"joints": [2]}, slices | {"$schema": 3}, slices | {"base": "pool/water"}, {"profile": {"length": 1}}]
        bad += [{"profile": {key: value for key, value in profile["profile"].items() if key != left}}
                for left in profile["profile"]]
        bad += [{"mesh": {key: value for key, value in mesh["mesh"].items() if key != left}} for left in ("file", "joints")]
        bad.append({"profile": profile["profile"] | {"fin": {"thickness": 0.1}}})
        for creature in good + bad:
            with self.subTest(creature):
                refused = read_creature(creature)
                self.assertEqual(refused is None, creature in good, refused)
                self.assertEqual(validator(NAMES[1]).is_valid(creature), creature in good)

    def test_words_that_choose_a_branch(self):
        """Measures of goals and shapes of obstacles, each with keys of its own."""
        for key, part, list_of in [("measure", "goal", "goals"), ("shape", "obstacle", "obstacles")]:
            branches = [branch["properties"][key] for branch in FILES[NAMES[0]]["$defs"][part]["oneOf"]]
            stated_words = [word for branch in branches for word in branch.get("enum", [branch.get("const")])]
            self.assertEqual(set(stated_words), words_of(read_scene({list_of: [{key: "other"}]})))

    def test_a_null_or_an_unnamed_creature(self):
        """Where a null means something, and that a creature says which it is."""
        taken = [{"fluid": None}, {"creature": {"profile": {"length": 1}}, "base": "pool/eel"}]
        refused = [{"creature": {}}, {"creature": {"spacing": 0.1}}, {"planes": None}, {"companions": [{"creature": {}}]},
                   {"goals": [{"measure": "turn"}]}, {"obstacles": [{"shape": "box", "centre": [1, 1, 1]}]}, {"$schema": 1}]
        for document in taken + refused:
            with self.subTest(document):
                self.assertEqual(validator(NAMES[0]).is_valid(document), document in taken)
                self.assertEqual(read_scene(document) is None, document in taken)


def stated(name, pointer, schema):
    """All parts of a schema that state a limit or describe a key."""
    found = set()
    if isinstance(schema, dict):
        if any(keyword in schema and not isinstance(schema[keyword], dict) for keyword in LIMITS):
            found.add((name, pointer))
        for key, inside in schema.items():
            found |= stated(name, f"{pointer}/{key}", inside)
    elif isinstance(schema, list):
        for i, inside in enumerate(schema):
            found |= stated(name, f"{pointer}/{i}", inside)
    return found


def unlike(part, path):
    """What the reader takes for something else: a creature's name for that of a file."""
    return path == ("companions", 0, "creature", "name") or part.get("type") == "null"


def words_of(refusal):
    """The words that a message says must be used."""
    return set(re.findall(r'"([^"]*)"', refusal.partition("must be ")[2]))


def disagreement(specimen, value, pointer, path, keyword, part):
    """What schema and reader don't agree on at one limit, or None."""
    name, document, reader, prefix = specimen
    at, beyond = tried(keyword, part, value)
    place = prefix + written(path[:-1] if keyword == "const" and isinstance(path[-1], int) else path)
    for wrong in beyond:
        wrong_document = changed(document, path, wrong)
        if validator(name).is_valid(wrong_document):
            return f"the schema takes {wrong}"
        refusal = reader(wrong_document)
        if not refusal or not re.search(rf"(^|[ :]){re.escape(place)}[ :\[]", refusal):
            return f"the reader takes {wrong}: {refusal}"
        if keyword == "enum" and path[-1] != "measure" and set(part["enum"]) != words_of(refusal):
            return f"the reader's words: {refusal}"
    if at is not None:
        right_document = changed(document, path, at)
        if not validator(name).is_valid(right_document):
            return f"the schema refuses {at}"
        refusal = reader(right_document)
        if refusal and complaint(refusal) == complaint(reader(changed(document, path, beyond[0]))):
            return f"the reader refuses {at}: {refusal}"
    return None


if __name__ == "__main__":
    unittest.main()
