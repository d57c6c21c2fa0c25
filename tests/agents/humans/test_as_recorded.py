"""A recording that is played as recorded, and the shape that both ways of playing share."""

import numpy as np
import pytest
from colift.agents.agent import FRAME
from colift.agents.humans import SUBJECTS, AsRecorded, Recording
from colift.agents.humans.as_recorded import fastest_of, heights_of, recorded_times
from colift.agents.humans.recorded import _retarget
from colift.agents.humans.shape import shape_of
from colift.benchmark.episode.kept_world import lift_in_kept_world
from colift.benchmark.suites.catalogue import make_scenario

from .motion import lift, rows, table

S1 = SUBJECTS["S1"]


def recording(rate=100.0, **changes):
    times, heights = lift(rate, **changes)
    return Recording(name="a", times=tuple(times.tolist()), heights=tuple(heights.tolist()))


@pytest.mark.parametrize("rate", [30.0, 100.0, 240.0, 1000.0])
def test_height_and_pace_are_those_of_the_recording(rate):
    made = recording(rate)
    plan = AsRecorded(recording=made).plan(S1, 0)
    first, times = recorded_times(made, plan)
    heights = np.interp(times, made.times, np.array(made.heights) - made.heights[0])
    assert np.abs(plan.target[first : first + len(times)] - heights)[:-20].max() < 0.0015
    # Beyond the ramps, the pace is the recording's.
    assert np.diff(times)[40:-40] == pytest.approx(FRAME, rel=0.005)
    assert times[-1] == pytest.approx(made.times[-1] - made.times[0])
    assert plan.goal == pytest.approx(heights_of(made)[1], abs=1e-4)
    assert np.abs(np.diff(plan.target)).max() / FRAME == pytest.approx(fastest_of(made), rel=0.02)


def test_a_plan_starts_and_ends_at_rest_with_the_seeds_rests():
    first, second = (AsRecorded(recording=recording()).plan(S1, seed) for seed in (1, 2))
    for plan in (first, second):
        assert plan.target[0] == plan.target[-1] == 0.0
        assert np.abs(np.diff(plan.target, 2)).max() / FRAME**2 < 2.0
    assert len(first.target) != len(second.target)


@pytest.mark.parametrize("changes", [{}, {"top": 0.5}, {"rate": 30.0}, {"top": -0.3}])
def test_a_shape_that_is_scaled_and_slowed_down_is_what_is_played(changes):
    made = recording(**changes)
    shape = shape_of(made)
    assert np.array_equal(shape.played(shape.scale, shape.slow_down), _retarget(made))


def test_a_person_who_moves_as_recorded_adds_nothing(tmp_path):
    path = tmp_path / "lifts.csv"
    path.write_text(table(rows(*lift())))
    scenario = make_scenario(f"as_recorded:{path}")
    assert isinstance(scenario.human, AsRecorded)
    with lift_in_kept_world(scenario) as played:
        played.reset(0)
        person = played.scripted_human()
        for step in range(5):
            references = person.act(played.human_observation())
            assert np.array_equal(references, played.plan.target[10 * step : 10 * step + 10])
            played.step(references, np.zeros(1))
