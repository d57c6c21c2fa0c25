"""The functions of numbers that a rule may call, by the names of the array API standard."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Final, Protocol, TypeVar

if TYPE_CHECKING:
    import jax

N = TypeVar("N", float, "jax.Array")
"""A number of one lift, or an array (n,) with one number for each of n lifts."""

Memory = TypeVar("Memory")
Output = TypeVar("Output")


class ArrayFunctions(Protocol[N]):
    """Functions of numbers, or of arrays with one number for each lift.

    ``jax.numpy`` has those of the standard as they are; :data:`SCALARS` has them for plain floats,
    exactly as the standard library computes them.
    """

    def clip(self, x: N, low: float, high: float, /) -> N:
        """Return ``x``, at least ``low``, at most ``high``."""

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

    @staticmethod
    def clip(x: float, low: float, high: float, /) -> float:
        """Return ``x``, at least ``low``, at most ``high``."""
        return min(max(x, low), high)

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
