"""The functions of numbers that a rule may call, by the names of the array API standard."""

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Final, Protocol, TypeVar, cast

from colift.agents.agent import FRAME

if TYPE_CHECKING:
    import jax

N = TypeVar("N", float, "jax.Array")
"""A number of one lift, or an array (n,) with one number for each of n lifts."""

N_co = TypeVar("N_co", float, "jax.Array", covariant=True)
"""The same, where it is only returned."""

Memory = TypeVar("Memory")
Record = TypeVar("Record", bound=tuple[Any, ...])
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

    def exp(self, x: N, /) -> N:
        """Return the exponential function."""

    def floor(self, x: N, /) -> N:
        """Return the largest whole number that is not larger."""

    def hypot(self, x: N | float, y: N, /) -> N:
        """Return the root of the sum of squares."""

    def logical_and(self, one: Any, other: Any, /) -> Any:
        """Return whether both hold."""

    def logical_not(self, one: Any, /) -> Any:
        """Return whether it does not hold."""

    def logical_or(self, one: Any, other: Any, /) -> Any:
        """Return whether either holds."""

    def minimum(self, x: N, y: N | float, /) -> N:
        """Return the smaller one."""

    def where(self, condition: Any, then: N | float, otherwise: N | float, /) -> N:
        """Return ``then`` where the condition holds, else ``otherwise``."""

    def fixed(self, x: N, /) -> N:
        """Return ``x``, as a constant for gradients."""

    def row(self, values: Sequence[N | float], like: N, /) -> Any:
        """Return some numbers as a row: a list, or an array (k, n) for the n lifts of ``like``."""

    def each(self, function: Callable[..., Any], /, *rows: Any) -> Any:
        """Return the row of a function's values for the numbers of rows of one length."""

    def seconds(self, frames: Any, /) -> N:
        """Return the time of a whole number of frames [s]."""

    def column(self, values: Sequence[N], /) -> Any:
        """Return numbers of successive frames as a column: a list, or an array (frames, n)."""

    def along(self, function: Callable[[Any], Record], column: Any, /) -> Record:
        """Return a record of columns, from a function that returns the record of a frame."""

    def total(self, row: Any, /) -> N:
        """Return the sum of a row's numbers."""

    def least(self, row: Any, /) -> N:
        """Return the smallest of a row's numbers."""

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
    exp = staticmethod(math.exp)
    floor = staticmethod(math.floor)
    hypot = staticmethod(math.hypot)
    minimum = staticmethod(min)

    @staticmethod
    def logical_and(one: Any, other: Any, /) -> Any:
        """Return whether both hold."""
        return one and other

    @staticmethod
    def logical_not(one: Any, /) -> Any:
        """Return whether it does not hold."""
        return not one

    @staticmethod
    def logical_or(one: Any, other: Any, /) -> Any:
        """Return whether either holds."""
        return one or other

    @staticmethod
    def fixed(x: float, /) -> float:
        """Return ``x``."""
        return x

    @staticmethod
    def row(values: Sequence[float], like: float, /) -> list[float]:
        """Return a list."""
        return list(values)

    @staticmethod
    def seconds(frames: float, /) -> float:
        """Return the time of frames [s]."""
        return frames * FRAME

    @staticmethod
    def column(values: Sequence[float], /) -> list[float]:
        """Return a list."""
        return list(values)

    @staticmethod
    def along(function: Callable[[Any], Record], column: Sequence[float], /) -> Record:
        """Return a record of lists, from the records of the frames."""
        found = [function(number) for number in column]
        kind: Any = type(found[0])
        return cast(Record, kind(*map(list, zip(*found, strict=True))))

    @staticmethod
    def total(row: Sequence[float], /) -> float:
        """Return the sum of a row's numbers, rounded once."""
        return math.fsum(row)

    @staticmethod
    def least(row: Sequence[float], /) -> float:
        """Return the smallest of a row's numbers."""
        return min(row)

    @staticmethod
    def each(function: Callable[..., Any], /, *rows: Sequence[float]) -> list[Any]:
        """Return the function's values."""
        return [function(*numbers) for numbers in zip(*rows, strict=True)]

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
