"""A trained recurrent network that moves by sight and touch; its weights are in weights.npz."""

from pathlib import Path

from colift.agents.tasks.touch.touch_controller import TouchController, read_touch


class Policy(TouchController):
    """Holds the table by touch, and departs from level by the output of gated recurrent units."""

    def __init__(self) -> None:
        super().__init__(read_touch(Path(__file__).with_name("weights.npz")))
