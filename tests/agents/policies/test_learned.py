"""`learned` with hands that wait, dip before a lift, or come to rest below their start.

Each lift is a minimum-jerk movement of 0.20 m up and down, apart from the one difference.
"""

from contextlib import closing
from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from colift.agents.humans.plan import assemble, move, still
from colift.agents.humans.stroke import stroke
from colift.agents.loading.policy_spec import PolicySpec
from colift.base.registry import POLICIES, own_entries
from colift.benchmark.episode.lift import Lift
from colift.benchmark.episode.loop import run_episode
from colift.benchmark.episode.scenario import Scenario
from colift.benchmark.suites.catalogue import make_subject
from colift.benchmark.tasks.level.task import LEVEL

pytestmark = pytest.mark.slow

HEIGHT = 0.20
DIPPING, RETURN = 0.6, 0.8
"""Duration of a counter-movement, and of the return from a low end [s]."""

USUAL = (2.1,)
"""Duration of a stroke of the five subjects [s]."""

STROKES = (1.0, 1.8, 2.6)
"""Durations of quick to slow strokes [s]; the quick one needs all of the arm's speed."""

SEEDS = (200_000, 200_001)
"""Of people from whom no policy has learned."""

OTHERS = sorted(set(own_entries(POLICIES)) - {"learned"})


@dataclass(frozen=True, kw_only=True)
class MinimumJerkLift:
    """A lift of minimum jerk, after a wait and a dip, to an end below the start."""

    duration: float
    """Of a stroke [s]."""
    wait: float = 0.0
    """Additional rest before the lift [s]."""
    dip: float = 0.0
    """Depth of a counter-movement before it [m]."""
    low: float = 0.0
    """Depth at which the hand comes to rest, before it returns to its start [m]."""

    def plan(self, subject, seed):
        return assemble(
            still("ready", 0.0, 1.0 + self.wait),
            move("dip", stroke(-self.dip, DIPPING)[0]),
            move("rise", stroke(HEIGHT + self.dip, self.duration)[0] - self.dip),
            still("hold", HEIGHT, 0.5),
            move("lower", HEIGHT + stroke(-HEIGHT - self.low, self.duration)[0]),
            still("low", -self.low, 1.5),
            move("return", stroke(self.low, RETURN)[0] - self.low),
            still("rest", 0.0, 0.5),
        )


@cache
def error_mm(policy, difference="", size=0.0, strokes=USUAL):
    """Return the mean RMSE over strokes and people, in lifts with one difference [mm]."""
    spec, errors = PolicySpec(text=policy), []
    for duration in strokes:
        lift = MinimumJerkLift(duration=duration, **({difference: size} if difference else {}))
        for seed in SEEDS:
            subject = make_subject(f"draw-{seed}")
            scenario = Scenario(behaviour="lift", human=lift, subject=subject, task=LEVEL)
            with closing(Lift(scenario)) as played:
                errors.append(run_episode(played, spec.make(), seed).scores["rmse_mm"])
    return np.mean(errors)


def test_waiting_for_four_seconds_costs_little():
    assert error_mm("learned", "wait", 4.0) <= 1.6 * error_mm("learned")


@pytest.mark.parametrize("difference", ["dip", "low"])
def test_a_dip_or_a_low_end_costs_at_most_three_millimetres(difference):
    assert error_mm("learned", difference, 0.025) <= 3.0


@pytest.mark.parametrize("difference", ["dip", "low"])
@pytest.mark.parametrize("other", OTHERS)
def test_no_other_policy_loses_less_by_a_dip_or_a_low_end(other, difference):
    learned, theirs = (error_mm(each, difference, 0.025, STROKES) for each in ("learned", other))
    assert learned < theirs
