"""The tuning of hand-made policies on people of no suite, so that no baseline is a straw man."""

import dataclasses
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Final

from colift.agents.loading.parameters import parameters_of
from colift.agents.loading.policy_spec import PolicySpec
from colift.agents.loading.values import write_value
from colift.base.errors import InputError
from colift.base.registry import own_policies, policies_by_task
from colift.benchmark.environment.drawing import TRAINING_SEEDS
from colift.benchmark.execution.runner import run_suite
from colift.benchmark.results.scores import ScoreTable
from colift.benchmark.suites.catalogue import make_subject
from colift.benchmark.suites.suite import Suite

PEOPLE: Final = 12
"""People on whom a policy is tuned, and others on whom it is judged."""

ROUNDS: Final = ((0.5, 2.0), (0.7, 1.4), (0.85, 1.2))
"""Factors of each parameter in each round of the search."""

GAIN: Final = 0.995
"""A setting must have at most this share of the best error so far: less is chance."""


@dataclass(frozen=True, kw_only=True)
class Tuned:
    """A policy before and after its tuning."""

    policy: str
    before_mm: float
    after_mm: float
    """Mean RMSE with the people on whom it is judged [mm]."""
    settings: str
    """The parameters that differ from the defaults; empty if tuning is of no use with them."""


def tunings(task: str, names: Sequence[str] | None = None) -> tuple[str, ...]:
    """Return the policies of a task that can be tuned: its own hand-made ones, or some of them.

    Raises
    ------
    InputError
        If there is none, or one of the names is not among them.
    """
    own = own_policies(task)
    known = tuple(
        name for name in policies_by_task().get(task, ()) if name in own and _numbers(name)
    )
    if not known:
        raise InputError(f"the task {task!r} has no policies of its own with parameters to tune")
    for name in names or ():
        if name not in known:
            raise InputError(f"{name!r} cannot be tuned; can be: {', '.join(known)}")
    return tuple(names or known)


def training_people(suite: Suite, first: int, count: int = PEOPLE) -> Suite:
    """Return one lift of each behaviour of a suite with each of some people of no suite.

    Parameters
    ----------
    suite
        The suite.
    first, count
        Place of the first person among :data:`.TRAINING_SEEDS`, and their number.
    """
    ways = {each.behaviour: each for each in reversed(suite.scenarios)}
    seeds = TRAINING_SEEDS[first : first + count]
    scenarios = tuple(
        dataclasses.replace(way, subject=make_subject(f"draw-{seed}"))
        for way in ways.values()
        for seed in seeds
    )
    return Suite(name="training people", scenarios=scenarios, seeds=(seeds[0],))


def tune(
    name: str,
    suite: Suite,
    *,
    people: int = PEOPLE,
    executor: Executor | None = None,
    progress: Callable[[int], None] = lambda episodes: None,
) -> Tuned:
    """Search the numeric parameters of a policy, one after another, by factors.

    Parameters
    ----------
    name
        The policy; see :func:`tunings`.
    suite
        The suite whose behaviours are played, with people of no suite.
    people
        Number of people to tune on; as many others judge.
    executor, progress
        As for :func:`.run_suite`.
    """
    learning = training_people(suite, 0, people)
    judging = training_people(suite, people, people)

    def error(values: dict[str, float], lifts: Suite) -> float:
        """Return the mean RMSE [mm]; infinite if the policy refuses the values."""
        spec = PolicySpec(text=_text(name, values))
        try:
            spec.check()
        except InputError:
            return float("inf")
        return ScoreTable.of(run_suite(spec, lifts, executor=executor, progress=progress)).mean

    defaults = _numbers(name)
    changed: dict[str, float] = {}
    least = error(changed, learning)
    for factors in ROUNDS:
        for key, default in defaults.items():
            now = changed.get(key, default)
            for factor in factors:
                tried = changed | {key: float(write_value(now * factor))}
                found = error(tried, learning)
                if found < GAIN * least:
                    least, changed = found, tried
    before = error({}, judging)
    after = error(changed, judging) if changed else before
    if after >= before:
        return Tuned(policy=name, before_mm=before, after_mm=before, settings="")
    settings = _text(name, changed).partition(",")[2]
    return Tuned(policy=name, before_mm=before, after_mm=after, settings=settings)


def _numbers(name: str) -> dict[str, float]:
    """Return the parameters of a policy that are numbers, but not 0, with their defaults."""
    known = parameters_of(PolicySpec(text=name).load())
    return {
        key: each.default
        for key, each in known.items()
        if type(each.default) is float and each.default != 0.0
    }


def _text(name: str, values: dict[str, float]) -> str:
    given = [f"{key}={write_value(value)}" for key, value in values.items()]
    return ",".join((name, *given))
