"""Errors by origin: the user's input, the policy, or the machine that evaluates."""

from enum import Enum, auto


class Remedy(Enum):
    """Action that a user can take after an InputError; each interface words it in its own way."""

    RESUME = auto()
    """Resume the interrupted run."""
    RESCORE = auto()
    """Verify the bundle and replace its scores by the present ones."""
    NEW_SUBMISSION = auto()
    """Start from the template of a submission."""
    SUBMISSION_FROM_FILE = auto()
    """Make a submission from a file; the target is ``file.py:Class``."""
    LIST = auto()
    """List the names of everything that is registered."""


class InputError(ValueError):
    """Invalid input from a user; the message names it, its value and the valid values.

    Parameters
    ----------
    message
        The fault, without options or commands of any interface.
    remedy
        The action to take, if a command line or a page can name a command for it.
    target
        The object of the remedy, such as a file.
    """

    def __init__(self, *message: object, remedy: Remedy | None = None, target: str = "") -> None:
        super().__init__(*message)
        self.remedy = remedy
        self.target = target


class PolicyError(Exception):
    """A failure of the policy; the message is the reason. The episode is a failed lift."""


class EvaluatorFault(Exception):  # noqa: N818
    """A failure of the machine, not of the policy: the episode is played again."""


def error_text(error: BaseException) -> str:
    """Return an error on one line: its class and its message."""
    if isinstance(error, PolicyError | EvaluatorFault):
        return str(error)
    return f"{type(error).__name__}: {error}".rstrip(": ")
