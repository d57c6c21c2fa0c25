"""The same live lift with other partners: two simulated people, and every policy."""

import dataclasses
from collections.abc import Iterator, Mapping
from typing import Any

from colift.agents.humans import Cued
from colift.agents.spec import AgentSpec
from colift.base.errors import EvaluatorFault
from colift.benchmark.episode.scenario import LATENCY, Scenario
from colift.benchmark.execution.playing import play
from colift.benchmark.real_lifts.suites import SEED
from colift.benchmark.results.baselines import SECOND_PERSON_SPEC
from colift.play.rooms.choice import LivePartner, in_frames
from colift.play.rooms.scenarios import ghost_scenario


def ghost_rmse(cue: Cued, number: int) -> float:
    """Return the RMSE of two simulated people with the same cue [mm]."""
    return _rmse(SECOND_PERSON_SPEC, ghost_scenario(cue, number))


def rehearse(partner: LivePartner, scenario: Scenario) -> None:
    """Play the coming cue once, by simulated people or a simulated person and the policy."""
    if partner.spec is None:
        _rmse(SECOND_PERSON_SPEC, dataclasses.replace(scenario, partner="human"))
    else:
        _rmse(partner.spec, scenario)


class Standing:
    """The RMSE of each policy with the hand of a live lift, one after the other.

    A network delays a second person's view, but not a simulated robot's. For a fair comparison the
    policies' view is delayed by the same time.

    Parameters
    ----------
    scenario
        The scenario of the lift, with the recorded hand.
    policies
        The policies by name.
    lag
        Delay that the network added for a second person [s].
    """

    def __init__(
        self, scenario: Scenario, policies: Mapping[str, AgentSpec], lag: float = 0.0
    ) -> None:
        self._latency = in_frames(LATENCY + lag)
        self._scenario = dataclasses.replace(scenario, latency=self._latency)
        self._left: Iterator[tuple[str, AgentSpec]] = iter([*policies.items()])
        self._found: list[dict[str, Any]] = []

    def next(self) -> dict[str, Any] | None:
        """Play one more policy; return the standing when all have been played."""
        for name, spec in self._left:
            try:
                self._found.append({"name": name, "rmse_mm": _rmse(spec, self._scenario)})
            except EvaluatorFault:
                continue  # A policy whose process fails has no place in the standing.
            return None
        people = dataclasses.replace(self._scenario, partner="human")
        return {
            "latency_ms": round(1000 * self._latency),
            "policies": sorted(self._found, key=lambda each: each["rmse_mm"]),
            "human_human_mm": _rmse(SECOND_PERSON_SPEC, people),
        }


def _rmse(spec: AgentSpec, scenario: Scenario) -> float:
    (episode,) = play(spec, scenario, (SEED,))
    return episode.scores["rmse_mm"]
