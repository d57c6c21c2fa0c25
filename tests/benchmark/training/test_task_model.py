"""Learning the task model: from demonstrations, and by practice."""

import dataclasses
import sys

import numpy as np
import pytest
from colift.agents.control.adaptive_impedance import Gains, LearnedImpedance
from colift.agents.control.learned_task import load_task, task_json
from colift.base.errors import InputError
from colift.base.registry import SUITES, own_entries
from colift.benchmark.paper.calibration import SEEDS
from colift.benchmark.suites.suite import make_suite
from colift.benchmark.training.demonstrations import (
    FIRST_SEED,
    LIFTS,
    Demonstration,
    demonstrations,
)
from colift.benchmark.training.task_model import (
    COMING,
    PAST,
    TUNING_LIFTS,
    TUNING_SEED,
    fine_tune,
    learn_task,
    windows,
)


def moving(heights, interval=0.1, noise=0.0):
    """Return a demonstration of given heights, by a demonstrator 5 mm below."""
    seen = heights + noise * np.sin(1e3 * np.arange(len(heights)))
    none = np.zeros(len(heights))
    series = np.column_stack((seen, seen, heights, none, heights - 0.005, none))
    times = interval * np.arange(len(heights))
    return Demonstration(lift=0, behaviour="made", subject="up", times=times, series=series)


@pytest.fixture(scope="module")
def lifts():
    return list(demonstrations(24))


@pytest.fixture(scope="module")
def learned(lifts):
    pytest.importorskip("sklearn")
    return learn_task(lifts, components=4)


def test_a_window_is_the_motion_around_a_sample():
    heights = np.array([0.0, 0.0, 0.01, 0.03, 0.06, 0.10, 0.15, 0.21])
    data = windows(moving(heights), 0.1)
    assert data.shape == (len(heights) - COMING, 1 + PAST + COMING)
    assert data[4] == pytest.approx([0.06, 0.3, 0.2, 0.1, 0.0, 0.4, 0.5, 0.6])
    assert data[0] == pytest.approx([0, 0, 0, 0, 0, 0, 0.1, 0.2]), "before, there was rest"


def test_what_is_seen_is_noisy_and_what_follows_is_true():
    """From the seen height the coming velocities lead to the true heights."""
    heights = np.linspace(0.0, 0.2, 30) ** 1.3
    demonstration = moving(heights, interval=0.05, noise=0.001)
    data = windows(demonstration, 0.05)
    assert (data[:, 0] == demonstration["seen_human_m"][:-COMING]).all()
    for ahead in range(1, COMING + 1):
        reached = data[:, 0] + 0.05 * data[:, 1 + PAST : 1 + PAST + ahead].sum(axis=1)
        assert reached == pytest.approx(heights[ahead : len(heights) - COMING + ahead])


def test_a_learned_model_knows_its_demonstrations(lifts, learned):
    """It explains lifts it has not seen better than one Gaussian does, and knows how sure it is."""
    fresh = list(demonstrations(8, FIRST_SEED + 1000))
    data = np.concatenate([windows(each, 0.1) for each in fresh])
    one = learn_task(lifts, components=1)
    errors, spreads, plain = [], [], []
    for row in data:
        mean, covariance, shares = learned.regression(row[: 1 + PAST])
        assert shares.sum() == pytest.approx(1.0)
        assert np.linalg.eigvalsh(covariance).min() > 0
        errors.append(row[1 + PAST :] - mean)
        spreads.append(np.diag(covariance))
        plain.append(row[1 + PAST :] - one.regression(row[: 1 + PAST]).mean)
    assert np.mean(np.square(errors)) < 0.9 * np.mean(np.square(plain))
    within = np.abs(errors) < 2 * np.sqrt(spreads)
    assert 0.9 < within.mean() < 0.99


def test_the_tolerance_is_how_far_apart_the_demonstrators_were(lifts, learned):
    apart = np.concatenate([each["human_m"] - each["partner_m"] for each in lifts])
    assert learned.tolerance == pytest.approx(np.sqrt(np.mean(apart**2)))
    assert 0.005 < learned.tolerance < 0.02


def test_the_interval_is_that_of_the_samples():
    pytest.importorskip("sklearn")
    rng = np.random.default_rng(0)
    made = [moving(np.cumsum(rng.normal(0, 0.01, 100)), interval=0.05) for _ in range(2)]
    task = learn_task(made, components=1)
    assert task.interval == 0.05
    assert task.tolerance == pytest.approx(0.005)
    with pytest.raises(InputError, match=r"must have one interval, got 0.05 to 0.1 s"):
        learn_task([*made, moving(np.zeros(50))], components=1)


def test_learning_twice_gives_the_same_bytes(lifts, learned):
    again = fine_tune(learn_task(lifts, components=4), 2)
    assert task_json(again) == task_json(fine_tune(learned, 2))
    assert task_json(again) != task_json(learned)
    assert again.provenance["fit"]["samples"] == sum(len(each.times) - COMING for each in lifts)


@pytest.mark.slow
def test_practice_learns_the_arm_and_keeps_the_model():
    """From nothing fed forward it finds the arm's lag and sag again, and the stiffness."""
    task = load_task()
    size = len(task.impedance.stiffness)
    ignorant = LearnedImpedance(stiffness=np.ones(size), lead=0.0, offset=0.0)
    told = []
    found = fine_tune(dataclasses.replace(task, impedance=ignorant), 24, progress=told.append)
    assert found.mixture is task.mixture
    assert found.impedance.lead == pytest.approx(task.impedance.lead, abs=0.012)
    assert found.impedance.offset == pytest.approx(task.impedance.offset, abs=0.0005)
    assert found.impedance.stiffness.mean() == pytest.approx(
        task.impedance.stiffness.mean(), abs=0.3
    )
    assert told == [1] * 24
    assert found.provenance["practice"]["lifts"] == 24


def test_effort_makes_it_stiffer():
    """Corrections that cost something are held back."""
    easy, costly = (
        fine_tune(load_task(), 8, gains=Gains(effort=effort)).impedance.stiffness
        for effort in (0.0, 2.0)
    )
    assert costly.mean() > easy.mean() + 0.05


def test_practice_is_on_seeds_of_its_own():
    practice = set(range(TUNING_SEED, TUNING_SEED + TUNING_LIFTS))
    assert practice.isdisjoint(range(FIRST_SEED, FIRST_SEED + LIFTS))
    assert practice.isdisjoint(range(*SEEDS))
    for name in own_entries(SUITES):
        assert practice.isdisjoint(make_suite(name).seeds)


def test_without_the_extra_it_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "sklearn", None)
    with pytest.raises(InputError, match=r"needs scikit-learn: "):
        learn_task([moving(np.zeros(50))])


def test_too_little_to_learn_from_is_refused():
    pytest.importorskip("sklearn")
    with pytest.raises(InputError, match="12 components need at least 120 samples, got 47"):
        learn_task([moving(np.zeros(50))])
    with pytest.raises(InputError, match="got 0"):
        learn_task([moving(np.zeros(3))])
    with pytest.raises(InputError, match="practice must be at least 1 lift, got 0"):
        fine_tune(load_task(), 0)
