"""The errors that have an owner: the user, the policy, or the machine that evaluates."""

from enum import Enum, auto


class Remedy(Enum):
    """What a user can do about an InputError; each interface has its own words for it."""

    RESUME = auto()
    """Resume the interrupted run."""
    RESCORE = auto()
    """Have a verification write the bundle anew, with the present scores."""
    NEW_SUBMISSION = auto()
    """Begin with the template of a submission."""
    SUBMISSION_FROM_FILE = auto()
    """Make a submission of a file; the target is ``file.py:Class``."""


class InputError(ValueError):
    """Something a user gave is wrong; the message names it, its value and what would be right.

    Parameters
    ----------
    message
        What is wrong, in the words of the library: without options or commands.
    remedy
        What the user can do, if a command line or a page can name a command for it.
    target
        What the remedy applies to, such as a file.
    """

    def __init__(self, *message: object, remedy: Remedy | None = None, target: str = "") -> None:
        super().__init__(*message)
        self.remedy = remedy
        self.target = target


class PolicyError(Exception):
    """A policy failed; the message is the reason, as it is shown. The episode counts as worst."""


class EvaluatorFault(Exception):  # noqa: N818
    """The machine failed, not the policy: the episode is played again and never counted."""


def error_text(error: BaseException) -> str:
    """Return an error in a line: its class and what it says."""
    if isinstance(error, PolicyError | EvaluatorFault):
        return str(error)
    return f"{type(error).__name__}: {error}".rstrip(": ")
