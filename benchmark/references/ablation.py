"""The value of each part of `anticipate`: the policy without that part, with new people."""

import dataclasses
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
from colift.agents.control.anticipation import FeatureWindow
from colift.agents.policies.anticipate import AnticipateParameters
from colift.benchmark.episode.scenario import CONTROL_PERIOD
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.references.anticipation_spec import AnticipationSpec
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.statistics import Estimate
from colift.benchmark.suites.suite import Suite
from colift.benchmark.tasks.level.task import BEHAVIOURS
from colift.benchmark.training.anticipation import HIDDEN, Lesson, learned
from colift.benchmark.training.data import Timing, TrainingData
from colift.benchmark.training.population import CURRICULUM, SETTLED, UNSETTLED

WHOLE: Final = "nothing: the complete policy"


@dataclass(frozen=True, kw_only=True)
class Variant:
    """The policy without one of its parts."""

    name: str
    """The part that it lacks."""
    window: dict[str, int] = field(default_factory=dict)
    """Differences in the window of its inputs."""
    hidden: Sequence[int] = HIDDEN
    """Units of its hidden layers."""
    first_round: bool = False
    """Whether it learns from the first round only."""
    only: Sequence[str] = CURRICULUM
    """Behaviours of the people that it learns from."""
    parameters: dict[str, Any] = field(default_factory=dict)
    """Differences in its parameters."""

    @property
    def learns(self) -> bool:
        """Whether it has to be fitted anew."""
        return bool(self.window) or self.hidden != HIDDEN or self.only != CURRICULUM


VARIANTS: Final = (
    Variant(name="the non-linearity: a linear map instead of the perceptron", hidden=()),
    Variant(name="the longer history: 0.4 s instead of 2 s", window={"velocities": 4}),
    Variant(name="the second training round", first_round=True),
    Variant(name="roaming people in the training data", only=(*BEHAVIOURS, UNSETTLED)),
    Variant(name="unsettled people in the training data", only=SETTLED),
    Variant(name="the arm's lag", parameters={"arm_lag": 0.0}),
    Variant(name="compensation of the sag", parameters={"sag_memory": 1e9}),
    Variant(
        name="forecast beyond the period, equally smooth",
        parameters={"horizon": CONTROL_PERIOD, "smoothness": 0.2},
    ),
    Variant(name="the cost on changes of slope", parameters={"smoothness": 0.0}),
)
"""Each lacks one part."""


@dataclass(frozen=True, kw_only=True)
class Ablation:
    """Errors of a variant, and its loss relative to the whole."""

    name: str
    rmse_mm: float
    sparc: float
    worse_mm: Estimate | None
    """RMSE minus that of the whole, lift by lift; None for the whole itself."""
    rougher: Estimate | None
    """SPARC of the whole minus that of the variant, over the lifts in which both move along."""


def variants(first: Lesson, last: Lesson, *, seed: int = 0) -> Iterator[AnticipationSpec]:
    """Yield the whole and then each of the :data:`VARIANTS`.

    Parameters
    ----------
    first, last
        Results of the first and the last round of learning.
    seed
        Seed of the fits.
    """
    whole = AnticipationSpec(name=WHOLE, model=last.model)
    yield whole
    window = last.model.window
    for variant in VARIANTS:
        parameters = AnticipateParameters(**variant.parameters)
        model = last.model
        if variant.first_round:
            model = first.model
        elif variant.learns:
            narrow = dataclasses.replace(window, **variant.window)
            data = narrowed(moving(last.data, variant.only), narrow)
            model = learned(data, narrow, Timing(), hidden=variant.hidden, provenance={})
        yield AnticipationSpec(name=variant.name, model=model, parameters=parameters)


def narrowed(data: TrainingData, window: FeatureWindow) -> TrainingData:
    """Return training data for a narrower window: the first inputs only."""
    return dataclasses.replace(data, inputs=data.inputs[:, : window.size])


def moving(data: TrainingData, behaviours: Sequence[str]) -> TrainingData:
    """Return the part of the training data with some behaviours of :data:`.CURRICULUM`."""
    if behaviours == CURRICULUM:
        return data
    chosen = np.isin(data.seeds % len(CURRICULUM), np.flatnonzero(np.isin(CURRICULUM, behaviours)))
    return TrainingData(
        inputs=data.inputs[chosen], outcomes=data.outcomes[chosen], seeds=data.seeds[chosen]
    )


def ablate(
    robots: Iterable[AnticipationSpec],
    suite: Suite,
    *,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> list[Ablation]:
    """Return the scores of the robots on a suite; the first is the whole policy, the reference."""
    found: list[Ablation] = []
    whole: ScoreTable | None = None
    for robot in robots:
        scores = ScoreTable.of(run_suite(robot, suite, executor=executor, progress=progress))
        first, whole = whole is None, whole or scores
        found.append(
            Ablation(
                name=robot.name,
                rmse_mm=scores.mean,
                sparc=float(np.nanmean(scores.values["sparc"])),
                worse_mm=None if first else scores.against(whole).difference,
                rougher=None if first else whole.against(scores, "sparc").difference,
            )
        )
    return found
