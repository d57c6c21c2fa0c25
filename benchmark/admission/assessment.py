"""The test of admission: all players on all lifts, each criterion, and the negative control."""

from collections.abc import Callable, Mapping
from concurrent.futures import Executor
from dataclasses import asdict, dataclass
from functools import partial
from typing import Any

import numpy as np
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.spec import AgentSpec
from colift.benchmark.admission.blind_reference import BLIND, BlindReference, has_blind_reference
from colift.benchmark.admission.criteria import Criterion
from colift.benchmark.admission.evidence import Evidence
from colift.benchmark.admission.fragility import judged
from colift.benchmark.admission.played import Played
from colift.benchmark.admission.players import HOLD, acts_alone, other_settings, players
from colift.benchmark.admission.published import NOT_COMPARED, compared
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.references.best_known import BestKnown, has_best_known
from colift.benchmark.results.baselines import BEST_KNOWN, HUMAN_HUMAN_LABEL, human_human_run
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.suite import Suite
from numpy.typing import NDArray

Progress = Callable[[int], None]


@dataclass(frozen=True, kw_only=True)
class Admission:
    """The result of the test."""

    suite: str
    digest: str
    means: Mapping[str, float]
    """Mean RMSE of each player [mm]."""
    criteria: tuple[Criterion, ...]
    control: "Admission | None"
    """The result of the negative control; None if it is the control."""

    @property
    def claims(self) -> dict[str, bool]:
        """Whether each claim holds: no criterion of it failed, and none is undecided."""
        claims = dict.fromkeys((each.claim for each in self.criteria), True)
        for each in self.criteria:
            claims[each.claim] &= each.verdict in ("passed", "not compared")
        return claims

    @property
    def passed(self) -> bool:
        """Whether the suite is admitted: its first claim holds, and not for the control."""
        control = self.control is not None and self.control.passed
        return next(iter(self.claims.values())) and not control

    def plain(self) -> dict[str, Any]:
        """Return it as a JSON document, with verdicts and claims."""
        return {
            **asdict(self),
            "criteria": [{**asdict(each), "verdict": each.verdict} for each in self.criteria],
            "control": None if self.control is None else self.control.plain(),
            "claims": self.claims,
            "passed": self.passed,
        }


def cast(suite: Suite) -> dict[str, AgentSpec]:
    """Return the robots that play a suite, by name: policies, settings, references and hold."""
    task = suite.scenarios[0].task.name
    names = players(task)
    settings = [text for name in names for text in other_settings(name)]
    found: dict[str, AgentSpec] = {
        text: PolicySpec(text=text) for text in (HOLD, *names, *settings)
    }
    if has_best_known(suite):
        found[BEST_KNOWN] = BestKnown(task=task)
    if has_blind_reference(task):
        found[BLIND] = BlindReference(task=task)
    return found


def lifts_to_play(suite: Suite) -> int:
    """Return the number of lifts of a test, without those of its control."""
    return (len(cast(suite)) + 1) * suite.size


def admission_of(
    suite: Suite,
    *,
    pairs: NDArray[np.float64] | None = None,
    control: Admission | None = None,
    executor: Executor | None = None,
    progress: Progress = lambda episodes: None,
) -> Admission:
    """Test a suite.

    Parameters
    ----------
    suite
        The suite; every person has lifts with every behaviour.
    pairs
        The result of :func:`.cross_play`; None if no pair was trained.
    control
        The result of the negative control; None if the suite is the control.
    executor, progress
        As for :func:`.run_suite`.

    Raises
    ------
    InputError
        If the suite has too few people or lifts of each, or not all with every behaviour.
    """
    task = suite.scenarios[0].task.name
    names, robots = players(task), cast(suite)
    play = partial(run_suite, suite=suite, executor=executor, progress=progress)
    human_human = human_human_run(suite, executor=executor, progress=progress)
    played = Played.of(
        {HUMAN_HUMAN_LABEL: ScoreTable.of(human_human)}
        | {name: ScoreTable.of(play(spec)) for name, spec in robots.items()}
    )
    references = tuple(name for name in (BEST_KNOWN, BLIND) if name in robots)
    evidence = Evidence(
        played=played,
        policies=names,
        references=references,
        settings=tuple(n for n in robots if n not in (HOLD, *names, *references)),
        alone=frozenset(n for n in names if acts_alone(n)) | ({BLIND} & set(references)),
        idle=HOLD,
        two_people=HUMAN_HUMAN_LABEL,
        pairs=pairs,
        compared=compared(human_human),
        not_compared=NOT_COMPARED.get(task, "nothing was published"),
    )
    return Admission(
        suite=suite.name,
        digest=suite.digest,
        means=played.means,
        criteria=judged(evidence),
        control=control,
    )
