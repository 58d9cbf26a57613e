"""The report of a run folder: its page and pictures, of what `natator show --json` tells and of the best gait swum again."""

import json
import os
import pathlib
import stat
import subprocess
import sys
import tempfile
import unittest

from natator import report

SCENE, GAIT = "bench/small-tank", {"frequency": 1.5, "amplitude": [0.9, 0.7], "phase": [0, 0.65]}
WORDS = {
    "title": "bench/small-tank, seed 1", "unfinished": None, "answer": ["The best gait <does> not swim: moves & stops."],
    "measures": [["way", "0.1", "more than 0.05", "holds"], ["mirrored", "", "at least half", "not measured"]],
    "numbers": [["frequency (1/s)", "1.5000"]], "request": {"id": 0, "scene": SCENE, "gait": GAIT, "duration": 0.5, "scheme": "flex", "overrides": None},
    "worth": "distance (scene units)", "generations": [{"generation": k, "best": k, "mean": 0, "median": 0} for k in range(3)],
    "objectives": ["forward", "work"], "population": [[0, 1], [1, 0], [0, 0]], "front": [[0, 1], [1, 0]],
    "elites": [{"beats": 1.0, "cost": 2.0, "worth": 0.5}]}


class Report(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.run_folder = self.folder / "run"
        self.run_folder.mkdir()
        self.result(0.0, "unstable")
        self.program("import pathlib\nprint(pathlib.Path(__file__).with_name('words.json').read_text())\n")  # a natator that shows WORDS
        self.words({})
        before = os.environ.get("NATATOR")
        os.environ["NATATOR"] = str(self.folder / "natator")
        self.addCleanup(lambda: os.environ.pop("NATATOR") if before is None else os.environ.__setitem__("NATATOR", before))

    def program(self, text):
        file = self.folder / "natator"
        file.write_text(f"#!{sys.executable}\n{text}")
        file.chmod(file.stat().st_mode | stat.S_IXUSR)

    def words(self, more):
        (self.folder / "words.json").write_text(json.dumps(WORDS | more))

    def result(self, distance, status="ok"):
        (self.run_folder / "best.json").write_text(json.dumps({"result": {"status": status, "distance": distance, "frames": 20}}))

    def test_has_its_answer_pictures_and_numbers(self):
        page = report.write(self.run_folder).read_text(encoding="utf-8")
        self.assertIn("The best gait &lt;does&gt; not swim: moves &amp; stops.</p>", page)
        self.assertIn('<td class="holds">✔ holds</td>', page)
        self.assertIn('<td class="unknown">– not measured</td>', page)
        self.assertRegex(page, r"It moves like (none of the three kinds of|anguilliform|carangiform|thunniform) fish: of anguilliform e \d\.\d{4} ")
        self.assertRegex(page, r"The simulated curves end at [01]\.\d\d of the length")
        for section in ("Course of the run", "Motion", "Beside real fish", "Water", "Numbers", "Command"):
            self.assertIn(f">{section}</h2>", page)
        self.assertNotIn("nan", page.split("base64")[0] + page.split("Numbers</h2>")[1])
        pictures = {file.stem for file in (self.run_folder / "report").glob("*.png")}
        self.assertLessEqual({"fitness", "front-1", "elites", "position", "rotation", "spines", "envelopes", "flow"}, pictures)
        self.assertEqual(page.count("<img"), len(pictures))

    def test_tells_what_todays_program_does_otherwise(self):
        self.result(7.0)
        self.assertRegex(report.write(self.run_folder, self.folder / "out").read_text(encoding="utf-8"), r"Stored 7\.0000, today&#x27;s program -?\d\.\d{4}\.")

    def test_bad_input_is_one_line(self):
        taken = self.folder / "file"
        taken.write_text("")
        for program, arguments, status, line in (
                ("import sys\nprint('natator show: x is not a run folder', file=sys.stderr)\nsys.exit(2)", [self.run_folder], 2, "natator show: x is not a run"),
                (None, [self.run_folder, "--output-dir", taken / "a"], 2, f"output folder {taken / 'a'} cannot be made: "),
                ("import sys\nsys.exit(1)", [self.run_folder], 1, "show ended with 1")):
            if program:
                self.program(program)
            else:
                self.setUp()
            done = subprocess.run([sys.executable, "-m", "natator", "report", *map(str, arguments)], capture_output=True, text=True, check=False)
            self.assertEqual(status, done.returncode, done.stderr)
            self.assertIn(line, done.stderr)
            self.assertEqual(1, done.stderr.count("\n"), done.stderr)


if __name__ == "__main__":
    unittest.main()
