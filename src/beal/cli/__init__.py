"""The command ``beal``: a thin door on the public functions, with its exit codes.

0 success, 2 bad input, 3 the numerics did not reach the accuracy asked for, 130 interrupted.
"""

import sys
import warnings
from io import TextIOWrapper
from typing import TextIO

from beal.errors import ConvergenceError, ModelError

BAD_INPUT, NOT_CONVERGED, INTERRUPTED = 2, 3, 130


def main() -> None:
    """Run the command line and turn what beal raises into one message and an exit code."""
    warnings.showwarning = _warn
    if isinstance(sys.stdout, TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")  # a title that the terminal cannot show is no error
    try:
        from beal.cli.app import app  # inside, so that an early Ctrl-C leaves no traceback either

        app()
    except ModelError as error:
        _fail(str(error), BAD_INPUT)
    except ConvergenceError as error:
        _fail(str(error), NOT_CONVERGED)
    except (OverflowError, ValueError) as error:  # of which LinAlgError is one
        _fail(f"the numbers of this model are too large or too far apart to be computed with: {error}", NOT_CONVERGED)
    except OSError as error:
        _fail(f"{error.filename}: {error.strerror}" if error.filename else str(error), BAD_INPUT)
    except KeyboardInterrupt:
        _fail("interrupted", INTERRUPTED)


def _fail(message: str, code: int) -> None:
    print(f"beal: {message}", file=sys.stderr)
    sys.exit(code)


def _warn(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    print(f"beal: warning: {message}", file=sys.stderr)
