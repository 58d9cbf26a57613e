"""What the Python client's README.md shows runs as it stands there."""

import contextlib
import io
import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[2] / "sim-native/python"
README = (PACKAGE / "README.md").read_text()


class DocumentsTest(unittest.TestCase):
    def test_every_block_of_python(self):
        blocks = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
        self.assertGreaterEqual(len(blocks), 5)
        for block in blocks:
            with self.subTest(block.splitlines()[0]), contextlib.redirect_stdout(io.StringIO()) as said:
                exec(compile(block, "README.md", "exec"), {"__name__": "__main__"})
            self.assertTrue(said.getvalue().strip(), block)

    def test_every_example(self):
        commands = re.findall(r"^python (sim-native/python/examples/.*)$", README, re.MULTILINE)
        self.assertEqual({Path(command.split()[0]).name for command in commands},
                         {path.name for path in (PACKAGE / "examples").glob("*.py")})
        for command in commands:
            done = subprocess.run([sys.executable, *command.split()], cwd=PACKAGE.parents[1], capture_output=True, text=True,
                                  env=dict(os.environ))
            self.assertEqual(done.returncode, 0, command + done.stderr)
            self.assertGreater(len(done.stdout.splitlines()), 2, command)


if __name__ == "__main__":
    unittest.main()
