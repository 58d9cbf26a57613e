"""The site by Sphinx: the pages of this checkout as they stand, and the Python package from its docstrings. .ci/site builds it."""

import json
import re
import sys
from pathlib import Path

from myst_parser.parsers.sphinx_ import MystParser

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "sim-native/python"))

project = "Natator"
author = "The Natator developers"
version = release = re.search(r"project\(natator VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]
extensions = ["myst_parser", "sphinx.ext.autodoc"]
root_doc = "sim-native/docs/index"
include_patterns = ["*.md", ".github/RELEASE.md", "sim-native/**.md", "sim-native/docs/*.rst", "sim-native/docs/*.ipynb", "ga-java/docs/*.md",
                    "results/**.md", "tests/conformance/*.md"]
smartquotes = False
suppress_warnings = ["misc.highlighting_failure"]  # "…" in a block of JSON
myst_heading_anchors = 4
myst_enable_extensions = ["dollarmath"]
myst_fence_as_directive = ["math"]
autodoc_inherit_docstrings = False
autodoc_default_options = {"members": True, "undoc-members": True, "member-order": "bysource"}
html_title = f"Natator {version}"
html_theme_options = {"description": "Swimming soft creatures in water of particles", "page_width": "1200px", "body_max_width": "none"}
html_show_sourcelink = html_copy_source = False

FOLDER = re.compile(r"\[([^\]]+)\]\(([^)#:]+)\)")


def without_links_to_folders(app, page, source):
    """There are none on the site: their names stay."""
    folder = Path(app.env.doc2path(page)).parent
    source[0] = FOLDER.sub(lambda link: link[1] if (folder / link[2]).is_dir() else link[0], source[0])


class NotebookParser(MystParser):
    """A notebook as a page: its text, and its code without results."""

    supported = ("ipynb",)

    def parse(self, inputstring, document):
        cells = [("".join(cell["source"]), cell["cell_type"]) for cell in json.loads(inputstring)["cells"]]
        super().parse("\n\n".join(f"```python\n{text}\n```" if kind == "code" else text for text, kind in cells), document)


def setup(app):
    app.connect("source-read", without_links_to_folders)
    app.add_source_suffix(".ipynb", "ipynb")
    app.add_source_parser(NotebookParser)
