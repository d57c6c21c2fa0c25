import itertools
import math

import numpy as np
import pytest
from colift.agents.control.predictor import Predictor, PredictorParameters
from colift.agents.policies.homotopy import Homotopy, HomotopyParameters
from colift.base.errors import InputError


def views(period=0.1, duration=8.0, noise=0.0):
    """Return what is seen of a lift with a pause from 3 to 5 s, by a hand that is somewhere."""
    time = period * np.arange(round(duration / period))
    rng = np.random.default_rng(4)
    human = 0.1 * (np.clip(time, 1, 3) - 1 + np.clip(time, 5, 6) - 5)
    human = human + noise * rng.standard_normal(len(time))
    hand, command = human + rng.uniform(-0.06, 0.06, (2, len(time)))
    return np.column_stack((human, rng.uniform(-1, 1, len(time)), hand, command, time))


def run(parameters, seen):
    """Return the actions, and the internals as arrays."""
    policy = Homotopy(parameters=parameters)
    policy.reset(0)
    actions, told = [], []
    for view in seen:
        actions.append(policy.act(view)[0])
        told.append(policy.internals())
    return np.array(actions), {name: np.array([t[name] for t in told]) for name in told[0]}


def given(*points, **others):
    """Return the parameters of an alpha through (time, alpha) points."""
    times, alphas = zip(*points, strict=True)
    return HomotopyParameters(times=times, alphas=alphas, **others)


def test_the_action_is_the_mixture_by_alpha():
    actions, told = run(None, views(noise=2e-4))
    alpha = told["role"]
    assert actions == pytest.approx(alpha * told["leader"] + (1 - alpha) * told["follower"])
    assert np.ptp(alpha) > 0.5
    assert np.abs(told["leader"] - told["follower"]).max() > 0.02


@pytest.mark.parametrize(("alpha", "name"), [(0.0, "follower"), (1.0, "leader")])
def test_the_ends_are_exactly_the_follower_and_the_leader(alpha, name):
    actions, told = run(given((0.0, alpha)), views())
    assert (actions == told[name]).all()
    assert (told["role"] == alpha).all()


def test_the_leader_goes_to_where_the_human_is_when_the_command_takes_effect():
    # 0.1 m/s, seen 0.1 s late, and the command is there after a period of 0.1 s.
    steady = np.array([[0.01 * k, 0.0, 0.3, 0.05, 0.1 * k] for k in range(60)])
    _, told = run(None, steady)
    assert told["prediction"][-1] == pytest.approx(0.01 * (59 + 2), abs=2e-4)
    assert told["leader"][-1] == pytest.approx(told["prediction"][-1] - 0.05, abs=1e-15)
    _, later = run(HomotopyParameters(latency=0.25), steady)
    assert later["prediction"][-1] == pytest.approx(0.01 * (59 + 3.5), abs=2e-4)


def test_the_leader_disregards_the_table_and_the_follower_the_plan():
    seen = views()
    moved = seen.copy()
    moved[:, 1:3] += 0.03
    _, told = run(None, seen)
    _, other = run(None, moved)
    assert (other["leader"] == told["leader"]).all()
    _, wild = run(HomotopyParameters(latency=0.5), seen)
    assert (wild["follower"] == told["follower"]).all()
    assert np.abs(wild["leader"] - told["leader"]).max() > 0.01


@pytest.mark.parametrize("period", [0.02, 0.1])
def test_the_follower_complies_at_its_rate_whatever_the_period(period):
    gain, policy = 4.0, Homotopy(parameters=given((0.0, 0.0), gain=4.0))
    policy.reset(0)
    hand = 0.0
    for k in range(round(0.6 / period)):
        hand += policy.act(np.array([0.1, 0.0, hand, 0.0, period * k]))[0]
        # The period is known from the second step on.
        if k == 0:
            left = 0.1 - hand
    elapsed = 0.6 - period
    assert 0.1 - hand == pytest.approx(left * math.exp(-gain * elapsed), rel=1e-9)


@pytest.mark.parametrize("period", [0.02, 0.1])
def test_alpha_is_the_given_one(period):
    points = ((1.0, 0.2), (2.0, 1.0), (4.0, 0.0), (6.0, 0.6))
    seen = views(period)
    _, told = run(given(*points), seen)
    times, alphas = zip(*points, strict=True)
    assert told["role"] == pytest.approx(np.interp(seen[:, 4], times, alphas), abs=1e-15)
    # Continuous: the steepest part rises by 0.8 in a second.
    assert np.abs(np.diff(told["role"])).max() == pytest.approx(0.8 * period, rel=1e-9)


@pytest.mark.parametrize("confidence", ["likelihood", "residuals"])
@pytest.mark.parametrize("rate", [0.3, 1.0, 4.0, 1e9])
@pytest.mark.parametrize("period", [0.02, 0.1])
def test_alpha_goes_towards_the_confidence_at_its_rate_at_most(confidence, rate, period):
    predictor = PredictorParameters(confidence=confidence)
    seen = views(period, noise=3e-4)
    _, told = run(HomotopyParameters(rate=rate, predictor=predictor), seen)
    alpha, confidences = told["role"], told["confidence"]
    assert ((alpha >= 0) & (alpha <= 1)).all()
    before = np.concatenate(([0.0], alpha[:-1]))
    limit = rate * np.concatenate(([0.1], np.diff(seen[:, 4])))
    short = np.abs(confidences - before) <= limit
    assert alpha[short] == pytest.approx(confidences[short], abs=1e-12)
    change = np.sign(confidences - before) * limit
    assert (alpha - before)[~short] == pytest.approx(change[~short], abs=1e-12)
    if rate == 1e9:
        assert (alpha == confidences).all()


@pytest.mark.parametrize("confidence", ["likelihood", "residuals"])
def test_the_confidence_is_the_predictors(confidence):
    parameters = PredictorParameters(confidence=confidence, forgetting=0.7)
    predictor = Predictor(parameters)
    predictor.reset()
    seen = views(noise=5e-4)
    _, told = run(HomotopyParameters(predictor=parameters), seen)
    assert told["confidence"].tolist() == [predictor.step(view)[1] for view in seen]


def test_gives_way_at_the_pause_and_comes_back_in_it():
    _, told = run(HomotopyParameters(rate=4.0), views())
    alpha = told["role"]
    assert alpha[29] > 0.9
    assert alpha[31:38].min() < 0.4
    assert alpha[49] > 0.9


def test_begins_as_a_follower():
    _, told = run(None, views())
    assert told["role"][0] == pytest.approx(0.1)
    assert told["confidence"][0] == 1.0


def test_a_reset_forgets():
    seen = views()
    policy = Homotopy()
    policy.reset(0)
    first = [policy.act(view)[0] for view in seen]
    policy.reset(0)
    assert [policy.act(view)[0] for view in seen] == first


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"times": (1.0,)}, "same length, got 1 and 0"),
        ({"times": (1.0, 1.0), "alphas": (0.0, 1.0)}, "increasing"),
        ({"times": (2.0, 1.0), "alphas": (0.0, 1.0)}, "increasing"),
        ({"times": (math.nan,), "alphas": (1.0,)}, "increasing numbers, got"),
        ({"times": (0.0, math.inf), "alphas": (0.0, 1.0)}, "increasing numbers, got"),
        ({"times": (0.0,), "alphas": (1.1,)}, r"in \[0, 1\], got \(1.1,\)"),
        ({"times": (0.0,), "alphas": (math.nan,)}, r"in \[0, 1\]"),
        ({"rate": 0.0}, "rate must be a positive number, got 0.0"),
        ({"rate": math.inf}, "rate must be a positive number, got inf"),
        ({"gain": math.nan}, "gain must be a positive number, got nan"),
        ({"latency": -0.1}, "latency must be a number of at least 0, got -0.1"),
        ({"latency": math.nan}, "latency"),
    ],
)
def test_impossible_parameters_are_refused(values, message):
    with pytest.raises(InputError, match=message):
        HomotopyParameters(**values)


def test_the_roles_differ_when_the_human_moves():
    _, told = run(
        given((0.0, 0.5)), np.array([[0.01 * k, 0, 0.01 * k, 0.01 * k, 0.1 * k] for k in range(60)])
    )
    assert told["leader"][-1] == pytest.approx(0.02, abs=2e-4)
    assert told["follower"][-1] == 0.0


def test_internals_have_always_the_same_names():
    policy = Homotopy()
    policy.reset(0)
    names = []
    for view in views():
        policy.act(view)
        names.append(tuple(policy.internals()))
    assert all(before == after for before, after in itertools.pairwise(names))
