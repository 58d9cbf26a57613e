"""Exceptions of the client."""


class NatatorError(Exception):
    """Base class of the client's exceptions."""


class InputError(NatatorError, ValueError):
    """A scene, a gait or a command that can't be used. The message is the simulator's: what, where, what was expected."""


class ProgramError(NatatorError, RuntimeError):
    """The program is not there, or has ended where it should not."""


class Unstable(NatatorError, ArithmeticError):
    """The simulation has become unstable; a stream needs a reset.

    Attributes: `time` in s, `particle`, `stage`, `law`: which law of mechanics was broken first, where and by what; law
    "finite" means that a number was none.
    """

    def __init__(self, time, particle, stage, law="finite"):
        super().__init__(f"unstable at {time:g} s: particle {particle}, stage {stage}, law {law}")
        self.time, self.particle, self.stage, self.law = time, particle, stage, law
