"""What the Python client's README.md shows runs as it stands there."""

import contextlib
import io
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from natator import __main__

PACKAGE = Path(__file__).resolve().parents[2] / "sim-native/python"
README = (PACKAGE / "README.md").read_text()


class DocumentsTest(unittest.TestCase):
    def test_every_block_of_python(self):
        blocks = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
        self.assertGreaterEqual(len(blocks), 5)
        for block in blocks:
            with self.subTest(block.splitlines()[0]), tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder), contextlib.redirect_stdout(io.StringIO()) as said:
                exec(compile(block, "README.md", "exec"), {"__name__": "__main__"})
            self.assertTrue(said.getvalue().strip(), block)

    def test_every_example(self):
        commands = re.findall(r"^python (sim-native/python/examples/.*)$", README, re.MULTILINE)
        self.assertEqual({Path(command.split()[0]).name for command in commands},
                         {path.name for path in (PACKAGE / "examples").glob("*.py")})
        shutil.rmtree(PACKAGE.parents[1] / "build/learned", ignore_errors=True)  # else a training that is whole says so, and no more
        for command in commands:
            if "ask_tell.py" in command:
                continue  # needs the program natator, which outside_again.py has
            done = subprocess.run([sys.executable, *shlex.split(command)], cwd=PACKAGE.parents[1], capture_output=True, text=True,
                                  env=dict(os.environ))
            self.assertEqual(done.returncode, 0, command + done.stderr)
            self.assertGreater(len(done.stdout.splitlines()), 2, command)

    def test_every_command_is_understood(self):
        root, parser = PACKAGE.parents[1], __main__.parser()
        lines = [(page, line) for page in [root / "README.md", *(root / "results").rglob("*.md"), *(root / "ga-java/docs").glob("*.md"),
                                           *(root / "sim-native").rglob("*.md")]
                 for line in re.findall(r"^python -m natator (.*)$", page.read_text(), re.MULTILINE)]
        self.assertGreaterEqual(len(lines), 10)
        for page, line in lines:
            with self.subTest(f"{page}: {line}"):
                parser.parse_args(shlex.split(line, comments=True))

    def test_every_command_of_the_simulator_has_its_options(self):
        root, helps, shown = PACKAGE.parents[1], {}, set()
        pages = [root / "README.md", root / "CONTRIBUTING.md", *(root / "results").rglob("measure*.sh"),
                 *(page for folder in ("sim-native/docs", "sim-native/protocol", "sim-native/python", "ga-java/docs", "results")
                   for page in (root / folder).rglob("*.md"))]
        for page in pages:
            fenced = page.suffix == ".sh"
            for line in re.sub(r"\\\n\s*", "", page.read_text()).splitlines():
                fenced ^= line.startswith("```")
                found = re.match(r"(?:\$ )?(?:build/release/bin/)?natator-sim ([a-z]+)(.*)", re.sub(r" +# .*$", "", line.strip()))
                if found and (fenced or line.startswith("    ")) and not re.search(r"[\[…]", found[0]):
                    shown.add((page.name, found[1], re.sub("'[^']*'", "TEXT", found[2])))
        self.assertGreater(len(shown), 15)
        for page, command, rest in sorted(shown):
            helps[command] = helps.get(command) or self.help_of(command)
            for option in re.findall(r"(?<= )--[a-z-]+", rest):
                self.assertRegex(helps[command], option + r"[ ,\n]", f"{page}: natator-sim {command}{rest}")

    def help_of(self, command):
        """What a command of the simulator says of itself, and each of its own commands."""
        def said(*arguments):
            return subprocess.run([os.environ["NATATOR_SIM"], *arguments, "--help"], capture_output=True, text=True, check=True).stdout

        own = said(command)
        below = re.findall(r"^  ([a-z]+) {2,}\S", own.partition("Subcommands:")[2], re.MULTILINE)
        return "".join([own, *(said(command, each) for each in below)])

    def test_examples_refuse_in_one_line(self):
        for command, message in [
                ("steer.py --duration -1", "duration = -1.0: must be a number above 0 (s)"),
                ("steer.py --duration nan", "duration = nan: must be a number above 0 (s)"),
                ("plan.py --duration 0", "duration = 0.0, ahead = 30: must be above 0 (s), and at least 5"),
                ("plan.py --scene bench/small-tank --keep CONTRIBUTING.md", "state: is no saved state"),
                ("steer.py --target 1 1 nan", "target[2] = nan: must be a finite number"),
                ("learn.py build/none --num-envs 0", "num_envs = 0: must be a whole number from 1 on"),
                ("learn.py build/none --rollouts 0", "--steps, --rollouts: must be at least 1"),
                ("steer.py --scene no/such", 'unknown scene "no/such": must be one of')]:
            with self.subTest(command):
                program, *options = command.split()
                done = subprocess.run([sys.executable, PACKAGE / "examples" / program, *options], capture_output=True, text=True,
                                      cwd=PACKAGE.parents[1])
                self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (2, "", 1), done.stderr)
                self.assertTrue(done.stderr.startswith(f"{program}: "), done.stderr)
                self.assertIn(message, done.stderr)

    def test_examples_tell_each_default_once(self):
        for example in (PACKAGE / "examples").glob("*.py"):
            said = subprocess.run([sys.executable, example, "--help"], capture_output=True, text=True, check=True).stdout
            self.assertNotIn("None", said, example)

    def test_examples_say_what_they_lack(self):
        for command, program, code, message in [
                ("steer.py", "/no/natator-sim", 1, "/no/natator-sim: must be the program natator-sim"),
                ("steer.py --scene pool/water", None, 2, "sense: the scene has no creature")]:
            with self.subTest(command):
                example, *options = command.split()
                done = subprocess.run([sys.executable, PACKAGE / "examples" / example, *options], capture_output=True, text=True,
                                      env=dict(os.environ, **({"NATATOR_SIM": program} if program else {})))
                self.assertEqual((done.returncode, done.stdout, len(done.stderr.splitlines())), (code, "", 1), done.stderr)
                self.assertIn(message, done.stderr)


if __name__ == "__main__":
    unittest.main()
