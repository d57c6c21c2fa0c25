"""The functions of numbers that a rule may call, by the names of the array API standard."""

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Final, Protocol, TypeVar

if TYPE_CHECKING:
    import jax

N = TypeVar("N", float, "jax.Array")
"""A number of one lift, or an array (n,) with one number for each of n lifts."""

N_co = TypeVar("N_co", float, "jax.Array", covariant=True)
"""The same, where it is only returned."""

Memory = TypeVar("Memory")
Output = TypeVar("Output")


class ArrayFunctions(Protocol[N]):
    """Functions of numbers, or of arrays with one number for each lift.

    ``jax.numpy`` has those of the standard as they are; :data:`SCALARS` has them for plain floats,
    exactly as the standard library computes them.
    """

    def abs(self, x: N, /) -> N:
        """Return the absolute value."""

    def arcsin(self, x: N, /) -> N:
        """Return the inverse sine [rad]."""

    def clip(self, x: N, low: float, high: float, /) -> N:
        """Return ``x``, at least ``low``, at most ``high``."""

    def floor(self, x: N, /) -> N:
        """Return the largest whole number that is not larger."""

    def minimum(self, x: N, y: N, /) -> N:
        """Return the smaller one."""

    def where(self, condition: Any, then: N, otherwise: N | float, /) -> N:
        """Return ``then`` where the condition holds, else ``otherwise``."""

    def frames(
        self,
        step: Callable[[Memory, tuple[Any, ...]], tuple[Memory, Output]],
        memory: Memory,
        columns: tuple[Sequence[Any], ...],
        /,
    ) -> tuple[Memory, Sequence[Output]]:
        """Return the memory after some frames, and the output of each: a loop, or a scan.

        ``step`` returns memory and output for a memory and the numbers of a frame, one of each
        column.
        """


class Scalars:
    """The functions for plain floats."""

    abs = staticmethod(abs)
    arcsin = staticmethod(math.asin)
    floor = staticmethod(math.floor)
    minimum = staticmethod(min)

    @staticmethod
    def clip(x: float, low: float, high: float, /) -> float:
        """Return ``x``, at least ``low``, at most ``high``."""
        return min(max(x, low), high)

    @staticmethod
    def where(condition: Any, then: float, otherwise: float, /) -> float:
        """Return ``then`` if the condition holds, else ``otherwise``."""
        return then if condition else otherwise

    @staticmethod
    def frames(
        step: Callable[[Memory, tuple[Any, ...]], tuple[Memory, Output]],
        memory: Memory,
        columns: tuple[Sequence[Any], ...],
        /,
    ) -> tuple[Memory, list[Output]]:
        """Return the memory after some frames, and the output of each."""
        outputs = []
        for due in zip(*columns, strict=True):
            memory, output = step(memory, due)
            outputs.append(output)
        return memory, outputs


SCALARS: Final = Scalars()
