"""Pose by a recurrent network that was learned through the twin."""

from functools import cache
from importlib.resources import files

from colift.agents.tasks.touch.touch_controller import TouchController, read_touch
from colift.agents.tasks.touch.touch_law import TouchNetwork


class PoseLearned(TouchController):
    """Departs from a level table by a recurrent network, learned by gradients (ours).

    128 gated recurrent units remember the lift so far. The network was trained on the score itself,
    by gradients through whole lifts of the twin, with people whose manners were drawn anew for each
    lift (``colift train apg --task intent --updates 4000 --units 128 --lifts 12000 --rate 0.001
    --wide 0.1``). See :func:`.felt_action` for the equations.
    """

    def __init__(self) -> None:
        super().__init__(_shipped())


@cache
def _shipped() -> TouchNetwork:
    return read_touch(files(__package__).joinpath("data", "pose_learned.npz"))
