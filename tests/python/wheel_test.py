"""The wheel in an environment that has nothing else but numpy, with an empty PATH, from another folder; and where it can't work."""

import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest
import zipfile
from pathlib import Path

import numpy

ROOT = Path(__file__).resolve().parents[2]
WHEEL = os.environ.get("NATATOR_WHEEL", "")  # tests/python/run.sh makes it
READ_ONLY = [shutil.which("unshare"), "--map-root-user", "--mount"] if shutil.which("unshare") else []
SWIM = "import natator; print(natator.swim('eel', duration=0.1)); print(natator.program.simulator_path())"
REFUSED = """
import natator
try:
    natator.swim("eel", duration=0.1)
except natator.ProgramError as error:
    print(error)
"""


class WheelTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        cls.venv, cls.empty = cls.folder / "venv", cls.folder / "empty"
        cls.empty.mkdir()
        subprocess.run([sys.executable, "-m", "venv", "--without-pip", cls.venv], check=True)
        subprocess.run([sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check", "--python", cls.venv / "bin/python",
                        "install", "--no-index", "--no-deps", WHEEL], check=True,
                       env={name: value for name, value in os.environ.items() if name != "PYTHONPATH"})  # where it is installed, too
        cls.package, = cls.venv.glob("lib/python3*/site-packages/natator")
        cls.program = cls.package / "program/bin/natator-sim"
        libraries = Path(numpy.__file__).parents[1]
        for name in ("numpy", "numpy.libs"):
            (cls.package.parent / name).symlink_to(libraries / name)

    def run_here(self, *command, path=None, before=()):
        environment = {"PATH": "", "HOME": str(self.empty)} | ({"PYTHONPATH": str(path)} if path else {})
        return subprocess.run([*before, self.venv / "bin" / command[0], *command[1:]], cwd=self.empty, env=environment, capture_output=True,
                              text=True)

    def test_it_swims(self):
        done = self.run_here("python", "-W", "error", "-c", SWIM)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        summary, program = done.stdout.splitlines()
        self.assertRegex(summary, r"^pool/eel: -?\d\.\d{3} in 0\.10 s, -?\d\.\d\d body lengths/s$")
        self.assertEqual(program, str(self.program))

    @unittest.skipUnless(READ_ONLY and subprocess.run([*READ_ONLY, "true"]).returncode == 0, "needs a namespace of its own")
    def test_it_swims_where_nothing_can_be_written(self):
        mount = [*READ_ONLY, "/bin/sh", "-c", 'PATH=/usr/bin:/bin:/usr/sbin:/sbin; mount --bind -o ro "$0" "$0" && PATH= exec "$@"', self.folder]
        tried = self.run_here("python", "-c", "import natator; open(natator.__file__, 'a')", before=mount)
        self.assertIn("Read-only file system", tried.stderr)
        done = self.run_here("python", "-c", SWIM, before=mount)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_its_commands(self):
        version = self.run_here("natator-sim", "--version").stdout
        self.assertRegex(version, r"^natator-sim [\d.]+, commit ")
        listed = self.run_here("natator-sim", "info").stdout
        for scene in (ROOT / "sim-native/scenes").rglob("*.json"):
            self.assertIn(str(scene.relative_to(ROOT / "sim-native/scenes").with_suffix("")), listed)
        self.assertEqual(self.run_here("python", "-m", "natator", "--help").returncode, 0)
        for name in ("bench", "run pool/eel --backend cuda"):
            done = self.run_here("natator-sim", *name.split())
            self.assertEqual((done.returncode, len(done.stderr.splitlines())), (1 if name == "bench" else 4, 1), done.stderr)
            self.assertNotIn("site-packages", done.stderr)

    def test_it_brings_what_the_source_has(self):
        with zipfile.ZipFile(WHEEL) as wheel:
            names = set(wheel.namelist())
        for kind in ("scenes", "creatures", "examples/gaits", "protocol"):
            folder = ROOT / "sim-native" / kind
            for file in folder.rglob("*.json"):
                self.assertIn(f"natator/program/share/natator/{folder.name}/{file.relative_to(folder)}", names)
        self.assertLess(Path(WHEEL).stat().st_size, 15e6)  # CONTRIBUTING.md

    def test_the_sdist_holds_what_the_program_is_built_of(self):
        made = subprocess.run([sys.executable, "-c", "import sys; from scikit_build_core.build import build_sdist; build_sdist(sys.argv[1])",
                               self.folder], cwd=ROOT, capture_output=True, text=True)
        self.assertEqual(made.returncode, 0, made.stderr)
        with tarfile.open(next(self.folder.glob("natator-*.tar.gz"))) as sdist:
            held = {name.partition("/")[2] for name in sdist.getnames()}
        source = {str(file.relative_to(ROOT)) for file in (ROOT / "sim-native").rglob("*")
                  if file.is_file() and "__pycache__" not in file.parts}
        self.assertEqual(held, source | {"CMakeLists.txt", "LICENSE", "PKG-INFO", "pyproject.toml", "setup.sh"})

    def test_it_is_a_good_wheel(self):
        shown = subprocess.run([sys.executable, "-m", "auditwheel", "show", WHEEL], capture_output=True, text=True)
        self.assertIn('platform tag: "manylinux_2_', " ".join(shown.stdout.split()), shown.stderr)
        self.assertNotIn("libstdc++", shown.stdout)
        for checked in (["check_wheel_contents"], ["twine", "check", "--strict"]):
            done = subprocess.run([sys.executable, "-m", *checked, WHEEL], capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def refused(self, change, message, command=None):
        """What the client, and the command if that is told, say where the package's program has been changed."""
        with tempfile.TemporaryDirectory(dir=self.folder) as folder:
            package = Path(folder, "natator")
            shutil.copytree(self.package, package)
            change(package / "program/bin/natator-sim")
            said = self.run_here("python", "-c", REFUSED, path=folder)
            self.assertEqual((said.returncode, said.stderr, len(said.stdout.splitlines())), (0, "", 1))
            self.assertRegex(said.stdout, message)
            if command:
                done = self.run_here("natator-sim", "info", path=folder)
                self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (1, "", 1))
                self.assertRegex(done.stderr, command)

    def test_a_program_for_another_processor(self):
        def to_another(program):
            data = bytearray(program.read_bytes())
            data[18] = 0xF3 if data[18] != 0xF3 else 0x3E  # e_machine of ELF
            program.write_bytes(data)

        self.refused(to_another, "cannot be started: Exec format error, as a program for another kind of processor; build it here: pip install",
                     "^natator-sim: .*Exec format error: .*pip install")

    def test_a_c_library_that_is_too_old(self):
        def newer(program):
            data = program.read_bytes()
            needed = max(set(re.findall(rb"GLIBC_2\.\d\d(?=\0)", data)))
            program.write_bytes(data.replace(needed + b"\0", b"GLIBC_9.99\0"))

        self.refused(newer, "version `GLIBC_9.99' not found .*: this system's C library is too old for it; build it here: pip install",
                     r"^natator-sim: .*: needs glibc 9\.99, this system has 2\.\d\d: build it on this machine by pip install")

    def test_a_system_without_glibc(self):
        def to_another(program):
            data = program.read_bytes()
            loader = re.search(rb"/lib[\w/]*/ld-linux[\w.-]*(?=\0)", data)[0]
            program.write_bytes(data.replace(loader, loader.replace(b"ld-linux", b"ld-other"), 1))

        self.refused(to_another, r"cannot be started: No such file or directory, as where there is no glibc \(musl\); build it here: pip install",
                     "^natator-sim: .*No such file or directory: .*pip install")

    def test_a_program_of_another_version(self):
        def other(program):
            program.write_text("#!/bin/sh\necho natator-sim 0.0.1, commit unknown, instruction set portable\n")

        self.refused(other, r"program/bin/natator-sim is natator-sim 0\.0\.1, this package is [\d.]+: must be of the same version; ")

    def test_a_program_that_may_not_run(self):
        self.refused(lambda program: program.chmod(0o644), "Permission denied: must be executable, .*; install the package again$",
                     "^natator-sim: .*Permission denied: install natator again")

    def test_no_program(self):
        self.refused(Path.unlink, "^no natator-sim: install the package by pip install", "^natator-sim: the Python package natator .* no program")


if __name__ == "__main__":
    unittest.main()
