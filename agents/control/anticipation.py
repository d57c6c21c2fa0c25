"""What was learned of how people move on: a perceptron, what it sees and how far it looks."""

import json
from dataclasses import asdict, dataclass, field
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..errors import InputError
from ..estimators.perceptron import Perceptron
from .modes import MODES
from .senses import Window

Array = NDArray[np.float64]


class Foresight(NamedTuple):
    """What is expected of the human from now on, on the mean."""

    rises: Array
    """(m,) rise of the human's end from its newest seen height, at each of the leads [m]."""
    modes: Array
    """(5,) probabilities of the :data:`.MODES`."""
    stroke_rise: float
    """Rise from the newest seen height to where the stroke in progress ends [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Anticipation:
    """Where the human's end will be, given what was seen of it.

    Raises
    ------
    InputError
        If the parts do not fit together.
    """

    perceptron: Perceptron
    """From the inputs of :class:`.Senses` to rises at the leads [m], probabilities of the modes and
    the rise of the stroke [m], in this order; see :class:`Foresight`."""
    window: Window
    """What it sees."""
    leads: Array
    """(m,) times from now [s], increasing."""
    latency: float = 0.1
    """Age of the seen heights that it was learned with [s]."""
    provenance: dict[str, Any] = field(default_factory=dict)
    """What it was learned from, and how."""

    def __post_init__(self) -> None:
        """Check that the parts fit together."""
        sizes = len(self.perceptron.centre), len(self.perceptron.gain)
        wanted = self.window.size, len(self.leads) + len(MODES) + 1
        if sizes != wanted:
            raise InputError(
                f"a perceptron of {wanted[0]} inputs and {wanted[1]} outputs is needed for the "
                f"window and {len(self.leads)} leads, got {sizes[0]} and {sizes[1]}"
            )
        if len(self.leads) < 2 or not (np.diff(self.leads) > 0).all():
            raise InputError(f"leads must increase, got {self.leads.tolist()}")

    def foresee(self, inputs: Array) -> Foresight:
        """Return what is expected after the inputs of :class:`.Senses`.

        The modes were learned by least squares on ones and zeros, whose mean is a probability; what
        a perceptron puts outside of [0, 1] is cut off, and the rest scaled to a sum of one.
        """
        outputs = self.perceptron(inputs)
        count = len(self.leads)
        shares = np.clip(outputs[count:-1], 1e-6, 1.0)
        return Foresight(outputs[:count], shares / shares.sum(), float(outputs[-1]))


def anticipation_json(anticipation: Anticipation) -> str:
    """Return the content of a file for :func:`read_anticipation`, one part a line."""
    content = {
        "window": asdict(anticipation.window),
        "leads_s": anticipation.leads.tolist(),
        "latency_s": anticipation.latency,
        "perceptron": anticipation.perceptron.plain(),
        "provenance": anticipation.provenance,
    }
    lines = (f"{json.dumps(name)}: {json.dumps(value)}" for name, value in content.items())
    return "{\n" + ",\n".join(lines) + "\n}\n"


def read_anticipation(text: str) -> Anticipation:
    """Return the anticipation of :func:`anticipation_json`.

    Raises
    ------
    InputError
        If the text is no such content.
    """
    try:
        content = json.loads(text)
        return Anticipation(
            perceptron=Perceptron.of(content["perceptron"]),
            window=Window(**content["window"]),
            leads=np.array(content["leads_s"], dtype=np.float64),
            latency=float(content["latency_s"]),
            provenance=content["provenance"],
        )
    except InputError:
        raise
    except (ValueError, KeyError, TypeError, AttributeError) as error:
        raise InputError(f"no anticipation: {type(error).__name__}: {error}") from error


@cache
def load_anticipation(path: str | None = None) -> Anticipation:
    """Return the anticipation of a file; of none, the one that is shipped.

    Raises
    ------
    InputError
        If the file cannot be read, or is no anticipation.
    """
    if path is None:
        return read_anticipation(files(__package__).joinpath("data", "anticipate.json").read_text())
    try:
        return read_anticipation(Path(path).read_text())
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: cannot be read: {error}") from None
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
