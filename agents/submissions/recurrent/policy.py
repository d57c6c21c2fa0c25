"""A trained recurrent network that corrects a straight line; its weights are in weights.npz."""

from pathlib import Path

from colift.agents.control.recurrent import read_gated
from colift.agents.control.recurrent_controller import RecurrentController


class Policy(RecurrentController):
    """Holds the human's last pace, corrected by gated recurrent units."""

    def __init__(self) -> None:
        super().__init__(read_gated(Path(__file__).with_name("weights.npz")))
