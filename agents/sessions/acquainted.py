"""Control by a recurrent network that remembers the lifts of a session."""

from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path

from colift.agents.control.recurrent import GatedNetwork, read_gated
from colift.agents.sessions.session_controller import SESSION_INPUTS, SessionController


@dataclass(frozen=True, kw_only=True)
class AcquaintedParameters:
    """Parameters of :class:`Acquainted`."""

    remember: bool = True
    """Whether the units are kept from lift to lift; without, the weights are those of a network
    that was trained alike, and begins each lift anew."""
    model: str | None = None
    """File ``weights.npz`` of a folder written by ``colift train apg --session``; None: a shipped
    one. A network that was trained to forget needs ``remember=False``."""


class Acquainted(SessionController):
    """Corrects a straight line by a recurrent network that gets to know the person (ours).

    The equations are those of :class:`.Learned`, with the time since the lift began as one more
    input, and units that are kept from lift to lift. The network was trained by gradients through
    whole sessions of the twin, with other people (``colift train apg --session remember``): it has
    to find out by itself what of a lift is worth remembering.
    """

    def __init__(self, *, parameters: AcquaintedParameters | None = None) -> None:
        chosen = parameters or AcquaintedParameters()
        network = (
            shipped_network(remember=chosen.remember)
            if chosen.model is None
            else read_gated(Path(chosen.model), SESSION_INPUTS)
        )
        super().__init__(network, remember=chosen.remember)


@cache
def shipped_network(*, remember: bool) -> GatedNetwork:
    """Return the shipped network that remembers, or the one that forgets."""
    name = "remember.npz" if remember else "forget.npz"
    return read_gated(files(__package__).joinpath("data", name), SESSION_INPUTS)
