"""Control by a recurrent network that was learned through the twin."""

from dataclasses import dataclass
from pathlib import Path

from colift.agents.control.recurrent import read_gated, shipped_network
from colift.agents.control.recurrent_controller import RecurrentController


@dataclass(frozen=True, kw_only=True)
class LearnedParameters:
    """Parameters of :class:`Learned`."""

    model: str | None = None
    """File ``weights.npz`` of a folder written by ``colift train apg``; None: the shipped one."""


class Learned(RecurrentController):
    """Corrects a straight line by a recurrent network, learned by gradients through lifts (ours).

    128 gated recurrent units remember the lift so far: how fast and how evenly this person moves,
    how noisy and how late the samples are, and how far the predictions have been off. The network
    was trained on the score itself, by gradients through whole lifts of the twin, with people of
    the benchmark's population and, for some lifts, of much wider ranges. See
    :func:`.recurrent.act` for the equations and ``docs/background/learned.md`` for the training.
    """

    def __init__(self, *, parameters: LearnedParameters | None = None) -> None:
        model = (parameters or LearnedParameters()).model
        super().__init__(shipped_network() if model is None else read_gated(Path(model)))
