"""The learned causal bound: how level a robot can be that sees what a robot may see."""

from functools import cache
from importlib.resources import files
from typing import Final

from ...agents.policies.anticipation import read_anticipation
from ...agents.policies.anticipation_controller import AnticipateParameters
from .foreseer import Foreseer

CAUSAL_BOUND: Final = "causal_bound"

FIRST_SEED: Final = 150_000
"""Seed of the first lift that it learns from: other people and lifts than those of the policy."""

LIFTS: Final = 2400
"""Lifts that it learns from, in one round: its robot has anticipated from the first."""

HIDDEN: Final = (128, 128, 128)
"""Units of its hidden layers: twice the policy's, so more than three times the weights."""

ONLY_LEVEL: Final = AnticipateParameters(smoothness=0.0)
"""It is a bound of the error alone: nothing is given away for smoothness."""


@cache
def causal_bound() -> Foreseer:
    """Return the bound that is shipped, for the paper's latency and control period.

    It is an estimate, not a proof: what a larger network than the policy's learns in the same way,
    from other lifts, with nothing given away for smoothness.
    """
    text = files(f"{__package__.rpartition('.')[0]}").joinpath("data", "causal_bound.json")
    return Foreseer(
        name=CAUSAL_BOUND, model=read_anticipation(text.read_text()), parameters=ONLY_LEVEL
    )
