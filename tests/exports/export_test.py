"""Swims in the formats of other programs: read back by these programs' own readers, and what happens when things go wrong."""

import json
import os
import resource
import signal
import stat
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path
from unittest import mock

import natator
import numpy as np
from natator import InputError
from natator.export import FORMATS, bodies, export
from natator.export.folder import LOCK, METADATA, ExportFolder, files_in
from natator.program import simulator_path
from natator.source import merged, source

ROOT = Path(__file__).resolve().parents[2]
READERS = ROOT / "tests/readers"
sys.path += [str(READERS), str(ROOT / "tests/python")]
import check_export  # noqa: E402
from wrong_program_test import changed  # noqa: E402

TWO = {"frequency": 1.861, "amplitude": [0.973, 0.69], "phase": [0, 0.648]}
THREE = {"frequency": 1.761, "amplitude": [0.863, 0.503, 0.271], "phase": [0, 0.176, 0.729]}
FIVE = {"frequency": 1.5, "amplitude": [1, 1, 1, 1, 1], "phase": [0, 0.92, 0.84, 0.76, 0.68]}
TANK = "bench/small-tank"


class FolderTest(unittest.TestCase):
    """A folder for each test."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.target = self.folder / "swim"

    def names(self):
        return sorted(os.listdir(self.folder))


def command(*arguments, env={}, **options):
    return subprocess.run([sys.executable, "-m", "natator", *map(str, arguments)], capture_output=True, text=True,
                          env={**os.environ, **env}, **options)


class ReadersTest(FolderTest):
    """Exports beside the simulator's own stream: every number, by pyvista, plyfile, USD, pygltflib and numpy."""

    streams = {}

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.shared = Path(temporary.name)

    def stream(self, scene, until, **options):
        """What the simulator writes, byte for byte, all fields and frames."""
        arguments = [scene, "--until", str(until), *(f"--{key}={value if key == 'scheme' else json.dumps(value)}"
                                                     for key, value in options.items())]
        file = self.streams.setdefault(tuple(arguments), self.shared / f"{len(self.streams)}.stream")
        if not file.exists():
            with open(file, "wb") as out, subprocess.Popen(
                    [simulator_path(), "stream", "--fields", "position,velocity,density", "--rate", "0", "--lossless", *arguments],
                    stdin=subprocess.PIPE, stdout=out) as program:
                program.stdin.write(b'{"do":"credit","frames":1000}\n')
                program.stdin.flush()
                self.assertEqual(program.wait(), 0)
        return file

    def check(self, scene, until, format, given={}, **options):
        """How many numbers are equal."""
        folder = self.folder / format
        metadata = export(scene, format, folder, duration=until, **given, **options)
        self.assertEqual(metadata, json.loads((folder / METADATA).read_text()))
        self.assertEqual(sorted(metadata["files"]), files_in(folder))
        found = check_export.Check(self.stream(scene, until, **options), folder)
        getattr(found, format)()
        return found

    def test_every_number_of_a_swim_is_read_back(self):
        for format, least in {"vtp": 500000, "ply": 400000, "usd": 300000, "usdc": 300000, "csv": 400000, "npz": 300000,
                              "glb": 5000, "vti": 100000}.items():
            with self.subTest(format):
                found = self.check("thesis/creature-1", 0.1, format, gait=TWO)
                self.assertGreater(found.compared, least)
                self.assertEqual(len(found.reference.frames), 7)

    def test_the_body_alone_and_fewer_fields_and_frames(self):
        for format in FORMATS.keys() - {"vti"}:
            with self.subTest(format):
                found = self.check("thesis/creature-4", 0.2, format, dict(water=False, every=3, fields=["position"]), gait=THREE,
                                   scheme="conserving", overrides={"solver": {"substeps": 2, "viscosity": 3}})
                self.assertEqual(len(found.reference.frames), 5)

    def test_the_force_of_the_water_and_its_pressure(self):
        swim = self.folder / "forces"
        export("bench/small-tank", "npz", swim, scheme="conserving", duration=0.1, fields=("force",))
        with np.load(swim / "swim.npz") as arrays:
            force, body = arrays["force"], arrays["kind"] == 1
            self.assertNotIn("velocity", arrays)
        self.assertEqual(np.abs(force[0]).max(), 0)
        self.assertEqual(np.abs(force[:, ~body]).max(), 0)
        self.assertGreater(force[1:, body].sum(1)[:, 1].min(), 0)  # it is held up
        import pyvista
        export("bench/small-tank", "vti", self.folder / "grid", scheme="conserving", duration=0.1)
        *_, last = sorted((self.folder / "grid" / "water").iterdir())
        self.assertGreater(np.nanmax(pyvista.read(last)["pressure"]), 0)
        with self.assertRaisesRegex(InputError, "fields: scheme flex knows no force"):
            export("bench/small-tank", "npz", self.folder / "none", scheme="flex", duration=0.1, fields=("force",))

    def test_water_without_a_body(self):
        for format in FORMATS.keys() - {"glb"}:
            with self.subTest(format):
                self.check("thesis/tank", 0.05, format)

    def test_companions_and_obstacles(self):
        for scene, formats in (("company/school", ("vtp", "ply", "usd", "glb", "npz")), ("company/pillars", ("usd", "csv"))):
            for format in formats:
                with self.subTest(format):
                    self.check(scene, 0.02, format, dict(force=True))
            self.validate()

    def test_the_waters_surface(self):
        for format in ("vtp", "ply", "usd", "usdc"):
            with self.subTest(format):
                self.check("pool/creature-1", 0.1, format, dict(water_surface=True, every=5, fields=["position"]), gait=TWO)

    def test_the_waters_surface_alone(self):
        for format in ("vtp", "ply", "usdc"):
            with self.subTest(format):
                self.check("thesis/tank", 0.02, format, dict(water=False, water_surface=True))

    def test_bodies_of_all_kinds(self):
        for scene in ("pool/eel", "pool/tadpole", "pool/tuna", "pool/ray", "open-water/creature-3", "thesis/creature-1-vacuum"):
            for format in ("vtp", "npz"):
                with self.subTest(f"{scene} {format}"):
                    self.check(scene, 0.02, format, dict(force=True))

    def test_a_skin_has_bones(self):
        self.check("pool/ray", 0.1, "glb", gait=FIVE)
        self.check("pool/torus", 0.1, "glb", dict(force=True))
        self.validate()

    def test_a_skin_follows_its_bones(self):
        from pxr import Usd, UsdGeom

        export("pool/ray", "usd", self.folder / "usd", gait=FIVE, duration=0.1)
        found = check_export.Check(self.stream("pool/ray", 0.1, gait=FIVE), self.folder / "usd")
        stage = Usd.Stage.Open(str(self.folder / "usd/swim.usda"))
        mesh = UsdGeom.Mesh(stage.GetPrimAtPath("/Swim/Body"))
        found._glb_skin(mock.Mock(
            places=found.reference.scene["skin"]["vertices"],
            moved=lambda i: np.array(mesh.GetPointsAttr().Get(found.reference.frames[i]["frame"]))))

    def validate(self):
        """The validator of glTF finds nothing, where there is one."""
        validator = Path(sys.prefix) / "node_modules/gltf-validator"
        if validator.is_dir():
            done = subprocess.run(["node", READERS / "validate_glb.js", validator, self.folder / "glb/swim.glb"],
                                  capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_another_swim_is_not_the_same(self):
        other = self.stream("thesis/creature-1", 0.05, overrides={"solver": {"substeps": 3}})
        for format in ("vtp", "ply", "usd", "csv", "npz"):
            with self.subTest(format):
                export("thesis/creature-1", format, self.folder / format, duration=0.05)
                check = check_export.Check.__new__(check_export.Check)
                with mock.patch.object(check_export.Reference, "_frame", self.frame_of(other)), \
                        self.assertRaisesRegex(check_export.Difference, "; expected "):
                    check.__init__(self.stream("thesis/creature-1", 0.05), self.folder / format)
                    getattr(check, format)()

    @staticmethod
    def frame_of(file):
        """Frames of another stream in turn."""
        frames = iter(check_export.Reference(file, 1).frames)
        return lambda *_: next(frames)

    def test_the_same_export_has_the_same_bytes(self):
        for format in FORMATS:
            if format in ("usd", "usdc", "vtp", "ply", "npz"):
                for name in ("one", "two"):
                    export(TANK, format, self.folder / name, duration=0.02, force=True)
                one, two = ({name: (self.folder / folder / name).read_bytes() for name in files_in(self.folder / folder)}
                            for folder in ("one", "two"))
                self.assertEqual(one, two)

    def test_memory_does_not_grow_with_the_duration(self):
        for format in ("npz", "usdc"):
            used = []
            for duration in (0.5, 6):
                program = subprocess.Popen([
                    sys.executable, "-m", "natator", "export", "thesis/tank", "--format", format, "--duration", str(duration),
                    "--overrides", '{"solver":{"substeps":1}}', "--output-dir", self.target, "--force"], stdout=subprocess.DEVNULL)
                _, status, usage = os.wait4(program.pid, 0)
                program.returncode = status
                self.assertEqual(status, 0)
                used.append(usage.ru_maxrss << 10)
            self.assertGreater((self.target / f"swim.{format}").stat().st_size, 50 << 20)
            self.assertLess(used[1] - used[0], 40 << 20, format)


class CommandTest(FolderTest):
    """`python -m natator export`."""

    def refused(self, *arguments, code=2, **options):
        done = command("export", *arguments, **options)
        self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (code, "", 1), done.stderr)
        self.assertTrue(done.stderr.startswith("python -m natator"), done.stderr)
        return done.stderr

    def run_folder(self, **best):
        """A finished run."""
        run = self.folder / "run"
        run.mkdir()
        (run / "config.json").write_text(json.dumps({"scene": TANK, "scheme": "conserving", "duration": 0.05,
                                                     "overrides": {"solver": {"substeps": 8, "viscosity": 3}}}))
        (run / "best.json").write_text(json.dumps({"gait": TWO, "distance": 0.5, "runs": 1,
                                                   "result": {"status": "ok", "frames": 3}, **best}))
        return run

    def test_a_run_swims_by_its_best_gait_in_its_own_scene(self):
        run = self.run_folder(body={"solver": {"damping": 0.5}})
        done = command("export", run, "--format", "csv", "--every", 3, "--overrides", '{"solver":{"viscosity":5}}', "--fields", "density")
        self.assertEqual((done.returncode, done.stdout), (0, f"{run}/export-csv: 2 frames\n"), done.stderr)
        metadata = json.loads((run / "export-csv/metadata.json").read_text())
        self.assertEqual({key: metadata[key] for key in ("format", "run", "every", "scheme", "fields", "duration", "frames")}, {
            "format": "csv", "run": "run", "every": 3, "scheme": "conserving", "fields": ["position", "density"], "duration": 0.05,
            "frames": 2})
        self.assertEqual(metadata["gait"]["amplitude"], TWO["amplitude"])
        self.assertEqual(metadata["overrides"], {"scheme": "conserving", "solver": {"substeps": 8, "viscosity": 5, "damping": 0.5}})

    def test_that_a_run_swims_otherwise_today_is_told(self):
        run = self.run_folder()
        done = command("export", run, "--format", "npz")
        with np.load(run / "export-npz/swim.npz") as swim:
            today = float(swim["distance"][-1])
        self.assertEqual((done.returncode, done.stderr), (0, f"{run}: stored 0.5000, today's program {today:.4f}: another program, or "
                                                          "the scene was changed after the run was begun\n"))
        best = json.loads((run / "best.json").read_text())
        for changes, options in (({"distance": today}, []), ({"runs": 4}, []), ({}, ["--precision", "double"]),
                                 ({}, ["--scheme", "flex"])):
            (run / "best.json").write_text(json.dumps({**best, **changes}))
            done = command("export", run, "--format", "npz", "--force", *options)
            self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_bad_usage_is_one_line(self):
        (self.folder / "gait.json").write_text(json.dumps(TWO))
        (self.folder / "no.json").write_text("{")
        (self.folder / "list.json").write_text("[1]")
        (self.folder / "islands").mkdir()
        (self.folder / "islands/islands.json").write_text("{}")
        (self.folder / "begun").mkdir()
        (self.folder / "begun/config.json").write_text(json.dumps({"scene": TANK}))
        for arguments, message in (
                ("no/such --format csv", 'unknown scene "no/such"'),
                ("none.json --format csv", "none.json is neither a run folder nor a scene: there is no such file"),
                (". --format csv", ". is not a run folder: it has no config.json"),
                ("islands --format csv", "islands was evolved on islands by an earlier version"),
                ("begun --format csv", "begun has no best gait yet"),
                (f"{TANK} --format obj", "argument --format: invalid choice: 'obj'"),
                (f"{TANK} --format csv --gait none.json", "none.json: No such file"),
                (f"{TANK} --format csv --gait no.json", "no.json is no JSON: "),
                (f"{TANK} --format csv --gait list.json", "list.json holds [1]; expected a JSON object"),
                (f"{TANK} --format csv --gait gait.json --scheme fast", "scheme"),
                (f"{TANK} --format csv --overrides [1]", "[1]: No such file"),
                (f"{TANK} --format csv --overrides {{", "--overrides is no JSON: "),
                (f"{TANK} --format csv --overrides {{\"solver\":{{\"speed\":1}}}}", "solver.speed"),
                (f"{TANK} --format csv --water-surface", "--water-surface and --format csv: expected a format that holds meshes of many "
                 "shapes: vtp, ply, usd, usdc"),
                ("bench/small-tank --format usd --water-surface --overrides {\"fluid\":null}", "has no water; expected some"),
                ("lake/water --format npz", "lake/water has no particles to export; expected some"),
                ("thesis/tank --format ply --no-water", "thesis/tank has no particles to export; expected some"),
                ("thesis/tank --format glb", "--format glb: thesis/tank has no body with a surface; expected one"),
                (f"{TANK} --format csv --fields velocity,velocity", "--fields is velocity,velocity: must be some of position, velocity, "
                 "density, force, each once"),
                (f"{TANK} --format csv --every 0", "every = 0: must be a whole number from 1 on"),
                (f"{TANK} --format csv --every x", "argument --every: invalid int value: 'x'"),
                (f"{TANK} --format csv --duration 0", "duration = 0.0: must be above 0 s"),
                (f"{TANK} --format csv --duration nan", "duration = nan: must be"),
                (f"{TANK} --format csv --duration 1e300", "duration = 1e+300: must be at most "),
                (f"{TANK} --format csv --output-dir gait.json", "output folder gait.json cannot be made: there is a file of that name"),
                (f"{TANK} --format csv --output-dir gait.json/a", "output folder gait.json/a cannot be made: "),
                (f"{TANK} --format csv --output-dir /", "output folder is /: must be a folder of its own")):
            with self.subTest(arguments):
                before = self.names()
                self.assertIn(message, self.refused(*arguments.split(), cwd=self.folder))
                self.assertEqual(self.names(), before)

    def test_a_missing_package_is_named_before_anything_is_simulated(self):
        for arguments, module, message in (
                (["--format", "usdc"], "pxr", "--format usdc: the Python package usd-core is missing: pip install usd-core"),
                (["--format", "ply", "--water-surface"], "pysplashsurf",
                 "--water-surface: the Python package pysplashsurf is missing: pip install pysplashsurf")):
            (self.folder / f"{module}.py").write_text("raise ImportError\n")
            path = os.pathsep.join([str(self.folder), os.environ.get("PYTHONPATH", "")])
            self.assertIn(message, self.refused("no/such", *arguments, "--output-dir", self.target, env={"PYTHONPATH": path}))

    def test_a_failed_simulation_leaves_nothing(self):
        script = self.folder / "simulator.sh"
        script.write_text(f"#!/bin/sh\nexec timeout --foreground 0.5 '{simulator_path()}' \"$@\"\n")
        script.chmod(script.stat().st_mode | stat.S_IXUSR)
        for format in FORMATS:
            with self.subTest(format):
                said = self.refused(TANK, "--format", format, "--duration", 10000, "--every", 7, "--output-dir", self.target, code=1,
                                    env={"NATATOR_SIM": str(script)})
                self.assertIn("natator-sim has ended", said)
                self.assertEqual(self.names(), ["simulator.sh"])

    def test_an_unstable_simulation_leaves_nothing(self):
        self.assertIn("unstable at ", self.refused(
            TANK, "--format", "vtp", "--overrides", '{"solver":{"relaxationMode":"global"}}', "--output-dir", self.target, code=1))
        self.assertEqual(self.names(), [])

    def begun(self):
        """An export that has written some frames and goes on for hours."""
        program = subprocess.Popen([sys.executable, "-m", "natator", "export", TANK, "--format", "ply", "--duration", "100000",
                                    "--output-dir", self.target], stderr=subprocess.DEVNULL)
        while program.poll() is None and not (self.folder / "swim.partial/swim_000003.ply").exists():
            time.sleep(0.01)
        self.assertIsNone(program.poll())
        return program

    def test_an_export_that_is_told_to_end_leaves_nothing(self):
        for number, code in ((signal.SIGTERM, 143), (signal.SIGINT, 130)):
            program = self.begun()
            program.send_signal(number)
            self.assertEqual(program.wait(), code)
            self.assertEqual(self.names(), [])

    def test_a_killed_export_leaves_nothing_that_looks_complete(self):
        program = self.begun()
        self.assertIn("another export to ", self.refused(TANK, "--format", "csv", "--output-dir", self.target))
        program.kill()
        program.wait()
        self.assertEqual(self.names(), ["swim.partial"])
        done = command("export", TANK, "--format", "csv", "--duration", "0.02", "--output-dir", self.target)
        self.assertEqual((done.returncode, self.names(), sorted(os.listdir(self.target))),
                         (0, ["swim"], ["metadata.json", "swim.csv"]), done.stderr)

    def test_the_current_folder_is_filled_and_stays_the_current_one(self):
        self.target.mkdir()
        for options in ([], ["--force"]):
            done = command("export", TANK, "--format", "csv", "--duration", "0.02", "--output-dir", ".", *options, cwd=self.target)
            self.assertEqual((done.returncode, done.stdout), (0, ".: 2 frames\n"), done.stderr)
            self.assertEqual((self.names(), sorted(os.listdir(self.target))), (["swim"], ["metadata.json", "swim.csv"]))

    def test_a_disk_that_is_full_is_told(self):
        limit = lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100000, 100000)) or signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        for format in ("csv", "npz", "ply", "vtp"):
            said = self.refused("thesis/tank", "--format", format, "--duration", "0.1", "--output-dir", self.target, code=1,
                                preexec_fn=limit)
            self.assertIn("File too large", said)
            self.assertEqual(self.names(), [])

    def test_an_output_that_cannot_be_written_is_told(self):
        arguments = [sys.executable, "-m", "natator", "export", TANK, "--format", "csv", "--duration", "0.02", "--output-dir", self.target]
        with open("/dev/full", "w") as full:
            done = subprocess.run(arguments, stdout=full, stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, done.stderr), (1, "python -m natator: standard output: No space left on device\n"))

    def test_the_name_of_a_scene_is_told_as_it_is(self):
        scene = self.folder / 'm\u00e9 "a"\u001b\U0001f41f.json'
        scene.write_text(json.dumps({"base": TANK}))
        for format in ("usd", "ply", "glb", "vtp"):
            metadata = export(scene, format, self.folder / format, duration=0.01)
            self.assertEqual(metadata["scene"], str(scene))
        title = str(scene).replace("\u001b", "?")
        from pxr import Sdf
        self.assertIn(title, Sdf.Layer.FindOrOpen(str(self.folder / "usd/swim.usda")).documentation)
        self.assertIn(json.dumps(title).encode(), (self.folder / "glb/swim.glb").read_bytes().replace(b', Natator', b'"'))
        self.assertIn(title.encode("ascii", "replace"), (self.folder / "ply/swim_000000.ply").read_bytes())


class ExportFolderTest(FolderTest):
    def write(self, files=(METADATA,), replace=False):
        with ExportFolder(self.target, replace) as folder:
            for name in files:
                (folder.path / name).parent.mkdir(exist_ok=True)
                (folder.path / name).write_text(json.dumps({"files": list(files)}))
            folder.commit()

    def refused(self, message, replace=False):
        with self.assertRaisesRegex(InputError, message), ExportFolder(self.target, replace):
            pass

    def test_it_appears_when_it_is_whole(self):
        with ExportFolder(self.target) as folder:
            (folder.path / METADATA).write_text("{}")
            self.assertEqual(self.names(), ["swim.partial"])
            folder.commit()
        self.assertEqual((self.names(), os.listdir(self.target)), (["swim"], [METADATA]))

    def test_it_leaves_nothing_when_it_fails(self):
        with self.assertRaises(ZeroDivisionError), ExportFolder(self.target) as folder:
            (folder.path / "water").mkdir()
            (folder.path / "water/one").write_text("x")
            raise ZeroDivisionError
        self.assertEqual(self.names(), [])

    def test_an_empty_folder_is_filled_and_stays_itself(self):
        self.target.mkdir()
        self.target.chmod(0o771)
        before = self.target.stat().st_ino
        self.write(("water/1.ply", METADATA))
        self.assertEqual(files_in(self.target), [METADATA, "water/1.ply"])
        self.assertEqual((self.target.stat().st_ino, stat.S_IMODE(self.target.stat().st_mode)), (before, 0o771))

    def test_a_link_is_followed(self):
        (self.folder / "disk").mkdir()
        self.target.symlink_to(self.folder / "disk")
        for replace in (False, True):
            self.write(replace=replace)
            self.assertTrue(self.target.is_symlink())
            self.assertEqual(os.listdir(self.folder / "disk"), [METADATA])

    def test_a_link_that_leads_nowhere_is_refused(self):
        self.target.symlink_to("nowhere")
        self.refused("is a link that leads nowhere")

    def test_an_export_is_replaced_only_if_wanted(self):
        self.write(("swim.csv", "water/1.ply", METADATA))
        self.refused("is not empty; choose another by --output-dir, or replace the export in it by --force")
        self.write(replace=True)
        self.assertEqual((self.names(), os.listdir(self.target)), (["swim"], [METADATA]))

    def test_what_somebody_put_beside_an_export_is_not_removed(self):
        self.write()
        (self.target / "figures").mkdir()
        (self.target / "figures/notes.txt").write_text("mine")
        self.refused("holds figures/notes.txt, which is no part of the export in it", replace=True)

    def test_what_is_no_export_is_never_replaced(self):
        self.target.mkdir()
        for content in ("years of work", "[]", '{"files": 1}', "{"):
            for name in ("thesis.tex", METADATA):
                (self.target / name).write_text(content)
                self.refused("holds no export: it has no metadata.json that lists one", replace=True)
                (self.target / name).unlink()

    def test_what_somebody_put_into_the_folder_meanwhile_is_not_removed(self):
        for there in (True, False):
            if there:
                self.write()
            with self.assertRaises(InputError), ExportFolder(self.target, True) as folder:
                (folder.path / METADATA).write_text("{}")
                self.target.mkdir(exist_ok=True)
                (self.target / "notes.txt").write_text("mine")
                folder.commit()
            self.assertEqual((self.target / "notes.txt").read_text(), "mine")
            self.assertEqual(self.names(), ["swim"])
            (self.target / "notes.txt").unlink()
            (self.target / METADATA).unlink(missing_ok=True)

    def test_a_folder_of_somebody_else_is_not_removed(self):
        (self.folder / "swim.partial").mkdir()
        (self.folder / "swim.partial/mine").write_text("x")
        self.refused("swim.partial is in the way; remove it")
        (self.folder / "swim.partial" / LOCK).write_text("")  # as a killed export leaves it
        self.write()
        self.assertEqual((self.names(), os.listdir(self.target)), (["swim"], [METADATA]))


class WrongSceneTest(FolderTest):
    def test_a_scene_that_is_none_is_refused_before_a_file_is_begun(self):
        with natator.Stream("pool/ray", fields=("position", "velocity", "density")) as stream:
            scene, frame = stream.scene, stream.frame
        refused = 0
        for name, wrong in changed({key: scene[key] for key in ("mass", "clusters", "skin", "muscles", "slices", "solidRestDistance",
                                                                "fluidRestDistance", "companions")}):
            with self.subTest(name):
                said = mock.Mock(scene={**{key: scene[key] for key in scene.keys() - wrong.keys() - {name.removeprefix("no ")}}, **wrong},
                                 frame=frame, no_simulator=lambda: natator.ProgramError("another"))
                try:
                    swim = bodies.Swim.of(said)
                except natator.ProgramError:
                    refused += 1
                    continue
                for format in ("npz", "ply", "glb"):
                    writer = FORMATS[format](swim, self.folder)
                    try:
                        writer.frame(frame)
                        writer.finish()
                    finally:
                        writer.close()
        self.assertGreater(refused, 100)


class SourceTest(FolderTest):
    def test_patches_are_merged(self):
        self.assertEqual(merged({"a": {"b": 1, "c": 2}, "d": 1}, {"a": {"c": None}, "d": {"e": 1}}),
                         {"a": {"b": 1, "c": None}, "d": {"e": 1}})
        self.assertEqual((merged(None, {"a": 1}), merged({"a": 1}, None), merged(None, None)), ({"a": 1}, {"a": 1}, None))

    def test_a_gait_may_have_a_body(self):
        file = self.folder / "best.json"
        file.write_text(json.dumps({"gait": {"$schema": "x", **TWO}, "body": {"creature": {"spacing": 1}}}))
        swim = source("pool/eel", file, '{"creature":{"profile":2}}')
        self.assertEqual((swim.gait, swim.overrides), (TWO, {"creature": {"spacing": 1, "profile": 2}}))


class BodySurfaceTest(unittest.TestCase):
    SPACING = 0.075

    def body(self, slices):
        """Triangles and places of slices from the head on, each around the same axis: 3x5 wide and high, or rows from below 2-4-2."""
        places, indices = [], []
        for i, size in enumerate(slices.split()):
            rows = [int(size.split("x")[0])] * int(size.split("x")[1]) if "x" in size else list(map(int, size.split("-")))
            start = len(places)
            places += [(-i, y - (len(rows) - 1) / 2, z - (count - 1) / 2) for y, count in enumerate(rows) for z in range(count)]
            indices.append(range(start, len(places)))
        return indices, self.SPACING * np.array(places, "f4")

    def triangles(self, indices, places):
        return bodies.body_surface(indices, places, bodies.ROW_GAP * 2 * self.SPACING)

    @staticmethod
    def volume(places, triangles):
        a, b, c = (places[triangles[:, i]].astype(float) for i in range(3))
        return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6

    def test_a_prism_is_enclosed_exactly(self):
        for slices, cells in (("3x5 3x5 3x5", 16), ("2x6 2x6", 5), ("2x2 2x2 2x2 2x2", 3), ("2-4-4-2 2-4-4-2", 7),
                              ("1-3-5-3-1 1-3-5-3-1", 8), ("1-5-1 1-5-1 1-5-1", 8)):
            indices, places = self.body(slices)
            self.assertAlmostEqual(self.volume(places, self.triangles(indices, places)) / self.SPACING ** 3, cells, 3, slices)

    def test_every_shape_is_closed(self):
        for slices in ("1x3 2x4 3x5 3x6 2x5 1x3", "4x4 1x1", "1x1 3x2 1x2", "1x4 1x4", "5x1 5x1 2x1", "2x2 3x3 5x5 4x4",
                       "2x2 2-4-4-2 1-3-5-5-3-1 3x4 1x6", "1-3-1 1-5-1"):
            indices, places = self.body(slices)
            triangles = self.triangles(indices, places)
            edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
            self.assertEqual(sorted(map(tuple, edges)), sorted(map(tuple, edges[:, ::-1])), slices)
            self.assertGreaterEqual(self.volume(places, triangles), -1e-12, slices)
            self.assertGreater(len(triangles), 0)

    def test_small_shifts_do_not_matter(self):
        indices, places = self.body("3x5 3x5")
        shifts = np.arange(places.size).reshape(places.shape)
        moved = places + 0.004 * (shifts % 3 - 1) * (shifts % 7 - 3) / 3
        np.testing.assert_array_equal(self.triangles(indices, places), self.triangles(indices, moved.astype("f4")))

    def test_slices_that_are_no_grids_have_no_surface(self):
        indices, places = self.body("3x5 3x5")
        places[14, 1] += 0.06
        self.assertEqual(len(self.triangles(indices, places)), 0)
        for slices in ("3x5 2-3-2", "3x5 4-2-4", "3x5 2-4", "3x5 2-4-2-2", "3x5"):
            self.assertEqual(len(self.triangles(*self.body(slices))), 0, slices)


class MotionTest(unittest.TestCase):
    def test_a_rigid_motion_is_found(self):
        chance = np.random.default_rng(1)
        for _ in range(100):
            turn, _ = np.linalg.qr(chance.normal(size=(3, 3)))
            turn *= np.sign(np.linalg.det(turn))
            rest = chance.normal(size=(8, 3))
            found, centre, to = bodies.motion(rest, rest @ turn.T + [1, 2, 3])
            np.testing.assert_allclose(found, turn, atol=1e-12)
            np.testing.assert_allclose(to - turn @ centre, [1, 2, 3], atol=1e-12)
            x, y, z, w = bodies.quaternion(turn)
            np.testing.assert_allclose([1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)], turn[:, 0], atol=1e-12)

    def test_a_mirror_image_is_turned_not_mirrored(self):
        rest = np.random.default_rng(2).normal(size=(8, 3))
        self.assertAlmostEqual(np.linalg.det(bodies.motion(rest, rest * [1, 1, -1])[0]), 1)


if __name__ == "__main__":
    unittest.main()
