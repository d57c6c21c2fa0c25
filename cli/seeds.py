"""Ranges of seeds on the command line."""

from ..agents.errors import InputError


def seed_range(text: str) -> tuple[int, int]:
    """Return A and B of ``A:B``.

    Raises
    ------
    InputError
        If it is not two whole numbers.
    """
    start, colon, stop = text.partition(":")
    if not (colon and start.isdecimal() and stop.isdecimal()):
        raise InputError(f"--seeds must be A:B with 0 <= A < B, got {text!r}")
    return int(start), int(stop)
