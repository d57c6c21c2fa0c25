"""Learning the reactive controller online, in the world, while the human stands still.

The paper leaves some details open. Here an iteration waits until the measurement reflects the
action (with a measurement one action old the learner credits the wrong action and never converges);
ties are broken at random; no action inclines the table by more than about 8 cm. From a level start
this limit, four whole position steps, keeps the inclinations on a lattice of 2 cm. Convergence
hinges on that: a limit of 9 cm moves differences off the lattice, and no trial converges.
"""

import json
from collections.abc import Iterator
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.agent import FRAME, Observation, RobotObservation
from colift.agents.control.q_learning import ACTIONS, Q_PARAMETERS, QLearner, state_of
from colift.agents.estimators.minimum_jerk import profile
from colift.agents.humans import SUBJECTS, Plan, Subject
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.tasks.level.task import LEVEL
from numpy.typing import NDArray

HEIGHT: Final = 0.13
"""Height at which the human stands still [m]: the middle of the robot's stroke."""

RISE: Final = 3.0
"""Time for both ends to rise there before the learning begins [s]."""

WAIT: Final = 24
"""Control periods to wait after an action. The arm comes to rest within two; the person yields to
the inclined table at first and is back at the old height after some 2 s. The paper's learner was
slow as well: about 5 minutes for 36 iterations, 8 s each."""

TILT_LIMIT: Final = 0.08
"""Largest height difference [m]: an action that would exceed it is carried out only up to this
difference."""


@dataclass(frozen=True, kw_only=True)
class StandingHuman:
    """Rises to a height and stands still there."""

    duration: float
    """Duration of standing still [s]."""

    def plan(self, subject: Subject, seed: int) -> Plan:
        """Return the plan; nothing in it is random."""
        rise = HEIGHT * profile(np.arange(FRAME, RISE, FRAME) / RISE)
        still = np.full(round(self.duration / FRAME), HEIGHT)
        target = np.concatenate((rise, still))
        return Plan(target=target, strokes=((0, len(rise)),), goal=HEIGHT, events=())


@dataclass(frozen=True, kw_only=True, eq=False)
class LearningTrial:
    """One learning phase from an empty Q-table."""

    table: NDArray[np.float64]
    """(states, actions) the Q-table at the end; values in metres of removed height difference."""
    rewards: NDArray[np.float64]
    """(iterations,) reward of each action [m] (eq. 9)."""
    converged_at: int | None
    """Iterations after which the greedy action was right in every state and stayed so; None if it
    was not right at the end."""


def learn(seed: int, *, iterations: int = 100, subject: str = "S1") -> LearningTrial:
    """Run Algorithm 1 for a number of iterations.

    Parameters
    ----------
    seed
        Seed of the sensors, the human and the ties.
    iterations
        Actions to try.
    subject
        Name of the subject who stands still.
    """
    person = SUBJECTS[subject]
    duration = iterations * (1 + WAIT) * 0.1 + 1.0
    standing = StandingHuman(duration=duration)
    lift = Lift(Scenario(behaviour="standing", human=standing, subject=person, task=LEVEL))
    lift.reset(seed)
    table = _Table(lift)
    learner = QLearner(derive_seed(seed, "learner"))
    rewards, right = [], []
    view = table.raise_together()
    for _ in range(iterations):
        difference = table.difference(view)
        state = state_of(difference)
        action = learner.select(state)
        before = table.incline(view)
        change = ACTIONS[action] * Q_PARAMETERS.position_step
        view = table.act(min(max(change, difference - TILT_LIMIT), difference + TILT_LIMIT))
        reward = before - table.incline(view)
        learner.update(state, action, reward, state_of(table.difference(view)))
        rewards.append(reward)
        right.append(learner.right)
    lift.close()
    wrong = np.flatnonzero(~np.array(right))
    settled = int(wrong[-1]) + 1 if len(wrong) else 0
    return LearningTrial(
        table=learner.table,
        rewards=np.array(rewards),
        converged_at=None if settled == iterations else settled + 1,
    )


def table_json(trial: LearningTrial, seed: int) -> str:
    """Return the content of the shipped Q-table, with its origin."""
    content = {
        "table": trial.table.tolist(),
        "provenance": {
            "command": f"colift learn reactive --seed {seed}",
            "iterations": len(trial.rewards),
            "converged_at": trial.converged_at,
        },
    }
    return json.dumps(content, indent=2) + "\n"


def learning_trials(
    count: int, seed: int = 0, *, executor: Executor | None = None
) -> Iterator[LearningTrial]:
    """Yield independent learning trials on the seeds ``seed`` to ``seed + count - 1``, in order."""
    seeds = range(seed, seed + count)
    return map(learn, seeds) if executor is None else executor.map(learn, seeds)


class _Table:
    """The learner's access to the table: act, wait, look."""

    def __init__(self, lift: Lift) -> None:
        self._lift = lift
        self._human = lift.scripted_human()

    def raise_together(self) -> Observation:
        """Follow the human to the height at which the human stands still."""
        for _ in range(round(RISE / 0.1) + 5):
            view = self._lift.partner_observation()
            self._move(view[RobotObservation.HUMAN_END] - view[RobotObservation.HAND_COMMAND])
        return self._lift.partner_observation()

    def act(self, change: float) -> Observation:
        """Move the hand [m], wait, and return the observation after that."""
        self._move(change)
        for _ in range(WAIT):
            self._move(0.0)
        return self._lift.partner_observation()

    def _move(self, change: float) -> None:
        self._lift.step(self._human.act(self._lift.human_observation()), np.array([change]))

    @staticmethod
    def difference(view: Observation) -> float:
        """Return the human's end minus the robot's hand [m], as the reactive controller sees it."""
        return float(view[RobotObservation.HUMAN_END] - view[RobotObservation.HAND_HEIGHT])

    @staticmethod
    def incline(view: Observation) -> float:
        """Return the height difference of the table's ends [m], as in eq. 9."""
        return abs(float(view[RobotObservation.HUMAN_END] - view[RobotObservation.ROBOT_END]))
