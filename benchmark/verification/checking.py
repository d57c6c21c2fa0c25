"""Pre-submission checks: interface, determinism, score, timing."""

import dataclasses
import os
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from colift.agents.real_time import POLICY_SHARE
from colift.agents.spec import AgentSpec
from colift.base.errors import EvaluatorFault
from colift.benchmark.bundle import Results, results
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import CONTROL_PERIOD, Scenario
from colift.benchmark.episode.turns import START
from colift.benchmark.execution.playing import play
from colift.benchmark.execution.runner import Run
from colift.benchmark.results.baselines import (
    HUMAN_HUMAN,
    baseline_specs,
    shipped_baselines,
)
from colift.benchmark.results.headline import headline
from colift.benchmark.results.remarks import clipped_text, unit_remark, worse_remark
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.results.summary import Summary
from colift.benchmark.suites.catalogue import make_scenario
from colift.benchmark.suites.suite import Suite, make_suite
from colift.benchmark.tasks.level.task import LEVEL
from colift.benchmark.verification.audit import audit, audited

SUITE: Final = "quick-v1"
"""The suite of the score by default."""

FEW: Final = 20
"""Largest number of lifts of a suite that is scored as a whole."""

LIFTS: Final = (("smooth", "S1"), ("changing_goal", "S4"))
"""Behaviour and subject of the first lifts."""

SEED: Final = 7000
"""Seed of these lifts, which no suite has."""

INTERFACE: Final = "interface"
"""Name of the check that the policy can be made and reset."""

MACHINE: Final = "machine"
"""Name of the check that reports a failure of this machine, not of the policy."""

MUCH_PRINTED: Final = 5000
"""Output in a lift that deserves a warning [characters]: printing takes time."""


@dataclass(frozen=True, kw_only=True)
class Check:
    """The outcome of one check."""

    name: str
    ok: bool
    message: str
    """The result, or the reason why the check failed."""
    printed: str = ""
    """The end of the policy's output, if it failed."""
    results: Results | None = None
    """The results, if the check is the score."""
    warning: bool = False
    """Whether the check passed with a remark."""


def presubmission_checks(
    policy: AgentSpec,
    fresh: AgentSpec,
    evaluate: Callable[[AgentSpec, Suite], Run],
    suite: Suite | None = None,
) -> Iterator[Check]:
    """Check a policy; the iterator ends early where the rest would add nothing.

    Parameters
    ----------
    policy
        The policy to check.
    fresh
        The same policy, loaded again: in a sandbox, as another instance.
    evaluate
        Plays a suite; see :func:`.run_suite`.
    suite
        The suite whose task the policy plays; :data:`SUITE` by default. For a large suite, the
        score is that of :func:`check_part`.

    Yields
    ------
    Check
        interface, lifts, determinism, score, actions, time; a failure of the machine ends them.
    """
    try:
        yield from _checks(policy, fresh, evaluate, suite or make_suite(SUITE))
    except EvaluatorFault as fault:
        yield Check(name=MACHINE, ok=False, message=f"{fault}; this is no fault of the policy")


def _checks(
    policy: AgentSpec,
    fresh: AgentSpec,
    evaluate: Callable[[AgentSpec, Suite], Run],
    whole: Suite,
) -> Iterator[Check]:
    scenarios = [make_scenario(*names) for names in LIFTS]
    if whole.name != SUITE:
        scenarios = [whole.scenarios[0], whole.scenarios[-1]]
    first = _played(policy, scenarios)
    interface, lifts = _interface(policy, first), _lifts(first)
    yield interface
    if not interface.ok:
        return
    yield lifts
    if not lifts.ok:
        return
    suite = check_part(whole)
    run = evaluate(policy, suite)
    determinism = _determinism(fresh, run)
    yield determinism
    if not determinism.ok:
        return
    content = results(run, shipped_baselines(suite) or _baselines(suite, evaluate))
    yield _score(run, content)
    yield _actions(content.summary)
    yield _time(content.summary, run.episodes)


def checked_with(suite: Suite) -> Suite:
    """Return the suite with which a submission to a board of ``suite`` is checked.

    It is :data:`SUITE` for a level table, else that of the board: a policy of another task plays no
    other.
    """
    return make_suite(SUITE) if suite.scenarios[0].task.name == LEVEL.name else suite


def check_part(suite: Suite) -> Suite:
    """Return a suite of at most :data:`FEW` lifts unchanged, of others two lifts per behaviour.

    Each behaviour has other people, as far as there are enough of them: two if the suite has a
    single seed, else one. Of sessions there are four, whole.
    """
    if suite.size <= FEW:
        return suite
    behaviours: dict[str, list[Scenario]] = {}
    for scenario in suite.scenarios:
        behaviours.setdefault(scenario.behaviour, []).append(scenario)
    people = 4 if suite.session else 2 if len(suite.seeds) == 1 else 1
    return dataclasses.replace(
        suite,
        name=f"{suite.name}, a part",
        scenarios=tuple(
            some[(people * i + k) % len(some)]
            for i, some in enumerate(behaviours.values())
            for k in range(people)
        ),
        seeds=suite.seeds if suite.session else suite.seeds[:2],
    )


def _baselines(suite: Suite, evaluate: Callable[[AgentSpec, Suite], Run]) -> dict[str, ScoreTable]:
    """Return the baselines of the score, played like the policy."""
    return {
        name: ScoreTable.of(
            evaluate(spec, suite.with_partner("human") if name == HUMAN_HUMAN else suite)
        )
        for name, spec in baseline_specs(suite).items()
    }


def _played(policy: AgentSpec, scenarios: Sequence[Scenario]) -> list[Episode]:
    return [episode for scenario in scenarios for episode in play(policy, scenario, (SEED,))]


def _interface(policy: AgentSpec, episodes: Sequence[Episode]) -> Check:
    for episode in episodes:
        if episode.failure is not None and episode.failure.startswith(START):
            message = episode.failure.removeprefix(START)
            return Check(name=INTERFACE, ok=False, message=message, printed=episode.log)
    message = f"has reset(seed) and act(observation); isolation: {policy.isolation}"
    return Check(name=INTERFACE, ok=True, message=message)


def _lifts(episodes: Sequence[Episode]) -> Check:
    for episode in episodes:
        if episode.failure is not None:
            return Check(name="lifts", ok=False, message=_why(episode), printed=episode.log)
    message = ", ".join(f"{e.behaviour}/{e.subject} {e.scores['rmse_mm']:.1f} mm" for e in episodes)
    return Check(name="lifts", ok=True, message=message)


def _determinism(fresh: AgentSpec, run: Run) -> Check:
    """Audit the lifts of the score."""
    finding = audit(fresh, run, os.urandom(32))
    if finding is not None:
        printed = run.episodes[finding.index].log
        return Check(name="determinism", ok=False, message=finding.describe(run), printed=printed)
    count = audited(len(run.episodes))
    message = f"{count} of the lifts again, started afresh in another order: equal to the bit"
    return Check(name="determinism", ok=True, message=message)


def _score(run: Run, content: Results) -> Check:
    message = f"{run.suite.name}, {len(run.episodes)} lifts: {headline(content.summary)}"
    failed = [episode for episode in run.episodes if episode.failure is not None]
    if failed:
        message += f". {len(failed)} failed and count as worst; the first, {_why(failed[0])}"
    worse = "" if failed else worse_remark(content.summary, content.baselines)
    printed = failed[0].log if failed else ""
    return Check(
        name="score",
        ok=not failed,
        message=f"{message}. {worse}" if worse else message,
        printed=printed,
        results=content,
        warning=bool(worse),
    )


def _actions(summary: Summary) -> Check:
    """Report the share of clipped actions."""
    share = summary.metrics["clipped"].mean
    if share is None:
        return Check(name="actions", ok=False, message="the policy never acted")
    message, units = clipped_text(share), unit_remark(summary)
    if units:
        message += f". {units}"
    return Check(name="actions", ok=True, message=message, warning=bool(units))


def _time(summary: Summary, episodes: Sequence[Episode]) -> Check:
    """Report whether a real robot, which does not wait, could run the policy; it need not."""
    p50, p99 = summary.step_ms.p50, summary.step_ms.p99
    if p50 is None or p99 is None:
        return Check(name="time", ok=False, message="no step was completed")
    message = (
        f"a step takes {p50:.3f} ms (median), {p99:.3f} ms (99th percentile): "
        f"{'' if summary.real_time else 'not '}real-time capable "
        f"(a robot waits {1000 * POLICY_SHARE * CONTROL_PERIOD:.0f} ms for an answer)"
    )
    printed = max(len(episode.log) for episode in episodes)
    if printed >= MUCH_PRINTED:
        message += f". It prints over {MUCH_PRINTED} characters in a lift, which takes time"
    return Check(name="time", ok=True, message=message, warning=printed >= MUCH_PRINTED)


def _where(episode: Episode) -> str:
    return f"{episode.behaviour}/{episode.subject} seed {episode.seed}"


def _why(episode: Episode) -> str:
    return f"{_where(episode)}: {episode.failure}"
