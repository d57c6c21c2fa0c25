"""The errors that have an owner: the user, the policy, or the machine that evaluates."""


class InputError(ValueError):
    """Something a user gave is wrong; the message names it, its value and what would be right."""


class PolicyError(Exception):
    """A policy failed; the message is the reason, as it is shown. The episode counts as worst."""


class EvaluatorFault(Exception):  # noqa: N818
    """The machine failed, not the policy: the episode is played again and never counted."""


def error_text(error: BaseException) -> str:
    """Return an error in a line: its class and what it says."""
    if isinstance(error, PolicyError | EvaluatorFault):
        return str(error)
    return f"{type(error).__name__}: {error}".rstrip(": ")
