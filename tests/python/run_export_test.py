"""Exports of a run folder: TensorBoard, MLflow, Optuna and pyribs read back what is in it."""

import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
import warnings

import numpy as np

import natator
from natator import runs
from natator.export.runs import export_run

NAMES = ["frequency", "amplitude 1", "amplitude 2", "phase 2"]
DISTANCES = [[0.2, 0.5, 0.4], [0.6, 0.1, -0.3], [0.8, 0.7, 0.9]]  # of each generation
UNSTABLE, FAILED, STILL = (1, 1), (2, 1), (0, 0)
LENGTH, WORK = 0.8, 3.0


def gait(k):
    return {"frequency": 0.5 + 0.125 * k, "amplitude": [0.5, 0.25], "phase": [0.0, 0.75]}


def genes(k):
    return [0.5 + 0.125 * k, 0.5, 0.25, 0.75]


def write_run(folder, starts=1, **config):
    """Generations of three gaits each, as a run of natator leaves them."""
    folder.mkdir()
    settings = {"scene": "bench/small-tank", "encoding": "dense", "actuators": 2, "optimizer": "random", "population": 3, "generations": 2, "seed": 1,
                "fitness": "distance", "starts": starts, "judge": "mean", "scheme": "conserving", "duration": 0.1}
    (folder / "config.json").write_text(json.dumps(settings | config))
    lines, rows = [], []
    for generation, distances in enumerate(DISTANCES):
        for i, distance in enumerate(distances):
            for start in range(starts):
                k, place = len(lines) // starts, (generation, i)
                result = {"id": len(lines), "status": "ok", "distance": distance + 0.1 * start, "simulated": 2.0, "work": 0.0 if place == STILL else WORK}
                if place == UNSTABLE:
                    result = {"id": len(lines), "status": "unstable"}
                if place == FAILED:
                    result = {"id": len(lines), "status": "failed", "error": "gone"}
                lines.append({"generation": generation, "genes": genes(k), "gait": gait(k), "result": result, **({"start": start} if starts > 1 else {})})
        rows.append([generation, max(distances), np.mean(distances), np.median(distances), min(distances), 3, 3 * starts, int(generation == 1), int(generation == 2)])
    (folder / "evaluations.jsonl").write_text("".join(json.dumps(line) + "\n" for line in lines) + '{"generation":3,"gen')
    with open(folder / "generations.csv", "w", newline="") as table:
        csv.writer(table).writerows([["generation", "best", "mean", "median", "worst", "population", "evaluations", "unstable", "failed"], *rows])
    (folder / "timings.csv").write_text("generation,evaluations,seconds\n0,3,1.5\n1,6,2.5\n2,9,3.5\n")
    (folder / "environment.json").write_text('{"started": "2026-01-01T00:00:00Z"}')
    fresh = {"base": {"distance": {"mean": 0.71, "sd": 0.02}}}
    (folder / "best.json").write_text(json.dumps({"gait": gait(8), "bodyLength": LENGTH, "fresh": fresh}))
    return folder


class RunExportTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.out = self.folder / "out"
        self.run_folder = write_run(self.folder / "run")

    def test_tensorboard(self):
        export_run(self.run_folder, "tensorboard", self.out)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            from tensorboard.backend.event_processing.event_accumulator import EventAccumulator
            events = EventAccumulator(str(self.out))
            events.Reload()
            best = events.Tensors("fitness/best")
            from tensorboard.util.tensor_util import make_ndarray
        self.assertEqual([one.step for one in best], [0, 1, 2])
        np.testing.assert_allclose([make_ndarray(one.tensor_proto) for one in best], [0.5, 0.6, 0.9], rtol=1e-6)
        self.assertEqual([one.wall_time - best[0].wall_time for one in best], [0, 2.5, 6])
        self.assertEqual([float(make_ndarray(one.tensor_proto)) for one in events.Tensors("kinds")], [row["kinds"] for row in self.coverage()])

    def test_mlflow(self):
        from mlflow import MlflowClient
        export_run(self.run_folder, "mlflow", self.out)
        client = MlflowClient(tracking_uri=f"sqlite:///{self.out / 'mlflow.db'}")
        run, = client.search_runs([client.get_experiment_by_name("natator").experiment_id])
        self.assertEqual((run.info.run_name, run.info.status, run.data.params["optimizer"], run.data.params["population"]), ("run", "FINISHED", "random", "3"))
        self.assertEqual([(one.step, one.value) for one in client.get_metric_history(run.info.run_id, "fitness/best")], [(0, 0.5), (1, 0.6), (2, 0.9)])
        self.assertEqual((run.data.metrics["fresh/mean"], run.data.metrics["failed"]), (0.71, 1))

    def test_optuna(self):
        import optuna
        from optuna.storages.journal import JournalFileBackend
        export_run(self.run_folder, "optuna", self.out)
        storage = optuna.storages.JournalStorage(JournalFileBackend(str(self.out / "journal.log")))
        study = optuna.load_study(study_name="run", storage=storage)
        self.assertEqual([trial.value for trial in study.trials], [0.2, 0.5, 0.4, 0.6, None, -0.3, 0.8, None, 0.9])
        self.assertEqual([k for k, trial in enumerate(study.trials) if trial.state.name == "FAIL"], [4, 7])
        self.assertEqual(study.best_trial.params, dict(zip(NAMES, genes(8), strict=True)))
        self.assertEqual((study.best_trial.user_attrs["generation"], study.user_attrs["scene"]), (2, "bench/small-tank"))
        self.assertEqual(study.best_trial.distributions["frequency"], optuna.distributions.FloatDistribution(0.5, 2))

    def test_genes_have_their_encodings_names_and_ranges(self):
        for encoding, last in (("wave", {"waves": (0.25, 1.25)}), ("sparse", {"phase difference": (0.0, 1.0)}), ("sparse-steered", {"offset": (-0.5, 0.5)})):
            folder = write_run(self.folder / encoding, encoding=encoding)
            self.assertLessEqual(last.items(), runs.Run(folder).genes().items())

    def archive(self):
        folder = self.folder / "archive"
        export_run(self.run_folder, "archive", folder, force=True)
        return folder

    def coverage(self):
        with open(self.archive() / "coverage.csv", newline="") as lines:
            return [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines)]

    def test_archive_has_the_best_of_each_kind(self):
        import pandas
        from ribs.archives import ArchiveDataFrame
        folder = self.archive()
        kinds = {}
        for generation, distances in enumerate(DISTANCES):
            for i, distance in enumerate(distances):
                if (generation, i) not in (UNSTABLE, FAILED, STILL):
                    k = 3 * generation + i
                    pair = (gait(k)["frequency"] * 2 / (abs(distance) / LENGTH), WORK / abs(distance))
                    cell = tuple(math.floor(2 * math.log2(one)) for one in pair)
                    kinds[cell] = max(kinds.get(cell, (-9, None)), (distance, pair))
        frame = ArchiveDataFrame(pandas.read_csv(folder / "archive.csv"))
        self.assertLess(len(kinds), 6)
        self.assertEqual(frame["objective"].tolist(), [kinds[cell][0] for cell in sorted(kinds)])
        np.testing.assert_allclose(frame[["measures_0", "measures_1"]], [np.log2(kinds[cell][1]) for cell in sorted(kinds)], rtol=1e-14)
        self.assertEqual(len(frame["index"].unique()), len(kinds))
        rows = self.coverage()
        self.assertEqual([row["kinds"] for row in rows], sorted(row["kinds"] for row in rows))
        self.assertEqual(rows[-1]["kinds"], len(kinds))
        self.assertAlmostEqual(rows[-1]["qd_score"], sum(max(value, 0) for value, _ in kinds.values()))
        self.assertEqual(json.loads((folder / "metrics.json").read_text())["kinds"], len(kinds))

    def test_several_starts_are_judged_together(self):
        run = runs.Run(write_run(self.folder / "starts", starts=3))
        self.assertAlmostEqual(run.judge(run.tried()[1].worths), 0.6)
        best = max(value for _, value in run.elites(run.tried()).values())
        self.assertAlmostEqual(best, 1.0)

    def test_fresh_runs_correct_the_archive(self):
        written = [export_run(self.run_folder, "archive", self.folder / name, fresh=2, workers=workers) for name, workers in (("one", 1), ("two", 2))]
        self.assertEqual((self.folder / "one/corrected.csv").read_bytes(), (self.folder / "two/corrected.csv").read_bytes())
        self.assertLess(written[0]["corrected_qd_score"], written[0]["qd_score"])  # of these gaits, whose distances are made up
        self.assertLessEqual(written[0]["corrected_kinds"], written[0]["kinds"])

    def test_the_same_to_the_bit_and_replaced_by_force(self):
        for format in ("archive", "optuna"):
            export_run(self.run_folder, format, self.out)
            before = (self.out / "metadata.json").read_bytes()
            with self.assertRaisesRegex(natator.InputError, "--force$"):
                export_run(self.run_folder, format, self.out)
            export_run(self.run_folder, format, self.out, force=True)
            self.assertEqual((self.out / "metadata.json").read_bytes(), before)
            for file in self.out.iterdir():
                file.unlink()

    def command(self, *arguments):
        done = subprocess.run([sys.executable, "-m", "natator", "export", *map(str, arguments)], capture_output=True, text=True)
        return done.returncode, done.stdout.strip(), done.stderr.strip()

    def test_command(self):
        status, said, wrong = self.command(self.run_folder, "--format", "archive")
        self.assertEqual((status, wrong), (0, ""))
        self.assertRegex(said, r"run/export-archive: 3 generations, kinds \d, qd_score [\d.]+$")

    def test_what_cannot_be_used_is_one_line(self):
        empty = self.folder / "empty"
        empty.mkdir()
        young = write_run(self.folder / "young")
        (young / "generations.csv").unlink()
        compact = write_run(self.folder / "compact")
        (compact / "evaluations.jsonl").unlink()
        damaged = write_run(self.folder / "damaged")
        (damaged / "evaluations.jsonl").write_text("{}x\n")
        body = write_run(self.folder / "body", evolve={})
        for arguments, message in [([empty, "--format", "mlflow"], "is not a run folder: it has no config.json"),
                                   ([young, "--format", "archive"], "has no finished generation yet"),
                                   ([compact, "--format", "optuna"], "has no evaluations.jsonl"),
                                   ([damaged, "--format", "archive"], "evaluations.jsonl, line 1 is no JSON"),
                                   ([body, "--format", "archive"], "the kinds of gaits of"),
                                   ([self.run_folder, "--format", "optuna", "--duration", "1"], "--duration and --format optuna"),
                                   ([self.run_folder, "--format", "optuna", "--fresh", "1"], "--fresh and --format optuna"),
                                   (["pool/eel", "--format", "vtp", "--fresh", "1"], "--fresh and --format vtp"),
                                   ([self.run_folder, "--format", "archive", "--fresh", "0"], "--fresh is 0")]:
            with self.subTest(message):
                status, said, wrong = self.command(*arguments)
                self.assertEqual((status, said), (2, ""), wrong)
                self.assertIn(message, wrong)
                self.assertNotIn("\n", wrong)

    def test_a_missing_package_is_one_line_with_its_command(self):
        for format, module, package in (("tensorboard", "tensorboard", "tensorboard"), ("mlflow", "mlflow", "mlflow"), ("optuna", "optuna", "optuna")):
            with unittest.mock.patch.dict(sys.modules, {module: None, "tensorboard.summary": None}):
                with self.assertRaisesRegex(natator.InputError, f"^--format {format}: the Python package {package} is missing: pip install {package}$"):
                    export_run(self.run_folder, format, self.out)
        self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main()
