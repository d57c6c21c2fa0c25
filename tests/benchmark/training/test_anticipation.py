import sys

import numpy as np
import pytest
from colift.base.errors import InputError
from colift.benchmark.references import held_out
from colift.benchmark.training.anticipation import fit, learn_anticipation, window_for
from colift.benchmark.training.data import LEADS, Timing, TrainingData

NOISE = 0.05


def known(count, seed=0):
    """Return experience in which one outcome is linear in the inputs, and one is bent; noisy."""
    rng = np.random.default_rng(seed)
    inputs = rng.normal(0.0, 0.05, (count, 3)).astype(np.float32)
    straight = inputs @ np.array([[1.0], [0.5], [-2.0]], np.float32)
    bent = 3.0 * np.abs(inputs[:, :1]) + straight
    outcomes = np.hstack((straight, bent)) + rng.normal(0.0, NOISE, (count, 2)).astype(np.float32)
    return TrainingData(inputs=inputs, outcomes=outcomes, seeds=np.arange(count))


def test_the_fit_finds_the_function_in_the_experience():
    pytest.importorskip("sklearn")
    perceptron, errors = fit(known(30_000), hidden=(16,))
    new = known(4000, seed=1)
    off = np.sqrt(((perceptron(new.inputs) - new.outcomes) ** 2).mean(axis=0))
    assert off == pytest.approx(NOISE, rel=0.1)
    assert errors == pytest.approx(NOISE, rel=0.1)


def test_a_fit_without_hidden_units_is_a_straight_line():
    pytest.importorskip("sklearn")
    perceptron, errors = fit(known(30_000), hidden=())
    ends = perceptron([[0.1, 0, 0], [0.0, 0, 0], [-0.1, 0, 0]])
    assert ends[0] + ends[2] == pytest.approx(2 * ends[1], abs=1e-9)
    assert errors[0] == pytest.approx(NOISE, rel=0.1)
    # |x| of a normal x with deviation d: a line leaves d sqrt(1 - 2 / pi).
    left = 3.0 * 0.05 * np.sqrt(1.0 - 2.0 / np.pi)
    assert errors[1] == pytest.approx(np.hypot(left, NOISE), rel=0.05)


def test_the_same_experience_gives_the_same_bits():
    pytest.importorskip("sklearn")
    one, same = (fit(known(500), hidden=(8,))[0] for _ in range(2))
    assert one.plain() == same.plain()


def test_it_is_learned_in_rounds_of_which_each_has_all_before():
    pytest.importorskip("sklearn")
    done = []
    lessons = list(
        learn_anticipation(lifts=4, rounds=2, hidden=(8,), first_seed=100_100, progress=done.append)
    )
    first, last = lessons
    assert done == [1] * 8
    assert len(last.data.inputs) == last.model.provenance["samples"]
    kept = last.data.inputs[: len(first.data.inputs)]
    assert (kept == first.data.inputs).all()
    assert last.model.provenance["seeds"] == [100_100, 100_107]
    assert len(last.model.provenance["rms_error_mm"]) == len(LEADS)


def test_without_the_library_it_says_what_to_install(monkeypatch):
    monkeypatch.setitem(sys.modules, "sklearn.neural_network", None)
    with pytest.raises(InputError, match="needs scikit-learn: "):
        next(learn_anticipation(lifts=1))


def test_a_faster_robot_looks_back_at_least_as_many_values_and_over_a_second():
    assert window_for(Timing()).velocities == 20
    quick = window_for(Timing(control_period=0.02))
    assert quick.interval * quick.velocities == pytest.approx(1.2)


def test_the_test_has_seeds_of_its_own():
    from colift.benchmark.training.anticipation import FIRST_SEED, LAST_SEED, LIFTS, ROUNDS

    assert FIRST_SEED + ROUNDS * LIFTS <= LAST_SEED < held_out.FIRST_SEED
