"""The watched blend policy, and its lifts step by step, with the human's plan."""

import math
from dataclasses import dataclass
from functools import partial

import numpy as np
from colift.agents.agent import Action, Observation, RobotObservation
from colift.agents.control.predictor import PredictorParameters
from colift.agents.humans import Plan
from colift.agents.loading.policy_spec import InMemorySpec
from colift.agents.policies.blend import Blend
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.execution.runner import Run
from colift.benchmark.paper.refilter import Refiltered, refilter
from numpy.typing import ArrayLike, NDArray


class Watched:
    """Acts as the blend policy does; its internals include the ``sample`` on which it acted."""

    def __init__(self, blend: Blend) -> None:
        self._blend = blend

    def reset(self, seed: int) -> None:
        """Begin an episode."""
        self._blend.reset(seed)

    def act(self, observation: Observation) -> Action:
        """Return the action of the blend policy [m]."""
        self._sample = float(observation[RobotObservation.HUMAN_END])
        return self._blend.act(observation)

    def internals(self) -> dict[str, float]:
        """Return the internals of the blend policy and the sample on which it acted [m]."""
        return {**self._blend.internals(), "sample": self._sample}


def watched_blend(parameters: PredictorParameters, name: str = "blend") -> InMemorySpec:
    """Return the specification of the watched blend policy, by the name that tables use."""
    return InMemorySpec(name=name, factory=partial(_watched, parameters), source=Blend)


def _watched(parameters: PredictorParameters) -> Watched:
    return Watched(Blend(parameters=parameters))


Series = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class SampledLift:
    """An episode, described by the samples that the robot got; m steps."""

    scenario: Scenario
    episode: Episode
    plan: Plan
    """The human's plan."""
    parameters: PredictorParameters
    """Parameters of the policy's predictor."""

    @property
    def samples(self) -> Series:
        """(m,) measured height of the human's end [m]."""
        return self.episode.trace.internals["sample"]

    @property
    def confidence(self) -> Series:
        """(m,) confidence in the prediction of the next sample (eq. 7)."""
        return self.episode.trace.internals["confidence"]

    @property
    def predicted(self) -> Series:
        """(m,) prediction of each sample, one step earlier [m]; NaN for the first."""
        return self.one_step_ahead("prediction")

    def one_step_ahead(self, name: str) -> Series:
        """Return an internal, moved to the step in which it can be checked; NaN for the first."""
        return np.concatenate(([np.nan], self.episode.trace.internals[name][:-1]))

    @property
    def refiltered(self) -> Refiltered:
        """The filter of the policy, run again over the samples."""
        return refilter(self.samples, self.scenario.control_period, self.parameters)

    @property
    def errors(self) -> Series:
        """(m,) measured minus predicted height [m]; NaN for the first."""
        return self.samples - self.predicted

    @property
    def sample_frames(self) -> NDArray[np.int64]:
        """(m,) frame that each sample shows, negative before the beginning."""
        scenario = self.scenario
        steps = np.arange(len(self.samples), dtype=np.int64)
        return steps * scenario.frames_per_step - 1 - scenario.latency_frames

    @property
    def speed(self) -> Series:
        """(m,) speed of the human's end when the sample was taken [m/s]."""
        frames = self.sample_frames
        return np.where(frames < 0, 0.0, np.abs(self.episode.trace.human_velocity[frames]))

    def step_showing(self, frame: int) -> int:
        """Return the first step whose sample shows the frame or a later one."""
        scenario = self.scenario
        return math.ceil((frame + 1 + scenario.latency_frames) / scenario.frames_per_step)

    def event(self, name: str) -> int:
        """Return the first frame of the event of that name."""
        return dict(self.plan.events)[name]

    @property
    def first_motion(self) -> int:
        """The first step whose sample shows the human moving."""
        return self.step_showing(self.plan.strokes[0][0])


def sampled_lifts(run: Run, parameters: PredictorParameters) -> list[SampledLift]:
    """Return the lifts of a complete run of :func:`watched_blend`, in its order."""
    remaining = iter(run.episodes)
    found = []
    for scenario in run.suite.scenarios:
        lift = Lift(scenario)
        for seed in run.suite.seeds:
            lift.reset(seed)
            sampled = SampledLift(
                scenario=scenario, episode=next(remaining), plan=lift.plan, parameters=parameters
            )
            found.append(sampled)
        lift.close()
    return found


def rms(values: ArrayLike) -> float:
    """Return the root mean square of the values; missing ones (NaN) are left out."""
    return float(np.sqrt(np.nanmean(np.square(np.asarray(values, dtype=np.float64)))))
