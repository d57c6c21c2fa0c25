"""Re-simulation of an episode from its logged actions, without the policy."""

from dataclasses import dataclass

import numpy as np
from colift.agents.actions import ActionError
from colift.base.errors import InputError
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.metric import Scores
from colift.benchmark.episode.recorder import Recorder
from colift.benchmark.episode.trace import Trace
from colift.benchmark.episode.turns import START
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True, eq=False)
class Simulated:
    """The simulated consequences of an episode's actions, m steps."""

    trace: Trace
    """The trace, without a policy's internals."""
    scripted: NDArray[np.float64]
    """(m, n) the scripted human's action in each step, from its observation in this replay [m]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Replay(Simulated):
    """Everything that follows from an episode's actions."""

    failure: str | None
    """Reason why the episode ended early: a drop, or the claimed failure of the policy; None if it
    did not."""
    scores: Scores


class ReplayError(InputError):
    """Actions that cannot be those of an episode."""

    def __init__(self, step: int, message: str, found: Simulated) -> None:
        super().__init__(step, message, found)
        self.step = step
        """The first step that shows the fault."""
        self.message = message
        self.found = found
        """The simulation up to that step."""

    def __str__(self) -> str:
        return self.message


def replay(
    lift: Lift,
    seed: int,
    human: NDArray[np.float64],
    partner: NDArray[np.float64],
    claimed: str | None,
) -> Replay:
    """Simulate the episode ``seed`` from both agents' actions alone.

    The world follows the given actions. In each step the scripted human also computes its action in
    this world: a log with other human actions is not from this benchmark, even if the rest fits.

    A drop of the table follows from the actions. A failure of the policy does not: the claim is
    accepted if the actions end there, and each missing frame counts with the worst error.

    Parameters
    ----------
    lift
        The scenario's lift; it is reset here.
    seed
        The episode's seed.
    human, partner
        Actions of the human's end, shape (m, n), and of the robot's end, as in :class:`.Trace`.
    claimed
        The claimed failure, or None.

    Raises
    ------
    ReplayError
        If an action is not possible, if there are more actions than the episode has steps, or if
        they end too early although the policy did not fail.
    """
    lift.reset(seed)
    scripted_human, recorder = lift.scripted_human(), Recorder(lift)
    scripted = np.empty(human.shape)
    wrong = None
    for step, (reference, action) in enumerate(zip(human.tolist(), partner.tolist(), strict=True)):
        if lift.done:
            wrong = f"there are {len(human)} actions, the episode has {step} steps"
            break
        try:
            does = scripted_human.act(lift.human_observation())
            lift.step(reference, action)
        except ActionError as error:
            wrong = str(error)
            break
        scripted[step] = does
        recorder.step(reference, action, {})
    steps, trace = recorder.steps, recorder.trace()
    wrong = wrong or _end(lift, steps, claimed)
    if wrong is not None:
        raise ReplayError(steps, wrong, Simulated(trace=trace, scripted=scripted[:steps]))
    failure = lift.dropped if lift.done else claimed
    return Replay(
        trace=trace,
        failure=failure,
        scores=lift.task.score(lift, trace, failed=failure is not None),
        scripted=scripted,
    )


def _end(lift: Lift, step: int, claimed: str | None) -> str | None:
    """Return the fault of actions that end before ``step``, or None."""
    begins = (f"step {step}: ", START) if step == 0 else (f"step {step}: ",)
    if lift.done or (claimed is not None and claimed.startswith(begins)):
        return None
    said = "no failure" if claimed is None else repr(claimed)
    length = lift.horizon // lift.frames_per_step
    return f"the actions end, but the episode has {length} steps; claimed is {said}"
