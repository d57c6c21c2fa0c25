"""The functions of rules for many lifts at a time: those of :mod:`jax.numpy`, and a scan."""

from collections.abc import Callable
from typing import Any, Final

import jax
import jax.numpy as jnp


class LiftFunctions:
    """The functions for arrays with one number for each lift; see :class:`.ArrayFunctions`."""

    def __getattr__(self, name: str) -> Any:
        """Return a function of :mod:`jax.numpy`."""
        return getattr(jnp, name)

    def frames(
        self, step: Callable[..., Any], memory: Any, columns: tuple[Any, ...], /
    ) -> tuple[Any, Any]:
        """Return the memory after some frames, and the output of each, from columns (f, n)."""
        return jax.lax.scan(step, memory, columns)


LIFTS: Final = LiftFunctions()
