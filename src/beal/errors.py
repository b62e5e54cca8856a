"""The exceptions of beal.

BealError
├── ModelError (ValueError)         the vehicle, study or option is not usable: what, where, what was expected
└── ConvergenceError (RuntimeError) the numerics could not reach the accuracy asked for
"""

from collections.abc import Sequence


class BealError(Exception):
    """Base of every exception that beal raises on purpose."""


class ModelError(BealError, ValueError):
    """A model, study or option that cannot be used.

    Parameters
    ----------
    problems : sequence of (path, message) or str
        Every problem that was found, each with the path of the quantity (``stage[1].length``), or one message.
    source : str
        Name of the file that they are in.

    Examples
    --------
    >>> print(ModelError([("stage[1].length", "must be positive, found -0.4")]))
    stage[1].length: must be positive, found -0.4
    """

    def __init__(self, problems: str | Sequence[tuple[str, str]], source: str = "") -> None:
        self.problems: list[tuple[str, str]] = [("", problems)] if isinstance(problems, str) else list(problems)
        lines = [f"{path}: {message}" if path else message for path, message in self.problems]
        if source and len(lines) == 1:
            lines = [f"{source}: {lines[0]}"]
        elif source:
            lines = [f"{source}: {len(lines)} problems", *(f"  {line}" for line in lines)]
        super().__init__("\n".join(lines))


class ConvergenceError(BealError, RuntimeError):
    """The accuracy asked for was not reached; the message says which was reached and what to change."""
