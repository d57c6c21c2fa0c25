"""Errors of a lift, described by their causes: the task, the behaviour, and their code."""

from collections.abc import Iterator
from contextlib import contextmanager

from colift.base.errors import EvaluatorFault, InputError
from colift.base.plugins import error_at, is_ours, place_of, plugin_frames
from colift.benchmark.episode.conformance import episode_fault, observation_fault, plan_fault
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import Episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.seeding import derive_seed


def behaviour_title(scenario: Scenario) -> str:
    """Return the behaviour of a scenario in words, with its class."""
    return f"behaviour {scenario.behaviour!r} ({place_of(scenario.human)})"


def task_title(scenario: Scenario) -> str:
    """Return the task of a scenario in words, with its class."""
    return f"task {scenario.task.name!r} ({place_of(scenario.task)})"


@contextmanager
def blaming_plugins(scenario: Scenario, seed: int) -> Iterator[None]:
    """Turn the errors of another package's task or behaviour into one that names it.

    Such an error would recur: it is not a failure of the machine.

    Raises
    ------
    InputError
        Instead of an exception that the plan, the task or the behaviour explains.
    """
    try:
        yield
    except (EvaluatorFault, InputError, MemoryError, OSError):
        raise
    except Exception as error:
        cause = _cause(scenario, seed, error)
        if cause is None:
            raise
        raise InputError(cause) from error


def _cause(scenario: Scenario, seed: int, error: Exception) -> str | None:
    """Return an error in words with its cause; None if only colift's own code was involved."""
    human, lift = scenario.human, f"{scenario.name}, seed {seed}"
    fault = plan_fault(human, scenario.subject, derive_seed(seed, f"plan/{scenario.name}"))
    if fault is not None:
        return (
            f"{behaviour_title(scenario)}: plan() of {scenario.subject.name}, seed {seed}, {fault}"
        )
    others = [
        (each, title)
        for each, title in (
            (human, behaviour_title(scenario)),
            (scenario.task, task_title(scenario)),
        )
        if not is_ours(type(each))
    ]
    for each, title in others:
        passed = [name for name, _ in plugin_frames(error, type(each))]
        if passed and (hasattr(each, passed[0]) or len(others) == 1):
            return f"{title}: {passed[0]}() in {lift}, raised {error_at(error, type(each))}"
    if not others:
        return None
    titles = " or ".join(title for _, title in others)
    return f"{titles}: {lift}, cannot be played: {type(error).__name__}: {error}"


def check_start(lift: Lift, seed: int) -> None:
    """Begin an episode, and check its first observations.

    Raises
    ------
    InputError
        If one is not as the task states it; the message names the task.
    """
    lift.reset(seed)
    _check(lift, seed, observation_fault(lift))


def check_episode(lift: Lift, episode: Episode) -> None:
    """Check an episode's outcome.

    Raises
    ------
    InputError
        If scores, series or the failure are not as the task states them; the message names it.
    """
    _check(lift, episode.seed, episode_fault(lift.task.metrics, episode))


def _check(lift: Lift, seed: int, fault: str | None) -> None:
    if fault is not None:
        title = task_title(lift.scenario)
        raise InputError(f"{title}: in {lift.scenario.name}, seed {seed}, {fault}")
