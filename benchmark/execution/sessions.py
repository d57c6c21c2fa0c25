"""Lifts in a row with the same person, who remembers those before."""

import dataclasses
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from colift.agents.humans.serial import Serial
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.episode.trace import Trace
from colift.benchmark.suites.suite import Due, Suite


def is_session(lifts: Sequence[Due]) -> bool:
    """Return whether some lifts are those of a session."""
    return isinstance(lifts[0].scenario.human, Serial)


def after(scenario: Scenario, trace: Trace) -> Scenario:
    """Return the scenario of the next lift of a session, after a lift with a trace."""
    human: Any = scenario.human
    following = human.after(trace.human_end.tolist(), trace.robot_end.tolist())
    return dataclasses.replace(scenario, human=following)


def known_lifts(suite: Suite, places: Iterable[int], traces: Mapping[int, Trace]) -> Iterator[Due]:
    """Yield the lifts at some places of a suite, whose people know those of their session before.

    Parameters
    ----------
    suite
        The suite; without sessions, the lifts are those of :meth:`.Suite.at`.
    places
        The places, fastest in the suite's order.
    traces
        The traces by place. An earlier lift of a session that is not there left nothing behind.
    """
    following, scenario = -1, suite.scenarios[0]
    for place in places:
        due = suite.at(place)
        if not suite.session:
            yield due
            continue
        first = place - place % suite.session
        if not first < following <= place:
            following, scenario = first, suite.at(first).scenario
        for earlier in range(following, place):
            scenario = _after(scenario, earlier, traces)
        yield due._replace(scenario=scenario)
        following, scenario = place + 1, _after(scenario, place, traces)


def _after(scenario: Scenario, place: int, traces: Mapping[int, Trace]) -> Scenario:
    """Return the scenario after a lift, of which there may be no trace."""
    if place in traces:
        return after(scenario, traces[place])
    human: Any = scenario.human
    return dataclasses.replace(scenario, human=human.after((), ()))
