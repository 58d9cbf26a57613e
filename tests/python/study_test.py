"""What pages of results/ share: statistics beside textbooks and R, and a check that tells of other files than the data give."""

import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "results"))

import study  # noqa: E402


class Statistics(unittest.TestCase):
    def test_the_rank_test_is_that_of_the_textbook(self):
        """The example of scipy.stats.mannwhitneyu, from Conover's textbook: U = 17, exact p = 1/9."""
        row, = study.pairs({"males": [19, 22, 16, 29, 24], "females": [20, 11, 17, 12]})
        self.assertAlmostEqual(14 / 126, row["p"], 12)
        self.assertEqual(17 / 20, row["a"])

    def test_equal_values_are_no_evidence(self):
        row, = study.pairs({"a": [2, 2, 2], "b": [2, 2, 2, 2]})
        self.assertEqual((1, 0.5), (row["p"], row["a"]))

    def test_holms_correction_and_verdicts(self):
        low = list(range(10))
        a, b, c = study.pairs({"low": low, "high": [x + 100 for x in low], "none": [], "between": [x + 0.5 for x in low]})
        self.assertEqual("high further than low (p < 0.001, A = 0.00)", a["verdict"])
        self.assertAlmostEqual(3 * 2 / 184_756, a["p_holm"], 15)
        self.assertTrue(b["verdict"].startswith("no difference seen (p = "), b["verdict"])
        self.assertEqual("high further than between (p < 0.001, A = 1.00)", c["verdict"])
        few, = study.pairs({"a": [1, 2, 3], "b": [11, 12, 13]})
        self.assertEqual("too few to tell", few["verdict"])

    def test_intervals_of_few_values_are_exact(self):
        """The median of five drawn of 1, 2, … 5 is 1 with a chance of 0.058, more than a tail of 2.5 %: the interval is all of it."""
        self.assertEqual((3, 1, 5), study.median_interval([3, 1, 5, 2, 4]))
        self.assertEqual((10, 8, 12), study.median_interval([11, 12, 13], [1, 2, 3]))
        self.assertTrue(math.isnan(study.median_interval([7])[1]))

    def test_numbers_in_words(self):
        self.assertEqual(["0.13", "0.0", "-0.1"], [study.fixed(0.125, 2), study.fixed(-0.04, 1), study.fixed(-0.05, 1)])
        self.assertEqual(["1.00 ± 0.02", "1.0000 ± 0.0004", "1.00 ± 0.00"], [study.with_error(1, error, 2) for error in (0.02, 0.0004, 0)])

    def test_random_numbers_are_those_of_java(self):
        """new Random(20190101).ints(10, 0, 10), twice; ints(3, 0, 8) by low bits."""
        java = study.Random(20190101)
        self.assertEqual([[4, 7, 3, 4, 6, 4, 9, 7, 0, 8], [4, 3, 5, 8, 2, 3, 3, 6, 3, 6]], [java.ints(10, 10).tolist() for _ in range(2)])


class Check(unittest.TestCase):
    def check(self, page, change):
        """What --check of a page's copy says (exit code, errors), when the data are as they are and when they were changed."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder) / "results"
            shutil.copytree(ROOT / "results" / page, root / page)
            shutil.copy(ROOT / "results/study.py", root / "study.py")

            def told():
                done = subprocess.run([sys.executable, root / page / "make.py", "--check"], capture_output=True, text=True, check=False,
                                      env={"PYTHONPATH": str(root)})
                return done.returncode, done.stderr
            before = told()
            change(root / page)
            return before, told()

    def changed(self, page, name, old, new):
        def change(folder):
            text = (folder / name).read_text()
            self.assertIn(old, text)
            (folder / name).write_text(text.replace(old, new))
        return self.check(page, change)

    def test_tells_of_what_the_data_do_not_give(self):
        def change(folder):
            data = folder / "precision.csv"
            text = data.read_text().splitlines(keepends=True)
            data.write_text("".join(line for line in text if not line.startswith("hanging-chain,flex,double")))
        before, (code, errors) = self.check("precision", change)
        self.assertEqual((0, ""), before)
        self.assertEqual(1, code)
        self.assertRegex(errors, r"(?m)^\S*precision-hanging-chain.png: is not what make.py makes of the data; run: results/redo.sh precision$")

    def test_tells_of_an_answer_that_no_longer_follows(self):
        for page, name, old, new in (("convergence", "gaits.jsonl", '"mean": -0.26', '"mean": -0.06'), ("stability", "stability.csv", "dt,32,,,ok,,", "dt,32,,,unstable,tank,"),
                                     ("endless", "results.jsonl", '"distance":2.8', '"distance":3.8')):
            before, (code, errors) = self.changed(page, name, old, new)
            self.assertEqual((0, ""), before, page)
            self.assertEqual(1, code, page)
            self.assertRegex(errors, rf"^\S*README.md: is not what make.py makes of the data; run: results/redo.sh {page}\n$")

    def test_tells_of_rows_that_the_program_does_not_give(self):
        def again(folder):
            return subprocess.run([sys.executable, folder / "again.py", "cluster", "--seed", "1"], capture_output=True, text=True, encoding="utf-8")
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for file in ("again.py", "study.py"):
                shutil.copy(ROOT / "results" / file, folder)
            shutil.copytree(ROOT / "results/cluster", folder / "cluster")
            before, table = again(folder), folder / "cluster/efficiency.csv"
            self.assertEqual((0, ""), (before.returncode, before.stderr))
            lines = [line.split(",") for line in table.read_text(encoding="utf-8").splitlines()]
            table.write_text("".join(",".join([*line[:-4], line[-4].replace("0.", "0.1"), *line[-3:]]) + "\n" for line in lines), encoding="utf-8")
            after = again(folder)
            self.assertIn("DIFFERS", after.stdout)
            self.assertEqual(1, after.returncode, after.stderr)


if __name__ == "__main__":
    unittest.main()
