"""Knowledge of a rule about a lift: what was drawn before it, and read-outs of its past."""

from typing import Any, Generic, NamedTuple, Protocol

from colift.agents.rules.functions import N_co
from colift.agents.rules.series import Series


class View(Protocol[N_co]):
    """A lift, or n lifts, at the beginning of a step."""

    @property
    def frame(self) -> Any:
        """Frames since the beginning."""

    @property
    def visual(self) -> Any:
        """The person's visual delay in frames."""

    @property
    def haptic(self) -> Any:
        """The person's haptic delay in frames."""

    @property
    def latency(self) -> Any:
        """Age of the motion capture's sample in frames."""

    @property
    def hand(self) -> N_co:
        """Height of the far hands by their encoders now [m]."""

    @property
    def command(self) -> N_co:
        """Command of the far hands now [m]."""

    def seen(self, name: str, age: Any) -> N_co:
        """Return a read-out at the end of a frame, ``age`` frames before the last one.

        Before the beginning it is that of rest.

        Parameters
        ----------
        name
            ``human_end`` and ``robot_end`` [m], ``human_force`` and ``robot_force`` [N],
            ``robot_torque`` [Nm], ``ball_place`` [m]; or a field of the person's own past
            intentions (:meth:`.Person.intend`), such as ``target`` [m].
        age
            A whole number.
        """


class Drawn(NamedTuple, Generic[N_co]):
    """What is drawn before a lift, or before n lifts; it does not change."""

    target: Series[N_co]
    """The planned height of the person's end [m]."""
    series: Any
    """A named tuple of the task's series; see :meth:`.Task.setting`."""
    facts: Any
    """A named tuple of the task's numbers."""
    chance: Any
    """A named tuple of the person's series; see :meth:`.Person.draw`."""
    manner: Any
    """A named tuple of the person's numbers."""
