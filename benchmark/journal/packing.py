"""An episode as plain values, all its bits kept, and back."""

from dataclasses import asdict, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..episode import Episode
from ..scores import Scores
from ..trace import Trace


def packed(episode: Episode) -> dict[str, Any]:
    """Return an episode as numbers, texts and bytes."""
    trace = episode.trace
    return {
        **{each.name: getattr(episode, each.name) for each in fields(Episode)},
        "seed": str(episode.seed),  # A hidden seed has more bits than a number here may have.
        "scores": asdict(episode.scores),
        "trace": {
            **{name: _packed(getattr(trace, name)) for name in (*Trace.series(), "state")},
            "internals": {name: _packed(values) for name, values in trace.internals.items()},
        },
    }


def unpacked(content: dict[str, Any]) -> Episode:
    """Return the episode that :func:`packed` was given."""
    arrays = dict(content["trace"])
    internals = {name: _unpacked(values) for name, values in arrays.pop("internals").items()}
    trace = {name: _unpacked(values) for name, values in arrays.items()}
    return Episode(
        **{
            **content,
            "seed": int(content["seed"]),
            "scores": Scores(**content["scores"]),
            "trace": Trace(**trace, internals=internals),
            "step_times": tuple(content["step_times"]),
        }
    )


def _packed(values: NDArray[Any]) -> list[Any]:
    return [values.dtype.str, list(values.shape), values.tobytes()]


def _unpacked(content: list[Any]) -> NDArray[Any]:
    kind, shape, data = content
    return np.frombuffer(data, np.dtype(kind)).reshape(shape).copy()
