"""Damage to what a board has stored."""

from typing import Final

import msgspec
from colift.base.errors import EvaluatorFault

DAMAGE: Final = (
    ValueError,
    TypeError,
    LookupError,
    AttributeError,
    RecursionError,
    msgspec.MsgspecError,
)
"""Errors of code that reads a record with other content than was written."""


class DamagedError(EvaluatorFault):
    """Something stored cannot be read; the message names it, and what to do."""
