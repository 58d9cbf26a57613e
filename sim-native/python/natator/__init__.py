"""The Natator simulator: swims, evaluations, trajectories as arrays, swimmers that a program drives.

`natator.gym` has the Gymnasium environments; importing it registers them. `natator.zoo` has PettingZoo's. `natator.export` writes swims for other programs,
`natator.picture` draws them; both are commands too: `python -m natator --help`.
"""

from natator.errors import InputError, NatatorError, ProgramError, Unstable
from natator.evolution import Evolved, evolve
from natator.gait import Gait
from natator.simulator import Simulator, evaluate
from natator.stream import Frame, Senses, Stream
from natator.swimming import Swim, swim
from natator.trajectory import Trajectory, record

__version__ = "0.3.0"

__all__ = [
    "Evolved", "Frame", "Gait", "InputError", "NatatorError", "ProgramError", "Senses", "Simulator", "Stream", "Swim", "Trajectory",
    "Unstable", "evaluate", "evolve", "record", "swim",
]
