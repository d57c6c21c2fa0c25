"""What a policy is checked for before it is submitted: that it works, repeats itself, its score."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final

from ..agents.errors import EvaluatorFault
from .agent_spec import AgentSpec
from .audit import first_difference
from .bundle import results
from .catalogue import make_scenario
from .episode import START, Episode
from .headline import headline
from .references import shipped_references
from .runner import Run
from .scenario import CONTROL_PERIOD
from .suite import Suite, make_suite
from .tasks import play

SUITE: Final = "quick-v1"
"""The suite of the score."""

LIFTS: Final = (("smooth", "S1"), ("changing_goal", "S4"))
"""Behaviour and subject of the lifts that are played twice."""

SEED: Final = 7000
"""Their seed, which no suite has."""


@dataclass(frozen=True, kw_only=True)
class Check:
    """The outcome of one check."""

    name: str
    ok: bool
    told: str
    """What was found, or why it failed."""
    printed: str = ""
    """The end of what the policy printed, if it failed."""
    results: dict[str, Any] | None = None
    """The content of ``results.json``, if the check is the score."""


def check_policy(
    policy: AgentSpec, fresh: AgentSpec, evaluate: Callable[[AgentSpec, Suite], Run]
) -> Iterator[Check]:
    """Check a policy; the iterator ends early where the rest would tell nothing more.

    Parameters
    ----------
    policy
        What is checked.
    fresh
        The same policy, with a process of its own for each episode: nothing is loaded beforehand.
    evaluate
        Plays a suite; see :func:`.run_suite`.

    Yields
    ------
    Check
        interface, lifts, determinism, score, time; a machine that fails ends them.
    """
    try:
        yield from _checks(policy, fresh, evaluate)
    except EvaluatorFault as fault:
        yield Check(name="machine", ok=False, told=f"{fault}; this is no fault of the policy")


def _checks(
    policy: AgentSpec, fresh: AgentSpec, evaluate: Callable[[AgentSpec, Suite], Run]
) -> Iterator[Check]:
    first = _played(policy, LIFTS)
    interface, lifts = _interface(policy, first), _lifts(first)
    yield interface
    if not interface.ok:
        return
    yield lifts
    if not lifts.ok:
        return
    determinism = _determinism(first, _played(fresh, LIFTS[::-1])[::-1])
    yield determinism
    if not determinism.ok:
        return
    suite = make_suite(SUITE)
    run = evaluate(policy, suite)
    if not run.complete:
        told = f"interrupted after {len(run.episodes)} of {suite.size} lifts"
        yield Check(name="score", ok=False, told=told)
        return
    content = results(run, shipped_references(suite) or {})
    yield _score(run, content)
    yield _time(content["summary"])


def _played(policy: AgentSpec, lifts: Sequence[tuple[str, str]]) -> list[Episode]:
    return [
        episode
        for behaviour, subject in lifts
        for episode in play(policy, make_scenario(behaviour, subject), (SEED,))
    ]


def _interface(policy: AgentSpec, episodes: Sequence[Episode]) -> Check:
    for episode in episodes:
        if episode.failure is not None and episode.failure.startswith(START):
            told = episode.failure.removeprefix(START)
            return Check(name="interface", ok=False, told=told, printed=episode.log)
    told = f"has reset(seed) and act(observation); isolation: {policy.isolation}"
    return Check(name="interface", ok=True, told=told)


def _lifts(episodes: Sequence[Episode]) -> Check:
    for episode in episodes:
        if episode.failure is not None:
            return Check(name="lifts", ok=False, told=_why(episode), printed=episode.log)
    told = ", ".join(f"{e.behaviour}/{e.subject} {e.scores.rmse_mm:.1f} mm" for e in episodes)
    return Check(name="lifts", ok=True, told=told)


def _determinism(first: Sequence[Episode], again: Sequence[Episode]) -> Check:
    """Compare the lifts with the same lifts in another order."""
    for one, other in zip(first, again, strict=True):
        step = first_difference(one, other)
        if step is not None:
            told = (
                f"the same lift again ({_where(one)}) goes another way from step {step} on: "
                "actions must follow from the seed and the observations of the lift alone"
            )
            return Check(name="determinism", ok=False, told=told, printed=other.log)
    told = "the same lifts again, started afresh in another order: equal to the bit"
    return Check(name="determinism", ok=True, told=told)


def _score(run: Run, content: dict[str, Any]) -> Check:
    told = f"{run.suite.name}, {len(run.episodes)} lifts: {headline(content['summary'])}"
    failed = [episode for episode in run.episodes if episode.failure is not None]
    if failed:
        told = f"{told}. {len(failed)} failed and count as worst; the first, {_why(failed[0])}"
    printed = failed[0].log if failed else ""
    return Check(name="score", ok=not failed, told=told, printed=printed, results=content)


def _time(summary: dict[str, Any]) -> Check:
    """Tell whether a real robot, which does not wait, could run the policy; it need not."""
    p50, p99 = summary["step_ms"]["p50"], summary["step_ms"]["p99"]
    if p50 is None or p99 is None:
        return Check(name="time", ok=False, told="no step came to an end")
    told = (
        f"a step takes {p50:.3f} ms (median), {p99:.3f} ms (99th percentile): "
        f"{'' if summary['real_time'] else 'not '}real-time capable "
        f"(control period {1000 * CONTROL_PERIOD:.0f} ms)"
    )
    return Check(name="time", ok=True, told=told)


def _where(episode: Episode) -> str:
    return f"{episode.behaviour}/{episode.subject} seed {episode.seed}"


def _why(episode: Episode) -> str:
    return f"{_where(episode)}: {episode.failure}"
