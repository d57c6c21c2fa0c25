"""Rules of a suite's scenarios and seeds; the first broken one, in words."""

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Any

from colift.agents.humans.serial import Serial
from colift.base.plugins import article, place_of
from colift.benchmark.episode.conformance import behaviour_fault, task_fault
from colift.benchmark.episode.scenario import Scenario


def scenarios_fault(scenarios: Sequence[object]) -> str | None:
    """Return the reason why scenarios cannot form a suite, or None.

    There must be one, with distinct names, and all must have the same task: its metrics are the
    columns of every table.
    """
    if not scenarios:
        return "has no scenario"
    for each in scenarios:
        if not isinstance(each, Scenario):
            return f"must have scenarios, got {article(each)}"
    known = [each for each in scenarios if isinstance(each, Scenario)]
    # Most share their task, and many their behaviour.
    for each in {id(each.human): each for each in known}.values():
        fault = behaviour_fault(each.human)
        if fault is not None:
            return f"has the behaviour {each.behaviour!r} ({place_of(each.human)}), which {fault}"
    for task in {id(each.task): each.task for each in known}.values():
        fault = task_fault(task)
        if fault is not None:
            return f"has a task ({place_of(task)}) that {fault}"
    if len({isinstance(each.human, Serial) for each in known}) > 1:
        return "has sessions and independent lifts: it must have one or the other"
    tasks = list(dict.fromkeys(each.task for each in known))
    if len(tasks) > 1:
        names = [task.name for task in tasks]
        equal = len({*names}) < len(names)
        shown = map(repr, tasks) if equal else names
        return f"must have one task, got {', '.join(shown)}"
    name = _twice(each.name for each in known)
    return None if name is None else f"has the scenario {name!r} twice: names must be distinct"


def seeds_fault(seeds: Iterable[Any]) -> str | None:
    """Return the reason why seeds cannot be a suite's, or None: distinct whole numbers from 0."""
    if not isinstance(seeds, tuple | list):
        return f"must have its seeds in a tuple, got {article(seeds)}"
    if not seeds:
        return "has no seed"
    for seed in seeds:
        if type(seed) is not int or seed < 0:
            return f"must have whole numbers from 0 as seeds, got {seed!r:.80}"
    seed = _twice(seeds)
    return None if seed is None else f"has the seed {seed} twice: seeds must be distinct"


def _twice(values: Iterable[Any]) -> Any:
    """Return the first value that comes more than once, or None."""
    return next((value for value, count in Counter(values).items() if count > 1), None)
