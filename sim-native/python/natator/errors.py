"""What can go wrong."""


class NatatorError(Exception):
    """Any of the errors below."""


class InputError(NatatorError, ValueError):
    """A scene, a gait or a command that can't be used. The message is the simulator's: what, where, what was expected."""


class ProgramError(NatatorError, RuntimeError):
    """The program is not there, or has ended where it should not."""


class Unstable(NatatorError, ArithmeticError):
    """The simulation has become unstable; a stream needs a reset.

    Attributes: `time` in s, `particle`, `stage`: where a number first was none.
    """

    def __init__(self, time, particle, stage):
        super().__init__(f"unstable at {time:g} s: particle {particle}, stage {stage}")
        self.time, self.particle, self.stage = time, particle, stage
