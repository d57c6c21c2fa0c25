"""The loops within a control step: over its frames, and over the physics steps of a frame."""

from collections.abc import Callable
from typing import Any, Final

import jax

UNROLLED: Final = {"gpu": 10}
"""Turns of these loops that are one piece of code, by device; 1 elsewhere.

A GPU waits at each turn. On a processor it makes none faster, and compiling takes longer.
"""


def each_frame(step: Callable[..., Any], begun: Any, due: Any) -> tuple[Any, Any]:
    """Return what is left after some frames, and the output of each, as :func:`jax.lax.scan`."""
    return jax.lax.scan(step, begun, due, unroll=UNROLLED.get(jax.default_backend(), 1))
