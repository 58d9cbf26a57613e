"""Every cell of the notebook runs, with small evolutions, and shows what it says it shows."""

import json
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

NOTEBOOK = Path(__file__).resolve().parents[2] / "sim-native/docs/evolve.ipynb"
SMALL = 'sizes = {"generations": 2, "population": 4, "duration": 0.2, "starts": 1}'
# Ends with the error of the first cell that fails.
EXECUTE = """
import sys
import nbclient, nbformat
notebook = nbformat.read(sys.argv[1], as_version=4)
nbclient.NotebookClient(notebook, timeout=600, kernel_name="python3").execute()
nbformat.write(notebook, sys.argv[1])
"""


def text(cell):
    return "".join(cell["source"])


class NotebookTest(unittest.TestCase):
    def execute(self, notebook):
        """It as it is after it ran; or what was said when it failed."""
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "notebook.ipynb")
            file.write_text(json.dumps(notebook))
            done = subprocess.run([sys.executable, "-c", EXECUTE, file], cwd=folder, capture_output=True, text=True,
                                  env={**os.environ, "TQDM_DISABLE": "", "IPYTHONDIR": folder, "JUPYTER_CONFIG_DIR": folder})
            left = {path.relative_to(folder).as_posix() for path in Path(folder).rglob("*") if path.is_file()}
            return (json.loads(file.read_text()), left) if done.returncode == 0 else done.stderr

    def test_it_runs(self):
        notebook = json.loads(NOTEBOOK.read_text())
        cells = {cell["id"]: cell for cell in notebook["cells"]}
        self.assertTrue(text(cells["sizes"]).startswith("sizes = {"))
        cells["sizes"]["source"] = SMALL
        ran = self.execute(notebook)
        self.assertIsInstance(ran, tuple, ran)
        outputs = {cell["id"]: json.dumps(cell["outputs"], ensure_ascii=False) for cell in ran[0]["cells"] if "outputs" in cell}
        self.assertIn("<animate attributeName", outputs["swim"])
        self.assertEqual(outputs["weaker"].count("pool/eel: "), 2)
        self.assertRegex(outputs["evolve"], r"2/2 .*best -?\d\.\d{3}")
        self.assertRegex(outputs["evolve"], r"\d ± \d\.\d{3} body lengths/s, -?\d\.\d\d at half the time step")
        self.assertIn("<animate attributeName", outputs["history"])
        self.assertIn("image/png", outputs["history"])
        self.assertEqual(outputs["climb"].count("at half the time step"), 2)
        self.assertLessEqual({"evolved.json", "evolved/swim.glb", "evolved/metadata.json"}, ran[1])

    def test_a_cell_that_fails_is_told(self):
        notebook = json.loads(NOTEBOOK.read_text())
        for cell in notebook["cells"]:
            if cell["id"] == "swim":
                cell["source"] = text(cell).replace('"eel"', '"eal"')
        ran = self.execute(notebook)
        self.assertIsInstance(ran, str)
        self.assertIn('unknown scene "pool/eal"', ran)

    def test_it_is_kept_without_outputs(self):
        for cell in json.loads(NOTEBOOK.read_text())["cells"]:
            self.assertEqual((cell.get("outputs", []), cell.get("execution_count")), ([], None), cell["id"])


if __name__ == "__main__":
    unittest.main()
