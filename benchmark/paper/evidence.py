"""The evidence for the report, and its collection."""

import dataclasses
import itertools
from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Final

from colift.agents.control.predictor import PredictorParameters
from colift.agents.humans import Behaviour, Jerky, Pause
from colift.agents.loading.parameters import make_with, read_values
from colift.agents.loading.policy_spec import InMemorySpec, PolicySpec
from colift.agents.spec import AgentSpec
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.execution.runner import Run, run_suite
from colift.benchmark.paper.practice import PRACTICE, PracticeRuns, practice_runs
from colift.benchmark.paper.table_one import FORGETTING_FACTORS
from colift.benchmark.paper.watched import SampledLift, sampled_lifts, watched_blend
from colift.benchmark.results.baselines import human_human_run
from colift.benchmark.suites.suite import Suite
from colift.benchmark.training.q_learning import LearningTrial, learning_trials

PAUSE: Final = Pause(length=(2.0, 2.0), lowering_probability=0.0)
"""Figure 6: a pause of 2 s on the way up."""

LONG_PAUSE: Final = Pause(length=(8.0, 8.0), lowering_probability=0.0)
"""Long enough for the slowest confidence of figure 7 to settle."""

TORQUE_ROBOT: Final = "iiwa"
"""The torque-controlled arm that is compared with the NAO."""

REACTIVE: Final = PolicySpec(text="reactive")


@dataclass(frozen=True, kw_only=True)
class Effort:
    """Largest number of seeds per subject in each experiment beside Table I."""

    pause: int = 10
    rest: int = 4
    jerky: int = 10
    torque: int = 10
    forgetting: int = 4
    timing: int = 2
    practice: int = 10
    periods: tuple[float, ...] = (0.02, 0.05, 0.1)
    """Control periods to compare [s]."""
    latencies: tuple[float, ...] = (0.0, 0.05, 0.1, 0.15)
    """Latencies to compare [s]."""
    learning_trials: int = 60


@dataclass(frozen=True, kw_only=True)
class TimingSetting:
    """One setting of the comparison of control periods and latencies."""

    policy: str
    control_period: float
    """[s]"""
    latency: float
    """[s]"""


@dataclass(frozen=True, kw_only=True, eq=False)
class FreshRuns:
    """Runs at latency 0, the literal reading of the paper."""

    reactive: Run
    """Without prediction."""
    blend: Run
    """With prediction."""


@dataclass(frozen=True, kw_only=True, eq=False)
class TorqueRuns:
    """Runs with :data:`TORQUE_ROBOT`."""

    reactive: Run
    """Without prediction."""
    blend: Run
    """With prediction."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Evidence:
    """The runs behind the report; lifts of the blend policy are watched."""

    reactive: Run
    """Table I without prediction."""
    blend: Run
    """Table I with prediction."""
    fresh: FreshRuns
    """Table I with samples that are taken when the robot decides."""
    lifts: list[SampledLift]
    """The lifts of ``blend``."""
    human_human: Run
    """Two humans on the lifts of Table I."""
    pauses: list[SampledLift]
    """Lifts that stop for 2 s on the way up."""
    rests: list[SampledLift]
    """Lifts that stop for 8 s on the way up."""
    jerky_reactive: Run
    jerky_blend: Run
    """Lifts in irregular submovements."""
    torque: TorqueRuns
    """Some of Table I's lifts with a torque-controlled arm instead of the NAO."""
    forgetting: Mapping[float, Run]
    """Some of Table I's lifts with prediction, by forgetting factor."""
    timing: Mapping[TimingSetting, Run]
    """Some of Table I's lifts, by policy, control period and latency."""
    practice: Mapping[str, PracticeRuns]
    """Some of Table I's lifts before and after practice, by policy: ``reactive`` and ``blend``."""
    learning: list[LearningTrial]
    parameters: PredictorParameters
    """Parameters of the predictor of the blend policy."""


def collect_evidence(
    suite: Suite,
    effort: Effort | None = None,
    *,
    blend: str = "",
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda done: None,
) -> Evidence:
    """Run every experiment.

    Parameters
    ----------
    suite
        The lifts of Table I: one smooth scenario per subject. The other experiments have the same
        subjects and take the first of the same seeds.
    effort
        Size of each experiment.
    blend
        Parameters of the blend policy that differ from its own, ``name=value,name=value``.
    executor, progress
        As for :func:`.run_suite`; :func:`lift_count` is what ``progress`` adds up to.

    Raises
    ------
    InputError
        As :func:`blend_parameters`.
    KeyboardInterrupt
        If it is interrupted; there is no report on an incomplete experiment.
    """
    effort = effort or Effort()
    parameters = blend_parameters(blend)
    watched = watched_blend(parameters, f"blend,{blend}" if blend else "blend")

    def run(policy: AgentSpec, lifts: Suite) -> Run:
        return run_suite(policy, lifts, executor=executor, progress=progress)

    def sampled(lifts: Suite) -> list[SampledLift]:
        return sampled_lifts(run(watched, lifts), parameters)

    def forgets(phi: float) -> InMemorySpec:
        return watched_blend(dataclasses.replace(parameters, forgetting=phi))

    table = run(watched, suite)
    jerky = behaving(suite, "jerky", Jerky(), effort.jerky)
    some = first_seeds(suite, effort.forgetting)
    other_robot = first_seeds(suite, effort.torque).with_robot(TORQUE_ROBOT)
    timings = [
        TimingSetting(policy=policy, control_period=period, latency=latency)
        for policy, period, latency in itertools.product(
            ("reactive", "blend"), effort.periods, effort.latencies
        )
    ]
    fresh = suite.with_timing(0.0, None)
    return Evidence(
        reactive=run(REACTIVE, suite),
        blend=table,
        fresh=FreshRuns(reactive=run(REACTIVE, fresh), blend=run(watched, fresh)),
        lifts=sampled_lifts(table, parameters),
        human_human=human_human_run(suite, executor=executor, progress=progress),
        pauses=sampled(behaving(suite, "pause", PAUSE, effort.pause)),
        rests=sampled(behaving(suite, "pause", LONG_PAUSE, effort.rest)),
        jerky_reactive=run(REACTIVE, jerky),
        jerky_blend=run(watched, jerky),
        torque=TorqueRuns(reactive=run(REACTIVE, other_robot), blend=run(watched, other_robot)),
        forgetting={phi: run(forgets(phi), some) for phi in FORGETTING_FACTORS},
        timing={
            timing: run(
                REACTIVE if timing.policy == "reactive" else watched,
                first_seeds(suite, effort.timing).with_timing(
                    timing.latency, timing.control_period
                ),
            )
            for timing in timings
        },
        practice={
            name: practice_runs(policy, first_seeds(suite, effort.practice), run)
            for name, policy in (("reactive", REACTIVE), ("blend", watched))
        },
        learning=_learn(effort.learning_trials, suite.seeds[0], executor, progress),
        parameters=parameters,
    )


def blend_parameters(text: str) -> PredictorParameters:
    """Return the parameters of the blend policy with those of ``name=value,name=value``.

    Raises
    ------
    InputError
        If the policy has no such parameter, or it cannot have such a value.
    """
    values = read_values(PredictorParameters, text) if text else {}
    parameters: PredictorParameters = make_with(PredictorParameters, values)
    return parameters


def lift_count(suite: Suite, effort: Effort | None = None) -> int:
    """Return the number of lifts and learning trials that :func:`collect_evidence` plays."""
    effort = effort or Effort()
    subjects, seeds = len(suite.scenarios), len(suite.seeds)
    settings = 2 * len(effort.periods) * len(effort.latencies)
    repeated = (
        (5, seeds),
        (1, effort.pause),
        (1, effort.rest),
        (2, effort.jerky),
        (2, effort.torque),
        (len(FORGETTING_FACTORS), effort.forgetting),
        (settings, effort.timing),
        (4, effort.practice),
    )
    lifts = sum(times * min(count, seeds) for times, count in repeated) + 2 * PRACTICE
    return subjects * lifts + effort.learning_trials


def first_seeds(suite: Suite, count: int) -> Suite:
    """Return the suite on the first of its seeds only."""
    return dataclasses.replace(suite, seeds=suite.seeds[:count])


def behaving(suite: Suite, name: str, human: Behaviour, seeds: int) -> Suite:
    """Return a suite of the same subjects, with another behaviour, on the first of the seeds."""
    scenarios = tuple(
        Scenario(behaviour=name, human=human, subject=scenario.subject, task=scenario.task)
        for scenario in suite.scenarios
    )
    return Suite(name=name, scenarios=scenarios, seeds=suite.seeds[:seeds])


def _learn(
    count: int, seed: int, executor: Executor | None, progress: Callable[[int], None]
) -> list[LearningTrial]:
    trials = []
    for trial in learning_trials(count, seed, executor=executor):
        trials.append(trial)
        progress(1)
    return trials
