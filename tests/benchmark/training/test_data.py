"""What is learned from must be what a robot meets: the same inputs, and what came of them."""

import numpy as np
import pytest
from colift.agents.control.anticipation import MODES, FeatureHistory, FeatureWindow
from colift.base.errors import InputError
from colift.benchmark.tasks.level.task import BEHAVIOURS
from colift.benchmark.training import data as module
from colift.benchmark.training.anticipation import collect_training_data
from colift.benchmark.training.data import (
    LEADS,
    Timing,
    TrainingData,
    scenario,
    training_data,
    window_inputs,
)

WINDOW = FeatureWindow(velocities=6)


def lifted(seed, *, behaviours=BEHAVIOURS, timing=None, window=WINDOW):
    return training_data(
        seed, model=None, window=window, behaviours=behaviours, timing=timing or Timing()
    )


def test_inputs_are_those_of_a_robots_senses():
    rng = np.random.default_rng(0)
    human = rng.normal(0.0, 0.1, 30)
    history, seen = FeatureHistory(WINDOW), []
    for time, height in zip(0.1 * np.arange(30), human, strict=True):
        history.add(np.array([height, 0.0, 0.0, 0.0, time]))
        seen.append(history.features())
    assert window_inputs(human, WINDOW) == pytest.approx(np.array(seen), abs=1e-12)


def test_outcomes_are_what_came_of_the_inputs(monkeypatch):
    """The height 0.1 s ahead is the height now, one step later, whatever was seen of it."""
    monkeypatch.setattr(module, "LOOKS", 1)
    found = lifted(100_001)
    now, ahead = LEADS.index(0.0), LEADS.index(0.1)
    height = found.inputs[:, :1] + found.outcomes[:, : len(LEADS)]
    assert height[:-1, ahead] == pytest.approx(height[1:, now], abs=1e-6)
    assert height[0, now] == pytest.approx(0.0, abs=1e-6)
    # What is seen is a latency of one step old, with a millimetre of noise at most.
    assert found.inputs[1:, 0] == pytest.approx(height[:-1, now], abs=1e-3)
    modes = found.outcomes[:, len(LEADS) : -1]
    assert modes.shape[1] == len(MODES)
    assert (modes.sum(axis=1) == 1.0).all()
    end = found.inputs[:, 0] + found.outcomes[:, -1]
    still = modes[:, MODES.index("rest")] == 1.0
    assert end[still] == pytest.approx(height[still, now], abs=1e-6)


def test_a_lift_is_looked_at_from_other_frames_too():
    """Five looks at every period: the heights are those of one and the same lift."""
    found = lifted(100_001)
    steps = len(found.inputs) // 5
    height = found.inputs[:, 0] + found.outcomes[:, 0]
    looks = height[: 5 * steps].reshape(5, -1)
    assert looks.shape == (5, steps)
    between = np.sort(np.stack((looks[0, :-1], looks[0, 1:])), axis=0)
    for look in looks[1:]:
        inside = (look[:-1] >= between[0] - 2e-3) & (look[:-1] <= between[1] + 2e-3)
        assert inside.mean() > 0.9


def test_the_same_seed_gives_the_same_bits_and_another_another_lift():
    one, same, other = lifted(100_002), lifted(100_002), lifted(100_006)
    assert (one.inputs == same.inputs).all()
    assert (one.outcomes == same.outcomes).all()
    assert one.inputs.shape != other.inputs.shape or (one.inputs != other.inputs).any()


@pytest.mark.parametrize("timing", [Timing(latency=0.0), Timing(control_period=0.02, latency=0.2)])
def test_other_timings_are_looked_at_alike(timing):
    window = FeatureWindow(interval=timing.control_period, velocities=6)
    found = lifted(100_003, timing=timing, window=window)
    height = found.inputs[:, 0] + found.outcomes[:, 0]
    assert found.inputs.shape[1] == window.size
    if timing.latency == 0.0:
        assert found.inputs[:, 0] == pytest.approx(height, abs=1e-3)


def test_every_seed_is_another_person_in_one_of_the_ways():
    behaviours = (*BEHAVIOURS, "roaming")
    people = [scenario(seed, behaviours, Timing()) for seed in range(100_000, 100_005)]
    assert {each.behaviour for each in people} == set(behaviours)
    assert len({each.subject for each in people}) == 5


def test_seeds_of_suites_and_of_tests_are_not_learned_from():
    rest = {"model": None, "window": WINDOW, "behaviours": BEHAVIOURS, "timing": Timing()}
    for seeds in (range(5), range(199_999, 200_001)):
        with pytest.raises(InputError, match="seeds for learning are 100000 to 199999"):
            collect_training_data(seeds, **rest)
    with pytest.raises(InputError, match="at least 1 lift"):
        collect_training_data(range(100_000, 100_000), **rest)
    joined = collect_training_data(range(100_000, 100_002), **rest)
    apart = TrainingData.join([lifted(100_000), lifted(100_001)])
    assert (joined.inputs == apart.inputs).all()
