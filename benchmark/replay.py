"""Plays an episode again from its log: without the policy that acted in it."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..agents.actions import ActionError
from ..agents.errors import InputError
from .episode import START
from .lift import Lift
from .recorder import Recorder
from .scores import Scores, score
from .trace import Trace


class ReplayError(InputError):
    """Actions that are not those of an episode."""

    def __init__(self, step: int, message: str) -> None:
        super().__init__(step, message)
        self.step = step
        """The step in which that shows."""
        self.message = message

    def __str__(self) -> str:
        return self.message


@dataclass(frozen=True, kw_only=True, eq=False)
class Replay:
    """What follows from an episode's actions."""

    trace: Trace
    """What happens, without a policy's internals."""
    failure: str | None
    """Why the episode ended early: a drop, or else what was claimed of the policy."""
    scores: Scores
    scripted: NDArray[np.float64]
    """(m, n) what the scripted human does in each step, given what it sees in this replay [m]."""


def replay(
    lift: Lift,
    seed: int,
    human: NDArray[np.float64],
    partner: NDArray[np.float64],
    claimed: str | None,
) -> Replay:
    """Simulate the episode ``seed`` from both agents' actions alone.

    The world obeys the given actions. The scripted human is asked beside them, in each step, what
    it does on seeing this world: a log in which the human did something else is not one of this
    benchmark, however well the rest fits.

    That the table was dropped follows from the actions. That the policy failed does not: it is
    taken as claimed, if the actions end there; the frames that are missing count as the worst.

    Parameters
    ----------
    lift
        The scenario's lift; it is reset here.
    seed
        The episode's seed.
    human, partner
        Actions of the human's end, shape (m, n), and of the robot's end, as :class:`.Trace` has
        them.
    claimed
        The failure that is claimed, or None.

    Raises
    ------
    ReplayError
        If an action cannot be one, if there are more than the episode has steps, or if they end
        too early without the policy having failed.
    """
    lift.reset(seed)
    scripted_human, recorder = lift.scripted_human(), Recorder(lift)
    scripted = np.empty(human.shape)
    for step, (reference, action) in enumerate(zip(human.tolist(), partner.tolist(), strict=True)):
        if lift.done:
            raise ReplayError(step, f"there are {len(human)} actions, the episode has {step} steps")
        try:
            does = scripted_human.act(lift.human_observation())
            lift.step(reference, action)
        except ActionError as error:
            raise ReplayError(step, str(error)) from None
        scripted[step] = does
        recorder.step(reference, action, {})
    failure = _failure(lift, recorder.steps, claimed)
    trace = recorder.trace()
    return Replay(
        trace=trace,
        failure=failure,
        scores=score(lift, trace, failed=failure is not None),
        scripted=scripted,
    )


def _failure(lift: Lift, step: int, claimed: str | None) -> str | None:
    if lift.done:
        return lift.dropped
    begins = (f"step {step}: ", START) if step == 0 else (f"step {step}: ",)
    if claimed is None or not claimed.startswith(begins):
        said = "no failure" if claimed is None else repr(claimed)
        length = lift.horizon // lift.frames_per_step
        raise ReplayError(
            step, f"the actions end, but the episode has {length} steps; claimed is {said}"
        )
    return claimed
