"""The pages that list a format's keys have all of them, with the defaults of its schema; theory.md has the numbers of the source."""
import json
import re
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def schema(name):
    return json.loads((ROOT / f"sim-native/protocol/{name}.schema.json").read_text())


def at(document, pointer):
    """What a reference such as #/$defs/solver leads to."""
    for key in pointer.lstrip("#").split("/")[1:]:
        document = document[key]
    return document


class FormatsTest(unittest.TestCase):
    def rows(self, key):
        """Rows of the page that begin with a key."""
        found = re.findall(rf"^\| [^|\n]*`{re.escape(key)}`.*", self.page, re.MULTILINE)
        self.assertTrue(found, key)
        return found

    def test_scenes_and_gaits(self):
        self.page = (ROOT / "sim-native/protocol/scenes.md").read_text()
        scene, gait = schema("scene"), schema("gait")
        objects = [at(scene, one) for one in ("#/properties/settling", "#/properties/stopping", "#/$defs/solver", "#/$defs/fluid",
                                              "#/$defs/fluid/properties/mass")]
        for properties in [one["properties"] for one in objects]:
            self.assertTrue(properties)
            for key, value in properties.items():
                if not value.get("$ref", "").endswith("clothOnly"):
                    default = re.search(r"Default: (.*?)\.$", value.get("description", ""))
                    self.assertTrue(any(not default or f"| {default[1]} |" in row for row in self.rows(key)), key)
        for key in {*scene["properties"], *gait["properties"]} - {"$schema"}:
            self.rows(key)
        for key, value in [item for one in [*objects, gait] for item in one["properties"].items()]:
            each = at(scene, value["$ref"]).get("items", {}) if "$ref" in value else value.get("items", {})
            if "minimum" in each:  # of a list of numbers the page says what each may be
                said = f"each in [{each['minimum']}, {each['maximum']}]"
                self.assertTrue(any(said in row for row in self.rows(key)), key)

    def test_results(self):
        text = (ROOT / "sim-native/docs/results.md").read_text()
        properties = schema("result")["oneOf"][0]["properties"]
        keys = [key for name, value in properties.items() for key in (name, *value.get("properties", ())) if key != "id"]
        self.assertGreater(len(keys), 20)
        for key in keys:
            self.assertRegex(text, rf"`(\w+\.)?{key}[`.]")

    def test_run_folders(self):
        text = (ROOT / "ga-java/docs/run-folder.md").read_text()
        names = [file.name for file in (ROOT / "results/quick-evolution/default-seed-1").iterdir() if "." in file.name]
        self.assertGreater(len(names), 6)
        for name in names:
            self.assertIn(f"| `{name}` |", text)

    def test_the_numbers_of_theory_are_those_of_the_source(self):
        def numbers(pattern, text):
            return {name: float(value) for name, value in re.findall(pattern, text)}

        page, physics = (ROOT / "sim-native/docs/theory.md").read_text(), ROOT / "sim-native/src/physics"
        method, constants = [numbers(r"\b([a-z_]{4,}) = ([0-9.e-]+)[,;]", (physics / name).read_text()) for name in ("dfsph.h", "constants.h")]
        told = numbers(r"\| `([a-z_]+)` \| ([0-9.e-]+) (?=\|)", page)
        self.assertTrue(told)
        self.assertEqual(told, {name: {**constants, **method}.get(name) for name in told})
        self.assertLessEqual(method.keys(), told.keys())

    def test_what_theory_links_to_is_there(self):
        page = ROOT / "sim-native/docs/theory.md"
        links = re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page.read_text())
        self.assertGreater(len(links), 20)
        for link in links:
            self.assertTrue((page.parent / link).exists(), link)


if __name__ == "__main__":
    unittest.main()
