"""A page with a moving picture of each scene, which needs nothing else."""

import html
import json
import re
import subprocess
from pathlib import Path

from natator.errors import InputError, Unstable
from natator.program import simulator_path
from natator.stream import Stream
from natator.swimming import swim

PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Swimmers of Natator</title><meta name="viewport" content="width=device-width">
<style>:root{{color-scheme:light dark}}body{{font:16px/1.45 sans-serif;margin:1em}}main{{display:grid;gap:1em;
grid-template-columns:repeat(auto-fill,minmax(min(24em,100%),1fr))}}figure{{margin:0}}svg{{max-width:100%;height:auto}}</style></head><body>
<h1>Swimmers of Natator</h1><button type="button">Stop</button>
<main>
{figures}
</main>
<script>
const button = document.querySelector('button');
const toggle = () => {{
  const stops = button.textContent === 'Stop';
  document.querySelectorAll('svg').forEach(one => stops ? one.pauseAnimations() : one.unpauseAnimations());
  button.textContent = stops ? 'Go on' : 'Stop';
}};
button.addEventListener('click', toggle);
if (matchMedia('(prefers-reduced-motion: reduce)').matches) toggle();
</script></body></html>
"""


def scenes():
    """Names of the scenes that come with the program. Raises ProgramError."""
    return json.loads(subprocess.run([simulator_path(), "info", "--json"], capture_output=True, check=True).stdout)["scenes"]


def write(file, names=None, duration=2.0, told=lambda line: None):
    """Simulates scenes, by default all that come with the program and have a swimmer, each by its own gait, and writes an HTML page.

    names: scenes as of `swim`; one without a swimmer is an error. duration: s. told: is called with a line for each. Returns how
    many are on the page. Raises InputError, ProgramError and OSError; a swim that breaks a law of mechanics is told and left out.
    """
    if Path(file).suffix.lower() != ".html":
        raise InputError(f"file = {str(file)!r}: must end in .html")
    figures = []
    for name in names or filter(_swims, scenes()):
        try:
            one = swim(name, duration)
        except Unstable as error:
            told(f"{name}: {error}")
            continue
        told(repr(one))
        about = f"<figcaption>{html.escape(name)}: {html.escape(_description(one))}</figcaption>"
        figures.append(f"<figure>{one._repr_html_()}{about}</figure>")
    Path(file).write_text(PAGE.format(figures="\n".join(figures)), encoding="utf-8")
    return len(figures)


def _swims(name):
    """Whether it has a swimmer; without one some can't run at all."""
    try:
        with Stream(name) as stream:
            return stream.actuators > 0
    except InputError:
        return False


def _description(one):
    """The first sentence of its scene's."""
    text = one.trajectory.scene["definition"].get("description", "")
    return re.split(r"(?<=\.) ", text)[0]
