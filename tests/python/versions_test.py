"""One version in all places: of this checkout, of a release made from it, and of what is to come after it."""

import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))
import versions  # noqa: E402


def run(*arguments):
    done = subprocess.run([sys.executable, ROOT / "tests/versions.py", *map(str, arguments)], capture_output=True, text=True)
    return done.returncode, done.stderr


class VersionsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        self.places = [place for place, _ in [versions.SOURCE, versions.CLIENT, versions.RECIPE, versions.HEADS, versions.CITATION, *versions.modules(ROOT)]]
        for place in self.places:
            (self.root / place).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / place, self.root / place)

    def test_all_places_agree(self):
        self.assertEqual(run(), (0, ""))
        self.assertGreaterEqual(len(self.places), 6)

    def test_a_release_and_the_next_version(self):
        self.assertEqual(run("--root", self.root, "--set", "97.0.0"), (0, ""))
        self.assertEqual(run("--root", self.root, "v97.0.0"), (0, ""))
        self.assertIn("tag v97.0.1", run("--root", self.root, "v97.0.1")[1])
        self.assertRegex((self.root / "CHANGELOG.md").read_text(), r"\n## \[97\.0\.0\] - \d{4}-\d\d-\d\d\n")
        for place in self.places:
            with self.subTest(place):
                text = (self.root / place).read_text()
                self.assertIn("97.0.0", text)
                (self.root / place).write_text(text.replace("97.0.0", "97.0.2"))
                code, said = run("--root", self.root)
                self.assertEqual(code, 1)
                self.assertIn("97.0.2", said)
                (self.root / place).write_text(text)
        heads = (self.root / "CHANGELOG.md").read_text().count("\n## ")
        self.assertEqual(run("--root", self.root, "--set", "98.0.0-SNAPSHOT"), (0, ""))
        self.assertIn("97.0.0", (self.root / "CITATION.cff").read_text())
        self.assertEqual(run("--root", self.root, "v98.0.0")[0], 1)
        self.assertEqual((self.root / "CHANGELOG.md").read_text().count("\n## "), heads + 1)

    def test_what_is_no_version(self):
        for version in ("1.2", "v1.2.3", "1.2.3-beta"):
            code, said = run("--root", self.root, "--set", version)
            self.assertEqual((code, said), (2, f"versions.py: --set {version}: must be as 1.2.3 or 1.2.3-SNAPSHOT\n"))


if __name__ == "__main__":
    unittest.main()
