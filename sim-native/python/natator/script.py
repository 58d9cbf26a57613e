"""How a script ends."""

import os
import sys

from natator.errors import InputError, NatatorError


def run(parser, work):
    """Calls work(arguments) of an argparse parser. What goes wrong is said in one line: exit code 2 for what can't be used, 1 for
    other errors of this package; 130 if interrupted. Nothing is wrong if nobody reads the output to its end."""
    try:
        work(parser.parse_args())
    except NatatorError as error:
        parser.exit(2 if isinstance(error, InputError) else 1, f"{parser.prog}: {error}\n")
    except KeyboardInterrupt:
        parser.exit(130)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
