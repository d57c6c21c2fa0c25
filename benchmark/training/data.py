"""Training data for anticipation: lifts with simulated people, sampled several times."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from colift.agents.agent import FRAME, Agent, RobotObservation
from colift.agents.control.anticipation import Anticipation, FeatureWindow
from colift.agents.policies.anticipate import AnticipateParameters, AnticipationController
from colift.agents.policies.extrapolate import Extrapolate
from colift.agents.senses import MOCAP_NOISE
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.scenario import CONTROL_PERIOD, LATENCY, Scenario
from colift.benchmark.episode.seeding import derive_seed
from colift.benchmark.suites.catalogue import make_scenario, make_subject
from colift.benchmark.tasks.level.task import LEVEL
from colift.benchmark.training.labels import modes, stroke_ends
from colift.benchmark.training.population import UNREGISTERED
from colift.benchmark.world.interface import since_reset
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

Array = NDArray[np.float64]

LEADS: Final = tuple(round(0.05 * i, 2) for i in range(10))
"""Times from now to forecast [s]: the policy's horizon, and a little more."""

LOOKS: Final = 5
"""Number of times at which each period of a lift is sampled, as if the robot had decided then."""

DISTURBANCE: Final = (0.002, 0.6)
"""Size [m] and persistence per step of the random disturbance of the robot's command in half of the
lifts, so that the model can separate reactions to the robot from joint motion."""


@dataclass(frozen=True, kw_only=True)
class Timing:
    """Latency and control period of a robot."""

    latency: float = LATENCY
    """Age of the seen heights [s]."""
    control_period: float = CONTROL_PERIOD
    """Time between two decisions [s]."""


@dataclass(frozen=True, kw_only=True, eq=False)
class TrainingData:
    """Observations and their outcomes; in single precision, as there is a lot of it."""

    inputs: NDArray[np.float32]
    """(n, window.size) inputs of :class:`.FeatureHistory`."""
    outcomes: NDArray[np.float32]
    """(n, leads + 6) height of the human's end above its newest seen height at each of the leads
    [m], the present mode (:func:`.modes`), and the rise until the stroke's end [m]."""

    seeds: NDArray[np.int64]
    """(n,) seed of the lift of each sample."""

    @classmethod
    def join(cls, parts: Sequence["TrainingData"]) -> "TrainingData":
        """Return the parts joined into one."""
        return cls(
            inputs=np.concatenate([part.inputs for part in parts]),
            outcomes=np.concatenate([part.outcomes for part in parts]),
            seeds=np.concatenate([part.seeds for part in parts]),
        )


def scenario(seed: int, behaviours: Sequence[str], timing: Timing) -> Scenario:
    """Return the scenario of a seed: a new person, who moves with one of the behaviours.

    Parameters
    ----------
    seed
        Seed of the person and the lift.
    behaviours
        Names of registered behaviours, and of :data:`.UNREGISTERED`.
    timing
        Latency and control period.
    """
    behaviour, subject = behaviours[seed % len(behaviours)], f"draw-{seed}"
    latency, period = timing.latency, timing.control_period
    human = UNREGISTERED.get(behaviour)
    if human is None:
        return make_scenario(behaviour, subject, control_period=period, latency=latency)
    return Scenario(
        behaviour=behaviour,
        human=human,
        subject=make_subject(subject),
        control_period=period,
        latency=latency,
        task=LEVEL,
    )


def training_data(
    seed: int,
    *,
    model: Anticipation | None,
    window: FeatureWindow,
    behaviours: Sequence[str],
    timing: Timing,
) -> TrainingData:
    """Return the data from the lift of a seed; without a model, the robot extrapolates.

    A lift of a few seconds has some seventy decisions. It is sampled :data:`LOOKS` times as often,
    as if the periods had begun at other frames, each time with new sensor noise.
    """
    lift = Lift(scenario(seed, behaviours, timing))
    lift.reset(seed)
    human = lift.scripted_human()
    robot: Agent = Extrapolate()
    if model is not None:
        robot = AnticipationController(model, AnticipateParameters())
    robot.reset(0)
    rng = np.random.default_rng(derive_seed(seed, "disturbance"))
    size, persistence = DISTURBANCE
    size *= float(rng.random() < 0.5)
    seen, disturbance = [], 0.0
    while not lift.done:
        view = lift.partner_observation()
        seen.append(view[RobotObservation.HUMAN_END])
        before, disturbance = disturbance, persistence * disturbance + rng.normal(0.0, size)
        lift.step(human.act(lift.human_observation()), robot.act(view) + disturbance - before)
    lift.close()

    size_of_step, age = lift.frames_per_step, lift.scenario.latency_frames
    heights = np.array([0.0, *since_reset(lift.world.human_end)])
    doing, ends = modes(heights), stroke_ends(heights)[:, np.newaxis]
    parts = []
    for first in range(0, size_of_step, max(size_of_step // LOOKS, 1)):
        now = np.arange(first, lift.frame, size_of_step)
        human_end = np.array(seen)
        if first > 0:
            human_end = heights[np.maximum(now - age, 0)] + rng.normal(0.0, MOCAP_NOISE, len(now))
        coming = now[:, np.newaxis] + np.round(np.array(LEADS) / FRAME).astype(int)
        rises = np.hstack((heights[np.minimum(coming, lift.frame)], ends[now]))
        rises -= human_end[:, np.newaxis]
        outcomes = np.hstack((rises[:, :-1], doing[now], rises[:, -1:]))
        inputs = window_inputs(human_end, window)
        parts.append(
            TrainingData(
                inputs=inputs.astype(np.float32),
                outcomes=outcomes.astype(np.float32),
                seeds=np.full(len(inputs), seed),
            )
        )
    return TrainingData.join(parts)


def window_inputs(heights: Array, window: FeatureWindow) -> Array:
    """Return the inputs of :class:`.FeatureHistory` in each of n steps, an interval apart.

    Parameters
    ----------
    heights
        (n,) seen height of the human's end in each step [m].

    Returns
    -------
    array
        (n, window.size).
    """
    begun = np.concatenate((np.full(window.velocities, heights[0]), heights))
    past = sliding_window_view(begun, window.size)[:, ::-1]
    return np.hstack((past[:, :1], past[:, :-1] - past[:, 1:]))
