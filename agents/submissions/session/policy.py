"""A trained recurrent network that remembers the lifts of a session; its weights are beside it."""

from pathlib import Path

from colift.agents.control.recurrent import read_gated
from colift.agents.sessions.session_controller import SESSION_INPUTS, SessionController


class Policy(SessionController):
    """Holds the human's last pace, corrected by units that remember the lifts before."""

    def __init__(self, remember: bool = True) -> None:
        weights = Path(__file__).with_name("weights.npz")
        super().__init__(read_gated(weights, SESSION_INPUTS), remember=remember)
