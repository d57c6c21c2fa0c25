"""The settings of analytic policy gradients, without JAX."""

import math
from dataclasses import dataclass, replace
from typing import Final, Literal, get_args

from colift.base.errors import InputError
from colift.benchmark.suites.catalogue import make_task
from colift.benchmark.tasks.level.task import LEVEL
from colift.benchmark.tasks.session.suites import LIFTS
from colift.benchmark.tasks.touch import Touch
from colift.benchmark.training.population import SHARE
from colift.benchmark.training.validation import FEWEST, LEARNING_SEEDS

NAME: Final = "apg"

PARTS: Final = 2
"""Parts of a batch, each in a thread of its own: a fixed number, so that sums keep their order."""

Session = Literal["", "remember", "forget"]

OF_SIGHT: Final = ("unsettled", "encoders", "smoothness", "gentleness", "session")
"""Settings that only the training of a level table uses."""

OF_LIFTS: Final = ("wide", "unsettled", "varied", "smoothness", "gentleness")
"""Settings that the training on sessions does not use."""


@dataclass(frozen=True, kw_only=True)
class ApgSettings:
    """Settings of a training.

    Raises
    ------
    InputError
        If a number is out of range, a setting has no effect, or there is no twin of the task.
    """

    task: str = LEVEL.name
    """Name of the task."""
    updates: int = 800
    """Steps of the optimiser."""
    lifts: int = 4000
    """Lifts drawn at the beginning."""
    batch: int = 256
    """Lifts per update, chosen from those drawn."""
    units: int = 64
    """Gated recurrent units of the network."""
    rate: float = 3e-3
    """Learning rate at its highest. It rises for 5 % of the updates, then falls as a cosine."""
    wide: float = 0.2
    """Share of people from wide ranges; in tasks with touch: their width. For a level table: share
    of lifts with people, bodies and sensors from wide ranges. For tasks with hurdles and poses:
    extension of the ranges of people's manners beyond the population's. With a ball, people always
    have the population's manners, since others fling it about."""
    unsettled: int = SHARE
    """Lifts for every five others in which the hand waits, dips before the lift, halts, or ends off
    its start. Only for a level table."""
    varied: float = 0.2
    """Variation of the robot's arms in the last update. See :meth:`varied_in`."""
    encoders: float = 1e-4
    """Noise of the hand's encoders, in m. It is in the observed height and command of the robot's
    hand, and not in the benchmark: at most the resolution of a NAO's joints (12 bits per turn, at
    0.2 m). Without it a policy learns to rely on micrometres. Only for a level table."""
    smoothness: float = 0.05
    """Weight of the cost of bends beside the RMSE. Only for a level table."""
    gentleness: float = 0.0
    """Cost of the force at the human's hands, in mm/N. Only for a level table."""
    alone: bool = False
    """Blind to the partner, who is seen only to keep level. Only for tasks with touch."""
    session: Session = ""
    """Train on sessions of ten lifts with people who have habits: ``remember`` keeps the units from
    lift to lift, ``forget`` does not. A batch is then of sessions. Only for a level table."""

    def __post_init__(self) -> None:
        """Check the ranges."""
        if self.session not in get_args(Session):
            raise InputError(f"--session must be remember or forget, got {self.session!r}")
        self._check_task()
        if self.session:
            self._check_unused(OF_LIFTS, "sessions")
        self._check_lifts()
        for name in ("updates", "units"):
            if getattr(self, name) < 1:
                raise InputError(f"--{name} must be at least 1, got {getattr(self, name)}")
        if self.batch < PARTS or self.batch % PARTS:
            raise InputError(f"--batch must be a multiple of {PARTS}, got {self.batch}")
        if self.unsettled < 0:
            raise InputError(f"--unsettled must be at least 0, got {self.unsettled}")
        if not 0 <= self.wide < 1:
            raise InputError(f"--wide must be at least 0 and below 1, got {self.wide}")
        for name in ("varied", "encoders", "smoothness", "gentleness"):
            if not 0 <= getattr(self, name) < math.inf:
                raise InputError(f"--{name} must be at least 0, got {getattr(self, name)}")
        if not 0 < self.rate < 1:
            raise InputError(f"--rate must be between 0 and 1, got {self.rate}")

    def _check_task(self) -> None:
        """Check that the task can be learned, with these settings."""
        unused: tuple[str, ...] = ("alone",)
        if make_task(self.task) != LEVEL:
            traits = task_by_rules(self.task).person.traits
            wider = any(trait.wider for trait in traits.values())
            unused = OF_SIGHT if wider else (*OF_SIGHT, "wide")
        self._check_unused(unused, f"the task {self.task!r}")

    def _check_unused(self, names: tuple[str, ...], what: str) -> None:
        """Check that settings without effect on something are as they are by default."""
        for name in names:
            if getattr(self, name) != getattr(ApgSettings, name):
                raise InputError(f"--{name} has no effect on {what}")

    def _check_lifts(self) -> None:
        """Check that there are so many lifts to learn from; of sessions, each has some."""
        each = LIFTS if self.session else 1
        least, most = FEWEST * each, len(LEARNING_SEEDS) * each
        if not least <= self.lifts <= most:
            where = " in sessions" if self.session else ""
            raise InputError(f"--lifts must be {least} to {most}{where}, got {self.lifts}")

    def varied_in(self, update: int) -> float:
        """Return the variation of the arms in an update, of which 0 is the first."""
        return self.varied * (update + 1) / self.updates

    def of_loss(self) -> "ApgSettings":
        """Return the settings that affect the loss of a batch, with defaults for the others."""
        others = ("updates", "rate", "varied")
        return replace(self, **{name: getattr(ApgSettings, name) for name in others})


def task_by_rules(name: str) -> Touch:
    """Return a task that is stated by rules, so that it has a twin.

    Raises
    ------
    InputError
        If there is no such task, or it is not stated by rules.
    """
    task = make_task(name)
    if not isinstance(task, Touch):
        raise InputError(f"the task {name!r} is not stated by rules, so that it has no twin")
    return task


def pair_settings(task: str) -> ApgSettings:
    """Return the settings of the training of a person and a robot together.

    Raises
    ------
    InputError
        If there is no such task, or it has no touch.
    """
    if not make_task(task).touch:
        raise InputError(f"pairs can be trained for tasks with touch; {task!r} has none")
    return ApgSettings(task=task, updates=200, lifts=1000, batch=128, units=32)
