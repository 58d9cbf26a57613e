"""What scripts need: packages, and an end."""

import importlib
import os
import sys

from natator.errors import InputError, NatatorError


def run(parser, work):
    """Calls work(arguments) of an argparse parser. What goes wrong is said in one line: exit code 2 for what can't be used, 1 for
    other errors of this package; 130 if interrupted. Nothing is wrong if nobody reads the output to its end."""
    if sys.stdout is None:
        parser.exit(1, f"{parser.prog}: standard output: is closed; must be open\n")
    try:
        work(parser.parse_args())
        sys.stdout.flush()
    except NatatorError as error:
        parser.exit(2 if isinstance(error, InputError) else 1, f"{parser.prog}: {error}\n")
    except OSError as error:
        if error.filename is None:  # standard output, to which no more is to be written at the end
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        if not isinstance(error, BrokenPipeError):
            parser.exit(1, f"{parser.prog}: {error.filename or 'standard output'}: {error.strerror}\n")
    except KeyboardInterrupt:
        parser.exit(130)


def package(module, name, wanted_by):
    """A module of a package that not everybody has. Raises InputError where it is not there."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise InputError(f"{wanted_by}: the Python package {name} is missing: pip install {name}") from error
