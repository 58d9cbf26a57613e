"""`python -m natator gallery`: a page with a moving picture of each scene."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import natator
from natator import gallery

TANKS = ["bench/small-tank", "thesis/creature-1-vacuum"]


def gallery_of(*arguments):
    return subprocess.run([sys.executable, "-m", "natator", "gallery", *map(str, arguments)], capture_output=True, text=True)


class GalleryTest(unittest.TestCase):
    def test_each_scene_moves_on_one_page(self):
        with tempfile.TemporaryDirectory() as folder:
            page = Path(folder, "page.html")
            made = gallery_of(*TANKS, "--duration", 0.1, "-o", page)
            self.assertEqual((made.returncode, made.stdout), (0, f"{page}: 2 swims\n"), made.stderr)
            text = page.read_text()
        self.assertEqual([line.split(":")[0] for line in made.stderr.splitlines()], TANKS)
        self.assertEqual([text.count(part) for part in ("<figure>", "<animate ", "</figure>", "http://www.w3.org/2000/svg")], [2] * 4)
        for line in made.stderr.splitlines():
            self.assertIn(f"<title>{line}", text)
        self.assertIn("<figcaption>bench/small-tank: ", text)
        self.assertNotIn("src=", text)

    def test_by_default_all_that_have_a_swimmer(self):
        found = gallery.scenes()
        self.assertIn("plane/loach", found)
        with mock.patch.object(gallery, "scenes", return_value=["pool/water", "endless/water", TANKS[0]]), tempfile.TemporaryDirectory() as folder:
            told = []
            self.assertEqual(gallery.write(Path(folder, "page.html"), duration=0.05, told=told.append), 1)
        self.assertEqual([line.split(":")[0] for line in told], TANKS[:1])

    def test_what_breaks_a_law_is_told_and_left_out(self):
        broken = natator.Unstable(0.5, 3, "frame")
        with mock.patch.object(gallery, "swim", side_effect=broken), tempfile.TemporaryDirectory() as folder:
            told = []
            self.assertEqual(gallery.write(Path(folder, "page.html"), TANKS[:1], told=told.append), 0)
        self.assertEqual(told, [f"{TANKS[0]}: {broken}"])

    def test_what_cannot_be_used(self):
        for arguments, said in [(["pool/shark"], 'unknown scene "pool/shark"'), (["pool/water"], "must have a creature with actuators"),
                                ([TANKS[0], "--duration", "0"], "duration = 0.0: must be above 0 s"),
                                ([TANKS[0], "-o", "page.txt"], "file = 'page.txt': must end in .html")]:
            refused = gallery_of(*arguments)
            self.assertEqual((refused.returncode, refused.stderr.count("\n")), (2, 1), refused.stderr)
            self.assertIn(said, refused.stderr)


if __name__ == "__main__":
    unittest.main()
