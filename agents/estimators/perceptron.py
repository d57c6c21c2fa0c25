"""Inference of a trained multilayer perceptron in plain NumPy, with a JSON representation."""

import itertools
from dataclasses import dataclass
from typing import Any, Self

import numpy as np
from colift.base.errors import InputError
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Perceptron:
    """A function from n to m numbers by layers of rectified linear units.

        z_0 = (x - centre) / deviation,  z_(i+1) = max(0, z_i W_i + b_i),
        y = gain (z_last W_last + b_last)

    It is piecewise linear: outside the training data it extrapolates along straight lines.

    Raises
    ------
    InputError
        If the shapes do not fit together, or a number is not finite.
    """

    centre: Array
    """(n,) mean of the inputs."""
    deviation: Array
    """(n,) standard deviation of the inputs."""
    weights: tuple[Array, ...]
    """W of each layer, (n, k), (k, l), ..., (., m)."""
    biases: tuple[Array, ...]
    """b of each layer, (k,), (l,), ..., (m,)."""
    gain: Array
    """(m,) scale of the outputs."""

    def __post_init__(self) -> None:
        """Check the shapes."""
        parts = [self.centre, self.deviation, *self.weights, *self.biases, self.gain]
        if not all(np.isfinite(part).all() for part in parts):
            raise InputError("a perceptron's numbers must be finite")
        sizes = [len(self.centre), *(len(bias) for bias in self.biases)]
        wanted = list(itertools.pairwise(sizes))
        shapes = [weight.shape for weight in self.weights]
        if not shapes or shapes != wanted:
            raise InputError(f"a perceptron's layers must have the shapes {wanted}, got {shapes}")
        if len(self.deviation) != sizes[0] or len(self.gain) != sizes[-1]:
            raise InputError("a perceptron needs one deviation per input and one gain per output")

    def __call__(self, inputs: ArrayLike) -> Array:
        """Return the outputs (..., m) for inputs (..., n)."""
        values = (np.asarray(inputs, dtype=np.float64) - self.centre) / self.deviation
        for weight, bias in zip(self.weights[:-1], self.biases[:-1], strict=True):
            values = np.maximum(values @ weight + bias, 0.0)
        outputs: Array = (values @ self.weights[-1] + self.biases[-1]) * self.gain
        return outputs

    def plain(self) -> dict[str, Any]:
        """Return a JSON representation, with five significant digits."""
        return {
            "centre": _rounded(self.centre),
            "spread": _rounded(self.deviation),
            "weights": [_rounded(weight) for weight in self.weights],
            "biases": [_rounded(bias) for bias in self.biases],
            "gain": _rounded(self.gain),
        }

    @classmethod
    def of(cls, content: dict[str, Any]) -> Self:
        """Return the perceptron of :meth:`plain`."""
        return cls(
            centre=np.array(content["centre"], dtype=np.float64),
            deviation=np.array(content["spread"], dtype=np.float64),
            weights=tuple(np.array(each, dtype=np.float64) for each in content["weights"]),
            biases=tuple(np.array(each, dtype=np.float64) for each in content["biases"]),
            gain=np.array(content["gain"], dtype=np.float64),
        )


def _rounded(values: Array) -> Any:
    """Return nested lists of numbers in five significant digits."""
    if values.ndim > 1:
        return [_rounded(row) for row in values]
    return [float(f"{value:.5g}") for value in values.tolist()]
